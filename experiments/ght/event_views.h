// The three views of a tree that "ght" shows beside one another, whole or cut open.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "experiments/ght/tree_view.h"
#include "renderers/context.h"
#include "terrain/image.h"

namespace terrabench::ght {

struct Look {
  glm::vec3 from{0.55F, 0.75F, 1.0F};  // towards the eye
  int width = 800, height = 600;       // pixels
  std::vector<CutPlane> cuts{};        // of wires and solid; what they leave is convex
};

Image planes_view(GlContext&, const Ght&, const Look&);
Image wires_view(GlContext&, const Ght&, const Look&);
// Lit and coloured by height, as a block of ground.
Image solid_view(GlContext&, const Ght&, const Look&);

}  // namespace terrabench::ght
