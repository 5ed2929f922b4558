// Levels of detail of a model ("meshgrow" §6): subdivision steps are left out, last ones first; growing steps
// are left out or generate less, by other values of the model's constants.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "representations/procedural_mesh/model.h"
#include "terrain/solid.h"

namespace terrabench::growing {

// How a level differs from the whole model.
struct DetailLevel {
  std::vector<std::string> leave_out{};  // names of steps
  std::uint32_t fewer_subdivisions = 0;  // taken from the end of the schedule
  std::vector<ConstantChange> constants{};
};

// The models of all levels, finest first.
struct DetailModel {
  std::string name;
  std::vector<Model> levels;
  // Metres by which the subdivision steps of a level may move vertices out of the box of the mesh before
  // them: twice the most that the expansions of 4 seeds show, and 0 without displacements.
  std::vector<float> margins;
  std::vector<std::uint32_t> growth;  // per level, the first level with the same growing steps and constants
};

// Parses the model once per level. Throws as parse_model(); unknown_name for a step that the model does not
// have; usage_error for no level, or more subdivisions left out than there are.
DetailModel make_detail_model(std::string_view text, const std::string& name, std::span<const DetailLevel>);

// A model's expansion with another seed. Same for every number of threads. Throws as expand().
GrownMesh expand_seed(const Model&, std::uint64_t seed);

// What an expansion will have, from its growing steps alone.
struct Estimate {
  std::uint64_t faces = 0;  // exact
  // A box around its vertices. Standard and linear placement give weighted means with weights of at least 0,
  // so subdivision does not leave the box of the mesh before it. Displacements may, by the level's margin at
  // most if that holds for all seeds; callers check their expansions.
  Bounds box;
};
// One per level. Grows once per different growth.
std::vector<Estimate> estimate(const DetailModel&, std::uint64_t seed);

// Metres by which the inner box leaves the other; 0 if it does not.
float beyond(const Bounds& inner, const Bounds& box);

}  // namespace terrabench::growing
