// Heights of the tree's vertices from height points (MRBSP paper, §2). Each vertex takes its height from the
// three nearest of all points (nearest_three.h), so all triangles that meet at a vertex agree on its height.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lod/mrbsp/bisection_tree.h"
#include "terrain/heightfield.h"
#include "terrain/progress.h"

namespace terrabench {

// (side + 1)² heights over the rectangle that the points span. O(points + vertices), in parallel; the result
// does not depend on the number of threads. Throws usage_error for points in one line.
Heightfield interpolate_heights(std::span<const glm::vec3> points, const BisectionTree&, Progress&);
// The field's samples as height points.
std::vector<glm::vec3> height_points(const Heightfield&);

}  // namespace terrabench
