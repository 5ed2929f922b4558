// Paths give the views that they describe, over any ground; errors name the line.
#include "lod/camera/camera_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "lod/lod.h"
#include "terrain/error.h"
#include "terrain/files.h"
#include "tests/lod/drawing.h"
#include "tests/terrain/errors.h"

namespace terrabench::test {
namespace {

constexpr std::string_view kWalk = R"(kind = "walk"
field_of_view = 90
screen = [640, 480]
frames_per_second = 10
speed = 2
[[keyframe]]
at = [10, 20]
[[keyframe]]
at = [20, 20]
speed = 4
[[keyframe]]
at = [20, 8]
)";

CameraPath parse(std::string_view text) { return parse_camera_path(text, "test", "test.toml"); }

std::string replaced(std::string_view text, std::string_view from, std::string_view to) {
  std::string result(text);
  const std::size_t at = result.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return result.replace(at, from.size(), to);
}

void expect_refused(const std::string& text, int line, const std::string& what) {
  const Failure failure = failure_of([&] { parse(text); });
  EXPECT_EQ(failure.code, ExitCode::kBadInput);
  EXPECT_THAT(failure.what, testing::HasSubstr("test.toml:" + std::to_string(line))) << text;
  EXPECT_THAT(failure.what, testing::HasSubstr(what));
}

TEST(CameraPath, AWalkKeepsPaceAndEyeHeight) {
  const Heightfield ground = hilly(60, 60);
  const std::vector<View> all = views(parse(kWalk), ground);
  ASSERT_EQ(all.size(), 81U);  // 10 m at 2 m/s and 12 m at 4 m/s, ten frames per second
  for (std::size_t k = 0; k < all.size(); ++k) {
    EXPECT_NEAR(all[k].eye.y - ground.sample(all[k].eye.x, all[k].eye.z), 1.8, 1e-4);
    EXPECT_EQ(all[k].width, 640);
    EXPECT_NEAR(all[k].vertical_fov, 1.5708, 1e-4);
    if (k > 0) {
      const float step =
          glm::length(glm::vec2(all[k].eye.x - all[k - 1].eye.x, all[k].eye.z - all[k - 1].eye.z));
      EXPECT_NEAR(step, k <= 50 ? 0.2 : 0.4, 1e-4) << k;
    }
  }
  EXPECT_NEAR(all.front().eye.x, 10, 1e-5);
  EXPECT_NEAR(all.back().eye.z, 8, 1e-4);
  const glm::vec3 east = glm::normalize(all[20].target - all[20].eye);
  EXPECT_NEAR(east.x, 1, 1e-5);
  const glm::vec3 north = glm::normalize(all[70].target - all[70].eye);
  EXPECT_NEAR(north.z, -1, 1e-5);
}

TEST(CameraPath, ScalesWithTheGround) {
  const std::string text =
      replaced(replaced(kWalk, "speed = 2", "speed = 0.1\nunit = \"extent\"\norigin = [0.5, 0]"),
               "at = [10, 20]", "at = [-0.25, 0.5]");
  const CameraPath path = parse(replaced(
      replaced(replaced(text, "at = [20, 20]", "at = [0.25, 0.5]"), "at = [20, 8]", "at = [0.25, 1]"),
      "speed = 4", "speed = 0.2"));
  for (const int size : {51, 501}) {
    const Heightfield ground = flat(size, size, 7);
    const std::vector<View> all = views(path, ground);
    ASSERT_EQ(all.size(), 76U);
    EXPECT_NEAR(all.front().eye.x, 0.25 * (size - 1), 1e-3);
    EXPECT_NEAR(all.back().eye.x, 0.75 * (size - 1), 1e-3);
    EXPECT_NEAR(all.back().eye.z, size - 1, 1e-3);
    EXPECT_NEAR(all.back().eye.y, 8.8, 1e-5);
  }
}

TEST(CameraPath, AFlightSinksEvenlyAndClearsPeaks) {
  Heightfield ground = flat(101, 3);
  ground.at(50, 1) = 500;
  const std::vector<View> all = views(parse(R"(kind = "fly"
field_of_view = 60
screen = [800, 600]
frames_per_second = 1
speed = 1
[[keyframe]]
at = [0, 1]
height = 100
look_at = [50, 1]
[[keyframe]]
at = [100, 1]
height = 50
look_at = [50, 1]
)"),
                                      ground);
  ASSERT_EQ(all.size(), 101U);
  EXPECT_NEAR(all[20].eye.y, 90, 1e-3);
  EXPECT_NEAR(all[50].eye.y, 501.8, 1e-3);
  EXPECT_NEAR(all[80].eye.y, 60, 1e-3);
  EXPECT_LT(all[80].target.x, all[80].eye.x);  // looks back at the peak
  EXPECT_GT(all[80].target.y, all[80].eye.y);
}

TEST(CameraPath, ArrivesWhereATimeIsTooShortToCount) {
  const std::string text = replaced(replaced(kWalk, "= 10\n", "= 0.01\n"), "speed = 2", "speed = 0.000001");
  const CameraPath path =
      parse(replaced(replaced(replaced(replaced(text, "speed = 4", "speed = 1e7"), "[10, 20]", "[0, 20]"),
                              "[20, 20]", "[90, 20]"),
                     "[20, 8]", "[90.001, 20]"));
  const std::vector<View> all = views(path, flat(101, 41));
  ASSERT_EQ(all.size(), 900001U);
  EXPECT_NEAR(all[450000].eye.x, 45, 1e-3);
  EXPECT_NEAR(all.back().eye.x, 90.001, 1e-3);
}

// Users start from this example.
TEST(CameraPath, ReadsTheExampleOfItsPage) {
  const std::string page = read_file(std::filesystem::path(TERRABENCH_SOURCE_DIR) / "docs/paths.md");
  const std::string fence = "```toml\n";
  const std::size_t begin = page.find(fence) + fence.size();
  const CameraPath path = parse(page.substr(begin, page.find("```", begin) - begin));
  EXPECT_EQ(path.kind, CameraPath::Kind::kFly);
  EXPECT_EQ(path.look, CameraPath::Look::kHeading);
  ASSERT_EQ(path.keyframes.size(), 3U);
  EXPECT_EQ(path.keyframes[0].pitch, -10);
  EXPECT_EQ(path.keyframes[1].speed, 40);
  EXPECT_EQ(path.screen, glm::ivec2(800, 600));
  EXPECT_EQ(views(path, flat(1001, 1001)).size(), 552U);
}

TEST(CameraPath, ATurnStaysAndGoesAround) {
  const std::vector<View> all = views(camera_path("turn"), flat(30, 30));
  ASSERT_EQ(all.size(), 226U);
  for (const View& view : all) EXPECT_EQ(view.eye, all[0].eye);
  const auto looks = [&](std::size_t k) { return glm::normalize(all[k].target - all[k].eye); };
  EXPECT_NEAR(looks(0).z, -1, 1e-5);
  EXPECT_GT(looks(56).x, 0.99F);  // a quarter: east
  EXPECT_GT(looks(112).z, 0.99F);
  EXPECT_NEAR(looks(225).z, -1, 1e-5);
}

TEST(CameraPath, CommittedPathsHoldOnAnyGround) {
  EXPECT_GE(camera_paths().size(), 4U);
  for (const CameraPath& path : camera_paths()) {
    for (const auto& [width, depth] : {std::pair{2, 2}, {3, 100}, {403, 344}}) {
      Heightfield ground = hilly(width, depth, 2);
      ground.cell_x = ground.cell_z = 30;
      const std::vector<View> all = views(path, ground);
      EXPECT_GE(all.size(), 200U) << path.name;
      EXPECT_LE(all.size(), 400U) << path.name;
      for (const View& view : all) EXPECT_NO_THROW(check_view(view));
      EXPECT_EQ(all.size(), views(path, ground).size());
    }
  }
  EXPECT_THROW(camera_path("wlak"), Error);
}

// On ground of the same sides and on much longer ones: named paths stay on the ground, go as far along each
// side as on a square, and look at the ground.
TEST(CameraPath, CommittedPathsStayOnGroundOfAnyShape) {
  for (const CameraPath& path : camera_paths()) {
    const std::vector<View> square = views(path, flat(101, 101, 0));
    for (const auto& [width, depth] : {std::pair{101, 101}, {34, 101}, {101, 34}, {11, 201}, {201, 11}}) {
      for (const float cell : {0.01F, 10.0F, 5000.0F}) {
        Heightfield ground = flat(width, depth, 0);
        ground.cell_x = ground.cell_z = cell;
        const std::vector<View> all = views(path, ground);
        ASSERT_EQ(all.size(), square.size()) << path.name;
        for (const View& view : all) {
          EXPECT_GE(view.eye.x, 0) << path.name << ' ' << width << " x " << depth << ", " << cell;
          EXPECT_GE(view.eye.z, 0) << path.name;
          EXPECT_LE(view.eye.x, ground.extent_x()) << path.name;
          EXPECT_LE(view.eye.z, ground.extent_z()) << path.name;
          EXPECT_LT(view.near, view.eye.y) << path.name;
          EXPECT_GT(view.far, std::hypot(ground.extent_x() - view.eye.x, ground.extent_z() - view.eye.z));
        }
        if (!path.by_extent) continue;
        EXPECT_NEAR(all.back().eye.x / ground.extent_x(), square.back().eye.x / 100, 1e-4) << path.name;
        EXPECT_NEAR(all.back().eye.z / ground.extent_z(), square.back().eye.z / 100, 1e-4) << path.name;
      }
    }
  }
}

// What was measured on such grounds stays comparable: the unit of all axes is the longer side.
TEST(CameraPath, NearlySquareGroundDoesNotStretchAPath) {
  const CameraPath& path = camera_path("fly");
  for (const auto& [width, depth] : {std::pair{101, 101}, {95, 101}, {101, 95}}) {
    const View first = views(path, flat(width, depth, 0)).front();
    EXPECT_NEAR(first.eye.x, 10, 1e-3);
    EXPECT_NEAR(first.eye.z, 90, 1e-3);
    EXPECT_NEAR(first.eye.y, 12, 1e-3);
  }
}

TEST(CameraPath, AMetreShrinksOnlyWhereItIsAsked) {
  const std::string beyond = replaced(kWalk, "[20, 8]", "[20, -40]");
  const View far = views(parse(beyond), flat(60, 60)).back();
  EXPECT_NEAR(far.eye.z, -40, 1e-4);
  const std::string shrinks =
      replaced(replaced(kWalk, "speed = 2", "speed = 2\nshrink = true"), "[20, 8]", "[20, 80]");
  EXPECT_NEAR(views(parse(shrinks), flat(101, 101)).back().eye.z, 80, 1e-4);
  const std::vector<View> small = views(parse(shrinks), flat(41, 41));
  EXPECT_NEAR(small.back().eye.z, 36, 1e-4);  // 0.9 of 40 m for 80 m
  EXPECT_NEAR(small.front().eye.x, 4.5, 1e-4);
  EXPECT_EQ(small.size(), views(parse(shrinks), flat(101, 101)).size());
}

// Looking straight down all the way, north is at the top; with `up`, what that says.
TEST(CameraPath, LooksStraightDown) {
  const std::string text = R"(kind = "fly"
field_of_view = 60
screen = [160, 120]
frames_per_second = 5
speed = 50
[[keyframe]]
at = [320, 320]
height = 300
look_at = [320, 320]
[[keyframe]]
at = [330, 320]
height = 300
look_at = [330, 320]
)";
  Heightfield ground = hilly(65, 65);
  ground.cell_x = ground.cell_z = 10;
  const auto expect = [&](const std::string& path, const glm::vec3& up) {
    for (const View& view : views(parse(path), ground)) {
      EXPECT_LT(glm::normalize(view.target - view.eye).y, -0.999F) << path;
      EXPECT_LT(glm::distance(view.up, up), 1e-5F) << path;
    }
  };
  expect(text, {0, 0, -1});
  expect(replaced(text, "speed = 50", "speed = 50\nup = [1, 0, 0]"), {1, 0, 0});
  const std::string east = replaced(replaced(text, "look_at = [320, 320]", "heading = 90\npitch = -90"),
                                    "look_at = [330, 320]", "heading = 90\npitch = -90");
  expect(east, {1, 0, 0});
  EXPECT_THROW(views(parse(replaced(text, "speed = 50", "speed = 50\nup = [0, 1, 0]")), ground), Error);
}

