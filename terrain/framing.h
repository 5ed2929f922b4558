// What a view needs for an eye at any place: which way is up, and how far the ground reaches.
#pragma once

#include "terrain/heightfield.h"
#include "terrain/view.h"

namespace terrabench {

// The direction of the picture's top for a line of sight of any length but 0: up. In a plan, whose line of
// sight is vertical, `ahead` is at the top, a horizontal direction: north.
glm::vec3 upright(const glm::dvec3& sight, const glm::vec3& ahead = {0, 0, -1});

// Distance of a far plane behind all of the box, from an eye at any place.
double far_plane(const glm::dvec3& eye, const Bounds&);

// How far in front of the eye the box begins and ends, in metres along the line of sight. Negative: behind
// it.
struct DepthRange {
  float nearest, farthest;
};
DepthRange depth_range(const View&, const Bounds&);

// The box around a field. O(samples).
Bounds bounds_of(const Heightfield&);

// Of the far plane, in sides of the ground: water reaches beyond the ground.
inline constexpr float kFarSides = 4;

// Sets near and far planes for an eye anywhere over or beside the ground, whose bounds are given. The far
// plane lies behind all ground, the near plane before the ground at a level eye's feet. If only the ground is
// drawn (`alone`), the near plane moves up to where the bounds begin.
void set_depth_planes(View&, const Heightfield&, const Bounds& ground, bool alone);

}  // namespace terrabench
