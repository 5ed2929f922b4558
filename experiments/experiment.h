// An experiment is one value: a function that lists its cases for a profile, and one that measures a case.
// The .cpp files of each paper's folder define them as `extern const Experiment kName`; registry.cpp lists
// them.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/recorder.h"
#include "terrain/parameters.h"
#include "terrain/progress.h"

namespace terrabench {

// kScale: growth with size, measured at the paper's sizes and kept with the records of that profile.
enum class Profile { kQuick, kPaper, kScale };

struct RunOptions {
  Profile profile = Profile::kQuick;
  std::uint64_t seed = 1;
  std::vector<std::string> terrains;  // names or paths; empty: each experiment uses its own
  std::string renderer = "osmesa";
};

struct Case {
  std::string name;  // unique within the experiment, such as "n=128"; a label, never parsed
  Parameters parameters;
  std::string terrain = "";  // catalogue name or path; empty when the case makes its own ground
  std::vector<std::string> overrides = {};  // "name=value" given by --set; `name` contains them too

  int integer(std::string_view parameter) const { return static_cast<int>(parameters.integer(parameter)); }
};

// Thrown by measure() where a case cannot be measured and nothing is at fault, such as a method on ground
// that it cannot hold. The case is recorded as skipped, with this reason.
struct SkippedCase : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Experiment {
  // Untimed cases record no times (is_timing() of a unit) and may be measured beside each other. Timed ones
  // want the machine to themselves. kOwnProcess: timed, and each case has a process of its own, since its
  // times depend on where in the heap its memory lies, and so on what the process allocated before.
  enum Kind { kUntimed, kTimed, kOwnProcess };

  std::string_view id, title;  // the id is the paper's, a dot and a name: "ght.edits"
  std::span<const ParameterSpec> parameters;
  std::vector<Case> (*cases)(const RunOptions&);
  void (*measure)(const Case&, const RunOptions&, Recorder&, Progress&);
  Kind kind = kUntimed;
  // Of a timed experiment: whether a case, with its --set values, is timed; null: every case is.
  bool (*times)(const Case&) = nullptr;
  bool profile_scale = false;  // measured in the profile kScale, and in no other

  bool timed(const Case& at) const { return kind != kUntimed && (times == nullptr || times(at)); }
  std::string_view paper() const { return id.substr(0, id.find('.')); }
};

std::span<const std::reference_wrapper<const Experiment>> experiments();
// Throws unknown_name, with the nearest id.
const Experiment& experiment(std::string_view id);
// Throws usage_error for a glob that matches no id. If it matches claims, the advice names the experiments
// that measure them.
void demand_experiments(std::span<const std::string> globs);

}  // namespace terrabench
