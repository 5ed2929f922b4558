// Rays on a grounded heightmap tree, cast on the tree itself: no mesh, and nothing is copied but a maximum
// mipmap over the root's squares (ray_walk.h). A square that no face lies over is the two triangles between
// its corners. Over any other square the ray is tested against the square's own two triangles, where it is
// plain, and against the faces whose boxes its way through the square meets: caves, tunnels and overhangs
// are nothing but faces.
//
// A square costs O(1), or O(faces over it).
#pragma once

#include <memory>

#include "representations/ght/ght.h"
#include "representations/ray_cast.h"

namespace terrabench {

// As Representation::ray_caster(). Null for a tree without area. Takes a fifteenth of the bytes of the root's
// heights. O(samples + faces).
std::unique_ptr<RayCaster> ght_ray_caster(const Ght&);

}  // namespace terrabench
