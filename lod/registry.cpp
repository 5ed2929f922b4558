#include <vector>

#include "lod/brute_force/brute_force.h"
#include "lod/lod.h"
#include "lod/mrbsp/mrbsp.h"
#include "terrain/error.h"

namespace terrabench {

std::span<const LodType> lods() {
  static const LodType kTypes[] = {
      {"brute_force",
       "every triangle of the blocks that the view sees",
       "mrbsp Table 2",
       {},
       BruteForce::knob(),
       {},
       BruteForce::build},
      {"mrbsp",
       "a tree of bisected triangles, each drawn at the depth its distance asks for; what the ground hides "
       "left out",
       "mrbsp",
       {},
       Mrbsp::knob(),
       Mrbsp::parameters(),
       Mrbsp::build},
  };
  return kTypes;
}

const LodType& lod(std::string_view name) {
  std::vector<std::string_view> known;
  for (const LodType& type : lods()) {
    if (type.name == name) return type;
    known.push_back(type.name);
  }
  throw unknown_name("level-of-detail method", name, known);
}

}  // namespace terrabench
