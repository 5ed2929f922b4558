// Heights of the tree's vertices from height points, each from its own three nearest of all of them
// (nearest_three.h), so that a vertex has one height however many triangles meet there.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lod/mrbsp/bisection_tree.h"
#include "terrain/heightfield.h"
#include "terrain/progress.h"

namespace terrabench {

// The lattice of (side + 1)² heights over the points. The field covers the rectangle that they span.
// O(points + vertices), in parallel; the same for any number of threads.
Heightfield interpolate_lattice(std::span<const glm::vec3> points, const BisectionTree&, Progress&);
// The grid's samples as height points.
std::vector<glm::vec3> height_points(const Heightfield&);

}  // namespace terrabench
