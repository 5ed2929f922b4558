// The ground that the viewer shows, and what opens one: the caller's, so that the viewer shows the same
// ground as `render` draws.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lod/lod.h"
#include "terrain/heightfield.h"
#include "terrain/mesh_chunks.h"
#include "terrain/progress.h"
#include "terrain/solid.h"

namespace terrabench::viewer {

struct Ground {
  std::string name;                // as it was asked for
  std::string as;                  // the representation whose surface it is; empty: the terrain's own
  std::string render;              // the command that draws it without a window; empty: there is none
  std::vector<std::string> notes;  // what the reader converted, guessed or left out
  Heightfield heights;             // without holes
  std::shared_ptr<const MeshChunks> surface;  // the near surface of a solid; null for heights alone
  bool solid = false;                         // has more than one surface over a place
  Bounds bounds;                              // of the heights

  LodGround lod() const { return {heights, surface.get()}; }
};

// `near_surface`: for a method that draws one. Called by a thread of its own. Throws as open_terrain().
using OpenGround =
    std::function<std::shared_ptr<Ground>(const std::string& name, bool near_surface, Progress&)>;

}  // namespace terrabench::viewer
