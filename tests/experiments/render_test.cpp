// `terrabench render`: pictures, sequences that continue, and clear errors.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <csignal>
#include <fstream>
#include <glm/vec3.hpp>
#include <set>
#include <thread>

#include "terrain/files.h"
#include "terrain/image.h"
#include "terrain/sources/dem/dem.h"
#include "tests/experiments/command_line.h"
#include "tests/terrain/ground.h"

namespace terrabench {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Render : public CommandLine {
 protected:
  Render() {
    write_geotiff(
        folder_ / "hills.tif",
        test::ground_of(
            65, 65, [](int i, int j) { return 30 * std::sin(0.2 * i) * std::cos(0.17 * j) + 40; }, 10, 10));
    write_file(
        folder_ / "short.toml",
        std::string_view("kind = \"fly\"\nunit = \"extent\"\nfield_of_view = 60\nscreen = [80, 60]\n"
                         "frames_per_second = 10\nspeed = 0.5\n[[keyframe]]\nat = [0.2, 0.8]\nheight = 0.1\n"
                         "look_at = [0.5, 0.5]\n[[keyframe]]\nat = [0.7, 0.8]\nheight = 0.1\n"
                         "look_at = [0.5, 0.5]\n"));
  }
  static std::size_t colours(const Image& image) {
    std::set<Rgb> seen;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) seen.insert(image.pixel(x, y));
    }
    return seen.size();
  }
};

TEST_F(Render, MakesAPicture) {
  const Outcome outcome = call("$T render hills.tif --scene --size 120x80 --out a.png");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  const Image image = read_picture(folder_ / "a.png");
  EXPECT_EQ(image.width, 120);
  EXPECT_EQ(image.height, 80);
  EXPECT_GT(colours(image), 500U);
  EXPECT_EQ(call("$T render hills.tif --scene --size 120x80 --set water=0 --out dry.png").code, 0);
  EXPECT_NE(image.rgb, read_picture(folder_ / "dry.png").rgb);
  EXPECT_EQ(call("$T render hills.tif --size 120x80 --out relief.png --lod geomipmap --detail 2").code, 0);
}

TEST_F(Render, ASequenceContinuesWhereItEnded) {
  const std::string sequence =
      "$T render hills.tif --scene --path short.toml --frames 5 --set shadows=false ";
  ASSERT_EQ(call(sequence + "--out whole").code, 0);
  ASSERT_EQ(call(sequence + "--out parts").code, 0);
  const auto file = [&](const char* folder, int k) {
    return folder_ / folder / ("frame_000" + std::to_string(k) + ".png");
  };
  EXPECT_NE(read_file(file("whole", 0)), read_file(file("whole", 4)));
  fs::remove(file("parts", 1));
  fs::remove(file("parts", 3));
  write_picture(file("parts", 0), Image(2, 2, {1, 2, 3}));  // is kept as it is
  const Outcome outcome = call(sequence + "--out parts");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("3 of 5 pictures from an earlier run"));
  EXPECT_EQ(read_picture(file("parts", 0)).width, 2);
  for (int k = 1; k < 5; ++k) EXPECT_EQ(read_file(file("parts", k)), read_file(file("whole", k))) << k;
  const Outcome other = call(sequence + "--set fog=1 --out parts");
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.text, HasSubstr("other settings"));
}

TEST_F(Render, AnInterruptedSequenceLeavesWholePictures) {
  const pid_t child = start("exec $T render hills.tif --scene --path short.toml --frames 400 --out many");
  while (!fs::exists(folder_ / "many/frame_0001.png")) std::this_thread::yield();
  kill(child, SIGINT);
  EXPECT_EQ(wait(child).code, 130);
  EXPECT_FALSE(fs::exists(folder_ / "many/frame_0399.png"));
  EXPECT_EQ(temporary_files(), 0U);
  for (const auto& entry : fs::directory_iterator(folder_ / "many")) {
    if (entry.path().extension() != ".png") continue;
    EXPECT_EQ(read_picture(entry.path()).width, 80);
  }
}

