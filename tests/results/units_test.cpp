#include <gtest/gtest.h>

#include "results/fill.h"
#include "terrain/error.h"

namespace terrabench {
namespace {

TEST(Units, TimesAndBytesAreConverted) {
  EXPECT_EQ(conversion("s", "µs", "t", "m.jsonl:3"), 1e6);
  EXPECT_EQ(conversion("ms", "s", "t", "m.jsonl:3"), 1e-3);
  EXPECT_EQ(conversion("B", "MB", "m", "m.jsonl:3"), 1e-6);
  EXPECT_EQ(conversion("GB", "kB", "m", "m.jsonl:3"), 1e6);
  EXPECT_EQ(0.25 * conversion("s", "ms", "t", "m.jsonl:3"), 250);
}

TEST(Units, OthersStayWhatTheyAre) {
  EXPECT_EQ(conversion("px", "px", "e", "m.jsonl:3"), 1);
  EXPECT_EQ(conversion("", "", "n", "m.jsonl:3"), 1);
  EXPECT_EQ(conversion("samples", "", "n", "m.jsonl:3"), 1);
  EXPECT_EQ(conversion("", "×", "gain", "m.jsonl:3"), 1);
}

TEST(Units, AFigureIsNotShownInAnotherKindOfUnit) {
  EXPECT_THROW(conversion("s", "B", "t", "m.jsonl:3"), Error);
  EXPECT_THROW(conversion("s", "", "t", "m.jsonl:3"), Error);  // a time needs its unit
  EXPECT_THROW(conversion("", "s", "t", "m.jsonl:3"), Error);
  EXPECT_THROW(conversion("px", "m", "e", "m.jsonl:3"), Error);
  EXPECT_THROW(conversion("m", "s", "e", "m.jsonl:3"), Error);
  try {
    conversion("m", "s", "time", "out/measurements.jsonl:7");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "out/measurements.jsonl:7: 'time' was measured in 'm' and cannot be shown in 's'");
  }
}

}  // namespace
}  // namespace terrabench
