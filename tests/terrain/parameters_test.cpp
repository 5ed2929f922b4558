#include "terrain/parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/terrain/errors.h"

namespace terrabench {
namespace {

using testing::HasSubstr;

const ParameterSpec kSpecs[] = {{"size", std::int64_t{128}, "samples", "edge of the grid", 1, 512},
                                {"height", 10.5, "m", "how high", 0, 100},
                                {"caves", true, "", "with caves"},
                                {"title", std::string("hill"), "", "what to call it"}};

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

TEST(Parameters, ErrorsNameTheRangeTheUnitAndTheNearestName) {
  Parameters parameters(kSpecs);
  const Failure range = failure_of([&] { parameters.set_from_text("size=1000"); });
  EXPECT_THAT(range.what, HasSubstr("1000"));
  EXPECT_THAT(range.advice, HasSubstr("[1, 512]"));
  EXPECT_THAT(range.advice, HasSubstr("samples"));
  EXPECT_THAT(failure_of([&] { parameters.set_from_text("hieght=1"); }).what,
              HasSubstr("did you mean 'height'?"));
}

}  // namespace
}  // namespace terrabench