TEST_F(Render, SaysWhatIsWrong) {
  const auto expect = [&](const std::string& arguments, int code, const char* text) {
    const Outcome outcome = call("$T render " + arguments);
    EXPECT_EQ(outcome.code, code) << arguments << '\n' << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr(text)) << arguments;
  };
  expect("jaksboro --scene", 2, "did you mean 'jacksboro'");
  expect("hills.tif --scene --path flyy", 2, "did you mean 'fly'");
  expect("hills.tif --scene --path none.toml", 3, "none.toml");
  expect("hills.tif --scene --lod clipmop", 2, "did you mean 'clipmap'");
  expect("hills.tif --scene --size 80", 2, "--size");
  expect("hills.tif --scene --size 80x0", 2, "--size");
  expect("hills.tif --scene --size 99999x99999", 2, "size");
  expect("hills.tif --scene --set fogg=1", 2, "did you mean 'fog'");
  expect("hills.tif --scene --set fog_color=blue", 2, "#rrggbb");
  expect("hills.tif --scene --frames 3", 2, "--path");
  expect("hills.tif --scene --frames 0 --path fly", 2, "--frames");
  expect("hills.tif --scene --eye 300 5 300", 2, "under the ground");
  expect("hills.tif --scene --eye 300 90 300 --look-at 300 90 300", 2, "must be finite and differ");
  expect("hills.tif --scene --eye nan 90 300 --look-at 300 90 300", 2, "must be a finite number");
  expect("hills.tif --scene --path fly --eye 300 90 300", 2, "--path");
  expect("hills.tif --scene --renderer nonsense", 2, "nonsense");
  expect("missing.tif --scene", 3, "missing.tif");
  fs::create_directory(folder_ / "folder");
  expect("hills.tif --scene --out folder", 2, "folder");
  expect("hills.tif --scene --path short.toml --frames 2 --out hills.tif", 2, "is a file");
}

// The same dome at the size of a garden pot, of a hill and of a country, with the eye as much nearer or
// farther.
TEST_F(Render, TheFarPlaneReachesGroundOfAnySizeFromAnyEye) {
  for (const double cell : {1.0 / 64, 10.0, 15625.0}) {
    write_geotiff(
        folder_ / "dome.tif",
        test::ground_of(
            65, 65, [&](int i, int j) { return 20 * cell * std::exp(-std::hypot(i - 32, j - 32) / 12); },
            cell, cell));
    for (const glm::dvec3 eye : {glm::dvec3(-200, 50, -200), {32, 30, 60}, {32, 3000, 40}, {2000, 100, 32}}) {
      for (const char* const scene : {"", "--scene --set water=0 "}) {
        const std::string file = "dome.png";
        const Outcome outcome = call(fmt::format(
            "$T render dome.tif {}--size 96x64 --fov 20 --look-at {} {} {} --eye {} {} {} --out {}", scene,
            32 * cell, 5 * cell, 32 * cell, eye.x * cell, eye.y * cell, eye.z * cell, file));
        ASSERT_EQ(outcome.code, 0) << outcome.text;
        const Image image = read_picture(folder_ / file);
        EXPECT_NE(image.pixel(image.width / 2, image.height / 2), (Rgb{255, 255, 255}))
            << cell << ", eye " << eye.x;
      }
    }
  }
}

TEST_F(Render, APlanHasNorthAtTheTop) {
  const std::string plan = "$T render hills.tif --eye 320 1000 320 --look-at 320 0 320 --size 64x64 ";
  const auto picture = [&](const std::string& more) {
    const Outcome outcome = call(plan + more + " --out plan.png");
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    return read_picture(folder_ / "plan.png");
  };
  const Image north = picture("");
  EXPECT_GT(colours(north), 100U);
  EXPECT_EQ(north.rgb, picture("--up 0 0 -1").rgb);
  EXPECT_NE(north.rgb, picture("--up 1 0 0").rgb);
  const Image scene = picture("--scene --up 0 0 -1");
  EXPECT_GT(colours(scene), 500U) << "the ground, and not fog alone";
  EXPECT_NE(scene.rgb, picture("--scene --up 1 1 0").rgb);
  const Outcome parallel = call(plan + "--up 0 2 0");
  EXPECT_EQ(parallel.code, 2);
  EXPECT_THAT(parallel.text, HasSubstr("up must be finite and not parallel"));
}

