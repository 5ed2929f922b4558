// A piece of plain ground with grass, for pictures and frame times of grass alone.
#pragma once

#include <memory>
#include <optional>

#include "renderers/context.h"
#include "renderers/grass/grass.h"
#include "terrain/image.h"
#include "terrain/view.h"

namespace terrabench {

// Ground of soil and rock below grass, in the same light and fog, where no other renderer draws the ground.
// The context must be current where it is made, drawn and destroyed.
class PlainGround {
 public:
  explicit PlainGround(const GrassGround&);  // copies it; throws environment_error when it does not fit
  ~PlainGround();
  PlainGround(const PlainGround&) = delete;
  PlainGround& operator=(const PlainGround&) = delete;

  // Into the bound framebuffer, as GrassRenderer::draw(). Of the look it uses all but wind and thinning.
  void draw(const GrassLook&);

 private:
  struct Gl;
  std::unique_ptr<Gl> gl_;
};

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
