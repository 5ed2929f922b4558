// GrassLook as the shaders read it: the uniform block of renderers/shaders/grass_look.glsl. Only for the
// sources in renderers/grass.
#pragma once

#include "renderers/gl.h"
#include "renderers/grass/grass.h"

namespace terrabench {

// A uniform buffer, bound as number 0 by set().
class LookBlock {
 public:
  LookBlock();
  void set(const GrassLook&);

 private:
  Buffer buffer_;
};

}  // namespace terrabench
