// Runs cases of experiments and keeps each record as soon as it is measured: one case after another, untimed
// ones also beside each other, and those of Experiment::kOwnProcess in a process each.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "terrain/error.h"

namespace terrabench {

struct PlannedCase {
  const Experiment* experiment;
  Case at;
};

enum class Part { kAll, kTimed, kUntimed };  // which cases: see Experiment::timed()

struct RunPlan {
  // Experiment ids or globs (* and ?), then, if only some of their cases are wanted, those cases' names or
  // globs. Empty: all.
  std::vector<std::string> patterns;
  RunOptions options;
  std::vector<std::string> assignments;  // name=value,…, for every case that has such a parameter
  std::filesystem::path folder = "out";
  bool resume = false;  // skip cases that the folder already holds, unless they failed
  Part part = Part::kAll;
  int shard = 1, shards = 1;          // measure only every shards-th case of the part, from the shard-th
  int threads = 0;                    // in use, for the provenance; 0: all
  int jobs = 1;                       // untimed cases beside each other, with threads ÷ jobs threads each
  std::vector<std::string> command;   // argv, for the provenance
  std::string terrain_checksum = {};  // of the terrains; to resume: cases of another content are not kept
  // Estimated seconds per case, 0 if not known, for printing the total and the remaining time. Empty: those
  // of the reference run.
  std::function<double(const PlannedCase&)> seconds = {};
};

// Exit code of a run of which some cases failed; the others are measured.
inline constexpr ExitCode kCasesFailed{5};

// The cases a plan names, in the registry's order. Throws usage_error when a pattern matches nothing (with
// the nearest name), the profile measures none of the experiments, or an assignment fits no parameter of any.
std::vector<PlannedCase> plan_cases(const RunPlan&);

// Seconds that a case should add to the run; 0: unknown.
double expected_seconds(const RunPlan&, const PlannedCase&);

// Measures all planned cases and appends their records to folder/measurements.jsonl. A case that fails or
// cannot be measured is recorded as such, with the reason, and does not end the run: kCasesFailed then says
// that some failed, and a list at the end names them. Only what all cases would meet ends it
// (MachineError): an interruption, a full disk, no OpenGL. In three parts: with jobs > 1 the untimed ones,
// beside each other in `jobs` processes, in the order in which they end; those of Experiment::kOwnProcess,
// one after another; the others, one after another. The last two parts keep the registry's order. Throws
// Error(kInterrupted) on Ctrl-C and keeps the records written so far. Call it before this process has threads
// (run_in_processes()).
ExitCode run(const RunPlan&);

}  // namespace terrabench
