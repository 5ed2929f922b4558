// --renderer, as a user gives it.
#include <gmock/gmock.h>

#include "terrain/image.h"
#include "tests/experiments/command_line.h"

namespace terrabench {
namespace {

using ::testing::HasSubstr;

class RendererOption : public CommandLine {
 protected:
  static std::string represent(const std::string& renderer) {
    return "$T represent jacksboro --as heightmap --resample 32 32 --render out.png --renderer " + renderer;
  }
};

TEST_F(RendererOption, DrawsWithTheContextNamed) {
  for (const char* const name : {"osmesa", "egl", "auto"}) {
    std::filesystem::remove(folder_ / "out.png");
    const Outcome outcome = call(represent(name));
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr("OpenGL 4.")) << name;
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out.png")) << name;
  }
}

TEST_F(RendererOption, TracesRaysWithAsManySamplesAsAsked) {
  const std::string trace = "$T represent jacksboro --as heightmap --resample 32 32 --renderer raytrace ";
  const Outcome outcome = call(trace + "--render out.png --samples 2");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("Embree 3."));
  EXPECT_THAT(outcome.text, HasSubstr("2 samples per pixel"));
  const Image picture = read_picture(folder_ / "out.png");
  EXPECT_EQ(picture.pixel(0, 0), (Rgb{255, 255, 255}));
  EXPECT_NE(picture.pixel(picture.width / 2, picture.height / 2), (Rgb{255, 255, 255}));
  EXPECT_EQ(call(trace + "--render out.png --samples 0").code, 2);
  EXPECT_EQ(call("$T run hybrid.noise-stages --renderer raytrace --out out").code, 2);
}

TEST_F(RendererOption, SuggestsTheNearestName) {
  for (const std::string& command :
       {represent("elg"), std::string("$T run hybrid.noise-stages --renderer elg --out out")}) {
    const Outcome outcome = call(command);
    EXPECT_EQ(outcome.code, 2) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr("did you mean 'egl'?"));
  }
}

TEST_F(RendererOption, WithoutADisplaySaysWhatToDo) {
  const Outcome outcome = call("unset DISPLAY; " + represent("glfw"));
  EXPECT_EQ(outcome.code, 4) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("DISPLAY"));
  EXPECT_THAT(outcome.text, HasSubstr("xvfb-run"));
}

TEST_F(RendererOption, IsInTheProvenance) {
  const Outcome outcome = call(
      "$T run hybrid.noise-stages --shard 1/11 --set pixels=16 --renderer egl --out out && "
      "grep 'Embree.*3\\.' out/measurements.jsonl | grep -c '\"gl_renderer\":\".*OpenGL 4'");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
}

}  // namespace
}  // namespace terrabench
