// Rays on representations against every triangle of a mesh in turn, in double precision.
#include <tbb/global_control.h>

#include "tests/representations/rays.h"

namespace terrabench::test {
namespace {

std::vector<float> rough(int count, unsigned seed, int hole_every) {
  std::mt19937 random(seed);
  std::vector<float> heights;
  for (int k = 0; k < count; ++k) {
    const auto height = static_cast<float>(random() % 1000) / 100;
    heights.push_back(
        hole_every > 0 && random() % static_cast<unsigned>(hole_every) == 0 ? Heightfield::kNoData : height);
  }
  return heights;
}

TEST(RayCast, HeightsAreTheTrianglesOfTheirMesh) {
  struct Shape {
    int width, depth;
    float cell_x, cell_z;
    int hole_every;
  };
  for (const Shape& s : {Shape{2, 2, 1, 1, 0}, Shape{17, 9, 1, 1, 0}, Shape{33, 2, 2, 5, 0},
                         Shape{23, 31, 3, 0.5F, 0}, Shape{20, 20, 1, 1, 30}, Shape{12, 40, 1, 2, 6}}) {
    const TerrainSource source =
        from_heights(s.width, s.depth, rough(s.width * s.depth, 5, s.hole_every), s.cell_x, s.cell_z);
    const auto built = build("heightmap", source);
    expect_hits(*built, built->mesh({}), 11);
  }
}

TEST(RayCast, HeightsOfASolidReachToItsBounds) {
  const TerrainSource source = random_boxes(3, 20, 30, 1);
  const auto built = build("heightmap", source, 13);
  expect_hits(*built, built->mesh({}), 12);
}

TEST(RayCast, DrillsAreTheirRegeneratedTerrain) {
  const auto built = build("drill", from_heights(30, 20, rough(600, 9, 0)));
  expect_hits(*built, built->mesh({}), 13);
}

TEST(RayCast, ColumnsAreBlocks) {
  for (const std::string_view type : {"layered_stack", "dense_voxel", "voxel"}) {
    for (const TerrainSource& source :
         {random_boxes(21, 24, 40, 3), random_cells(4, 9, 7, 11, 3, 40), random_cells(5, 6, 6, 6, 1, 90),
          from_heights(16, 11, rough(176, 2, 9))}) {
      const std::int64_t n = source.solid ? std::lround(source.solid->bounds.size().x) : 0;
      const auto built = build(type, source, n);
      // Voxels' own mesh is smoothed; a dense grid has the same blocks.
      const auto blocks = build(type == "voxel" ? "dense_voxel" : type, source, n);
      expect_hits(*built, blocks->mesh({}), 14);
    }
  }
}

TEST(RayCast, VerticalRaysHitWhatColumnsSay) {
  const TerrainSource source = random_boxes(22, 20, 40, 2);
  const auto built = build("layered_stack", source, 20);
  const Bounds bounds = built->bounds();
  const Lattice lattice(bounds, 20, 20);
  SpanSink sink;
  built->spans(lattice.columns(), sink);
  std::vector<Ray> rays;
  for (std::size_t c = 0; c < sink.columns(); ++c) {
    rays.push_back({{lattice.x[c], bounds.high.y + 5, lattice.z[c]}, {0, -1, 0}});
    rays.push_back({{lattice.x[c], bounds.low.y - 5, lattice.z[c]}, {0, 1, 0}});
  }
  const std::vector<float> distances = cast(*built, rays);
  for (std::size_t c = 0; c < sink.columns(); ++c) {
    const auto column = sink.column(c);
    EXPECT_FLOAT_EQ(distances[2 * c], column.empty() ? kNoHit : bounds.high.y + 5 - column.back().top);
    EXPECT_FLOAT_EQ(distances[2 * c + 1], column.empty() ? kNoHit : column.front().bottom - bounds.low.y + 5);
  }
}

// Through every sample, along every edge of the squares and along their diagonals: nothing slips through.
TEST(RayCast, NoRaySlipsThroughAnEdgeOrACorner) {
  constexpr int kSide = 13;
  const std::vector<float> heights = rough(kSide * kSide, 8, 0);
  const auto built = build("heightmap", from_heights(kSide, kSide, heights));
  std::vector<Ray> rays;
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const glm::vec3 sample(i, heights[static_cast<std::size_t>(j) * kSide + static_cast<std::size_t>(i)],
                             j);
      rays.push_back({sample + glm::vec3(0, 50, 0), {0, -1, 0}});
    }
  }
  const std::vector<float> down = cast(*built, rays);
  for (const float distance : down) EXPECT_NEAR(distance, 50, 1e-4);
  rays.clear();
  for (int k = 0; k < kSide; ++k) {
    const auto at = static_cast<float>(k);
    for (const float y : {-0.25F, 1.0F, 5.0F}) {  // walls are 1 m and more high: all enter through one
      rays.push_back({{-3, y - 0.5F, at}, {1, 0, 0}});
      rays.push_back({{at, y - 0.5F, kSide + 3.0F}, {0, 0, -1}});
      rays.push_back({{-3, y - 0.5F, at + 3}, {1, 0, -1}});
    }
  }
  const TriangleMesh mesh = built->mesh({});
  const std::vector<float> level = cast(*built, rays);
  for (std::size_t r = 0; r < rays.size(); ++r) {
    // The mesh is hit by this ray, or by one of its neighbours where it runs within a wall or an edge.
    float low = kNoHit, high = 0;
    for (const float dx : {-1e-3F, 1e-3F}) {
      Ray near = rays[r];
      near.origin += glm::vec3(dx, dx, -dx);
      low = std::min(low, brute_force(mesh, near));
      high = std::max(high, brute_force(mesh, near));
    }
    EXPECT_GE(level[r], low - 0.1F) << r;
    EXPECT_LE(level[r], high + 0.1F) << r;
  }
}

