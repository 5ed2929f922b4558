// A session in a window under Xvfb, by script.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "renderers/frame_renderer.h"
#include "terrain/files.h"
#include "terrain/framing.h"
#include "terrain/image.h"
#include "terrain/source.h"
#include "tests/renderers/virtual_display.h"
#include "tests/terrain/errors.h"
#include "viewer/camera.h"
#include "viewer/view.h"

namespace terrabench::viewer {
namespace {

std::shared_ptr<Ground> open_ground(const std::string& name, bool, Progress&) {
  auto ground = std::make_shared<Ground>();
  ground->name = name;
  ground->heights = fill_no_data(*open_terrain(name).heights);
  ground->bounds = bounds_of(ground->heights);
  return ground;
}

class Window : public ::testing::Test {
 protected:
  Window() {
    std::string name = (std::filesystem::temp_directory_path() / "terrabench_window_XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~Window() override { std::filesystem::remove_all(folder_); }

  ExitCode run(const std::string& script, const std::string& method = "roam", bool panels = true) {
    write_file(folder_ / "script.txt", std::string_view(script));
    return view({.ground = "jacksboro",
                 .methods = {method},
                 .window = {800, 600},
                 .script = folder_ / "script.txt",
                 .panels = panels},
                open_ground);
  }
  std::filesystem::path folder_;
};

TEST_F(Window, ItsPictureIsTheOfflinePicture) {
  ASSERT_TRUE(start_virtual_display());
  const std::string file = (folder_ / "seen.png").string();
  ASSERT_EQ(
      run("wait\nkey W 20\nkey Left 5\neye 9000 800 20000 10 -12\nframes 5\npicture " + file + " 400 300\n"),
      ExitCode::kGood);
  Progress progress;
  const auto ground = open_ground("jacksboro", false, progress);
  Camera camera;
  camera.stand_on(ground->heights, ground->bounds);
  camera.place({9000, 800, 20000}, 10, -12);
  const terrabench::View view = camera.view(400, 300);
  const LodType& type = lod("roam");
  const auto method = type.build(ground->lod(), Parameters(type.parameters), progress);
  method->tune(type.knob.fallback);
  const auto context = open_context("osmesa", 400, 300);
  FrameRenderer renderer(*context);
  renderer.draw(method->update(view), view,
                {.lowest = ground->bounds.low.y, .highest = ground->bounds.high.y});
  EXPECT_EQ(read_picture(file).rgb, renderer.image().rgb);
}

}  // namespace
}  // namespace terrabench::viewer
