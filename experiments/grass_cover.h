// Grass on the near meshes of a landscape (hybrid paper, §3.3): the chunks of the near surface that a frame
// lists grow grass where the landscape's ground is grass, that is above the water, in the band of grass and
// not on steep slopes. Strands become fewer towards the border of the near surface, where none stand.
#pragma once

#include <map>
#include <memory>
#include <span>

#include "renderers/grass/grass.h"
#include "renderers/landscape/landscape.h"
#include "terrain/frame.h"
#include "terrain/parameters.h"

namespace terrabench {

// `grass` (strands per square metre; 0: none), `grass_height`, `grass_width` and `grass_wind`.
std::span<const ParameterSpec> grass_parameters();

// The context must be current where it is made, used and destroyed.
class GrassCover {
 public:
  GrassCover(const Parameters&, const LandscapeStyle&);

  // Grows grass on meshes that the last frame did not list, and drops that of meshes which this one does not
  // list. All meshes together grow about kMostStrands strands at most: each its share, fewer per square metre
  // if they are that large. O(triangles of new meshes).
  void update(const Frame&, const View&);
  // LandscapeRenderer::also: draws in the picture and in reflections.
  void draw(const PassView&);

  std::int64_t strands() const;

  static constexpr std::int64_t kMostStrands = 8'000'000;  // 384 MB

 private:
  GrassPatch grow(const FrameMesh&, std::int64_t most) const;

  const LandscapeStyle& style_;
  double density_;
  GrassGrowth growth_;
  float wind_;
  float reach_ = 0;  // metres from the eye to the border of the near meshes in view, in plan
  GrassRenderer renderer_;
  std::map<std::uint64_t, GrassPatch> patches_;  // by FrameMesh::id
};

}  // namespace terrabench
