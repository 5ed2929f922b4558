// Cases of experiments that differ in one text parameter.
#pragma once

#include <array>
#include <initializer_list>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/experiment.h"

namespace terrabench {

// The names in a table, for choice().
template <class Entry, std::size_t N>
constexpr std::array<std::string_view, N> names_of(const std::array<Entry, N>& table) {
  std::array<std::string_view, N> names;
  for (std::size_t k = 0; k < N; ++k) names[k] = table[k].name;
  return names;
}

// One case per value that the parameter takes, named after it; `given` holds for all of them. Throws as
// Parameters::set() does.
inline std::vector<Case> cases_by(std::string_view parameter, std::span<const ParameterSpec> specs,
                                  std::initializer_list<std::pair<std::string_view, Value>> given = {}) {
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
