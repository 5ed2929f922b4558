// What cannot be compared has no error, least of all 0.
#include "experiments/fidelity.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/terrain/ground.h"

namespace terrabench {
namespace {

class FidelityTest : public testing::Test {
 protected:
  // Of a heightmap of `built`, measured against `truth`.
  Fidelity fidelity(const Heightfield& built, const Heightfield& truth) {
    const RepresentationType& type = representation("heightmap");
    const auto map = type.build(source_of("built", built), Parameters(type.parameters), silent_);
    return measure_fidelity(*map, source_of("truth", truth), silent_);
  }
  // Flat, without data west or east of column 4.
  static Heightfield half(bool west) {
    Heightfield field = test::flat(9, 5);
    for (int j = 0; j < 5; ++j) {
      for (int i = 0; i < 9; ++i) {
        if (west ? i < 4 : i > 4) field.at(i, j) = Heightfield::kNoData;
      }
    }
    return field;
  }
  Progress silent_;
};

TEST_F(FidelityTest, OfNoCommonColumnIsNotDefined) {
  Heightfield east = half(true), west = half(false);
  Fidelity found = fidelity(east, west);
  EXPECT_TRUE(found.compared) << "column 4";
  EXPECT_EQ(found.columns, 5U);
  for (int j = 0; j < 5; ++j) east.at(4, j) = Heightfield::kNoData;
  found = fidelity(east, west);
  EXPECT_FALSE(found.compared);
  EXPECT_EQ(found.lost, 45U);
}

TEST_F(FidelityTest, OfNothingSolidIsNotDefined) {
  Heightfield far = test::flat(9, 5);
  for (float& height : far.heights) height = Heightfield::kNoData;
  far.at(8, 4) = 1;
  const RepresentationType& type = representation("heightmap");
  const auto map = type.build(source_of("far", far), Parameters(type.parameters), silent_);
  TerrainSource air;
  air.solid = Solid{{{0, 0, 0}, {2, 2, 2}}, "", [](const ColumnSamples&, std::span<Material> out) {
                      std::ranges::fill(out, Material::kAir);
                    }};
  EXPECT_FALSE(measure_fidelity(*map, air, silent_).compared);
}

}  // namespace
}  // namespace terrabench
