// The verdict on every claim, computed from claims and records and nothing else:
// 1. A claim (claims.h, read from experiments/*/claims.toml) has conditions on metrics of named cases.
// 2. gather_evidence (evidence.h) reads these metrics from the records and evaluates each condition. Only
//    records of one profile count, the newest record's unless another is chosen, of each case the newest.
// 3. judge_measured() makes one verdict from the results: missing if one could not be evaluated, differs if
//    one fails, else reproduced ("shape" for claims of class S). Without evidence, judge_claim(): not
//    comparable if the claim gives a reason for it, not run if that profile does not measure the claim.
// 4. Check failures, with which `terrabench check` exits with 1, only on claims that went through
//    judge_measured(): a condition that fails and is not named in the claim's `fails`, one that is named
//    there and holds, a missing measurement, a record altered by hand, a comparison between different
//    machines or builds.
// To follow one verdict: judge_claim() and judge_measured() in judge.cpp, then evidence.cpp from its end.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "results/claims/evidence.h"
#include "results/store/absences.h"

namespace terrabench {

// The verdict on one claim.
struct Judgement {
  const Paper* paper = nullptr;
  const Claim* claim = nullptr;
  Verdict verdict = Verdict::kNotRun;  // until judge_claim() finds another
  std::string measured;                // the results in full; or why nothing was measured
  std::string stated;                  // that on the first condition, which is what the claim states
  // Decides the verdict: the first condition that was not measured, else the first that fails, else the one
  // with the least margin (ConditionResult::margin). Conditions without margin (equalities, pictures, ranges
  // of one value, a lower bound of 0 alone) decide only if an exact claim begins with one, or if no other has
  // margin. Empty if nothing was measured.
  ConditionResult deciding;
  std::size_t deciding_condition = 0;  // its index in the claim's conditions
  std::vector<std::string> runs;       // ids of the runs that it rests on
  std::string check_failure;           // why `check` fails at this claim; empty when it does not
};

struct JudgedResults {
  std::string profile;                        // that was judged
  std::vector<Judgement> judgements;          // by paper, in the claims' order
  std::vector<std::string> warnings, faults;  // of the store and of the pictures that its records drew
  std::vector<Absence> absences = {};         // cases of the profile without measurements, and why
  // "18 cases of profile paper are not read; --profile paper reads them instead": for each other profile in
  // the folder.
  std::vector<std::string> ignored = {};
  std::size_t left_out = 0;  // claims that were not asked for, since an experiment that they read was not run

  bool passed() const;  // some claim was judged by measurements; no check failure, no fault, no failed case
  std::span<const Judgement> of(const Paper&) const;
};

// Which claims of a folder that lacks whole experiments are judged.
enum class Demand {
  kAll,  // all: claims of experiments without records are missing, and fail, except those of profile scale
  kRun,  // those of whose experiments there is any record
};

// Judges the claims whose id matches one of the globs (* and ?), or all when there are no globs, on the
// records of the store's profile. The papers must outlive the result. Throws as Store::open(), and
// usage_error when a glob matches no claim.
JudgedResults judge(const std::filesystem::path& folder, std::span<const std::string> globs = {},
                    const std::string& profile = "", Demand = Demand::kAll);
JudgedResults judge(const Store&, std::span<const Paper>, std::span<const std::string> globs = {},
                    Demand = Demand::kAll);

}  // namespace terrabench
