// Ground of soil and rock below grass, in the same light and fog, where no other renderer draws the ground.
#pragma once

#include <memory>

#include "renderers/grass/grass.h"

namespace terrabench {

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

}  // namespace terrabench
