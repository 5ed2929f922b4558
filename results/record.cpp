#include "results/record.h"

#include <algorithm>
#include <tuple>

namespace terrabench {

bool comparable(const Provenance& a, const Provenance& b) {
  const auto identity = [](const Provenance& p) {
    return std::tie(p.git_revision, p.git_dirty, p.compiler, p.flags, p.build_type, p.cpu, p.threads, p.simd);
  };
  return identity(a) == identity(b);
}

const Metric* Record::find(std::string_view metric) const {
  const auto it =
      std::find_if(metrics.begin(), metrics.end(), [&](const Metric& m) { return m.name == metric; });
  return it == metrics.end() ? nullptr : &*it;
}

}  // namespace terrabench
