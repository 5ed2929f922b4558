// What the subdivision of "meshgrow" is compared with: the plain reference is Catmull–Clark on a mesh known
// by hand, OpenSubdiv places every vertex of every shape where we do, and differences show in both.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "experiments/meshgrow/subdivision_peer.h"
#include "experiments/meshgrow/subdivision_reference.h"
#include "tests/representations/face_shapes.h"

namespace terrabench::meshgrow {
namespace {

TEST(PlainCatmullClark, MovesTheCornerOfACubeToFiveNinths) {
  const PlainMesh cube = plain(shape("cube")), finer = catmull_clark(cube);
  ASSERT_EQ(finer.points.size(), 26U);
  ASSERT_EQ(finer.faces.size(), 24U);
  for (std::size_t v = 0; v < 8; ++v) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(finer.points[v][k], cube.points[v][k] * 5 / 9, 1e-15);
  }
}

TEST(PlainCatmullClark, ComparisonSeesMovedPointsAndOtherFaces) {
  const PlainMesh finer = catmull_clark(plain(shape("box")));
  std::vector<std::uint32_t> quads;
  for (const auto& face : finer.faces) quads.insert(quads.end(), face.begin(), face.end());
  std::vector<glm::dvec3> points = finer.points;
  EXPECT_EQ(compare(quads, points, finer).mismatches, 0U);
  EXPECT_EQ(compare(quads, points, finer).largest, 0);
  points[3].x += 0.01;
  EXPECT_GT(compare(quads, points, finer).largest, 1e-3);
  std::swap(quads[0], quads[1]);
  EXPECT_GT(compare(quads, finer.points, finer).mismatches, 0U);
}

using subdivision::Boundary;

class OpenSubdivPeerTest : public testing::TestWithParam<Boundary> {};

TEST_P(OpenSubdivPeerTest, HasOurFacesAndPlacesEveryVertexWhereWeDo) {
  for (const Shape& shape : shapes()) {
    const subdivision::Refinement ours(shape.mesh, 4, {GetParam()});
    const std::vector<PeerLevel> theirs = opensubdiv_levels(shape.mesh, ours, GetParam());
    const auto points = standard_points(ours, {shape.mesh.positions.begin(), shape.mesh.positions.end()});
    ASSERT_EQ(theirs.size(), points.size()) << shape.name;
    for (std::size_t l = 1; l < points.size(); ++l) {
      ASSERT_EQ(points[l].size(), theirs[l].points.size()) << shape.name;
      double worst = 0;
      for (std::size_t v = 0; v < points[l].size(); ++v) {
        worst = std::max(worst, glm::distance(points[l][v], theirs[l].points[theirs[l].ours[v]]));
      }
      EXPECT_EQ(theirs[l].mismatches, 0U) << shape.name << ", level " << l;
      EXPECT_LT(worst, 1e-12) << shape.name << ", level " << l;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Boundaries, OpenSubdivPeerTest,
                         testing::Values(Boundary::kEdge, Boundary::kEdgeAndCorner));

TEST(OpenSubdivPeer, SeesACreaseThatTheOtherSideLacks) {
  const FaceMesh creased = shape("creased-cube"), smooth = shape("cube");
  const subdivision::Refinement refinement(smooth, 2, {Boundary::kEdge});
  const std::vector<PeerLevel> same = opensubdiv_levels(smooth, refinement, Boundary::kEdge),
                               other = opensubdiv_levels(creased, refinement, Boundary::kEdge);
  ASSERT_EQ(same.size(), 3U);
  ASSERT_EQ(other.size(), 3U);
  EXPECT_EQ(same[2].mismatches, 0U);
  double apart = 0;
  for (std::size_t v = 0; v < same[2].points.size(); ++v) {
    apart = std::max(apart, std::abs(same[2].points[v].x - other[2].points[v].x));
  }
  EXPECT_GT(apart, 0.1);
}

// The constant vector has eigenvalue 1 and must not grow from rounding within the steps of the power method.
TEST(RingEigenvalue, IsThatOfTheClosedForms) {
  for (std::size_t faces = 3; faces <= 12; ++faces) {
    const auto n = static_cast<double>(faces);
    EXPECT_NEAR(ring_eigenvalue(faces, 0), (3 * n - 7 + std::sqrt(5 * n * n - 30 * n + 49)) / (8 * n), 1e-9)
        << faces;
    const double angle = std::numbers::pi / n, c = std::cos(2 * angle);
    EXPECT_NEAR(ring_eigenvalue(faces, 1), (5 + c + std::cos(angle) * std::sqrt(2 * (c + 9))) / 16, 1e-9)
        << faces;
  }
}

}  // namespace
}  // namespace terrabench::meshgrow
