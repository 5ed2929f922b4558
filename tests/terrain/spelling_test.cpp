#include "terrain/spelling.h"

#include <gtest/gtest.h>

namespace terrabench {
namespace {

TEST(Spelling, AShortNameIsNoSlipOfAnother) {
  EXPECT_TRUE(is_slip("aat", "at"));
  EXPECT_TRUE(is_slip("hieght", "height"));
  EXPECT_FALSE(is_slip("up", "at"));
  EXPECT_FALSE(is_slip("heading", "height"));
}

}  // namespace
}  // namespace terrabench
