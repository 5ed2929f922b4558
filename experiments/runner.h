// Runs cases of experiments one after another and keeps each record as soon as it is measured.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/experiment.h"

namespace terrabench {

struct RunPlan {
  std::vector<std::string> patterns;  // experiment ids or globs (* and ?); empty: all
  RunOptions options;
  std::vector<std::string> assignments;  // name=value,…, for every case that has such a parameter
  std::filesystem::path folder = "out";
  bool resume = false;               // skip cases that the folder already holds
  int shard = 1, shards = 1;         // measure only every shards-th case, from the shard-th
  int threads = 0;                   // in use, for the provenance; 0: all
  std::vector<std::string> command;  // argv, for the provenance
};

// The cases a plan names, in the registry's order. Throws usage_error when a pattern matches nothing (with
// the nearest id) or an assignment fits no parameter of any chosen experiment.
struct PlannedCase {
  const Experiment* experiment;
  Case at;
};
std::vector<PlannedCase> plan_cases(const RunPlan&);

// Measures all planned cases and appends their records to folder/measurements.jsonl. Throws
// Error(kInterrupted) on Ctrl-C; the records so far stay.
void run(const RunPlan&);

}  // namespace terrabench
