#include "results/record.h"

#include <algorithm>

namespace terrabench {

const Metric* Record::find(std::string_view metric) const {
  const auto it =
      std::find_if(metrics.begin(), metrics.end(), [&](const Metric& m) { return m.name == metric; });
  return it == metrics.end() ? nullptr : &*it;
}

}  // namespace terrabench
