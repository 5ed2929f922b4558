#include "representations/tin/tin.h"

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <thread>

#include "representations/column_grid.h"
#include "terrain/tin/triangle_plane.h"
#include "tests/representations/tin_ground.h"

namespace terrabench::test {
namespace {

// The square of the distance from a circle's centre, less that of its radius, by the determinant in long
// double.
bool inside_circle(Sample a, Sample b, Sample c, Sample q) {
  const auto row = [&](Sample s) {
    const long double x = s.i - q.i, y = s.j - q.j;
    return std::array<long double, 3>{x, y, x * x + y * y};
  };
  const auto u = row(a), v = row(b), w = row(c);
  return u[2] * (v[0] * w[1] - v[1] * w[0]) + v[2] * (w[0] * u[1] - w[1] * u[0]) +
             w[2] * (u[0] * v[1] - u[1] * v[0]) >
         0;
}

TEST(DelaunayTest, NoVertexLiesInACircumcircleAndTrianglesFillTheRectangle) {
  const Delaunay surface = triangulated(60, 60, some_samples(60, 300, 1));
  std::int64_t area = 0;
  for (const Triangle& t : surface.triangles()) {
    const Sample a = surface.vertex(t, 0), b = surface.vertex(t, 1), c = surface.vertex(t, 2);
    ASSERT_GT(tin::twice_area(a, b, c), 0);
    area += tin::twice_area(a, b, c);
    for (const Sample q : surface.vertices()) EXPECT_FALSE(inside_circle(a, b, c, q));
  }
  EXPECT_EQ(area, 2 * 59 * 59);
}

TEST(DelaunayTest, NeighboursPointAtEachOther) {
  const Delaunay surface = triangulated(40, 50, some_samples(40, 200, 2));
  for (std::uint32_t t = 0; t < surface.triangles().size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t beyond = surface.triangles()[t].neighbour[k];
      if (beyond == Delaunay::kNone) continue;
      EXPECT_THAT(surface.triangles()[beyond].neighbour, testing::Contains(t));
    }
  }
}

// A full lattice is nothing but four points on a circle.
TEST(DelaunayTest, TheOrderOfInsertionDoesNotMatter) {
  std::vector<Sample> samples;
  for (std::uint16_t j = 0; j < 9; ++j) {
    for (std::uint16_t i = 0; i < 9; ++i) samples.push_back({i, j});
  }
  const auto expected = corners(triangulated(9, 9, samples));
  EXPECT_EQ(expected.size(), 128U);
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::shuffle(samples.begin(), samples.end(), std::mt19937(seed));
    EXPECT_EQ(corners(triangulated(9, 9, samples)), expected) << seed;
  }
}

// One sample per triangle, listed with it before the threads start, as greedy insertion does.
TEST(DelaunayTest, ThreadsInTilesOfTheirOwnGiveTheTriangulationOfTheSamples) {
  constexpr int kSide = 256, kTile = 64;
  std::vector<Sample> all = some_samples(kSide, 4000, 4);
  Delaunay surface = triangulated(kSide, kSide, all);
  struct Work {
    tin::Tile tile;
    std::vector<std::pair<Sample, std::uint32_t>> due;
    Delaunay::Workspace space;
    std::vector<std::uint32_t> changed;
    std::vector<Sample> left;
  };
  std::vector<Work> works;
  for (std::uint16_t j = 0; j < kSide; j += kTile) {
    for (std::uint16_t i = 0; i < kSide; i += kTile) works.push_back({{{i, j}, kTile}, {}, {}, {}, {}});
  }
  std::set<std::uint32_t> taken;
  std::uint32_t near = 0;
  for (const Sample s : some_samples(kSide, 2000, 5)) {
    near = surface.locate(s, near);
    if (surface.vertex_at(s, near) != Delaunay::kNone || !taken.insert(near).second) continue;
    works[static_cast<std::size_t>(s.j / kTile * (kSide / kTile) + s.i / kTile)].due.emplace_back(s, near);
    all.push_back(s);
  }
  for (Work& work : works) work.space = surface.make_workspace(work.due.size());
  {
    std::vector<std::jthread> threads;  // not TBB's, which ThreadSanitizer does not see
    for (Work& work : works) {
      threads.emplace_back([&] {
        for (const auto& [s, triangle] : work.due) {
          if (std::ranges::count(work.changed, triangle) > 0 ||
              surface.insert_in(work.tile, s, triangle, work.space, work.changed) == Delaunay::kNone) {
            work.left.push_back(s);
          }
        }
      });
    }
  }
  std::size_t left = 0;
  std::vector<std::uint32_t> changed;
  for (Work& work : works) {
    surface.take_back(std::move(work.space));
    left += work.left.size();
    for (const Sample s : work.left) surface.insert(s, surface.locate(s, 0), changed);
  }
  surface.put_in_order();
  EXPECT_GT(left, 0U);
  EXPECT_LT(left, taken.size() / 2);
  EXPECT_EQ(corners(surface), corners(triangulated(kSide, kSide, all)));
}

