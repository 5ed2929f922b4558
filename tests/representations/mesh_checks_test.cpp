// Planted faults, each found once, and meshes without faults.
#include "representations/procedural_mesh/mesh_checks.h"

#include <gtest/gtest.h>

#include <glm/glm.hpp>
#include <random>

#include "tests/representations/face_shapes.h"

namespace terrabench {
namespace {

// The report has this many of this fault and no other fault, but for those listed as following from it.
void expect_only(const FaceMesh& mesh, MeshFault fault, std::size_t count,
                 std::initializer_list<MeshFault> also = {}, const MeshCheckOptions& options = {}) {
  const MeshReport report = check_mesh(mesh, options);
  EXPECT_EQ(report[fault], count) << testing::PrintToString(report.first);
  std::size_t others = report.faults() - report[fault];
  for (const MeshFault other : also) {
    EXPECT_GT(report[other], 0U) << testing::PrintToString(report.first);
    others -= report[other];
  }
  EXPECT_EQ(others, 0U) << testing::PrintToString(report.first);
  EXPECT_FALSE(report.first.empty());
}

TEST(MeshChecks, FindNothingInGoodMeshes) {
  for (const Shape& shape : shapes()) {
    if (shape.name == "bow tie") continue;
    const MeshReport report = check_mesh(shape.mesh);
    EXPECT_EQ(report.faults(), 0U) << shape.name << testing::PrintToString(report.first);
  }
  EXPECT_EQ(check_mesh(cube(), {.boundary_meant = false}).faults(), 0U);
  EXPECT_EQ(check_mesh(cube()).edges, 12U);
  EXPECT_EQ(check_mesh(FaceMesh{}).faults(), 0U);
}

TEST(MeshChecks, FindSeveralFans) { expect_only(bow_tie(), MeshFault::kSeveralFans, 1); }

TEST(MeshChecks, FindHolesUnlessMeant) {
  expect_only(cube(true), MeshFault::kUnmeantBoundary, 4, {}, {.boundary_meant = false});
}

TEST(MeshChecks, FindFacesTurnedOverAndEdgesOfManyFaces) {
  FaceMesh mesh = cube();
  std::reverse(mesh.corners.begin(), mesh.corners.begin() + 4);
  expect_only(mesh, MeshFault::kDirectedTwice, 4);
  mesh = cube();
  mesh.positions.push_back({5, 5, 5});
  mesh.add_face({0, 1, 8});
  // With three faces at 0–1 no two of them are neighbours there, so the vertices fall into fans.
  expect_only(mesh, MeshFault::kManyFaces, 1, {MeshFault::kSeveralFans});
}

TEST(MeshChecks, FindBadFaces) {
  FaceMesh mesh = grid(2);
  mesh.corners[2] = 77;
  // The face is left out; its corner vertex has no other.
  expect_only(mesh, MeshFault::kBadIndex, 1, {MeshFault::kUnusedVertex});
  mesh = cube();
  mesh.corners[1] = mesh.corners[0];
  EXPECT_EQ(check_mesh(mesh)[MeshFault::kRepeatedVertex], 1U);
  mesh = cube();
  mesh.first_corner[1] = 2;
  EXPECT_EQ(check_mesh(mesh)[MeshFault::kFewCorners], 1U);
  mesh.first_corner = {0, 24, 0, 24, 0, 24};  // overlapping lists
  EXPECT_EQ(check_mesh(mesh)[MeshFault::kBadIndex], 4U);
}

TEST(MeshChecks, FindPositionsAndShapesThatCannotBe) {
  FaceMesh mesh = cube();
  mesh.positions[3].x = NAN;
  EXPECT_EQ(check_mesh(mesh)[MeshFault::kNotFinite], 1U);
  mesh = grid(1);
  for (glm::vec3& p : mesh.positions) p = {p.x, 2 * p.x, 3 * p.x};  // on a line
  EXPECT_EQ(check_mesh(mesh)[MeshFault::kZeroArea], 1U);
  mesh = cube();
  mesh.positions[1] = mesh.positions[0];
  expect_only(mesh, MeshFault::kZeroEdge, 2);
  mesh = cube();
  mesh.positions.push_back({});
  expect_only(mesh, MeshFault::kUnusedVertex, 1);
}

// Two squares beside one of double height: its edge has their common vertex inside.
TEST(MeshChecks, FindTVertices) {
  FaceMesh mesh =
      mesh_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 1}, {1, 0, 1}, {2, 0, 1}, {0, 0, 2}, {1, 0, 2}},
              {{0, 3, 4, 1}, {3, 6, 7, 4}});
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {0, 0, 1}, {1, 0, 1}, {3, 0, 2}, {0, 0, 2}, {1, 0, 2}};
  mesh.add_face({1, 7, 5, 2});
  // At both ends of that edge the faces on its sides are not neighbours.
  expect_only(mesh, MeshFault::kTVertex, 1, {MeshFault::kSeveralFans});
  EXPECT_EQ(check_mesh(mesh).first.back(), "vertex 4 lies in the edge 1–7");
  mesh.positions[4].x = 0.99F;  // now a hole, but no T-vertex
  EXPECT_EQ(check_mesh(mesh)[MeshFault::kTVertex], 0U);
}

