// An experiment is one value: what to run in each profile, and a function that measures one case.
// Each .cpp file of a paper's folder exports its own as `extern const Experiment kName`; registry.cpp lists
// them.
#pragma once

#include <cstdint>
#include <functional>
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
  std::string name;  // unique within the experiment, such as "n=128"; a label, never parsed
  Parameters parameters;
  std::string terrain = "";  // catalogue name or path; empty when the case makes its own ground
  std::vector<std::string> overrides = {};  // "name=value" of --set, which the name repeats

  int integer(std::string_view parameter) const { return static_cast<int>(parameters.integer(parameter)); }
};

struct Experiment {
  std::string_view id, title;  // the id begins with the paper: "ght.edits"
  std::span<const ParameterSpec> parameters;
  std::vector<Case> (*cases)(const RunOptions&);
  void (*measure)(const Case&, const RunOptions&, Recorder&, Progress&);

  std::string_view paper() const { return id.substr(0, id.find('.')); }
};

std::span<const std::reference_wrapper<const Experiment>> experiments();
// Throws unknown_name, with the nearest id.
const Experiment& experiment(std::string_view id);

}  // namespace terrabench
