#include "results/glob.h"

#include <gtest/gtest.h>

#include <string>

namespace terrabench {
namespace {

TEST(Glob, StarIsAnyTextAndQuestionMarkOneCharacter) {
  for (const char* pattern : {"hybrid.T1", "*", "hybrid.*", "*.T1", "h*T?", "hybrid.T1*", "**", "h*.*1"}) {
    EXPECT_TRUE(matches_glob(pattern, "hybrid.T1")) << pattern;
  }
  for (const char* pattern : {"", "hybrid", "hybrid.T1?", "hybrid.T", "*.T2", "?", "ybrid.T1", "*x*"}) {
    EXPECT_FALSE(matches_glob(pattern, "hybrid.T1")) << pattern;
  }
  EXPECT_TRUE(matches_glob("", ""));
  EXPECT_TRUE(matches_glob("*", ""));
  EXPECT_FALSE(matches_glob("?", ""));
  EXPECT_TRUE(matches_glob("*ab*ab", "abxabab"));
}

// Trying every star at every place would not end in this century.
TEST(Glob, ManyStarsCostNoMoreThanOne) {
  std::string pattern;
  for (int i = 0; i < 40; ++i) pattern += "*a";
  EXPECT_FALSE(matches_glob(pattern + "b", std::string(5000, 'a')));
}

}  // namespace
}  // namespace terrabench
