// `terrabench represent --dig --add --erode`.
#include <gmock/gmock.h>

#include "representations/layered_stack/layered_stack.h"
#include "tests/experiments/command_line.h"

namespace terrabench {
namespace {

using ::testing::HasSubstr;

class RepresentEdit : public CommandLine {
 protected:
  std::vector<Span> line(const std::string& file, float x, float z) const {
    const Loaded loaded = load_representation(folder_ / file);
    SpanSink sink;
    loaded.representation->spans({std::span(&x, 1), std::span(&z, 1)}, sink);
    const auto spans = sink.column(0);
    return {spans.begin(), spans.end()};
  }
};

const std::string kGround =
    "$T represent jacksboro --as layered_stack --crop 0 0 40 40 --set step=1 --save s.tb ";

TEST_F(RepresentEdit, DigsAndAddsInTheOrderGiven) {
  ASSERT_EQ(call(kGround).code, 0);
  const Bounds bounds = load_representation(folder_ / "s.tb").representation->bounds();
  const float x = bounds.low.x + bounds.size().x * 0.51F, z = bounds.low.z + bounds.size().z * 0.51F;
  const std::vector<Span> before = line("s.tb", x, z);
  ASSERT_EQ(before.size(), 1U);
  const std::string at = std::to_string(x) + "," + std::to_string(before[0].top) + "," + std::to_string(z);
  const Outcome dug = call(kGround + "--add " + at + ",60 --dig " + at + ",50");
  ASSERT_EQ(dug.code, 0) << dug.text;
  EXPECT_THAT(dug.text, HasSubstr("dug         " + at + ",50: "));
  EXPECT_EQ(line("s.tb", x, z)[0].top < before[0].top - 20, true);
  ASSERT_EQ(call(kGround + "--dig " + at + ",50 --add " + at + ",60").code, 0);
  EXPECT_GT(line("s.tb", x, z)[0].top, before[0].top - 1);
}

TEST_F(RepresentEdit, ErodesAfterTheEdits) {
  ASSERT_EQ(call(kGround).code, 0);
  const Bounds bounds = load_representation(folder_ / "s.tb").representation->bounds();
  const float x = bounds.low.x + bounds.size().x / 2, z = bounds.low.z + bounds.size().z / 2;
  const std::string at = std::to_string(x) + "," + std::to_string(bounds.high.y) + "," + std::to_string(z);
  const Outcome eroded = call(kGround + "--erode 30 --dig " + at + ",200");
  ASSERT_EQ(eroded.code, 0) << eroded.text;
  EXPECT_THAT(eroded.text, HasSubstr("eroded      to 30 degrees in "));
  EXPECT_LT(eroded.text.find("dug "), eroded.text.find("eroded "));
  EXPECT_EQ(call("$T represent jacksboro --as implicit --crop 0 0 20 20 --erode 40").code, 0);
}

TEST_F(RepresentEdit, ExplainsWhatIsWrong) {
  const std::string implicit = "$T represent jacksboro --as implicit --crop 0 0 20 20 ";
  for (const std::string& ground : {kGround, implicit}) {
    for (const char* const wrong :
         {"--dig 1,2,3", "--dig 1,2,3,4,5", "--dig 1,2,3,x", "--dig 1,2,3,0", "--add 1,2,3,-4",
          "--add 1,2,3,nan", "--dig 1,inf,3,4", "--dig ,,,", "--dig 1,2,3,4m", "--dig ''", "--dig",
          "--dig 1e9,0,0,5", "--erode 90", "--erode -1", "--erode nan", "--erode steep"}) {
      const Outcome outcome = call(ground + wrong);
      EXPECT_EQ(outcome.code, 2) << wrong << outcome.text;
      EXPECT_FALSE(std::filesystem::exists(folder_ / "s.tb")) << wrong;
    }
  }
  const Outcome fixed = call("$T represent jacksboro --as drill --dig 1,2,3,4");
  EXPECT_EQ(fixed.code, 2);
  EXPECT_THAT(fixed.text, HasSubstr("'drill' cannot be edited"));
  const Outcome voxels = call("$T represent jacksboro --as voxel --erode 30");
  EXPECT_EQ(voxels.code, 2);
  EXPECT_THAT(voxels.text, HasSubstr("layered_stack or implicit"));
}

}  // namespace
}  // namespace terrabench