TEST(CameraPath, OpensANameOrAFile) {
  EXPECT_EQ(open_camera_path("fly").name, "fly");
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "my_path.toml";
  write_file(file, std::string(kWalk));
  EXPECT_EQ(open_camera_path(file.string()).name, "my_path");
  EXPECT_EQ(open_camera_path(file.string()).keyframes.size(), 3U);
  std::filesystem::remove(file);
  EXPECT_THROW(open_camera_path(file.string()), Error);
  EXPECT_THROW(open_camera_path("my_path"), Error);
}

TEST(CameraPath, RefusesGarbageByLine) {
  const auto refused = [](std::string_view from, std::string_view to, int line, const std::string& what) {
    expect_refused(replaced(kWalk, from, to), line, what);
  };
  refused("[10, 20]", "[nan, 20]", 7, "'at'");
  refused("[10, 20]", "[10, inf]", 7, "'at'");
  refused("[10, 20]", "[10]", 7, "list of 2");
  refused("[10, 20]", "[10, \"x\"]", 7, "'at'");
  refused("[10, 20]", "[20, 20]", 8, "must differ");
  refused("speed = 4", "speed = 0", 10, "'speed'");
  refused("speed = 4", "spede = 4", 10, "unknown key 'spede'; did you mean 'speed'?");
  refused("kind", "knid", 1, "'kind' is missing; is it meant by 'knid' in line 1?");
  refused("frames_per_second", "frames_per_secnd", 1, "by 'frames_per_secnd' in line 4?");
  refused("\nat = [20, 20]", "\natt = [20, 20]", 8, "is it meant by 'att' in line 9?");
  refused("speed = 4", "look_ta = [4, 4]", 10, "did you mean 'look_at'?");
  refused("speed = 4", "up = [0, 0, -1]", 10, "unknown key 'up'");
  refused("speed = 2", "speed = 2\nup = [0, 1]", 6, "list of 3");
  refused("speed = 2", "speed = 2\nup = [0, 1, nan]", 6, "'up'");
  refused("speed = 2", "speed = 2\nshrink = 1", 6, "true or false");
  refused("speed = 2", "speed = 2\nunit = \"extent\"\nshrink = true", 7, "unknown key 'shrink'");
  refused("speed = 2", "speed = 2\nnear = 0", 6, "'near'");
  refused("speed = 4", "speed = ", 10, "");
  refused("speed = 4", "heading = 4", 8, "all keyframes must");
  refused("speed = 4", "height = 4", 10, "'height'");
  refused("\"walk\"", "\"swim\"", 1, "walk, fly or turn");
  refused("\"walk\"", "7", 1, "'kind'");
  refused("\"walk\"", "\"turn\"", 6, "heading");
  expect_refused(replaced(replaced(kWalk, "\"walk\"", "\"turn\""), "at = [10, 20]",
                          "at = [10, 20]\nheading = 3\nlook_at = [3, 4]"),
                 6, "no 'look_at'");
  refused("= 90", "= 180", 2, "'field_of_view'");
  refused("= 90", "= -nan", 2, "'field_of_view'");
  refused("[640, 480]", "[640, 0]", 3, "'screen'");
  refused("[640, 480]", "[640, 48.5]", 1, "whole pixels");
  refused("= 10", "= 1e9", 4, "'frames_per_second'");
  expect_refused("", 1, "'kind'");
  expect_refused(std::string(kWalk.substr(0, kWalk.find("[[keyframe]]"))), 1, "'keyframe'");
  expect_refused("keyframe = 3\n" + std::string(kWalk.substr(0, kWalk.find("[[keyframe]]"))), 1,
                 "must be a list");
}

TEST(CameraPath, RefusesPathsWithoutEnd) {
  const CameraPath path =
      parse(replaced(replaced(kWalk, "speed = 2", "speed = 0.000001"), "= 10\n", "= 1000\n"));
  EXPECT_THROW(views(path, flat(9, 9)), Error);
}

TEST(CameraPath, WrittenAndReadAgainGivesTheSameViews) {
  const Heightfield ground = hilly(60, 45);
  std::vector<CameraPath> all(camera_paths().begin(), camera_paths().end());
  all.push_back(parse(kWalk));
  for (const CameraPath& path : all) {
    const CameraPath read = parse(to_toml(path));
    EXPECT_EQ(to_toml(read), to_toml(path)) << path.name;
    const std::vector<View> a = views(path, ground), b = views(read, ground);
    ASSERT_EQ(a.size(), b.size()) << path.name;
    for (std::size_t k = 0; k < a.size(); ++k) {
      EXPECT_EQ(a[k].eye, b[k].eye) << path.name << " " << k;
      EXPECT_EQ(a[k].target, b[k].target) << path.name << " " << k;
      EXPECT_EQ(a[k].near, b[k].near) << path.name << " " << k;
    }
  }
}

}  // namespace
}  // namespace terrabench::test
