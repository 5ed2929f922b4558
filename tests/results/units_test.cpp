#include <gtest/gtest.h>

#include "results/report/fill.h"

namespace terrabench {
namespace {

TEST(Units, TimesAndBytesAreConverted) {
  EXPECT_EQ(conversion("s", "µs"), 1e6);
  EXPECT_EQ(conversion("ms", "s"), 1e-3);
  EXPECT_EQ(conversion("B", "MB"), 1e-6);
  EXPECT_EQ(conversion("GB", "kB"), 1e6);
  EXPECT_EQ(0.25 * *conversion("s", "ms"), 250);
}

TEST(Units, OthersStayWhatTheyAre) {
  EXPECT_EQ(conversion("px", "px"), 1);
  EXPECT_EQ(conversion("", ""), 1);
  EXPECT_EQ(conversion("samples", ""), 1);
  EXPECT_EQ(conversion("", "×"), 1);
}

TEST(Units, AFigureIsNotShownInAnotherKindOfUnit) {
  EXPECT_FALSE(conversion("s", "B"));
  EXPECT_FALSE(conversion("s", ""));  // a time needs its unit
  EXPECT_FALSE(conversion("", "s"));
  EXPECT_FALSE(conversion("px", "m"));
  EXPECT_FALSE(conversion("m", "s"));
}

}  // namespace
}  // namespace terrabench
