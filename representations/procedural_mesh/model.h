// Models of "meshgrow" (Tobler, Maierhofer and Wilkie) as text: a base mesh, rules that let it grow (§4), and
// a schedule in which growing and subdivision steps alternate in any order (§5). docs/models.md is the
// grammar.
//
// To follow a model from its text to faces: growing/rules.h, what a rule is; parse_model() in model.cpp;
// RuleReader::run() in model_rules.cpp and what it calls for "sections"; expand() in expand.cpp;
// growing/grow.h; Grower::run() and step() in growing/grow.cpp; RuleApplier::run() in growing/apply_rule.cpp
// and extrude(), which make the new elements of one face. What can wait: expressions (growing/expression.h),
// checks of what is written down (growing/well_formed.cpp), limits, dropping what was replaced, textures, and
// subdivision (subdivision/subdivide.h).
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "representations/procedural_mesh/growing/grow.h"
#include "representations/procedural_mesh/subdivision/placement.h"

namespace terrabench::growing {

// Names in the expressions of displacements (§3): the vertex, placed but not displaced.
inline constexpr std::string_view kVertexNames[] = {"x",  "y",  "z",  "u",     "v",
                                                    "nx", "ny", "nz", "scale", "level"};

struct Step {
  Place place;
  std::string name;                      // for leaving it out; may be empty
  std::uint32_t levels = 0;              // subdivisions; 0: a growing step
  subdivision::PlacementRule placement;  // of a subdivision; the amounts are those below
  std::vector<Expression> amounts;       // per displacement, with kVertexNames
  GrowOptions growth;
};

struct Model {
  std::string title;
  std::size_t bytes = 0;  // of the text
  RuleSystem system;
  FaceMesh base;
  std::vector<std::vector<double>> arguments;  // of the symbols of the base's faces
  std::vector<Step> steps;
  Limits limits;
};

inline constexpr std::size_t kMostModelBytes = std::size_t{1} << 20U;

struct ConstantChange {
  std::string name;  // of a number among the model's constants
  double value = 0;
};

// `origin` names the text in errors, which give line and column. Throws bad_input for anything that is no
// model, and unknown_name for a change of a constant that the model does not have, or not as a number.
Model parse_model(std::string_view text, const std::string& origin,
                  std::span<const ConstantChange> changes = {});

// The models of the paper, which travel inside the program: models/*.toml and those of its folders, without
// the extension. The rules.toml of a folder follows each of its models.
std::vector<std::string> model_names();
std::string_view model_text(std::string_view name);  // throws unknown_name

struct ExpandOptions {
  std::vector<std::string> leave_out{};  // names of steps
  std::size_t most_steps = SIZE_MAX;     // of the schedule; the rest is left out
  // Called for the base and after every growing step and every subdivision, with the number of subdivisions
  // so far.
  std::function<void(const GrownMesh&, std::uint32_t subdivisions)> after_step{};
};

// Runs the schedule. The same for any number of threads. Throws bad_input as grow() does, and where a
// subdivision exceeds the limit of faces.
GrownMesh expand(const Model&, const ExpandOptions& = {});

// Takes so many subdivisions from the end of the schedule; returns how many it does not have.
std::uint32_t leave_out_last(Model&, std::uint32_t subdivisions);

}  // namespace terrabench::growing
