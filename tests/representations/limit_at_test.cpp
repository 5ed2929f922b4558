// The limit surface at any point, against the masks that give it at vertices.
#include "representations/procedural_mesh/subdivision/limit_at.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "representations/procedural_mesh/subdivision/limit.h"
#include "representations/procedural_mesh/subdivision/refinement.h"
#include "tests/representations/face_shapes.h"

namespace terrabench::subdivision {
namespace {

TEST(LimitAt, PlacesInAChildAndInItsParentAreTheSame) {
  for (const glm::dvec2 place : {glm::dvec2(0.2, 0.3), {0.7, 0.1}, {0.6, 0.9}, {0.4, 0.8}}) {
    glm::dvec2 at = place;
    const int child = child_at(at);
    EXPECT_LT(glm::distance(place_in_parent(child, at), place), 1e-15) << child;
  }
}

// On shapes with extraordinary vertices, boundaries and creases of every kind. The places are corners of
// faces two refinements later, where the evaluation begins.
TEST(LimitAt, AgreesWithTheMasksOfFinerVertices) {
  for (const Shape& shape : shapes()) {
    const Refinement refinement(shape.mesh, 3);  // after one refinement all faces are quadrilaterals
    std::vector<std::vector<glm::dvec3>> points{{shape.mesh.positions.begin(), shape.mesh.positions.end()}};
    for (int level = 0; level < 3; ++level) {
      const Topology& t = refinement.topology(level);
      std::vector<glm::dvec3> finer(child_vertices(t));
      place_standard<glm::dvec3>(t, refinement.stencils(level), points.back(), finer);
      points.push_back(std::move(finer));
    }
    const Topology &mesh = refinement.topology(1), &finest = refinement.topology(3);
    std::vector<glm::dvec3> limits(points[3].size());
    limit_points<glm::dvec3>(finest, points[3], limits);
    for (std::uint32_t face = 0; face < mesh.faces(); ++face) {
      const std::uint32_t child = face % 4, grandchild = face / 4 % 4;
      const glm::dvec2 place = place_in_parent(static_cast<int>(child),
                                               place_in_parent(static_cast<int>(grandchild), glm::dvec2(0)));
      const glm::dvec3 expected = limits[finest.corners[4 * (16 * face + 4 * child + grandchild)]];
      EXPECT_LT(glm::distance(limit_at(mesh, points[1], face, place), expected), 1e-12)
          << shape.name << ", face " << face;
    }
  }
}

// A plane stays flat, and its places stay where they are: the spline reproduces linear functions.
TEST(LimitAt, ReproducesAPlane) {
  FaceMesh grid;
  for (int k = 0; k < 36; ++k) grid.positions.emplace_back(k % 6, 0, k / 6);
  grid.first_corner = {0};
  for (std::uint32_t k = 0; k < 25; ++k) {
    const std::uint32_t v = k % 5 + 6 * (k / 5);
    grid.corners.insert(grid.corners.end(), {v, v + 6, v + 7, v + 1});
    grid.first_corner.push_back(4 * (k + 1));
  }
  const std::vector<glm::dvec3> points(grid.positions.begin(), grid.positions.end());
  const glm::dvec3 limit = limit_at(make_topology(grid), points, 12, {0.3, 0.9});  // the face at (2, 2)
  EXPECT_LT(glm::distance(limit, glm::dvec3(2.9, 0, 2.3)), 1e-14);
}

}  // namespace
}  // namespace terrabench::subdivision
