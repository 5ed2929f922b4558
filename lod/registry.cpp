#include <vector>

#include "lod/brute_force/brute_force.h"
#include "lod/clipmap/clipmap.h"
#include "lod/geomipmap/geomipmap.h"
#include "lod/hybrid/hybrid.h"
#include "lod/lod.h"
#include "lod/mrbsp/mrbsp.h"
#include "lod/roam/roam.h"
#include "terrain/error.h"

namespace terrabench {

std::span<const LodType> lods() {
  static const LodType kTypes[] = {
      {"brute_force",
       "brute force",
       "every triangle of the blocks in view",
       "mrbsp Table 2",
       {},
       BruteForce::knob(),
       {},
       "",
       BruteForce::build},
      {"roam",
       "ROAM",
       "binary triangle trees split and merged by priority as the view moves",
       "Duchaineau et al. 1997",
       {.conforming = true, .bounds_error = true},
       Roam::knob(),
       Roam::parameters(),
       "",
       Roam::build},
      {"geomipmap",
       "geomipmap",
       "patches at the coarsest level within the error bound, stitched to their neighbours",
       "de Boer 2000",
       {.conforming = true, .bounds_error = true},
       GeoMipMap::knob(),
       GeoMipMap::parameters(),
       "stitch=false",
       GeoMipMap::build},
      {"clipmap",
       "clipmap",
       "nested windows of samples around the eye, each twice as coarse as the next inner one",
       "hybrid §3.2",
       {},
       Clipmap::knob(),
       Clipmap::parameters(),
       "stitch=false",
       Clipmap::build},
      {"hybrid",
       "hybrid",
       "chunks of a near surface around the eye, in a clipmap with a hole of their outline",
       "hybrid §3.5",
       {.near_surface = true},
       Hybrid::knob(),
       Hybrid::parameters(),
       "stitch=false",
       Hybrid::build},
      {"mrbsp",
       "multiresolution BSP",
       "a tree of bisected triangles, drawn at a depth that decreases with distance, without hidden ones",
       "mrbsp",
       {},
       Mrbsp::knob(),
       Mrbsp::parameters(),
       "holes=left",
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
