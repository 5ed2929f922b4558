// The experiments on grass of "hybrid", in small.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "experiments/experiment.h"
#include "experiments/hybrid/grounds.h"
#include "tests/experiments/value.h"

namespace terrabench::hybrid {
namespace {

TEST(GrassExperiments, Table3TimesTheThreeNumbersWithEveryTechnique) {
  for (const char* const technique : {"geometry-shader", "instancing", "indirect"}) {
    const Record record = measured("hybrid.table3", {{"technique", std::string(technique)},
                                                     {"billboards", std::int64_t{600}},
                                                     {"frames", std::int64_t{4}},
                                                     {"warm_up", std::int64_t{1}},
                                                     {"width", std::int64_t{96}},
                                                     {"height", std::int64_t{64}},
                                                     {"cells", std::int64_t{16}}});
    SCOPED_TRACE(technique);
    EXPECT_EQ(value(record, "billboards_1n"), 600);
    EXPECT_EQ(value(record, "billboards_2n"), 1200);
    EXPECT_EQ(value(record, "billboards_3n"), 1800);
    EXPECT_GE(value(record, "ssim_to_geometry_shader"), 0.999);
    for (const char* const metric : {"frame_time_1n", "frame_time_2n", "frame_time_3n", "time_growth"}) {
      ASSERT_NE(record.find(metric), nullptr) << metric;
      EXPECT_EQ(record.find(metric)->samples.size(), 4U) << metric;
      for (const double each : record.find(metric)->samples) EXPECT_GT(each, 0) << metric;
    }
    const auto first = [&](const char* metric) { return record.find(metric)->samples.front(); };
    EXPECT_NEAR(first("frame_time_3n") / first("frame_time_1n"), first("time_growth"), 1e-9);
  }
}

TEST(GrassExperiments, SlopeCountsTheTrianglesOfEachReading) {
  const TriangleMesh mesh = grassland_mesh(grassland(RunOptions{}.seed, 128, 0.9F));
  const auto triangles = [&](double limit, bool printed) {
    std::int64_t count = 0;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
      const glm::dvec3 a(mesh.positions[mesh.indices[t]]), b(mesh.positions[mesh.indices[t + 1]]),
          c(mesh.positions[mesh.indices[t + 2]]);
      const double y = glm::normalize(glm::cross(b - a, c - a)).y;
      count += (printed ? (1 - y) * 90 : std::acos(y) * 57.29577951308232) <= limit ? 1 : 0;
    }
    return static_cast<double>(count);
  };
  const Record record = measured("hybrid.slope", {{"limit", 35.0}});
  EXPECT_EQ(value(record, "billboards_printed"), 2 * triangles(35, true));
  EXPECT_EQ(value(record, "billboards_by_true_angle"), 2 * triangles(35, false));
  EXPECT_GT(value(record, "billboards_printed"), value(record, "billboards_by_true_angle"));
  EXPECT_EQ(value(record, "billboards_everywhere"), 2.0 * static_cast<double>(mesh.triangles()));
  EXPECT_NEAR(value(record, "largest_difference"), 18.946, 0.001);
  EXPECT_NEAR(value(record, "true_angle_there"), 39.54, 0.01);
}

TEST(GrassExperiments, OnlyTheSumKeepsStrandsOnTheGround) {
  const auto share = [&](const char* point, const char* metric) {
    return value(measured("hybrid.bary", {{"point", std::string(point)}, {"strands", std::int64_t{9000}}}),
                 metric);
  };
  EXPECT_EQ(share("sum", "share_on_the_triangle"), 1);
  EXPECT_LT(share("sum", "largest_distance"), 1e-3);
  EXPECT_EQ(share("product", "share_on_the_triangle"), 0);
  EXPECT_GT(share("product", "median_distance"), 1000);
  EXPECT_EQ(share("cross-product", "share_on_the_triangle"), 0);
}

TEST(Grassland, IsTheSameGroundInAnyNumberOfCells) {
  const Heightfield coarse = grassland(3, 32, 0.8F), fine = grassland(3, 128, 0.8F);
  for (int j = 0; j <= 32; ++j) {
    for (int i = 0; i <= 32; ++i) ASSERT_EQ(coarse.at(i, j), fine.at(4 * i, 4 * j));
  }
  const HeightRange range = height_range(fine);
  EXPECT_GT(range.highest - range.lowest, 4);
  EXPECT_EQ(range.no_data, 0U);
}

}  // namespace
}  // namespace terrabench::hybrid