TEST_F(Render, APictureWithoutGroundIsRefused) {
  for (const char* const view :
       {"--eye 320 300 320 --look-at 320 900 320", "--eye 320 100 -50 --look-at 320 100 -900",
        "--scene --eye 320 300 320 --look-at 320 900 330", "--eye 1e9 1e9 1e9 --look-at 0 0 0"}) {
    const Outcome outcome = call(std::string("$T render hills.tif --size 64x48 --out none.png ") + view);
    EXPECT_EQ(outcome.code, 2) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr("no ground is in view from (")) << view;
    EXPECT_THAT(outcome.text, HasSubstr("--look-at 320 ")) << view;
    EXPECT_FALSE(fs::exists(folder_ / "none.png"));
  }
  const Outcome dug = call(
      "$T represent hills.tif --as layered_stack --dig 320,40,320,9000 --render none.png --crop 0 0 9 9");
  EXPECT_EQ(dug.code, 2) << dug.text;
  EXPECT_THAT(dug.text, HasSubstr("nothing of the terrain is left to draw"));
}

// A path whose every frame is empty is refused and leaves no pictures; some empty frames are counted.
TEST_F(Render, APathThatLooksAtTheSkyIsRefused) {
  const auto fly = [&](int from, int to) {
    write_file(
        folder_ / "sky.toml",
        fmt::format("kind = \"fly\"\nfield_of_view = 40\nscreen = [64, 48]\nframes_per_second = 10\n"
                    "speed = 50\n[[keyframe]]\nat = [100, 300]\nheight = 100\nheading = 90\npitch = {}\n"
                    "[[keyframe]]\nat = [400, 300]\nheight = 100\nheading = 90\npitch = {}\n",
                    from, to));
    return call("$T render hills.tif --path sky.toml --frames 4 --out sky");
  };
  const Outcome all = fly(60, 50);
  EXPECT_EQ(all.code, 2) << all.text;
  EXPECT_THAT(all.text, HasSubstr("no ground is in view"));
  for (const auto& entry : fs::directory_iterator(folder_ / "sky"))
    EXPECT_EQ(entry.path().extension(), ".toml");
  fs::remove_all(folder_ / "sky");
  const Outcome some = fly(60, -40);
  EXPECT_EQ(some.code, 0) << some.text;
  EXPECT_THAT(some.text, HasSubstr("no ground is in view in 2 of 4 pictures, the first sky/frame_0000.png"));
}

TEST_F(Render, DetailIsWithinTheMethodsRange) {
  for (const char* const detail : {"-1", "0", "1e300", "nan"}) {
    const Outcome outcome = call(std::string("$T render hills.tif --lod geomipmap --detail ") + detail);
    EXPECT_EQ(outcome.code, 2) << detail << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr("--detail")) << detail;
  }
  EXPECT_EQ(call("$T render hills.tif --lod brute_force --detail 2").code, 2);
}

TEST_F(Render, UnusualGroundGivesAPictureOrAnError) {
  const auto draw = [&](const Heightfield& field, const std::string& more = "") {
    write_geotiff(folder_ / "ground.tif", field);
    return call("$T render ground.tif --scene --size 64x48 --out g.png " + more);
  };
  EXPECT_EQ(draw(test::flat(9, 9, 7)).code, 0);
  EXPECT_EQ(draw(test::flat(2, 2)).code, 0);
  const Outcome one = draw(test::flat(1, 1));
  EXPECT_EQ(one.code, 2) << one.text;
  Heightfield holes = test::flat(9, 9, 3);
  holes.at(4, 4) = Heightfield::kNoData;
  EXPECT_EQ(draw(holes).code, 0);
  for (float& height : holes.heights) height = Heightfield::kNoData;
  EXPECT_EQ(draw(holes).code, 3);
  // Under water: the sea bed lies at 0, the water at half the relief.
  const Heightfield pit = test::ground_of(
      33, 33, [](int i, int) { return i < 16 ? 0 : 40; }, 10, 10);
  const Outcome below = draw(pit, "--set water=0.5 --eye 50 8 150 --look-at 200 10 150");
  EXPECT_EQ(below.code, 0) << below.text;
}

TEST_F(Render, DrawsASolidsSurface) {
  const Outcome outcome = call("$T render caves --scene --samples 65 --size 96x64 --seed 2 --out caves.png");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_GT(colours(read_picture(folder_ / "caves.png")), 500U);
}

TEST_F(Render, ListsTheScenesParameters) {
  const Outcome outcome = call("$T list scene");
  EXPECT_EQ(outcome.code, 0);
  for (const char* name : {"--set fresnel=", "--set fog_sun=", "--set cloud_cover=", "--set slope_rule="}) {
    EXPECT_THAT(outcome.text, HasSubstr(name));
  }
}

}  // namespace
}  // namespace terrabench
