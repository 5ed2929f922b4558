// The place of the ground that a pixel shows.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "terrain/heightfield.h"
#include "terrain/view.h"

namespace terrabench::viewer {

// Where the ray first meets the bilinear surface of the heights, by steps of half a cell in plan; nothing
// where it does not, or begins below. `sight` is of any length but 0. O(width + depth)
std::optional<glm::dvec3> pick(const Heightfield&, const glm::dvec3& eye, const glm::dvec3& sight);
// Through the middle of a pixel, counted from the top left corner.
std::optional<glm::dvec3> pick(const Heightfield&, const View&, const glm::dvec2& pixel);

}  // namespace terrabench::viewer
