#include "results/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "terrain/error.h"

namespace terrabench {
namespace {

struct Unit {
  std::string_view name, kind;
  double size;
};

// Sizes are whole multiples of the smallest unit of the kind, so that no factor is rounded twice.
constexpr Unit kUnits[] = {{"s", "time", 1e9},   {"ms", "time", 1e6}, {"µs", "time", 1e3},
                           {"ns", "time", 1},    {"B", "bytes", 1},   {"kB", "bytes", 1e3},
                           {"MB", "bytes", 1e6}, {"GB", "bytes", 1e9}};

}  // namespace

double conversion(std::string_view from, std::string_view to, std::string_view metric,
                  std::string_view where) {
  if (from == to) return 1;
  const auto find = [](std::string_view name) {
    return std::find_if(std::begin(kUnits), std::end(kUnits), [&](const Unit& u) { return u.name == name; });
  };
  const Unit *const a = find(from), *const b = find(to);
  // Counts may be shown without the name of what is counted, ratios with ×.
  if ((to.empty() && a == std::end(kUnits)) || (from.empty() && to == "×")) return 1;
  if (a == std::end(kUnits) || b == std::end(kUnits) || a->kind != b->kind) {
    throw bad_input(fmt::format("'{}' was measured in '{}' and cannot be shown in '{}'", metric, from, to),
                    where, "measure again into a new folder, or correct the unit in the claims file");
  }
  return a->size / b->size;
}

}  // namespace terrabench
