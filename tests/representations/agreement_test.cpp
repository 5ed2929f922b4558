// Every representation that can hold a terrain returns the samples that it was built from, so that all agree.
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <atomic>

#include "representations/column_grid.h"
#include "representations/layered_stack/layered_stack.h"
#include "tests/representations/ground.h"
#include "tests/terrain/ground.h"

namespace terrabench::test {
namespace {

const std::vector<std::string_view> kVolumes = types([](const Traits& t) { return t.materials; });

// The lattice's samples, asked at cell centres, are the source's own.
void expect_samples(std::string_view name, const TerrainSource& source, std::int64_t resolution) {
  SCOPED_TRACE(name);
  const RepresentationType& type = representation(name);
  const ColumnSampler sampler(source, with(type, resolution), 512);
  const ColumnGrid& grid = sampler.grid();
  const auto built = build(name, source, resolution);
  std::vector<Material> expected(static_cast<std::size_t>(grid.levels)), got(expected.size());
  std::vector<float> x(expected.size()), y(expected.size()), z(expected.size());
  for (int level = 0; level < grid.levels; ++level) y[static_cast<std::size_t>(level)] = grid.centre_y(level);
  for (int j = 0; j < grid.depth; ++j) {
    for (int i = 0; i < grid.width; ++i) {
      sampler.sample(i, j, expected);
      std::fill(x.begin(), x.end(), grid.centre_x(i));
      std::fill(z.begin(), z.end(), grid.centre_z(j));
      built->materials({x, y, z}, got);
      ASSERT_EQ(got, expected) << "column " << i << ", " << j;
    }
  }
}

// materials() agrees with spans() at any point; the default implementation uses spans().
void expect_materials_follow_spans(const Representation& built, unsigned seed) {
  const Cloud cloud(built.bounds(), 3000, seed);
  std::vector<Material> quick(cloud.x.size()), slow(cloud.x.size());
  built.materials(cloud.points(), quick);
  built.Representation::materials(cloud.points(), slow);
  EXPECT_EQ(quick, slow);
}

void expect_canonical(const SpanSink& sink, const Bounds& bounds) {
  for (std::size_t c = 0; c < sink.columns(); ++c) {
    float top = bounds.low.y;
    Material below = Material::kAir;
    for (const Span& span : sink.column(c)) {
      ASSERT_LT(span.bottom, span.top);
      ASSERT_GE(span.bottom, top);
      ASSERT_NE(span.material, Material::kAir);
      ASSERT_FALSE(span.bottom == top && span.material == below) << "two spans where one does";
      top = span.top;
      below = span.material;
    }
    ASSERT_LE(top, bounds.high.y);
  }
}

class VolumeAgreement : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Seeds, VolumeAgreement, testing::Range(0U, 12U));

TEST_P(VolumeAgreement, BoxesOfSeveralMaterials) {
  const TerrainSource source = random_boxes(GetParam(), 20 + static_cast<int>(GetParam()) * 3, 30,
                                            1 + static_cast<int>(GetParam() % 3));
  const auto stack = build("layered_stack", source, 37);
  const Lattice lattice(stack->bounds(), 61, 53);
  const SpanSink expected = spans_of(*stack, lattice.columns());
  expect_canonical(expected, stack->bounds());
  for (const std::string_view name : kVolumes) {
    expect_samples(name, source, 37);
    const auto built = build(name, source, 37);
    EXPECT_TRUE(same_spans(spans_of(*built, lattice.columns()), expected)) << name;
    expect_materials_follow_spans(*built, GetParam());
  }
}

TEST_P(VolumeAgreement, SingleCells) {
  const TerrainSource source =
      random_cells(GetParam(), 19, 40, 23, 1 + static_cast<int>(GetParam() % 4), 20 + 6 * GetParam());
  const auto stack = build("layered_stack", source, 40);
  const Lattice lattice(stack->bounds(), 19, 23);
  const SpanSink expected = spans_of(*stack, lattice.columns());
  for (const std::string_view name : kVolumes) {
    expect_samples(name, source, 40);
    EXPECT_TRUE(same_spans(spans_of(*build(name, source, 40), lattice.columns()), expected)) << name;
  }
}

TEST(Agreement, Caves) {
  const TerrainSource source = caves();
  for (const std::string_view name : kVolumes) expect_samples(name, source, 64);
}

TEST(Agreement,
     TallTilesOfRunsNeedWideStarts) {  // 16 × 16 columns of about 500 runs: starts need more than 16 bits
  const TerrainSource source = random_cells(5, 20, 1024, 18, 1, 50);
  for (const std::string_view name : kVolumes) expect_samples(name, source, 1024);
}

TEST(Agreement, HeightmapIsTheTopmostSurface) {
  const TerrainSource source = random_boxes(3, 30, 25, 2);
  const auto stack = build("layered_stack", source, 30), heightmap = build("heightmap", source, 30);
  const Lattice lattice(stack->bounds(), 30, 30);
  const SpanSink volumes = spans_of(*stack, lattice.columns()),
                 tops = spans_of(*heightmap, lattice.columns());
  int lost = 0;
  for (std::size_t c = 0; c < volumes.columns(); ++c) {
    ASSERT_EQ(volumes.column(c).empty(), tops.column(c).empty());
    if (volumes.column(c).empty()) continue;
    ASSERT_EQ(tops.column(c).size(), 1U);
    EXPECT_EQ(tops.column(c).front().top, volumes.column(c).back().top);
    EXPECT_EQ(tops.column(c).front().bottom, heightmap->bounds().low.y);
    lost += volumes.column(c).size() > 1 ? 1 : 0;
  }
  EXPECT_GT(lost, 50);
}

TEST(Agreement, HeightsComeBackExactlyOrToHalfAStep) {
  std::vector<float> heights = random_ground(31, 17, 4, -120.5F, 2300).heights;
  heights[40] = heights[200] = Heightfield::kNoData;
  const TerrainSource source = from_heights(31, 17, heights, 29.7F, 31.3F);
  std::vector<float> x, z;
  for (int j = 0; j < 17; ++j) {
    for (int i = 0; i < 31; ++i) {
      x.push_back(static_cast<float>(i) * 29.7F);
      z.push_back(static_cast<float>(j) * 31.3F);
    }
  }
  for (const auto& [name, step, error] : {std::tuple<std::string_view, double, float>{"heightmap", 0, 0.0F},
                                          {"layered_stack", 0, 1.0F / 32},  // 2451 m in 65535 steps of 1/16 m
                                          {"layered_stack", 10, 5.0F},
                                          {"voxel", 0, 4.0F},  // 512 levels of 8 m
                                          {"dense_voxel", 2.5, 1.25F}}) {
    SCOPED_TRACE(name);
    const auto built = build(name, source, 0, step);
    const SpanSink sink = spans_of(*built, {x, z});
    float largest = 0;
    for (std::size_t c = 0; c < heights.size(); ++c) {
      ASSERT_EQ(sink.column(c).empty(), Heightfield::is_no_data(heights[c])) << c;
      if (!sink.column(c).empty())
        largest = std::max(largest, std::abs(sink.column(c).back().top - heights[c]));
    }
    EXPECT_LE(largest, error * 1.01F);
    EXPECT_GE(largest, error * 0.9F);
  }
}

TEST(Agreement, WholeMetresAreExactInStacks) {
  std::vector<float> heights;
  for (int i = 0; i < 400; ++i) heights.push_back(static_cast<float>(236 + (i * 7919) % 840));
  const TerrainSource source = from_heights(20, 20, heights, 92.7F, 74.1F);
  const auto stack = build("layered_stack", source);
  for (int j = 0; j < 20; ++j) {
    for (int i = 0; i < 20; ++i) {
      const std::vector<float> x{static_cast<float>(i) * 92.7F}, z{static_cast<float>(j) * 74.1F};
      EXPECT_EQ(spans_of(*stack, {x, z}).column(0).back().top, heights[static_cast<std::size_t>(j * 20 + i)]);
    }
  }
}

TEST(Agreement, HeightmapIsBilinearBetweenSamples) {
  const auto built = build("heightmap", from_heights(3, 2, {0, 10, Heightfield::kNoData, 20, 50, 70}, 2, 4));
  const std::vector<float> x{1, 0.5F, 2, 3, 4, 2.5F, -0.1F}, z{2, 0, 1, 4, 4, 0, 0};
  const SpanSink sink = spans_of(*built, {x, z});
  const float expected[] = {20, 2.5F, 20, 60, 70};
  for (std::size_t c = 0; c < 5; ++c) {
    ASSERT_EQ(sink.column(c).size(), 1U);
    EXPECT_EQ(sink.column(c)[0].top, expected[c]) << c;
  }
  EXPECT_TRUE(sink.column(5).empty());  // a no-data sample has weight
  EXPECT_TRUE(sink.column(6).empty());  // outside
}

TEST(Agreement, OneThreadBuildsWhatManyBuild) {
  const TerrainSource source = caves();
  for (const RepresentationType& type : representations()) {
    const auto many = build(type.name, source, 50);
    const TriangleMesh many_mesh = many->mesh({});
    const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
    const auto alone = build(type.name, source, 50);
    EXPECT_EQ(saved(*alone), saved(*many)) << type.name;
    EXPECT_EQ(alone->mesh({}).indices, many_mesh.indices) << type.name;
  }
}

TEST(Agreement, ManyThreadsMayAskAtOnce) {
  for (const RepresentationType& type : representations()) {
    const auto built = build(type.name, random_boxes(5, 30, 40, 3), 30);
    const Cloud cloud(built->bounds(), 2000, 6);
    std::vector<Material> expected(cloud.x.size());
    built->materials(cloud.points(), expected);
    const SpanSink columns = spans_of(*built, {cloud.x, cloud.z});
    std::atomic<int> wrong = 0;
    tbb::parallel_for(0, 16, [&](int) {
      std::vector<Material> got(cloud.x.size());
      built->materials(cloud.points(), got);
      if (got != expected || !same_spans(spans_of(*built, {cloud.x, cloud.z}), columns)) ++wrong;
    });
    EXPECT_EQ(wrong, 0) << type.name;
  }
}

TEST(Agreement, SaveThenLoadIsTheSame) {
  for (const RepresentationType& type : representations()) {
    for (const TerrainSource& source : {random_boxes(9, 20, 30, 3), random_cells(2, 9, 30, 33, 2, 60),
                                        caves(), from_heights(2, 3, {1, 2, 3, Heightfield::kNoData, 5, 6})}) {
      const auto built = build(type.name, source, source.heights ? 0 : 33),
                 copy = reloaded(type.name, *built);
      const Lattice lattice(built->bounds(), 40, 40);
      EXPECT_TRUE(same_spans(spans_of(*copy, lattice.columns()), spans_of(*built, lattice.columns())))
          << type.name;
      EXPECT_EQ(copy->bounds().low, built->bounds().low);
      EXPECT_EQ(copy->bounds().high, built->bounds().high);
      EXPECT_EQ(copy->memory().payload, built->memory().payload) << type.name;
      EXPECT_EQ(saved(*copy), saved(*built));
    }
  }
}

}  // namespace
}  // namespace terrabench::test
