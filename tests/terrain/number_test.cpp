#include "terrain/number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace terrabench {
namespace {

TEST(Number, IsTheWholeText) {
  EXPECT_EQ(parse_number<int>("-12"), -12);
  EXPECT_EQ(parse_number<double>("-1.5e3"), -1500.0);
  EXPECT_TRUE(std::isnan(parse_number<double>("nan").value_or(0)));
  for (const char* const text : {"", " 1", "1 ", "1x", "+1", "--1", "0x10", "e3"}) {
    EXPECT_FALSE(parse_number<double>(text)) << text;
  }
  EXPECT_FALSE(parse_number<int>("1.5"));
}

TEST(Number, FitsItsType) {
  EXPECT_EQ(parse_number<int>("2147483647"), 2147483647);
  EXPECT_FALSE(parse_number<int>("4294967297"));
  EXPECT_FALSE(parse_number<std::uint64_t>("-1"));
  EXPECT_FALSE(parse_number<double>("1e400"));
  EXPECT_TRUE(parse_number<long double>("1e400"));
}

}  // namespace
}  // namespace terrabench
