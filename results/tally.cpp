#include "results/tally.h"

#include <fmt/format.h>

namespace terrabench {

std::map<About, VerdictCounts> tally(std::span<const Judgement> judgements) {
  std::map<About, VerdictCounts> counts;
  for (const Judgement& judgement : judgements) ++counts[judgement.claim->about][judgement.verdict];
  return counts;
}

std::string counts_text(const VerdictCounts& counts) {
  std::string text;
  for (const auto& [verdict, count] : counts) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name(verdict));
  }
  return text;
}

}  // namespace terrabench
