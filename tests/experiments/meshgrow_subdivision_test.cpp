// What the subdivision of "meshgrow" is compared with: the plain reference is Catmull–Clark on a mesh known
// by hand, OpenSubdiv places every vertex of every shape where we do, and differences show in both.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "experiments/meshgrow/ring_eigenvalue.h"
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

double size_of(const FaceMesh& mesh) {
  glm::vec3 low = mesh.positions[0], high = low;
  for (const glm::vec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
  return glm::distance(low, high);
}

class OpenSubdivPeerTest : public testing::TestWithParam<subdivision::Boundary> {};

TEST_P(OpenSubdivPeerTest, HasOurFacesAndPlacesEveryVertexWhereWeDo) {
  constexpr int kLevels = 4;
  for (const Shape& shape : shapes()) {
    const subdivision::Refinement ours(shape.mesh, kLevels, {GetParam()});
    const std::vector<PeerLevel> theirs = opensubdiv_levels(shape.mesh, ours, GetParam());
    ASSERT_EQ(theirs.size(), kLevels + 1U) << shape.name;
    subdivision::LevelPoints points{shape.mesh.positions, {}};
    for (int l = 1; l <= kLevels; ++l) {
      const PeerLevel& peer = theirs[static_cast<std::size_t>(l)];
      points = subdivision::next_points(ours, l - 1, points, {}, 1);
      ASSERT_EQ(points.positions.size(), peer.points.size()) << shape.name;
      double worst = 0;
      for (std::size_t v = 0; v < peer.points.size(); ++v) {
        worst = std::max(worst, glm::distance(glm::dvec3(points.positions[v]), peer.points[peer.ours[v]]));
      }
      EXPECT_EQ(peer.mismatches, 0U) << shape.name << ", level " << l;
      EXPECT_LT(worst, 1e-6 * size_of(shape.mesh)) << shape.name << ", level " << l;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Boundaries, OpenSubdivPeerTest,
                         testing::Values(subdivision::Boundary::kEdge, subdivision::Boundary::kEdgeAndCorner),
                         [](const auto& info) {
                           return info.param == subdivision::Boundary::kEdge ? "Edge" : "EdgeAndCorner";
                         });

TEST(OpenSubdivPeer, SeesACreaseThatTheOtherSideLacks) {
  const FaceMesh creased = shape("creased-cube");
  FaceMesh smooth = creased;
  smooth.creases.clear();
  constexpr auto kEdge = subdivision::Boundary::kEdge;
  const subdivision::Refinement refinement(smooth, 2, {kEdge});
  const std::vector<PeerLevel> same = opensubdiv_levels(smooth, refinement, kEdge),
                               other = opensubdiv_levels(creased, refinement, kEdge);
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
