#include "lod/meters/signed_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lod/meters/screen_error.h"
#include "tests/lod/drawing.h"

namespace terrabench::test {
namespace {

// A square of flat ground at 0, drawn as one square: whatever the ground is inside is missed.
struct Square {
  Square(std::initializer_list<std::pair<glm::ivec2, float>> heights) {
    for (const auto& [at, y] : heights) field.at(at.x, at.y) = y;
  }
  SignedError measured(double water) const {
    Drawing drawing(field);
    drawing.square(0, 0, 8);
    SignedError error(water);
    error.add(SurfaceRaster(drawing.frame(), 9, 9), field, SeenSamples(field, from_above(field)));
    return error;
  }
  Heightfield field = flat(9, 9);
};

TEST(SignedError, TellsAboveFromBelow) {
  const SignedError error = Square({{{2, 2}, -3}, {{6, 6}, 4}, {{6, 5}, -1}}).measured(-100);
  EXPECT_EQ(error.samples(), 81U);
  EXPECT_EQ(error.above_largest(), 3) << "drawn above a pit";
  EXPECT_EQ(error.below_largest(), 4) << "drawn below a hill";
  EXPECT_DOUBLE_EQ(error.above_rms(), std::sqrt((9.0 + 1) / 81));
  EXPECT_DOUBLE_EQ(error.below_rms(), std::sqrt(16.0 / 81));
}

TEST(SignedError, CountsGroundThroughWaterAndWaterOverGround) {
  const Square square({{{2, 2}, -3}, {{6, 6}, 4}, {{6, 5}, -0.5F}});
  const SignedError low = square.measured(-1);  // the pit is a pond, and is drawn as dry ground
  EXPECT_EQ(low.under_water(), 1U);
  EXPECT_EQ(low.poking(), 1U);
  EXPECT_EQ(low.flooded(), 0U);
  const SignedError high = square.measured(2);  // all is under water but the hill, which is not drawn
  EXPECT_EQ(high.over_water(), 1U);
  EXPECT_EQ(high.poking(), 0U);
  EXPECT_EQ(high.flooded(), 1U);
}

TEST(SignedError, LeavesOutWhatIsHiddenOrNotDrawn) {
  Heightfield field = flat(9, 9);
  Drawing drawing(field);
  drawing.square(0, 0, 4);
  SignedError error(0);
  error.add(SurfaceRaster(drawing.frame(), 9, 9), field, SeenSamples(field, from_above(field)));
  EXPECT_EQ(error.samples(), 25U);
  View away = from_above(field);
  away.target = away.eye + glm::vec3(0, 1, 0);
  error.add(SurfaceRaster(drawing.frame(), 9, 9), field, SeenSamples(field, away));
  EXPECT_EQ(error.samples(), 25U);
}

TEST(SignedError, OfNothingIsZero) {
  const SignedError none(0);
  EXPECT_EQ(none.above_rms(), 0);
  EXPECT_EQ(none.below_largest(), 0);
}

}  // namespace
}  // namespace terrabench::test