TEST(RayCast, GroundIsHitFromInside) {
  const auto built = build("heightmap", from_heights(9, 9, std::vector<float>(81, 4.0F)));
  const float floor = built->bounds().low.y;
  const std::vector<Ray> rays = {{{4.25F, 3.5F, 4.5F}, {0, 2, 0}},
                                 {{4.25F, 3.5F, 4.5F}, {0, -1, 0}},
                                 {{4.25F, 3.5F, 4.5F}, {1, 0, 0}},
                                 {{4.25F, 3.5F, 4.5F}, {1, 0, 0}, 0, 3}};
  const std::vector<float> distances = cast(*built, rays);
  EXPECT_FLOAT_EQ(distances[0], 0.25F);
  EXPECT_FLOAT_EQ(distances[1], 3.5F - floor);
  EXPECT_FLOAT_EQ(distances[2], 3.75F);
  EXPECT_EQ(distances[3], kNoHit);
}

TEST(RayCast, RaysThatAreNoneHitNothing) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kFar = 1e30F;
  const Ray down{{3, 100, 3}, {0, -1, 0}};
  std::vector<Ray> rays(10, down);
  rays[1].origin.x = kNan;
  rays[2].direction = {kNan, -1, 0};
  rays[3].direction = {0, 0, 0};
  rays[4].near = kNan;
  rays[5].far = kNan;
  rays[6].near = -1;
  rays[7].origin = {kNoHit, 0, 0};
  rays[8].direction = {0, -kFar, 0};
  rays[9] = {{3, 100, 3}, {0, -1, 0}, 5, 4};
  for (const char* type : {"heightmap", "layered_stack", "ght", "implicit"}) {
    const std::vector<float> distances =
        cast(*build(type, from_heights(8, 8, std::vector<float>(64, 1.0F))), rays);
    EXPECT_NEAR(distances[0], 99, 0.5);
    for (std::size_t r = 1; r < rays.size(); ++r) EXPECT_EQ(distances[r], kNoHit) << type << ' ' << r;
  }
}

TEST(RayCast, MeshesAndGroundWithoutAreaHaveNone) {
  const TerrainSource source = from_heights(8, 8, std::vector<float>(64, 1.0F));
  EXPECT_EQ(build("procedural_mesh", source)->ray_caster(), nullptr);
  EXPECT_EQ(build("heightmap", from_heights(5, 1, {1, 2, 3, 4, 5}))->ray_caster(), nullptr);
}

TEST(RayCast, ThreadsChangeNothing) {
  for (const std::string_view type : types([](const Traits& t) { return t.rays; })) {
    const auto built = build(type, random_boxes(30, 30, 50, 1), 30);
    const std::vector<Ray> rays = random_rays(built->bounds(), 17, 20000);
    const std::vector<float> many = cast(*built, rays);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(many, cast(*built, rays)) << type;
  }
}

TEST(RayCast, BytesAreThoseOfTheAllocator) {
  for (const char* type : {"heightmap", "layered_stack", "ght", "implicit"}) {
    const auto built = build(type, from_heights(200, 150, rough(30000, 6, 0)));
    built->ray_caster();
    const HeapScope scope;
    const auto caster = built->ray_caster();
    EXPECT_EQ(static_cast<std::int64_t>(caster->bytes()), scope.held()) << type;
  }
}

}  // namespace
}  // namespace terrabench::test
