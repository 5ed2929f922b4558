// Errors of scripts name the line and what is expected.
#include "viewer/script.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/terrain/errors.h"

namespace terrabench::viewer {
namespace {

using ::testing::HasSubstr;

TEST(Script, ErrorsNameTheLine) {
  const Failure unknown = failure_of([] { Script("wait\n# pause\nfranes 3\n", "s.txt"); });
  EXPECT_EQ(unknown.code, ExitCode::kBadInput);
  EXPECT_THAT(unknown.what, HasSubstr("s.txt:3"));
  EXPECT_THAT(unknown.what, HasSubstr("did you mean 'frames'"));
  EXPECT_THAT(failure_of([] { Script("drag 1 2 3", "s.txt"); }).what, HasSubstr("drag X0 Y0 X1 Y1 FRAMES"));
}

TEST(Script, OfCommentsAloneHasEnded) { EXPECT_TRUE(Script("# nothing\n\n", "s.txt").ended()); }

}  // namespace
}  // namespace terrabench::viewer
