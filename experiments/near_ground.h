// Ground for what joins near and far (hybrid paper, §3.5): the implicit surface near the eye, and the height
// map of the same stacks beyond.
#pragma once

#include <memory>

#include "lod/lod.h"
#include "representations/implicit/implicit_surface.h"
#include "representations/layered_stack/height_map.h"
#include "terrain/source.h"

namespace terrabench {

struct NearGround {
  std::unique_ptr<ImplicitSurface> surface;  // null for ground of heights alone
  Heightfield heights;

  LodGround lod() const { return {heights, surface.get()}; }
};

// Stacks with `columns` along the longer side, solid at the bottom, and `finer` heights per column.
NearGround near_ground(const TerrainSource&, int columns, int finer, Progress&);

// The ground that methods draw. Of a solid: samples × samples heights, see scene_heights(); with
// `near_surface`, its near surface and the heights of its stacks.
NearGround ground_for(const TerrainSource&, bool near_surface, int samples, Progress&);

// At walking height over a place, in the air, looking along `heading` (radians) and a little down. `step` is
// the least height above what is solid, metres.
View standing_on(const NearGround&, glm::vec2 place, float heading, float step);

}  // namespace terrabench
