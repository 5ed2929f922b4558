// A height field as figures show it: as a grey image, as a surface in space, as a block.
#pragma once

#include <array>
#include <functional>
#include <glm/vec3.hpp>

#include "terrain/heightfield.h"
#include "terrain/image.h"
#include "terrain/mesh.h"

namespace terrabench::figures {

// One grey pixel per sample: black is the lowest, white the highest; a level field is middle grey throughout.
// O(samples)
Image heightmap_image(const Heightfield&);

// The surface alone, without sides and normals: vertices are the samples, row by row. O(samples)
TriangleMesh ground_mesh(const Heightfield&);

// The four upright sides of a block of ground of columns × rows samples, from the surface's border down to
// `floor`. `surface` gives the point of the surface at sample (i, j) of the border. O(border)
TriangleMesh block_sides(int columns, int rows, const std::function<glm::vec3(int i, int j)>& surface,
                         float floor);

// Corners counter-clockwise as seen from the air.
void add_quad(TriangleMesh&, const std::array<glm::vec3, 4>& corners);

}  // namespace terrabench::figures
