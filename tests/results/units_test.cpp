#include "results/units.h"

#include <gtest/gtest.h>

#include "terrain/error.h"

namespace terrabench {
namespace {

TEST(Units, TimesAndBytesAreConverted) {
  EXPECT_EQ(conversion("s", "µs", "t"), 1e6);
  EXPECT_EQ(conversion("ms", "s", "t"), 1e-3);
  EXPECT_EQ(conversion("B", "MB", "m"), 1e-6);
  EXPECT_EQ(conversion("GB", "kB", "m"), 1e6);
  EXPECT_EQ(0.25 * conversion("s", "ms", "t"), 250);
}

TEST(Units, OthersStayWhatTheyAre) {
  EXPECT_EQ(conversion("px", "px", "e"), 1);
  EXPECT_EQ(conversion("", "", "n"), 1);
  EXPECT_EQ(conversion("samples", "", "n"), 1);
  EXPECT_EQ(conversion("", "×", "gain"), 1);
}

TEST(Units, AFigureIsNotShownInAnotherKindOfUnit) {
  EXPECT_THROW(conversion("s", "B", "t"), Error);
  EXPECT_THROW(conversion("s", "", "t"), Error);  // a time needs its unit
  EXPECT_THROW(conversion("", "s", "t"), Error);
  EXPECT_THROW(conversion("px", "m", "e"), Error);
  EXPECT_THROW(conversion("m", "s", "e"), Error);
}

}  // namespace
}  // namespace terrabench
