// A sphere changes heights as it changes the heightmap representation, and undoing gives the same bytes.
#include "viewer/edits.h"

#include <gtest/gtest.h>

#include "representations/edit_tools.h"
#include "terrain/source.h"
#include "tests/terrain/ground.h"

namespace terrabench::viewer {
namespace {

Heightfield hills() {
  return test::ground_of(
      41, 31, [](int i, int j) { return 20 * std::sin(0.3 * i) * std::cos(0.2 * j) + 50; }, 2, 3);
}

TEST(Edits, AgreeWithTheHeightmapRepresentation) {
  for (const bool digs : {true, false}) {
    for (const glm::dvec3 centre : {glm::dvec3(40, 60, 45), glm::dvec3(22, 44, 31), glm::dvec3(3, 50, 80)}) {
      Heightfield ground = hills();
      const RepresentationType& type = representation("heightmap");
      Progress progress;
      const TerrainSource source = source_of("hills", ground);
      const float floor = source.bounds().low.y, ceiling = source.bounds().high.y;
      const auto map = type.build(source, Parameters(type.parameters), progress);
      Edits edits;
      ASSERT_TRUE(edits.apply(ground, {centre, 13, digs}));
      fill_sphere(*map, {glm::vec3(centre), 13}, digs ? Material::kAir : Material::kBedrock);
      for (int j = 0; j < ground.depth; ++j) {
        for (int i = 0; i < ground.width; ++i) {
          const float x = static_cast<float>(i) * ground.cell_x, z = static_cast<float>(j) * ground.cell_z;
          SpanSink spans;
          map->spans({{&x, 1}, {&z, 1}}, spans);
          // The representation ends at its bounds: where it holds nothing, the hole reaches its floor.
          if (spans.all().empty()) {
            EXPECT_LE(ground.at(i, j), floor) << i << " " << j;
          } else if (spans.all().back().top < ceiling) {
            EXPECT_NEAR(ground.at(i, j), spans.all().back().top, 1e-3) << digs << " " << i << " " << j;
          } else {
            EXPECT_GE(ground.at(i, j), ceiling - 1e-3F) << i << " " << j;
          }
        }
      }
    }
  }
}

TEST(Edits, NameAllChangedSamplesAndNoOthersThanNeeded) {
  const Heightfield before = hills();
  Heightfield ground = before;
  Edits edits;
  const auto rect = edits.apply(ground, {{40, 60, 45}, 13, true});
  ASSERT_TRUE(rect);
  SampleRect changed{{1000, 1000}, {-1, -1}};
  for (int j = 0; j < ground.depth; ++j) {
    for (int i = 0; i < ground.width; ++i) {
      if (ground.at(i, j) == before.at(i, j)) continue;
      changed = {glm::min(changed.low, {i, j}), glm::max(changed.high, {i, j})};
    }
  }
  EXPECT_EQ(rect->low, changed.low);
  EXPECT_EQ(rect->high, changed.high);
}

TEST(Edits, UndoGivesTheSameBytes) {
  const Heightfield before = hills();
  Heightfield ground = before;
  Edits edits;
  edits.apply(ground, {{40, 60, 45}, 13, true});
  const Heightfield dug = ground;
  edits.apply(ground, {{45, 55, 40}, 9, false});
  EXPECT_NE(ground.heights, dug.heights);
  edits.undo(ground);
  EXPECT_EQ(ground.heights, dug.heights);
  edits.undo(ground);
  EXPECT_EQ(ground.heights, before.heights);
  EXPECT_FALSE(edits.can_undo());
}

TEST(Edits, WhatMeetsNoGroundChangesNothing) {
  Heightfield ground = hills();
  Edits edits;
  EXPECT_FALSE(edits.apply(ground, {{40, 500, 45}, 13, true}));   // in the air
  EXPECT_FALSE(edits.apply(ground, {{40, -500, 45}, 13, true}));  // under a roof, which heights cannot hold
  EXPECT_FALSE(edits.apply(ground, {{-40, 50, 45}, 13, true}));   // beside
  EXPECT_FALSE(edits.can_undo());
}

}  // namespace
}  // namespace terrabench::viewer
