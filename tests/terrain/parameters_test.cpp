#include "terrain/parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/terrain/errors.h"

namespace terrabench {
namespace {

using testing::HasSubstr;

constexpr std::string_view kModes[] = {"off", "sampled", "conservative"};
const ParameterSpec kSpecs[] = {{"size", std::int64_t{128}, "samples", "edge of the grid", 1, 512},
                                {"height", 10.5, "m", "how high", 0, 100},
                                {"caves", true, "", "with caves"},
                                {"title", std::string("hill"), "", "what to call it"},
                                choice("mode", kModes, "what is hidden"),
                                {"tau", std::int64_t{1}, "", "pixels upstream", 1},
                                {"depth", -1.0, "m", "below", -INFINITY, 0},
                                {"offset", 0.0, "m", "sideways"}};

TEST(Parameters, StartWithTheirFallbacks) {
  const Parameters parameters(kSpecs);
  EXPECT_EQ(parameters.integer("size"), 128);
  EXPECT_EQ(parameters.number("height"), 10.5);
  EXPECT_TRUE(parameters.flag("caves"));
  EXPECT_EQ(parameters.text("title"), "hill");
  EXPECT_TRUE(parameters.has("size"));
  EXPECT_FALSE(parameters.has("sizes"));
}

TEST(Parameters, TakeTextOfTheirType) {
  Parameters parameters(kSpecs);
  for (const char* const text : {"size=512", "height=0.25", "caves=false", "title=a=b c"}) {
    parameters.set_from_text(text);
  }
  EXPECT_EQ(parameters.integer("size"), 512);
  EXPECT_EQ(parameters.number("height"), 0.25);
  EXPECT_FALSE(parameters.flag("caves"));
  EXPECT_EQ(parameters.text("title"), "a=b c");
  EXPECT_EQ(to_string(parameters.value(1)), "0.25");
}

TEST(Parameters, AWholeNumberIsANumberButNotTheReverse) {
  Parameters parameters(kSpecs);
  parameters.set("height", std::int64_t{7});
  EXPECT_EQ(parameters.number("height"), 7.0);
  EXPECT_EQ(failure_of([&] { parameters.set("size", 7.5); }).code, ExitCode::kUsage);
}

TEST(Parameters, RefuseWhatDoesNotFitAndKeepTheirValue) {
  Parameters parameters(kSpecs);
  for (const char* const text : {"size=0", "size=513", "size=12x", "size=", "size=1e2", "height=-1",
                                 "height=nan", "height=100.5", "caves=1", "=3", "size", ""}) {
    EXPECT_EQ(failure_of([&] { parameters.set_from_text(text); }).code, ExitCode::kUsage) << text;
  }
  EXPECT_EQ(parameters.integer("size"), 128);
  EXPECT_EQ(parameters.number("height"), 10.5);
  EXPECT_EQ(failure_of([&] { parameters.set("height", NAN); }).code, ExitCode::kUsage);
}

TEST(Parameters, ErrorsNameWhatIsExpectedWhatWasGivenAndTheHelp) {
  Parameters parameters(kSpecs);
  const std::pair<const char*, const char*> cases[] = {
      {"size=1000", "size must be between 1 and 512 samples, got 1000"},
      {"size=12x", "size must be a whole number between 1 and 512 samples, got '12x'"},
      {"height=nan", "height must be between 0 and 100 m, got nan"},
      {"tau=0", "tau must be at least 1, got 0"},
      {"depth=0.5", "depth must be at most 0 m, got 0.5"},
      {"offset=nan", "offset must be a number, got nan"},
      {"offset=west", "offset must be a number in m, got 'west'"},
      {"caves=1", "caves must be true or false, got '1'"},
      {"hieght=1", "unknown parameter 'hieght'; did you mean 'height'?"},
      {"size", "invalid assignment 'size': expected name=value"},
  };
  for (const auto& [text, what] : cases) {
    EXPECT_EQ(failure_of([&, text = text] { parameters.set_from_text(text); }).what, what) << text;
  }
  EXPECT_EQ(failure_of([&] { parameters.set_from_text("size=0"); }).advice, "size: edge of the grid");
  EXPECT_EQ(failure_of([&] { parameters.set("title", true); }).what, "title must be text, got 'true'");
}

TEST(Parameters, AChoiceTakesItsWordsOnly) {
  Parameters parameters(kSpecs);
  EXPECT_EQ(parameters.text("mode"), "off");
  EXPECT_EQ(parameters.choice("mode"), 0U);
  parameters.set_from_text("mode=conservative");
  EXPECT_EQ(parameters.choice("mode"), 2U);
  for (const char* const word : {"", "Off", "on", "sample", "off ", "conservative,off"}) {
    const Failure failure = failure_of([&] { parameters.set("mode", std::string(word)); });
    EXPECT_EQ(failure.code, ExitCode::kUsage) << word;
    EXPECT_THAT(failure.what, HasSubstr("for 'mode': expected off, sampled or conservative")) << word;
    EXPECT_EQ(failure.advice, "mode: what is hidden") << word;
  }
  EXPECT_EQ(parameters.text("mode"), "conservative");
  EXPECT_EQ(
      failure_of([&] { parameters.set_from_text("mode=sample"); }).what,
      "invalid value 'sample' for 'mode': expected off, sampled or conservative; did you mean 'sampled'?");
  EXPECT_EQ(failure_of([&] { parameters.set_from_text("mode=everything"); }).what,
            "invalid value 'everything' for 'mode': expected off, sampled or conservative");
}

TEST(Parameters, AcceptedValuesAreForHelpTexts) {
  const char* const expected[] = {"a whole number between 1 and 512 samples",
                                  "a number between 0 and 100 m",
                                  "true or false",
                                  "text",
                                  "off, sampled or conservative",
                                  "a whole number at least 1",
                                  "a number at most 0 m",
                                  "a number in m"};
  for (std::size_t i = 0; i < std::size(kSpecs); ++i) EXPECT_EQ(accepted_values(kSpecs[i]), expected[i]);
}

}  // namespace
}  // namespace terrabench
