// The sentences of ranking.h.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <utility>

#include "results/claims/ranking.h"
#include "results/store/format.h"

namespace terrabench {
namespace {

// Clauses become a sentence.
void finish(std::string& text) {
  text += ".";
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
}

// "1.3 [1.2, 1.4]"; the interval is left out where there is none. The figures have three digits.
std::string factor_text(const Summary& factor) {
  if (factor.low == factor.high) return format_number(factor.median);
  return fmt::format("{} [{}, {}]", format_number(factor.median), format_number(factor.low),
                     format_number(factor.high));
}

// Of a ranking with two places or more: by which the best is ahead of the next, or that of the last of
// several that are not behind it.
const Summary& factor_of(const Ranking& ranking) {
  return ranking.places[ranking.tied > 1 ? ranking.tied - 1 : 1].factor;
}

}  // namespace

std::string Ranking::result() const {
  if (places.empty()) return "none";
  if (!not_compared.empty()) return "not compared, as " + not_compared;
  std::vector<std::string> named;  // those that are not behind the best, and at least the first two
  for (const Place& p : places) {
    if (named.size() >= std::max<std::size_t>(tied, 2)) break;
    named.push_back(fmt::format("{} ({})", p.label, format_quantity(printed(p.value, timed), layout->unit)));
  }
  if (named.size() == 1) return named[0] + " alone";
  const std::string factor = factor_text(factor_of(*this)), all = list_of(named, ", ", " and ");
  if (tied == 1) return fmt::format("{}, ahead of {} by a factor of {}", named[0], named[1], factor);
  if (too_few) {
    return fmt::format("undecided, as they were measured fewer than {} times: {}, a factor of {}",
                       kFewestSamples, all, factor);
  }
  if (undecided) return fmt::format("undecided between {}, a factor of {}", all, factor);
  return all + " are tied" + (factor == "1" ? "" : ", within a factor of " + factor);
}

std::vector<std::string> Ranking::best() const {
  std::vector<std::string> labels;
  if (!decided()) return labels;
  for (std::size_t i = 0; i < tied; ++i) labels.push_back(places[i].label);
  std::ranges::sort(labels);
  return labels;
}

std::vector<std::string> Ranking::contenders() const {
  std::vector<std::string> labels;
  if (places.empty() || !not_compared.empty() || !undecided || too_few) return labels;
  for (std::size_t i = 0; i < tied; ++i) labels.push_back(places[i].label);
  std::ranges::sort(labels);
  return labels;
}

std::string Ranking::lead() const {
  if (!decided()) return "–";
  if (places.size() == 1) return "alone";
  return tied > 1 ? "tied" : format_number(places[1].factor.median) + " ×";
}

std::string Ranking::reason() const {
  if (places.empty()) return "no method comes within that error";
  if (!not_compared.empty()) return "not compared, as " + not_compared;
  const auto value_of = [&](const Place& p) {
    const double value = printed(p.value, timed);
    if (layout->unit != "1/s") return format_quantity(value, layout->unit);
    return value < 1e6 ? format_number(value) + " per second"
                       : format_number(value / 1e6) + " million per second";
  };
  if (places.size() == 1) return fmt::format("{}; no other method has a value", value_of(places[0]));
  if (tied == 1)
    return fmt::format("{} against {} ({})", value_of(places[0]), value_of(places[1]), places[1].label);
  std::vector<std::string> all;
  for (std::size_t i = 0; i < tied; ++i) all.push_back(places[i].label + " " + value_of(places[i]));
  const std::string values = list_of(all, ", ", ", ");
  if (too_few) return fmt::format("measured fewer than {} times: {}", kFewestSamples, values);
  return undecided ? "the samples vary too much to tell apart " + values : values;
}

std::string Ranking::clause() const {
  const std::string text = layout->where + ": " + result();
  return left_out.empty() ? text : fmt::format("{} (left out: {})", text, list_of(left_out, ", ", " and "));
}

std::string tie_rule() {
  return fmt::format(
      "A method led if that factor is at least a margin and its 95 % interval lies above 1; methods are tied "
      "if the whole interval lies within the margin on both sides of 1; else, and for times taken fewer than "
      "{} times, it is undecided. The margin is {} for times and rates, since two thirds of them change by "
      "less between two runs on one machine, {} for the sizes and errors of files, since two searches with "
      "different seeds differ by as much, and {} for all else, since a smaller lead is no reason to choose a "
      "method. Factors are rounded to three digits first.",
      kFewestSamples, kTimingMargin, kSearchMargin, kExactMargin);
}

Facts findings(std::span<const Ranking> rankings) {
  Facts facts;
  const std::string* task = nullptr;
  for (const Ranking& ranking : rankings) {
    if (task == nullptr || *task != ranking.layout->task) {
      task = &ranking.layout->task;
      const std::string& needs = ranking.layout->needs_text;
      facts.lines.emplace_back(*task, needs.empty() ? "" : needs + ", ");
    } else {
      facts.lines.back().second += "; ";
    }
    facts.lines.back().second += ranking.clause();
  }
  for (auto& [name, text] : facts.lines) finish(text);
  return facts;
}

std::string findings_json(std::span<const Ranking> rankings) {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  for (const Ranking& ranking : rankings) {
    const RankingLayout& layout = *ranking.layout;
    Json places = Json::array();
    for (const Ranking::Place& p : ranking.places) {
      places.push_back({{"label", p.label},
                        {"value", p.value},
                        {"factor", p.factor.median},
                        {"factor_low", p.factor.low},
                        {"factor_high", p.factor.high}});
    }
    list.push_back({{"id", layout.id},
                    {"task", layout.task},
                    {"where", layout.where},
                    {"table", layout.table},
                    {"question", layout.question},
                    {"ground", layout.ground},
                    {"experiment", layout.experiment},
                    {"metric", layout.metric},
                    {"unit", layout.unit},
                    {"best", layout.most ? "most" : "least"},
                    {"needs", layout.needs_text},
                    {"left_out", ranking.left_out},
                    {"places", places},
                    {"margin", ranking.margin},
                    {"tied", ranking.places.empty() ? 0 : ranking.tied},
                    {"undecided", ranking.undecided},
                    {"too_few_samples", ranking.too_few},
                    {"comparable", ranking.not_compared.empty()},
                    {"finding", ranking.clause()},
                    {"runs", ranking.runs}});
  }
  return list.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace terrabench
