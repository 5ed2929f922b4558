// Models of "meshgrow" (Tobler, Maierhofer and Wilkie) as text: a base mesh, rules that let it grow (§4), and
// a schedule in which growing and subdivision steps alternate in any order (§5). docs/models.md is the
// grammar.
//
// To follow a model from its text to faces: parse_model() and expand() in model.cpp; of the parts that they
// read, RuleReader in model_rules.cpp; growing/rules.h, what a rule is; growing/grow.h and grow();
// Wave::run() in growing/wave.cpp and what it calls, in that order; growing/expansion.h, the new elements of
// one face. What can wait: expressions (growing/expression.h), templates and their check, textures, limits,
// and subdivision (model_subdivide.cpp, subdivision/refine.h).
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "representations/procedural_mesh/growing/grow.h"

namespace terrabench::growing {

// What a subdivision step adds to the standard placement of its vertices (§3): expressions of kVertexNames.
struct Displace {
  enum class Along : std::uint8_t { kNormal, kTangent, kBitangent, kFixed } along = Along::kNormal;
  glm::vec3 direction{0, 1, 0};  // of kFixed
  bool by_scale = true;          // times the local scale factor; otherwise in metres
  bool new_vertices = false;     // those of faces and edges alone
  Expression amount;
};
inline constexpr std::string_view kVertexNames[] = {"x",  "y",  "z",  "u",     "v",
                                                    "nx", "ny", "nz", "scale", "level"};

struct Step {
  Place place;
  std::string name;          // for leaving it out; may be empty
  std::uint32_t levels = 0;  // subdivisions; 0: a growing step
  bool linear = false;       // keep the vertices, put new ones in the middle
  bool linear_texture = false;
  double bound = 0;  // of displacements, in local scale factors; 0: none
  std::vector<Displace> displacements;
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

// `origin` names the text in errors, which give line and column. Throws bad_input for anything that is no
// model.
Model parse_model(std::string_view text, const std::string& origin);

// The models of the paper, which travel inside the program: models/*.toml, without the extension; and the
// species of models/weber_penn, each followed by the rules that they share.
std::vector<std::string> model_names();
std::string_view model_text(std::string_view name);  // throws unknown_name

struct ExpandOptions {
  std::vector<std::string> leave_out{};                // names of steps
  std::size_t most_steps = SIZE_MAX;                   // of the schedule; the rest is left out
  std::function<void(const GrownMesh&)> after_step{};  // also called for the base
};

// Runs the schedule. The same for any number of threads. Throws bad_input as grow() does, and where a
// subdivision exceeds the limit of faces.
GrownMesh expand(const Model&, const ExpandOptions& = {});

// One level of a subdivision step; `level` counts from 1 over the whole schedule.
GrownMesh subdivide(const Model&, const Step&, const GrownMesh&, std::uint32_t level);

}  // namespace terrabench::growing