// So rough that tiles are taken.
TEST(TinTest, EveryNumberOfThreadsPicksTheSameVertices) {
  Heightfield field = hills(800, 800);
  std::mt19937 random(6);
  for (float& h : field.heights) h += static_cast<float>(random() % 64);
  Progress progress;
  const auto with = [&](std::size_t threads) {
    const tbb::global_control at_most(tbb::global_control::max_allowed_parallelism, threads);
    return tin::greedy_insertion(field, 1, progress);
  };
  const tin::Approximation one = with(1), four = with(4);
  EXPECT_GT(one.heights.size(), 400'000U);
  EXPECT_EQ(one.surface.vertices(), four.surface.vertices());
  EXPECT_EQ(one.heights, four.heights);
}

TEST(TinTest, NoSampleIsMissedByMoreThanTheLargestError) {
  const Heightfield field = hills(150, 90);
  for (const double error : {50.0, 5.0, 0.5}) {
    const auto built = build_tin(field, error);
    float largest = 0;
    for (int j = 0; j < field.depth; ++j) {
      for (int i = 0; i < field.width; ++i) {
        largest = std::max(largest, std::abs(field.at(i, j) - built->height(10.0F * static_cast<float>(i),
                                                                            20.0F * static_cast<float>(j))));
      }
    }
    EXPECT_LE(largest, error);
    EXPECT_GT(largest, 0.5 * error);
  }
}

TEST(TinTest, FlatGroundIsTwoTriangles) {
  const auto built = build_tin(Heightfield::zeros(300, 200), 0);
  EXPECT_EQ(built->triangles(), 2U);
}

// The published order, one sample at a time, by searching all samples for each.
std::size_t vertices_of_strict_order(const Heightfield& field, float error) {
  Delaunay surface(field.width, field.depth);
  std::vector<std::uint32_t> changed;
  for (;;) {
    float worst = 0;
    Sample at{};
    std::uint32_t in = 0, near = 0;
    for (std::uint16_t j = 0; j < field.depth; ++j) {
      for (std::uint16_t i = 0; i < field.width; ++i) {
        near = surface.locate({i, j}, near);
        const Triangle& t = surface.triangles()[near];
        const std::array<Sample, 3> p{surface.vertex(t, 0), surface.vertex(t, 1), surface.vertex(t, 2)};
        const tin::Plane plane(
            p, {field.at(p[0].i, p[0].j), field.at(p[1].i, p[1].j), field.at(p[2].i, p[2].j)});
        const auto miss = static_cast<float>(std::abs(plane(i, j) - field.at(i, j)));
        if (miss > worst) {
          worst = miss;
          at = {i, j};
          in = near;
        }
      }
    }
    if (worst <= error) return surface.vertices().size();
    surface.insert(at, in, changed);
  }
}

TEST(TinTest, PassesTakeHardlyMoreVerticesThanOneSampleAtATime) {
  const Heightfield field = hills(65, 65);
  for (const float error : {40.0F, 10.0F}) {
    const auto built = build_tin(field, error);
    const auto strict = static_cast<double>(vertices_of_strict_order(field, error));
    const double taken = static_cast<double>(built->triangles()) / 2;
    EXPECT_LE(taken, 1.1 * strict) << error;
  }
}

TEST(TinTest, HolesAreThoseOfTheHeightmap) {
  Heightfield field = hills(80, 70);
  std::mt19937 random(3);
  for (float& h : field.heights) {
    if (random() % 5 == 0) h = Heightfield::kNoData;
  }
  for (int j = 20; j < 40; ++j) {
    for (int i = 30; i < 60; ++i) field.at(i, j) = Heightfield::kNoData;
  }
  field.at(0, 0) = Heightfield::kNoData;
  const auto built = build_tin(field, 5);
  Progress progress;
  const auto map = Heightmap::build(source_of("test", field), Parameters(column_parameters()), progress);
  std::vector<float> x, z;
  for (int k = 0; k < 20000; ++k) {
    x.push_back(static_cast<float>(random() % 1600) * 0.5F);
    z.push_back(static_cast<float>(random() % 2800) * 0.5F);
  }
  SpanSink ours, theirs;
  built->spans({x, z}, ours);
  map->spans({x, z}, theirs);
  for (std::size_t c = 0; c < x.size(); ++c) {
    ASSERT_EQ(ours.column(c).size(), theirs.column(c).size()) << x[c] << " " << z[c];
  }
  EXPECT_TRUE(check_edges(built->mesh({})).watertight());
  ByteSink saved;
  built->save(saved);
  ByteSource bytes(saved.bytes(), "test");
  const auto loaded = Tin::load(bytes);
  SpanSink again;
  loaded->spans({x, z}, again);
  EXPECT_TRUE(std::ranges::equal(again.all(), ours.all()));
}

}  // namespace
}  // namespace terrabench::test
