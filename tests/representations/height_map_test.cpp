// The far ground's height map, by both readings of the paper.
#include "representations/layered_stack/height_map.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "terrain/error.h"
#include "terrain/sources/noise/cave_terrain.h"

namespace terrabench {
namespace {

std::unique_ptr<LayeredStack> caves(int columns) {
  Progress silent;
  Parameters parameters(representation("layered_stack").parameters);
  parameters.set("resolution", std::int64_t{columns});
  return LayeredStack::build_stack(noise::cave_source(), parameters, silent);
}

TEST(HeightMap, TopIsWhereTheHighestSpanEndsAndTheSumLacksTheAirBelowIt) {
  const auto stack = caves(48);
  const ColumnGrid& grid = stack->grid();
  const Heightfield top = column_heights(*stack, ColumnHeight::kTop);
  const Heightfield sum = column_heights(*stack, ColumnHeight::kSum);
  std::size_t sunk = 0;
  for (int j = 0; j < grid.depth; ++j) {
    for (int i = 0; i < grid.width; ++i) {
      const float x = grid.centre_x(i), z = grid.centre_z(j);
      SpanSink spans;
      stack->spans({{&x, 1}, {&z, 1}}, spans);
      float solid = grid.edge_y(0);
      for (const Span& span : spans.all()) solid += span.top - span.bottom;
      EXPECT_FLOAT_EQ(top.at(i, j), spans.all().empty() ? grid.edge_y(0) : spans.all().back().top);
      EXPECT_NEAR(sum.at(i, j), solid, 1e-3);
      sunk += sum.at(i, j) < top.at(i, j);
    }
  }
  EXPECT_GT(sunk, 100U);
}

TEST(HeightMap, InterpolatesBetweenTheColumnsCentres) {
  const auto stack = caves(16);
  const Heightfield columns = column_heights(*stack, ColumnHeight::kTop);
  for (const int finer : {1, 2, 4, 5}) {
    const Heightfield map = height_map(*stack, ColumnHeight::kTop, finer);
    ASSERT_EQ(map.width, 16 * finer + 1);
    EXPECT_FLOAT_EQ(map.extent_x(), stack->bounds().size().x);
    for (int j = 0; j < map.depth; ++j) {
      for (int i = 0; i < map.width; ++i) {
        // Heightfield::sample() has its samples where the map has the columns' centres.
        const float half = 0.5F * columns.cell_x;
        const float x = std::clamp(static_cast<float>(i) * map.cell_x - half, 0.0F, columns.extent_x());
        const float z = std::clamp(static_cast<float>(j) * map.cell_z - half, 0.0F, columns.extent_z());
        EXPECT_NEAR(map.at(i, j), columns.sample(x, z), 1e-3) << i << " " << j;
      }
    }
  }
}

TEST(HeightMap, ASingleColumnIsLevel) {
  Progress silent;
  Heightfield field = Heightfield::zeros(1, 1, 5, 5);
  field.at(0, 0) = 7;
  Parameters parameters(representation("layered_stack").parameters);
  const auto stack = LayeredStack::build_stack(source_of("point", field), parameters, silent);
  const Heightfield map = height_map(*stack, ColumnHeight::kTop, 3);
  EXPECT_EQ(map.width, 4);
  for (const float height : map.heights) EXPECT_EQ(height, map.heights[0]);
  EXPECT_THROW(height_map(*stack, ColumnHeight::kTop, 0), Error);
}

}  // namespace
}  // namespace terrabench
