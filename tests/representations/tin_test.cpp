#include "representations/tin/tin.h"

#include <gmock/gmock.h>

#include "representations/column_grid.h"
#include "representations/tin/triangle_plane.h"
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
