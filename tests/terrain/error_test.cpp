#include "terrain/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace terrabench {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr std::string_view kNames[] = {"heightmap", "layered_stack", "voxel"};

TEST(Error, PutsThePlaceBeforeTheReason) {
  const Error error = bad_input("is cut short", "a.tif", "fetch it again");
  EXPECT_STREQ(error.what(), "a.tif: is cut short");
  EXPECT_EQ(error.advice(), "fetch it again");
  EXPECT_EQ(error.code(), ExitCode::kBadInput);
  EXPECT_STREQ(usage_error("wrong", "", "").what(), "wrong");
  EXPECT_EQ(usage_error("wrong", "", "").code(), ExitCode::kUsage);
  EXPECT_EQ(environment_error("full", "", "").code(), ExitCode::kEnvironment);
}

TEST(Error, SuggestsTheNearestNameOnlyWhenItIsNear) {
  EXPECT_THAT(unknown_name("method", "heigtmap", kNames).what(), HasSubstr("did you mean 'heightmap'?"));
  EXPECT_THAT(unknown_name("method", "layered-stack", kNames).what(),
              HasSubstr("did you mean 'layered_stack'?"));
  EXPECT_THAT(unknown_name("method", "vexol", kNames).what(), HasSubstr("did you mean 'voxel'?"));
  for (const char* const far : {"", "octree", "clipmap_with_morphing"}) {
    EXPECT_THAT(unknown_name("method", far, kNames).what(), Not(HasSubstr("did you mean"))) << far;
  }
}

TEST(Error, ListsWhatIsKnown) {
  EXPECT_EQ(unknown_name("method", "x", kNames).advice(), "known: heightmap, layered_stack, voxel");
  EXPECT_STREQ(unknown_name("method", "x", {}).what(), "unknown method 'x'");
}

TEST(Error, HoldsNoControlCharacters) {
  const Error error = bad_input("the key 'a\x1B[2J\u009Bé' is unknown", "f\r\x07.toml", "remove\nit\x7F");
  EXPECT_STREQ(error.what(), "f  .toml: the key 'a [2J é' is unknown");
  EXPECT_EQ(error.advice(), "remove it ");
}

}  // namespace
}  // namespace terrabench
