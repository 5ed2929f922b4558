// A piece of plain ground with grass, for pictures and frame times of grass alone.
#pragma once

#include <optional>

#include "renderers/context.h"
#include "renderers/grass/grass.h"
#include "renderers/grass/plain_ground.h"
#include "terrain/image.h"
#include "terrain/view.h"

namespace terrabench {

// The context must outlive it and be current. Throws as GrassPatch does.
class GrassScene {
 public:
  GrassScene(GlContext&, const GrassGround&, const GrassGrowth&);

  // A frame in the context's picture, which it resizes: sky, ground, grass, and the mean of the samples. Does
  // not wait for the GPU.
  void draw(const View&, GrassTechnique);
  Image picture(const View&, GrassTechnique);
  // As GrassRenderer's, for a frame with this view.
  std::int64_t count_billboards(const View&, GrassTechnique);
  std::vector<GrassStrand> strands() { return grass_.strands(patch_); }

  // Ground that is drawn without grass, such as the sides of a block.
  void add_bare(const GrassGround&);

  const GrassPatch& patch() const { return patch_; }
  GrassLook look{};                           // the view sets its matrix and eye
  glm::vec3 background{0.76F, 0.84F, 0.93F};  // sRGB; the colour of the look's fog

 private:
  void begin(const View&);

  GlContext& gl_;
  PlainGround ground_;
  std::optional<PlainGround> bare_;
  GrassPatch patch_;
  GrassRenderer grass_;
};

}  // namespace terrabench
