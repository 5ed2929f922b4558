#include "lod/meters/triangle_set.h"

#include <gtest/gtest.h>

#include "lod/brute_force/brute_force.h"
#include "tests/lod/drawing.h"

namespace terrabench::test {
namespace {

TEST(TriangleSet, DoesNotDependOnOrderNorOnTheFirstCorner) {
  const Heightfield field = hilly(9, 9);
  Drawing one(field), other(field);
  one.triangle({0, 0}, {0, 4}, {4, 0});
  one.triangle({4, 0}, {0, 4}, {4, 4});
  other.triangle({0, 4}, {4, 4}, {4, 0});
  other.triangle({4, 0}, {0, 0}, {0, 4});
  EXPECT_EQ(TriangleSet(one.frame()), TriangleSet(other.frame()));
  EXPECT_EQ(TriangleSet(one.frame()).size(), 2U);
}

TEST(TriangleSet, TellsATurnedTriangleAndOneHeightApart) {
  Heightfield field = hilly(9, 9);
  Drawing one(field), turned(field);
  one.triangle({0, 0}, {0, 4}, {4, 0});
  turned.triangle({0, 0}, {4, 0}, {0, 4});
  const TriangleSet before(one.frame());
  EXPECT_NE(before, TriangleSet(turned.frame()));
  field.at(4, 0) = std::nextafter(field.at(4, 0), 1e9F);
  EXPECT_NE(before, TriangleSet(one.frame()));
}

TEST(TriangleSet, CountsWhatTheOtherLacks) {
  const Heightfield field = hilly(9, 9);
  Drawing one(field), twice(field);
  one.square(0, 0, 4);
  one.square(4, 0, 4);
  twice.square(0, 0, 4);
  twice.square(0, 0, 4);
  EXPECT_EQ(TriangleSet(one.frame()).missing_in(TriangleSet(twice.frame())), 2U);
  EXPECT_EQ(TriangleSet(twice.frame()).missing_in(TriangleSet(one.frame())), 2U) << "drawn twice";
  EXPECT_EQ(TriangleSet(one.frame()).missing_in(TriangleSet(one.frame())), 0U);
}

TEST(TriangleSet, HoldsAllTrianglesOfAFrame) {
  const Heightfield field = hilly(50, 40);
  BruteForce lod(field);
  EXPECT_EQ(TriangleSet(lod.update(from_above(field))).size(), 2U * 49 * 39);
}

}  // namespace
}  // namespace terrabench::test
