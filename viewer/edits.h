// Digs and fills with a sphere, and undoes it, as representations/heightmap does: digging lowers heights
// inside the sphere to its underside, and spares ground above it; filling raises heights below the sphere's
// top to it.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "lod/lod.h"
#include "terrain/heightfield.h"

namespace terrabench::viewer {

struct Stroke {
  glm::dvec3 centre{0};  // metres
  double radius = 1;     // metres, > 0
  bool digs = true;      // otherwise fills
};

class Edits {
 public:
  // Changes the heights and returns the least rectangle that holds all changed samples; nothing if none
  // changed. O(samples under the sphere)
  std::optional<SampleRect> apply(Heightfield&, const Stroke&);
  bool can_undo() const { return !done_.empty(); }
  // Takes back the last change that was not taken back. can_undo() must hold. O(its samples)
  SampleRect undo(Heightfield&);
  std::size_t count() const { return done_.size(); }
  void clear() { done_.clear(); }

 private:
  struct Before {
    SampleRect rect;
    std::vector<float> heights;  // row by row
  };
  std::vector<Before> done_;
};

}  // namespace terrabench::viewer
