#include "experiments/cases.h"

#include <string>

namespace terrabench {

std::vector<Case> cases_by(std::string_view parameter, std::span<const ParameterSpec> specs,
                           std::initializer_list<std::pair<std::string_view, Value>> given) {
  std::vector<Case> cases;
  for (const ParameterSpec& spec : specs) {
    if (spec.name != parameter) continue;
    for (const std::string_view value : spec.allowed) {
      Case& added = cases.emplace_back(Case{std::string(value), Parameters(specs, given)});
      added.parameters.set(parameter, added.name);
    }
  }
  return cases;
}

}  // namespace terrabench
