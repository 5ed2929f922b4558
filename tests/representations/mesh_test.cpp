// Meshes close, face outward and enclose the volume that the spans add up to.
#include <glm/geometric.hpp>

#include "tests/representations/ground.h"
#include "tests/terrain/ground.h"

namespace terrabench::test {
namespace {

// The spans' volume, for structures whose columns are the cells of an n × m lattice over their bounds.
double span_volume(const Representation& built, int n, int m) {
  const Lattice lattice(built.bounds(), n, m);
  double height = 0;
  const SpanSink sink = spans_of(built, lattice.columns());
  for (const Span& span : sink.all()) height += static_cast<double>(span.top) - span.bottom;
  return height * built.bounds().size().x * built.bounds().size().z / (static_cast<double>(n) * m);
}

void expect_no_degenerate_triangle(const TriangleMesh& mesh) {
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const glm::dvec3 a = mesh.positions[mesh.indices[t]], b = mesh.positions[mesh.indices[t + 1]],
                     c = mesh.positions[mesh.indices[t + 2]];
    ASSERT_GT(glm::length(glm::cross(b - a, c - a)), 0) << "triangle " << t / 3;
  }
}

class Blocks : public testing::TestWithParam<std::tuple<std::string_view, unsigned>> {};
INSTANTIATE_TEST_SUITE_P(Seeds, Blocks,
                         testing::Combine(testing::Values("layered_stack", "dense_voxel"),
                                          testing::Range(0U, 8U)));

TEST_P(Blocks, OfSingleCellsAreWatertight) {
  const auto [name, seed] = GetParam();
  const auto built = build(name, random_cells(seed, 11, 14, 9, 2, 10 + 11 * seed), 14);
  const TriangleMesh mesh = built->mesh({});
  EXPECT_TRUE(check_edges(mesh).watertight());
  expect_no_degenerate_triangle(mesh);
  EXPECT_NEAR(volume(mesh), span_volume(*built, 11, 9), 1e-3);
}

TEST_P(Blocks, OfBoxesAreWatertightAtAnyDetail) {
  const auto [name, seed] = GetParam();
  const auto built = build(name, random_boxes(seed, 24, 30, 2), 24);
  for (const float cell : {0.0F, 0.2F, 1.0F, 2.0F, 3.0F, 7.0F, 1000.0F}) {
    const TriangleMesh mesh = built->mesh({cell});
    EXPECT_TRUE(check_edges(mesh).watertight());
    if (cell <= 1) {
      EXPECT_NEAR(volume(mesh), span_volume(*built, 24, 24), 1e-2);
    }
  }
  EXPECT_LT(built->mesh({4}).triangles(), built->mesh({}).triangles() / 4);
}

TEST(StackMesh, OfOneBlockHasTwelveTriangles) {
  const auto built = build("layered_stack", from_heights(1, 1, {5}, 2, 2), 0, 0.5);
  const TriangleMesh mesh = built->mesh({});
  EXPECT_EQ(mesh.triangles(), 12U);
  EXPECT_TRUE(check_edges(mesh).watertight());
  EXPECT_NEAR(volume(mesh), 2 * 2 * 2, 1e-5);
}

TEST(StackMesh, WallsAreMergedOverLevels) {
  const auto coarse = build("layered_stack", from_heights(8, 8, std::vector<float>(64, 50), 1, 1), 0, 1);
  const auto fine = build("layered_stack", from_heights(8, 8, std::vector<float>(64, 50), 1, 1), 0, 0.01);
  EXPECT_EQ(coarse->mesh({}).triangles(), fine->mesh({}).triangles());
}

TEST(HeightmapMesh, ClosesAroundHolesThatTouchAtCorners) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::vector<float> heights =
        with_holes(random_ground(23, 31, seed, 0, 10), seed + 1, 0.02 * seed).heights;
    heights[0] = 1;
    const auto built = build("heightmap", from_heights(23, 31, heights, 3, 2));
    for (const float cell : {0.0F, 1.1F, 5.0F, 400.0F}) {
      const TriangleMesh mesh = built->mesh({cell});
      EXPECT_TRUE(check_edges(mesh).watertight());
      expect_no_degenerate_triangle(mesh);
      if (cell == 0 && seed < 10) {
        EXPECT_GT(volume(mesh), 0);
      }
    }
  }
}

TEST(HeightmapMesh, EnclosesTheGround) {
  const auto flat = build("heightmap", from_heights(4, 3, std::vector<float>(12, 10), 2, 2));
  EXPECT_NEAR(volume(flat->mesh({})), 6 * 4 * 2, 1e-4);  // down to the floor, a cell below
  EXPECT_EQ(flat->mesh({}).triangles(), 4U * 6 + 2 * 10);
  const auto row = build("heightmap", from_heights(5, 1, {1, 2, 3, 4, 5}));
  EXPECT_EQ(row->mesh({}).triangles(), 0U);
  const auto solid = build("heightmap", random_boxes(5, 16, 30, 1), 16);
  EXPECT_TRUE(check_edges(solid->mesh({})).watertight());
}

TEST(VoxelMesh, HasNoOpenEdgeAndFacesOutward) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    const auto built = build("voxel", random_boxes(seed, 24, 30, 2), 24);
    const TriangleMesh mesh = built->mesh({});
    const EdgeReport edges = check_edges(mesh);
    EXPECT_EQ(edges.open, 0U);
    // Each cell along an edge is cut off, so that boxes of few cells lose up to a fifth.
    const double expected = span_volume(*built, 24, 24);
    EXPECT_NEAR(volume(mesh), expected, 0.2 * expected);
  }
  EXPECT_TRUE(
      check_edges(build("voxel", from_heights(20, 20, std::vector<float>(400, 3)))->mesh({})).watertight());
}

TEST(Mesh, OfNothingIsEmpty) {
  const TerrainSource air =
      from_predicate({{0, 0, 0}, {4, 4, 4}}, [](float, float, float) { return Material::kAir; });
  for (const RepresentationType& type : representations()) {
    EXPECT_EQ(build(type.name, air, 4)->mesh({}).triangles(), 0U) << type.name;
  }
}

}  // namespace
}  // namespace terrabench::test
