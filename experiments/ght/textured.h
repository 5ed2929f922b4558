// The surface of a tree with textures by height and slope, lit and shadowed (figures 21 and 24).
#pragma once

#include "renderers/context.h"
#include "representations/ght/ght.h"
#include "terrain/image.h"
#include "terrain/parameters.h"
#include "terrain/view.h"

namespace terrabench::ght {

// Under a sky. `style` holds landscape_parameters() (renderers/landscape/style.h).
Image textured_view(GlContext&, const Ght&, const View&, const Parameters& style);
// As a block of ground on white, with yellow particles above it.
Image textured_block(GlContext&, const Ght&, const View&, const Parameters& style,
                     const TriangleMesh& particles);

}  // namespace terrabench::ght
