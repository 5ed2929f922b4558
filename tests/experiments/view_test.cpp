// `terrabench view` under Xvfb: a session by script, and its pictures, which `render` draws alike.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdlib>

#include "lod/lod.h"
#include "terrain/files.h"
#include "terrain/image.h"
#include "terrain/sources/dem/dem.h"
#include "tests/experiments/command_line.h"
#include "tests/renderers/virtual_display.h"
#include "tests/terrain/ground.h"

namespace terrabench {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class ViewCommand : public CommandLine {
 protected:
  void SetUp() override {
    ASSERT_TRUE(start_virtual_display());
    const auto hill = [](int i, int j) {
      return 120 * std::sin(0.07 * i) * std::cos(0.06 * j) + 9 * std::sin(0.7 * i) * std::sin(0.8 * j);
    };
    write_geotiff(folder_ / "two hills.tif", test::ground_of(129, 97, hill, 10, 10));
    write_geotiff(folder_ / "small.tif", test::ground_of(33, 65, hill, 10, 10));
  }
  Outcome script(const std::string& text, const std::string& options = "",
                 const std::string& size = "320x240") {
    write_file(folder_ / "script.txt", std::string_view(text));
    return call("$T view 'two hills.tif' --size " + size + " --script script.txt " + options);
  }
  // The command that the output names for a picture, to be written to another file.
  static std::string command_for(const std::string& output, const std::string& to) {
    const std::size_t begin = output.find("terrabench render"), end = output.find(" --out", begin);
    EXPECT_NE(begin, std::string::npos) << output;
    return "$T" + output.substr(begin + 10, end - begin - 10) + " --out " + to;
  }
};

TEST_F(ViewCommand, PicturesEqualThoseOfRender) {
  for (const LodType& type : lods()) {
    const Outcome outcome =
        script(fmt::format("wait\nmethod 0 {}\nwait\nkey W 20\nkey Left 10\ndrag 250 100 200 120 5\n"
                           "frames 3\npicture seen.png 320 240\n",
                           type.name),
               "--no-panels --seed 3");
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr("render 'two hills.tif' --seed 3 "));
    ASSERT_EQ(call(command_for(outcome.text, "drawn.png")).code, 0) << outcome.text;
    EXPECT_EQ(read_picture(folder_ / "seen.png").rgb, read_picture(folder_ / "drawn.png").rgb) << type.name;
  }
}

TEST_F(ViewCommand, ALandscapeEqualsThatOfRender) {
  for (const char* const method : {"roam", "tessellated"}) {
    const Outcome outcome = script(fmt::format("wait\nmethod 0 {}\nwait\nkey N\nframes 2\nkey W 3\nframes 2\n"
                                               "picture seen.png 160 120\nkey N\nframes 2\n",
                                               method),
                                   "--no-panels", "160x120");
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    ASSERT_EQ(call(command_for(outcome.text, "drawn.png")).code, 0) << outcome.text;
    EXPECT_EQ(read_picture(folder_ / "seen.png").rgb, read_picture(folder_ / "drawn.png").rgb) << method;
  }
}

TEST_F(ViewCommand, EverythingInOneSession) {
  std::string text = "wait\nframes 5\n";
  for (const char key : {'G', 'L', 'L', 'F'}) {
    text += fmt::format("key {}\nkey W 5\nkey D 3\n", key);
  }
  text += "key F\nkey L\nkey G\nkey N\nframes 2\nkey B\nwait\nframes 2\nkey B\nkey N\n";
  for (const char key : {'1', '2', '3', '4', '1'}) {
    text +=
        fmt::format("key {}\nkey W 5\nkey Q 2\nkey E 4\ndrag 600 250 560 270 4\nscroll 2\nscroll -1\n", key);
  }
  text += "resize 500 300\nframes 3\nresize 400 240\nframes 3\n";
  text +=
      "key B\nwait\nframes 3\nequal 2\nwait\nsplit 0.3\ndrag 120 50 180 60 4\nkey L\nkey L\nframes 30\nkey "
      "L\nkey B\nwait\n";
  text += "move 350 180\nkey X\nkey C\nframes 3\nkey Z\nkey Z\nframes 2\n";
  for (const LodType& type : lods())
    text += fmt::format("method 0 {}\nwait\nkey W 4\nkey ] 2\nkey [ 2\n", type.name);
  text += "play fly\nframes 20\nkey P\nkey H\nframes 2\nkey H\n";
  text +=
      "drop small.tif\nwait\nframes 3\ndrop nothing.tif\nwait\nframes 3\nkey Home\nframes 2\npicture "
      "end.png\n";
  const Outcome outcome = script(text, "", "800x600");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("per second"));
  EXPECT_THAT(outcome.text, HasSubstr("render small.tif"));
  EXPECT_EQ(read_picture(folder_ / "end.png").width, 400);
}

TEST_F(ViewCommand, ARecordedPathIsMeasuredAndDrawn) {
  const Outcome outcome = script("wait\nkey R\nkey W 90\nkey Left 20\nkey W 60\nkey R\nframes 2\n");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("recorded    path-1.toml"));
  const Outcome drawn =
      call("$T render 'two hills.tif' --path path-1.toml --frames 3 --size 80x60 --lod roam --out flight");
  EXPECT_EQ(drawn.code, 0) << drawn.text;
  const Outcome measured = call(
      "$T run cross.lod-equal-error 'two hills.tif/roam/1px' --terrain 'two hills.tif' --set "
      "path=path-1.toml,frames=2 "
      "--out "
      "out");
  EXPECT_EQ(measured.code, 0) << measured.text;
}

TEST_F(ViewCommand, ARepresentationsSurface) {
  const Outcome outcome = script("wait\nframes 2\npicture tin.png 160 120\n", "--as tin --lod geomipmap");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, Not(HasSubstr("terrabench render")));  // draws the terrain itself
}

TEST_F(ViewCommand, WithoutADisplayNamesWhatDrawsWithoutOne) {
  const Outcome outcome = call("env -u DISPLAY $T view 'two hills.tif'");
  EXPECT_EQ(outcome.code, 4);
  EXPECT_THAT(outcome.text, HasSubstr("no window can be opened"));
  EXPECT_THAT(outcome.text, HasSubstr("terrabench render"));
}

TEST_F(ViewCommand, MistakesAreFoundBeforeAWindowOpens) {
  EXPECT_EQ(call("env -u DISPLAY $T view 'two hills.tif' --lod roem").code, 2);
  EXPECT_EQ(call("env -u DISPLAY $T view jaksboro").code, 2);
  EXPECT_EQ(call("env -u DISPLAY $T view 'two hills.tif' --as tim").code, 2);
  const Outcome script_error = script("wait\nflames 3\n");
  EXPECT_EQ(script_error.code, 3);
  EXPECT_THAT(script_error.text, HasSubstr("script.txt:2"));
  EXPECT_EQ(call("echo none >bad.tif; $T view bad.tif --script script.txt").code, 3);
}

}  // namespace
}  // namespace terrabench
