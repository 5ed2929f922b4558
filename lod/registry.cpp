#include <fmt/format.h>

#include <vector>

#include "lod/brute_force/brute_force.h"
#include "lod/cbt/cbt.h"
#include "lod/cdlod/cdlod.h"
#include "lod/chunked/chunked.h"
#include "lod/clipmap/clipmap.h"
#include "lod/geomipmap/geomipmap.h"
#include "lod/hybrid/hybrid.h"
#include "lod/lod.h"
#include "lod/mrbsp/mrbsp.h"
#include "lod/roam/roam.h"
#include "lod/rtin/rtin.h"
#include "lod/tessellated/tessellated.h"
#include "terrain/error.h"

namespace terrabench {
namespace {

constexpr LodVariant kMorphing[] = {{"morph", "morphing", "morph=true"}};
constexpr LodVariant kByMiddle[] = {{"midpoint", "midpoint errors", "error=midpoint", false}};
constexpr LodVariant kByDistanceAlone[] = {{"distance", "ranges by distance", "ranges=distance", false}};
constexpr LodVariant kByLength[] = {{"length", "factors by length", "factor=length", false}};
constexpr LodVariant kByArea[] = {{"area", "area threshold", "threshold=area"}};

// A clipmap and the hybrid hold and read windows, of which there are log n.
constexpr LodGrowth kWindows{.memory = 0, .update = 0, .windows = true};
// At a given error on the screen, the density of triangles falls with the square of the distance.
constexpr LodGrowth kByDistanceSquared{.update = 0};
// By the rule printed in the MRBSP paper it falls with the distance.
constexpr LodGrowth kByDistance{.update = 0.5};
// Brute force and geomipmaps visit every block or patch in view. By default patches are larger on ground of
// more than 1025² samples.
constexpr LodGrowth kAllInView{}, kAllPatches{.option = "patch=16"};

std::vector<LodType>& table() {
  static std::vector<LodType> types = {
      {"brute_force",
       "brute force",
       "every triangle of the blocks in view",
       "mrbsp Table 2",
       {},
       BruteForce::knob(),
       {},
       "",
       BruteForce::build,
       {},
       kAllInView},
      {"roam",
       "ROAM",
       "binary triangle trees split and merged by priority as the view moves",
       "Duchaineau et al. 1997",
       {.conforming = true, .bounds_error = true},
       Roam::knob(),
       Roam::parameters(),
       "",
       Roam::build,
       {},
       kByDistanceSquared},
      {"rtin",
       "RTIN",
       "right triangles bisected anew from the roots in each frame, by nested exact errors",
       "Evans et al. 2001",
       {.conforming = true, .bounds_error = true},
       Rtin::knob(),
       Rtin::parameters(),
       "",
       Rtin::build,
       kByMiddle,
       kByDistanceSquared},
      {"cbt",
       "CBT",
       "right triangles kept as bits between frames, split and merged by one level per pass",
       "Dupuy 2020",
       {.conforming = true, .bounds_error = true},
       Cbt::knob(),
       Cbt::parameters(),
       "",
       Cbt::build},
      {"geomipmap",
       "geomipmap",
       "patches at the coarsest level within the error bound, stitched to their neighbours",
       "de Boer 2000",
       {.conforming = true, .bounds_error = true},
       GeoMipMap::knob(),
       GeoMipMap::parameters(),
       "stitch=false",
       GeoMipMap::build,
       kMorphing,
       kAllPatches},
      {"tessellated",
       "tessellated patches",
       "square patches that the GPU's tessellator divides, by a factor for each side",
       "Cantlay 2011",
       {.conforming = true, .bounds_error = true},
       Tessellated::knob(),
       Tessellated::parameters(),
       "",
       Tessellated::build,
       kByLength,
       kAllInView},
      {"cdlod",
       "CDLOD",
       "nodes of a quadtree by distance, whose vertices morph to the next coarser level",
       "Strugar 2009",
       {.conforming = true, .bounds_error = true},
       Cdlod::knob(),
       Cdlod::parameters(),
       "morph=false",
       Cdlod::build,
       kByDistanceAlone},
      {"chunked",
       "chunked LOD",
       "a quadtree of static meshes, by their errors on the screen, with skirts over the cracks between",
       "Ulrich 2002",
       {.conforming = false, .bounds_error = true},
       Chunked::knob(),
       Chunked::parameters(),
       "skirts=false",
       Chunked::build,
       kMorphing},
      {"clipmap",
       "clipmap",
       "nested windows of samples around the eye, each twice as coarse as the next inner one",
       "hybrid §3.2",
       {},
       Clipmap::knob(),
       Clipmap::parameters(),
       "stitch=false",
       Clipmap::build,
       {},
       kWindows},
      {"hybrid",
       "hybrid",
       "chunks of a near surface around the eye, in a clipmap with a hole of their outline",
       "hybrid §3.5",
       {.near_surface = true},
       Hybrid::knob(),
       Hybrid::parameters(),
       "stitch=false",
       Hybrid::build,
       {},
       kWindows},
      {"mrbsp",
       "multiresolution BSP",
       "a tree of bisected triangles, drawn at a depth that decreases with distance, without hidden ones",
       "mrbsp",
       {},
       Mrbsp::knob(),
       Mrbsp::parameters(),
       "holes=left",
       Mrbsp::build,
       kByArea,
       kByDistance},
  };
  return types;
}

}  // namespace

std::span<const LodType> lods() { return table(); }

void add_lod(const LodType& type) {
  for (const LodType& known : lods()) {
    if (known.name == type.name)
      throw usage_error("this name is taken", type.name, "choose another name for the method");
  }
  table().push_back(type);
}

std::vector<Entrant> entrants() {
  std::vector<Entrant> all;
  for (const LodType& type : lods())
    all.push_back({std::string(type.name), std::string(type.name), "", std::string(type.label),
                   type.traits.bounds_error});
  for (const LodType& type : lods()) {
    for (const LodVariant& variant : type.variants) {
      all.push_back({fmt::format("{}_{}", type.name, variant.name), std::string(type.name),
                     fmt::format("{}.{}", type.name, variant.option),
                     fmt::format("{}, {}", type.label, variant.label),
                     type.traits.bounds_error && variant.bounds_error});
    }
  }
  return all;
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