// The middle of an edge in single precision is off the edge by rounding, which is a large share of a short
// one.
TEST(MeshChecks, FindTVerticesInShortEdgesFarFromTheOrigin) {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> uniform(-1, 1);
  for (const float length : {1.0F, 0.1F, 0.01F, 1e-3F, 1e-4F}) {
    for (int k = 0; k < 200; ++k) {
      const glm::vec3 place = 4.0F * glm::vec3(uniform(random), uniform(random), uniform(random));
      const glm::vec3 along = length * glm::normalize(glm::vec3(uniform(random), uniform(random), 1.5F));
      const std::vector<glm::vec3> positions{place, place + along, 0.5F * (place + (place + along))};
      const std::vector<VertexPair> edges{{0, 1}, {1, 2}, {2, 0}};
      const std::vector<VertexInEdge> found = vertices_in_edges(positions, edges, 1e-5F);
      ASSERT_EQ(found.size(), 1U) << length;
      EXPECT_EQ(found[0].vertex, 2U);
    }
  }
}

TEST(MeshChecks, VerticesInEdgesAgreeWithTryingAll) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> uniform(-1, 1);
  const auto somewhere = [&] { return glm::vec3(uniform(random), uniform(random), uniform(random)); };
  std::vector<glm::vec3> positions;
  std::vector<VertexPair> edges;
  for (std::uint32_t i = 0; i < 300; ++i) {
    const glm::vec3 a = somewhere(), b = i % 3 == 0 ? a + glm::vec3(uniform(random), 0, 0) : somewhere();
    positions.insert(positions.end(), {a, b, a + (b - a) * (0.5F + 0.4F * uniform(random))});
    edges.push_back({3 * i, 3 * i + 1});
    edges.push_back({3 * i + 2, 3 * (i / 2)});
  }
  for (const float tolerance : {1e-5F, 0.05F}) {
    std::vector<std::pair<std::uint32_t, VertexPair>> expected, found;
    for (const VertexPair& e : edges) {
      const glm::dvec3 a(positions[e.first]), b(positions[e.second]);
      const double length = glm::distance(a, b),
                   limit = std::max(tolerance * length, glm::length(glm::max(glm::abs(a), glm::abs(b))) *
                                                            std::numeric_limits<float>::epsilon());
      for (std::uint32_t v = 0; v < positions.size(); ++v) {
        const glm::dvec3 p(positions[v]);
        const double t = std::clamp(glm::dot(p - a, b - a) / (length * length), 0.0, 1.0);
        const bool inside = glm::distance(p, a) > limit && glm::distance(p, b) > limit;
        if (inside && glm::distance(p, a + (b - a) * t) <= limit) expected.push_back({v, e});
      }
    }
    for (const VertexInEdge& f : vertices_in_edges(positions, edges, tolerance)) {
      found.push_back({f.vertex, f.edge});
    }
    EXPECT_EQ(found, expected);
    EXPECT_GE(expected.size(), 290U);
  }
}

}  // namespace
}  // namespace terrabench
