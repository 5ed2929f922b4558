#include "results/store/record.h"

namespace terrabench {

std::string_view name(CaseOutcome outcome) {
  constexpr std::string_view kNames[] = {"measured", "failed", "skipped"};
  return kNames[static_cast<std::size_t>(outcome)];
}

std::optional<WhyAbsent> Record::why_absent(std::string_view metric) const {
  if (outcome != CaseOutcome::kMeasured) return WhyAbsent{name(outcome), reason};
  const auto it = std::ranges::find(undefined, metric, &std::pair<std::string, std::string>::first);
  return it == undefined.end() ? std::nullopt : std::optional(WhyAbsent{"not defined", it->second});
}

}  // namespace terrabench
