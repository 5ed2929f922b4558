// Which cases a plan names (runner.h).
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "experiments/runner.h"
#include "results/store/glob.h"
#include "results/store/record_json.h"
#include "terrain/parameters.h"
#include "terrain/source.h"

namespace terrabench {
namespace {

// Reports a missing file before anything is measured, not hours later.
void check_terrain(const std::string& terrain) {
  std::error_code error;
  const std::string file = terrain_file(terrain);
  const bool virtual_file = file.starts_with("/vsi") || file.starts_with('<');
  if (!file.empty() && !virtual_file && !std::filesystem::exists(file, error)) {
    throw bad_input("no such file", file, "check the path, or see `terrabench list terrains`");
  }
}

// Two names of one file would give two columns of the same figures.
void check_terrains(const std::vector<std::string>& terrains) {
  for (const std::string& terrain : terrains) check_terrain(terrain);
  for (std::size_t k = 0; k < terrains.size(); ++k) {
    for (std::size_t first = 0; first < k; ++first) {
      std::error_code ignored;  // names of the catalogue are no files
      if (terrains[k] != terrains[first] &&
          !std::filesystem::equivalent(terrains[k], terrains[first], ignored))
        continue;
      throw usage_error(fmt::format("'{}' is given twice", terrains[k]), "--terrain",
                        "name each terrain once");
    }
  }
}

// Names become parts of records: refuses what a record cannot hold before anything is measured.
void check_names(const std::vector<PlannedCase>& cases) {
  for (const PlannedCase& planned : cases) {
    const std::string fault = name_fault(planned.at.name);
    if (fault.empty()) continue;
    throw usage_error("the name of a case " + fault, planned.at.name,
                      planned.at.terrain.empty()
                          ? "shorten the values of --set"
                          : "rename the file, or name it by a shorter path, such as a link");
  }
}

void apply(const std::vector<std::string>& assignments, std::vector<PlannedCase>& cases) {
  for (const std::string& assignment : assignments) {
    const std::string name = assignment.substr(0, assignment.find('='));
    bool used = false;
    for (PlannedCase& planned : cases) {
      if (!planned.at.parameters.has(name)) continue;
      planned.at.parameters.set_from_text(assignment);
      planned.at.name += fmt::format(" ({})", assignment);
      planned.at.overrides.push_back(assignment);
      used = true;
    }
    if (used) continue;
    std::vector<std::string_view> known;
    for (const PlannedCase& planned : cases) {
      for (const ParameterSpec& spec : planned.experiment->parameters) {
        if (std::find(known.begin(), known.end(), spec.name) == known.end()) known.push_back(spec.name);
      }
    }
    throw unknown_name("parameter", name, known);
  }
}

// A plan's words: globs of experiments; words that match no experiment are globs of their cases. Throws
// usage_error if no word matches an experiment.
struct Choice {
  explicit Choice(const std::vector<std::string>& words) {
    for (const std::string& word : words) (is_experiment(word) ? ids : case_names).push_back(word);
    if (ids.empty()) demand_experiments(words);
  }

  std::vector<std::string> ids, case_names;

 private:
  static bool is_experiment(const std::string& word) {
    return std::ranges::any_of(experiments(), [&](const Experiment& e) { return matches_glob(word, e.id); });
  }
};

// Those that the globs name and the profile measures.
std::vector<const Experiment*> chosen_experiments(const std::vector<std::string>& ids, Profile profile) {
  std::vector<const Experiment*> chosen;
  const bool scale = profile == Profile::kScale;
  for (const Experiment& experiment : experiments()) {
    if (experiment.profile_scale == scale && matches_any(ids, experiment.id)) chosen.push_back(&experiment);
  }
  if (chosen.empty()) {
    throw usage_error(fmt::format("not measured in this profile: {}", fmt::join(ids, " ")), "--profile",
                      scale ? "choose quick or paper" : "growth with size is measured with --profile scale");
  }
  return chosen;
}

void keep_named(const std::vector<std::string>& globs, std::vector<PlannedCase>& cases) {
  if (globs.empty()) return;
  std::vector<std::string_view> names;
  for (const PlannedCase& planned : cases) names.push_back(planned.at.name);
  for (const Experiment& experiment : experiments()) names.push_back(experiment.id);  // for suggestions
  demand_matches(globs, names, "experiment or case", "terrabench run EXPERIMENT --dry-run");
  std::erase_if(cases, [&](const PlannedCase& planned) { return !matches_any(globs, planned.at.name); });
}

}  // namespace

std::vector<PlannedCase> plan_cases(const RunPlan& plan) {
  check_terrains(plan.options.terrains);
  const Choice choice(plan.patterns);
  std::vector<PlannedCase> cases;
  for (const Experiment* const experiment : chosen_experiments(choice.ids, plan.options.profile)) {
    for (Case& at : experiment->cases(plan.options)) cases.push_back({experiment, std::move(at)});
  }
  keep_named(choice.case_names, cases);
  std::vector<ParameterSpec> specs;
  for (const PlannedCase& planned : cases) {
    specs.insert(specs.end(), planned.experiment->parameters.begin(), planned.experiment->parameters.end());
  }
  const std::vector<std::string> assignments = split_assignments(plan.assignments, specs);
  apply(assignments, cases);
  check_names(cases);
  if (!plan.options.terrains.empty() &&
      std::none_of(cases.begin(), cases.end(), [](const PlannedCase& p) { return !p.at.terrain.empty(); })) {
    throw usage_error("none of these experiments takes a terrain", "--terrain",
                      "leave it out, or choose another experiment");
  }
  if (plan.part != Part::kAll) {
    std::erase_if(cases, [&](const PlannedCase& planned) {
      return planned.experiment->timed(planned.at) != (plan.part == Part::kTimed);
    });
  }
  std::vector<PlannedCase> mine;
  for (std::size_t i = plan.shard - 1; i < cases.size(); i += plan.shards)
    mine.push_back(std::move(cases[i]));
  return mine;
}

}  // namespace terrabench
