// An experiment is data plus one function: what to run in each profile, and how to measure one case of it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/recorder.h"
#include "terrain/parameters.h"
#include "terrain/progress.h"

namespace terrabench {

enum class Profile { kQuick, kPaper };

struct RunOptions {
  Profile profile = Profile::kQuick;
  std::uint64_t seed = 1;
  std::vector<std::string> terrains;  // names or paths; empty: each experiment's own
  std::string renderer = "osmesa";
};

struct Case {
  std::string name;  // unique within the experiment, such as "n=128"
  Parameters parameters;
  std::string terrain;  // catalogue name or path; empty when the case makes its own ground
};

struct Experiment {
  std::string_view id, paper, title;
  std::span<const ParameterSpec> parameters;
  std::vector<Case> (*cases)(const RunOptions&);
  void (*measure)(const Case&, const RunOptions&, Recorder&, Progress&);
};

// The table, one line an experiment: registry.cpp.
std::span<const Experiment> experiments();

}  // namespace terrabench
