// Mutation test of the claims: what would a claim say if its method were replaced by a trivial one? Mutants
// replace the metrics that a claim's conditions read, and the conditions are evaluated again. A claim that
// cannot tell the method from a mutant needs another condition, such as a count of the work that was done.
// A figure's own condition holds for every mutant: a trivial method would draw its picture and print its
// numbers as well.
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
  // All of its conditions are figures. Allowed for those from which no number can be read.
  bool pictures_alone = false;
};

// The claims, measured in this store, whose check
// - has conditions on figures alone; or
// - holds when every metric that it reads is 0, is 1 or is not a number: the trivial methods; or
// - reads a metric that no mutant of this metric alone makes it refuse.
// A claim that differs is tried likewise: a trivial method must not pass it. O(claims · operands² · mutants)
std::vector<Survivor> survivors(const Store&, std::span<const Paper>);

}  // namespace terrabench
