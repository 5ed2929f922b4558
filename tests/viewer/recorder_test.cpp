// What was flown is what the file's path flies.
#include "viewer/recorder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "terrain/framing.h"
#include "tests/terrain/ground.h"

namespace terrabench::viewer {
namespace {

struct Recording {
  Heightfield ground = test::ground_of(
      101, 81, [](int i, int j) { return 200 * std::sin(0.1 * i) * std::cos(0.13 * j); }, 30, 30);
  Bounds bounds = bounds_of(ground);
  Camera camera;
  Recorder recorder;
  double seconds = 5;
  Recording() {
    camera.stand_on(ground, bounds);
    camera.set_speed(60);
    recorder.begin({640, 480});
  }
  void step(const glm::dvec3& way, double turn) {
    recorder.add(camera, ground, seconds);
    camera.move(way, 1.0 / 60);
    camera.turn(turn, 0);
    seconds += 1.0 / 60;
  }
  // Ends the recording, writes the path and reads it.
  std::optional<CameraPath> written() {
    recorder.add(camera, ground, seconds);
    const auto path = recorder.end();
    if (!path) return path;
    const CameraPath read = parse_camera_path(to_toml(*path), "recorded", "recorded.toml");
    EXPECT_EQ(to_toml(read), to_toml(*path));
    return read;
  }
};

TEST(Recorder, AFlightPassesTheRecordedPlacesInTheirTime) {
  Recording of;
  std::vector<glm::dvec3> eyes;
  for (int k = 0; k < 240; ++k) {
    if (k % 30 == 0) eyes.push_back(of.camera.eye());
    of.step({0.2, 0.1, 1}, 0.5);
  }
  eyes.push_back(of.camera.eye());
  const auto path = of.written();
  ASSERT_TRUE(path);
  EXPECT_EQ(path->kind, CameraPath::Kind::kFly);
  EXPECT_EQ(path->screen, glm::ivec2(640, 480));
  const std::vector<View> all = views(*path, of.ground);
  // 4 seconds; what the eye climbs is not in the speed, which counts in plan.
  EXPECT_NEAR(static_cast<double>(all.size()), 4 * path->frames_per_second + 1, 2);
  ASSERT_EQ(path->keyframes.size(), eyes.size());
  for (std::size_t k = 0; k < eyes.size(); ++k) {
    const Keyframe& key = path->keyframes[k];
    EXPECT_NEAR(key.at.x, eyes[k].x, 1e-6);
    EXPECT_NEAR(ground_under(of.ground, key.at) + key.height, eyes[k].y, 1e-6);
    double nearest = 1e9;
    for (const View& view : all) nearest = std::min(nearest, glm::distance(glm::dvec3(view.eye), eyes[k]));
    EXPECT_LT(nearest, 0.5 * 60 / path->frames_per_second * 1.3 + 1e-3) << k;
  }
  const auto heading = [](const View& view) {
    const glm::dvec3 sight(view.target - view.eye);
    return glm::degrees(std::atan2(sight.x, -sight.z));
  };
  EXPECT_NEAR(heading(all.back()) - heading(all.front()), 120, 1);
}

TEST(Recorder, AWalkWalks) {
  Recording of;
  of.camera.set_motion(Motion::kWalk);
  for (int k = 0; k < 100; ++k) of.step({0, 0, 1}, 0);
  const auto path = of.written();
  ASSERT_TRUE(path);
  EXPECT_EQ(path->kind, CameraPath::Kind::kWalk);
  for (const View& view : views(*path, of.ground))
    EXPECT_NEAR(view.eye.y - of.ground.sample(view.eye.x, view.eye.z), 1.8, 1e-2);
}

TEST(Recorder, LookingAroundIsATurn) {
  Recording of;
  for (int k = 0; k < 90; ++k) of.step({0, 0, 0}, k < 60 ? 2 : -1);
  const auto path = of.written();
  ASSERT_TRUE(path);
  EXPECT_EQ(path->kind, CameraPath::Kind::kTurn);
  EXPECT_NEAR(path->keyframes.back().heading - path->keyframes.front().heading, 90, 1e-6);
  EXPECT_GT(views(*path, of.ground).size(), 10U);
}

TEST(Recorder, PausesAreLeftOut) {
  Recording of;
  for (int k = 0; k < 60; ++k) of.step({0, 0, 1}, 0);
  for (int k = 0; k < 600; ++k) of.step({0, 0, 0}, 0.1);
  for (int k = 0; k < 60; ++k) of.step({0, 0, 1}, 0);
  const auto path = of.written();
  ASSERT_TRUE(path);
  EXPECT_LT(static_cast<double>(views(*path, of.ground).size()), 4 * path->frames_per_second);
}

TEST(Recorder, NothingIsRecordedOfAnEyeAtRest) {
  Recording of;
  for (int k = 0; k < 60; ++k) of.step({0, 0, 0}, 0);
  EXPECT_FALSE(of.written());
}

}  // namespace
}  // namespace terrabench::viewer
