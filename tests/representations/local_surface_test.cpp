// Local normals, scale factors and frames against sums over all faces, on polygons and on refined meshes.
#include "representations/procedural_mesh/subdivision/local_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/glm.hpp>

#include "representations/procedural_mesh/subdivision/refinement.h"
#include "tests/representations/face_shapes.h"

namespace terrabench {
namespace {

using namespace subdivision;

struct Sums {
  glm::dvec3 equal{0}, area{0};
  double diagonals = 0, faces = 0;
};

// By the definitions, face by face: Newell's normal, and diagonals by the number of corners.
std::vector<Sums> sums_of(const FaceMesh& mesh) {
  std::vector<Sums> sums(mesh.positions.size());
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    std::vector<glm::dvec3> p;
    for (std::uint32_t c = mesh.first_corner[f]; c < mesh.first_corner[f + 1]; ++c) {
      p.emplace_back(mesh.positions[mesh.corners[c]]);
    }
    const std::size_t n = p.size();
    glm::dvec3 newell(0);
    double diagonal = 0;
    for (std::size_t i = 0; i < n; ++i) {
      newell += glm::cross(p[i], p[(i + 1) % n]);
      diagonal += glm::distance(p[i], p[(i + n / 2) % n]) / static_cast<double>(n);
    }
    for (std::uint32_t c = mesh.first_corner[f]; c < mesh.first_corner[f + 1]; ++c) {
      Sums& sum = sums[mesh.corners[c]];
      sum.equal += glm::normalize(newell);
      sum.area += newell;
      sum.diagonals += diagonal;
      ++sum.faces;
    }
  }
  return sums;
}

void expect_definitions(const FaceMesh& mesh, const std::string& name) {
  const std::vector<Sums> sums = sums_of(mesh);
  const Topology t = make_topology(mesh);
  const LocalSurface equal = local_surface(t, mesh.positions, {}, {.tangent = TangentFrom::kAxis}, true);
  const LocalSurface area = local_surface(t, mesh.positions, {}, {.normals = NormalWeights::kArea}, false);
  EXPECT_TRUE(area.tangents.empty());
  for (std::size_t v = 0; v < sums.size(); ++v) {
    EXPECT_LT(glm::distance(glm::normalize(sums[v].equal), glm::dvec3(equal.normals[v])), 1e-5) << name;
    EXPECT_LT(glm::distance(glm::normalize(sums[v].area), glm::dvec3(area.normals[v])), 1e-5) << name;
    EXPECT_NEAR(sums[v].diagonals / sums[v].faces, equal.scales[v], 1e-5) << name;
    EXPECT_NEAR(glm::length(equal.tangents[v]), 1, 1e-5);
    EXPECT_NEAR(glm::dot(equal.tangents[v], equal.normals[v]), 0, 1e-5);
    EXPECT_GE(equal.tangents[v].x, 0);  // the projection of +x
  }
}

TEST(LocalSurface, FollowsItsDefinitionsOnPolygonsAndRefinedMeshes) {
  for (const Shape& shape : shapes()) {
    expect_definitions(shape.mesh, shape.name);
    expect_definitions(subdivide(shape.mesh, std::vector<PlacementRule>(2)), shape.name + ", refined");
  }
}

TEST(LocalSurface, HasFrameAndScaleWhereNoFaceGivesThem) {
  FaceMesh mesh = grid(1);
  mesh.positions.assign(5, {1, 1, 1});  // one place, and a vertex of no face
  const Topology t = make_topology(mesh);
  const std::vector<glm::vec2> texture(5);
  const LocalSurface surface = local_surface(t, mesh.positions, texture, {}, true);
  for (std::size_t v = 0; v < 5; ++v) {
    EXPECT_EQ(surface.normals[v], glm::vec3(0, 1, 0));
    EXPECT_EQ(surface.scales[v], 0);
    EXPECT_EQ(surface.tangents[v], glm::vec3(1, 0, 0));
  }
}

}  // namespace
}  // namespace terrabench
