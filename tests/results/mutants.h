// Mutation test of the claims: what would a claim say if its method were replaced by a trivial one? Mutants
// replace the metrics that a claim's conditions read, and the conditions are evaluated again. A claim that
// cannot tell the method from a mutant needs another condition, such as a count of the work that was done.
// Claims that read pictures alone (evidence.h) are left out.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "results/claims/claims.h"
#include "results/store/store.h"

namespace terrabench {

// What a metric is replaced by.
enum class Mutant {
  kZero,     // flat terrain, an empty set, an error that was never measured
  kOne,      // identity, or one of everything
  kOther,    // another metric of the condition: the method does not depend on the case
  kTenfold,  // × 10
  kTenth,    // ÷ 10
  kNan,      // with which no comparison holds
};
std::string_view name(Mutant);

struct Survivor {
  const Claim* claim = nullptr;
  std::string reason;  // why the check is too weak
};

// The claims, measured in this store, that read more than pictures and whose check
// - holds when every metric that it reads is 0, is 1 or is not a number: the trivial methods; or
// - reads a metric that no mutant of this metric alone makes it refuse.
// A claim that differs is tried likewise: a trivial method must not pass it. O(claims · operands² · mutants)
std::vector<Survivor> survivors(const Store&, std::span<const Paper>);

}  // namespace terrabench
