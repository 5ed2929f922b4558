#include "terrain/mesh.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace terrabench {
namespace {

TriangleMesh tetrahedron() {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.indices = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  return mesh;
}

TEST(Mesh, AClosedMeshIsWatertight) {
  const EdgeReport report = check_edges(tetrahedron());
  EXPECT_TRUE(report.watertight());
  EXPECT_EQ(report.edges, 6U);
}

TEST(Mesh, AMissingTriangleOpensThreeEdges) {
  TriangleMesh mesh = tetrahedron();
  mesh.indices.resize(9);
  const EdgeReport report = check_edges(mesh);
  EXPECT_FALSE(report.watertight());
  EXPECT_EQ(report.open, 3U);
}

TEST(Mesh, ATurnedTriangleIsMisoriented) {
  TriangleMesh mesh = tetrahedron();
  std::swap(mesh.indices[0], mesh.indices[1]);
  const EdgeReport report = check_edges(mesh);
  EXPECT_EQ(report.misoriented, 3U);
  EXPECT_FALSE(report.watertight());
}

TEST(Mesh, AFinOnAnEdgeIsNonManifold) {
  TriangleMesh mesh = tetrahedron();
  mesh.positions.emplace_back(2, 2, 2);
  mesh.indices.insert(mesh.indices.end(), {0, 1, 4});
  const EdgeReport report = check_edges(mesh);
  EXPECT_EQ(report.non_manifold, 1U);
  EXPECT_EQ(report.open, 2U);
  EXPECT_FALSE(report.watertight());
}

TEST(Mesh, NormalsFaceOutAndWeighByArea) {
  TriangleMesh mesh = tetrahedron();
  compute_normals(mesh);
  ASSERT_EQ(mesh.normals.size(), 4U);
  for (const glm::vec3& n : mesh.normals) EXPECT_NEAR(glm::length(n), 1, 1e-6);
  // The three faces at the origin have equal areas.
  EXPECT_NEAR(glm::dot(mesh.normals[0], glm::normalize(glm::vec3(-1, -1, -1))), 1, 1e-6);
  TriangleMesh ground;
  ground.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {9, 9, 9}};
  ground.indices = {0, 1, 2};
  compute_normals(ground);
  EXPECT_EQ(ground.normals[1], glm::vec3(0, 1, 0));
  EXPECT_EQ(ground.normals[3], glm::vec3(0, 1, 0)) << "a vertex of no triangle still has a normal";
}

TEST(Mesh, NothingIsWatertight) {
  EXPECT_EQ(check_edges({}).edges, 0U);
  TriangleMesh empty;
  compute_normals(empty);
  EXPECT_TRUE(empty.normals.empty());
}

}  // namespace
}  // namespace terrabench
