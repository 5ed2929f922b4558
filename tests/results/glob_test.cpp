#include "results/store/glob.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "tests/terrain/errors.h"

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

// Six hundred names would hide what was meant.
TEST(Glob, AMistypedNameOrPatternHasASuggestionAndNoList) {
  const std::vector<std::string_view> names = {"hybrid.caves", "hybrid.table1", "mrbsp.walk"};
  const auto failure = [&](const std::string& pattern) {
    return failure_of(
        [&] { demand_matches(std::vector{pattern}, names, "experiment", "terrabench list experiments"); });
  };
  for (const auto& [given, meant] : {std::pair{"hybird.*", "hybrid.*"},
                                     {"hybird.t?ble1", "hybrid.t?ble1"},
                                     {"mrbsp.wakl", "mrbsp.walk"}}) {
    EXPECT_EQ(failure(given).what,
              std::string("unknown experiment '") + given + "'; did you mean '" + meant + "'?");
  }
  EXPECT_EQ(failure("nothing").what, "unknown experiment 'nothing'");
  EXPECT_EQ(failure("nothing").code, ExitCode::kUsage);
  EXPECT_EQ(failure("nothing").advice, "'terrabench list experiments' names all 3");
  EXPECT_NO_THROW(demand_matches(std::vector<std::string>{"mrbsp.*"}, names, "experiment",
                                 "terrabench list experiments"));
}

}  // namespace
}  // namespace terrabench
