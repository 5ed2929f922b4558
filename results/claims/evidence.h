// The evidence for one claim: each of its conditions, evaluated on the measurements. judge.h derives the
// verdict from it.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "results/claims/claims.h"
#include "results/store/store.h"

namespace terrabench {

// One condition, evaluated.
struct ConditionResult {
  enum class Outcome { kHolds, kFails, kMissing } outcome = Outcome::kMissing;
  std::string text;  // in full: "time 0.12 s [0.11, 0.13], in [0, 1]"
  // In short: the figure that decides ("0.12 s"), what it must be ("[0, 1]", "< 3 s"), and its name ("time"),
  // which begins with the case's if the claim reads several cases.
  std::string value, expected, quantity;
  // From 0, at a bound of the condition, to 1: of several that hold, the one with the least margin says most
  // about the verdict. None: it fails, or knows no distance (margin_in_range() in evidence.cpp).
  std::optional<double> margin = std::nullopt;
};

struct Evidence {
  std::vector<ConditionResult> results;  // one per condition of the claim, in their order
  std::vector<std::string> runs;         // ids of the runs whose records were read
  bool altered = false;                  // one of these records was altered by hand
  bool incomparable = false;             // a ratio, growth or order of times mixes machines or builds
};

// Changes the samples of a condition's operands that are metrics, in their order: what would the claim say of
// a trivial method?
using Mutate = std::function<void(std::span<std::vector<double>> samples)>;

// Reads the records of one profile. Medians decide; a 95 % interval is reported beside each. With `mutate`,
// the evidence is what the claim would say of other measurements.
Evidence gather_evidence(const Claim&, const Store&, const std::string& profile, const Mutate& mutate = {});

}  // namespace terrabench
