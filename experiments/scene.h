// Ground drawn as a landscape through a level-of-detail method: what `terrabench render` and the figures of
// the hybrid paper share.
#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "experiments/grass_cover.h"
#include "lod/lod.h"
#include "renderers/landscape/landscape.h"
#include "terrain/heightfield.h"
#include "terrain/source.h"

namespace terrabench {

// The height of the highest surface of a solid over samples × samples points of its bounds in plan; the floor
// of the bounds where a column is empty, since ground continues below. Within 1/1024 of the bounds' height.
// O(samples²), parallel.
Heightfield surface_heights(const Solid&, int samples, Progress&);

// The source's heights, with holes filled, or those of its solid's surface, without single spikes. Of a
// solid's surface, whose cliffs are steps from sample to sample, all heights are smoothed over a few samples.
// Throws bad_input for ground without any heights and usage_error for fewer than 2 × 2 samples.
Heightfield scene_heights(const TerrainSource&, int samples, Progress&);

// A view from the south over the middle of the ground, as a picture without other wishes has: above the water
// and the ground before it.
View scene_view(const LandscapeStyle&, const Heightfield&, int width, int height);

// Throws usage_error for a picture without any ground: says where that is.
[[noreturn]] void refuse_empty(const View&, const Bounds& ground);

// Throws usage_error for an eye inside the ground: in the solid if the frame draws meshes, otherwise under
// the heights that it draws. An eye beside or over the ground is good.
void check_eye(const View&, const Frame&, const TerrainSource&, const Heightfield&);

// Draws views in order. The context, the method and what it was built from must outlive it.
class ScenePainter {
 public:
  ScenePainter(GlContext& context, Lod& lod, const LandscapeStyle& style);
  ~ScenePainter() { context_.make_current_to_delete(); }
  ScenePainter(const ScenePainter&) = delete;
  ScenePainter& operator=(const ScenePainter&) = delete;
  LandscapeRenderer& renderer() { return renderer_; }
  // Grass, of grass_parameters(), on the near meshes of the following frames. The style must outlive this.
  void grow(const Parameters& grass, const LandscapeStyle& style);
  std::int64_t strands() const { return grass_ ? grass_->strands() : 0; }
  // The frame for the view and its surroundings.
  const Frame& update(const View&);
  // Draws the frame of the last update(), once; or only uploads it, so that the next picture is the same as
  // if this one had been drawn.
  Image draw(const View&, double seconds = 0);
  bool shows_ground() { return renderer_.shows_ground(); }  // or water, in the last picture
  void skip();

 private:
  GlContext& context_;
  Lod& lod_;
  LandscapeRenderer renderer_;
  std::optional<GrassCover> grass_;
  const Frame* frame_ = nullptr;
};

}  // namespace terrabench
