#include "renderers/scene.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <utility>

#include "tests/renderers/ground.h"

namespace terrabench {
namespace {

using testing::ground;
using testing::hills;

constexpr Rgb kWhite{255, 255, 255};

// Looks straight down on [0, 100]², north up, one metre per pixel: (x, z) is pixel (x, z).
View map_view() {
  View view;
  view.width = view.height = 100;
  view.target = {50, 0, 50};
  view.eye = {50, 10000, 50};
  view.up = {0, 0, -1};
  view.vertical_fov = 2 * std::atan(50.0F / 10000);
  return view;
}

bool dark(const Rgb& color) { return color[0] < 140; }

TriangleMesh level(float height, int n = 4) {
  return ground(n, 100, [height](float, float) { return height; });
}

template <class Inked>
int count_pixels(const Image& image, const Inked& inked) {
  int count = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) count += inked(image.pixel(x, y)) ? 1 : 0;
  }
  return count;
}

class SceneTest : public ::testing::Test {
 protected:
  Image draw(const Scene& scene, const View& view = map_view()) {
    return render_scene(*context_, scene, view);
  }
  static SceneMesh wired(const TriangleMesh& mesh, float width = 2) {
    SceneMesh item;
    item.mesh = &mesh;
    item.shading = Shading::kFlat;
    item.wire_width = width;
    return item;
  }
  std::unique_ptr<GlContext> context_ = open_context("osmesa", 64, 64);
};

TEST_F(SceneTest, WiresAreTheCellsBordersAndHaveTheirWidth) {
  const TriangleMesh mesh = level(0);  // cells of 25 pixels
  Scene scene;
  scene.meshes = {wired(mesh, 4)};
  scene.meshes[0].wires = quad_wires(mesh);
  const Image image = draw(scene);
  for (const int at : {25, 50, 75}) {
    int across = 0;
    for (int i = at - 10; i < at + 10; ++i) across += dark(image.pixel(i, 37)) ? 1 : 0;
    EXPECT_NEAR(across, 4, 1) << at;
    EXPECT_TRUE(dark(image.pixel(37, at)));
  }
  EXPECT_EQ(image.pixel(37, 37), kWhite) << "the middle of a cell, where the diagonal would be";
  scene.meshes[0].wires.clear();
  EXPECT_TRUE(dark(draw(scene).pixel(37, 37)));
}

TEST_F(SceneTest, WiresBehindTheSurfaceAreHidden) {
  const TriangleMesh below = level(0), above = level(10, 1);
  Scene scene;
  scene.meshes = {wired(below), wired(above)};
  scene.meshes[1].wire_width = 0;
  const auto ink = [&] { return count_pixels(draw(scene), [](const Rgb& c) { return c != kWhite; }); };
  EXPECT_EQ(ink(), 0);
  std::swap(scene.meshes[0], scene.meshes[1]);
  EXPECT_EQ(ink(), 0) << "in either order";
  scene.meshes.erase(scene.meshes.begin());
  EXPECT_GT(ink(), 500);
}

TEST_F(SceneTest, OutlinesHaveTheWidthOfOtherWires) {
  // The border of the mesh lies 20 pixels inside the picture.
  TriangleMesh mesh = ground(1, 60, [](float, float) { return 0.0F; });
  for (glm::vec3& at : mesh.positions) at += glm::vec3(20, 0, 20);
  Scene scene;
  scene.meshes = {wired(mesh, 6)};
  scene.meshes[0].wires = quad_wires(mesh);
  const Image image = draw(scene);
  int across = 0;
  for (int x = 10; x < 40; ++x) across += dark(image.pixel(x, 50)) ? 1 : 0;
  EXPECT_NEAR(across, 6, 1);
}

TEST_F(SceneTest, OutlinesAreDrawnWhereNoWireRuns) {
  // A roof of two triangles; the ridge is the only edge that is not a wire. Seen from the side, it is the
  // outline against the sky.
  TriangleMesh roof;
  roof.positions = {{0, 0, 0}, {50, 40, 0}, {50, 40, 100}, {100, 0, 0}};
  roof.indices = {0, 2, 1, 1, 2, 3};
  Scene scene;
  scene.meshes = {wired(roof, 4)};
  scene.meshes[0].wires = {0, 0};
  View view = map_view();
  view.up = {0, 1, 0};
  view.eye = {-10000, 20, 50};
  view.target = {0, 20, 50};
  const auto ink = [&] { return count_pixels(draw(scene, view), dark); };
  EXPECT_GT(ink(), 150);
  view.eye = {50, 10000, 50};  // from above both triangles face the eye, so the ridge is not an outline
  view.target = {50, 0, 50};
  view.up = {0, 0, -1};
  EXPECT_EQ(ink(), 0);
}

TEST_F(SceneTest, FarWiresThinOutInsteadOfBlackening) {
  const TriangleMesh mesh = level(0, 400);  // four cells per pixel
  Scene scene;
  scene.meshes = {wired(mesh, 1)};
  const Image image = draw(scene);
  double sum = 0;
  for (int y = 20; y < 80; ++y) {
    for (int x = 20; x < 80; ++x) sum += image.pixel(x, y)[0];
  }
  EXPECT_GT(sum / 3600, 60);
  EXPECT_LT(sum / 3600, 250);
}

TEST_F(SceneTest, WiresBeforeAndBehindTheEyeDoNotTearThePicture) {
  const TriangleMesh mesh = ground(64, 10000, hills);
  View view;
  view.width = view.height = 64;
  view.eye = {5000, hills(5000, 5000) + 30, 5000};
  view.target = {0, 400, 0};
  Scene scene;
  scene.meshes = {wired(mesh, 1)};
  const Image image = draw(scene, view);
  for (int x = 0; x < 64; ++x) ASSERT_EQ(image.pixel(x, 0), kWhite) << "sky";
}

TEST_F(SceneTest, VerticesHaveTheirOwnColours) {
  const TriangleMesh mesh = level(0);
  Scene scene;
  SceneMesh& item = scene.meshes.emplace_back();
  item.mesh = &mesh;
  for (const glm::vec3& at : mesh.positions) {
    item.colors.push_back(at.x < 50.5F ? Rgb{200, 30, 30} : Rgb{90, 90, 90});
  }
  const Image image = draw(scene);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(image.pixel(20, 60)[c], (Rgb{200, 30, 30}[c]), 1)
        << "level ground in the sun keeps its colour";
    EXPECT_NEAR(image.pixel(90, 60)[c], (Rgb{90, 90, 90}[c]), 1);
  }
}

TEST_F(SceneTest, PlanesLetTheGroundShowThroughAndHideBehindIt) {
  const TriangleMesh mesh = level(0, 1);
  Scene scene;
  scene.meshes = {wired(mesh, 0)};
  scene.meshes[0].fill = {200, 200, 200};
  ScenePlane plane{{{20, 5, 20}, {80, 5, 20}, {80, 5, 80}, {20, 5, 80}}, {0, 0, 200}, 0.5F, 3};
  scene.planes = {plane};
  const Image over = draw(scene);
  EXPECT_NEAR(over.pixel(50, 50)[0], 100, 2);
  EXPECT_NEAR(over.pixel(50, 50)[2], 200, 2);
  EXPECT_EQ(over.pixel(50, 20), (Rgb{0, 0, 200})) << "the outline";
  EXPECT_EQ(over.pixel(10, 10), (Rgb{200, 200, 200}));
  for (glm::vec3& corner : scene.planes[0].corners) corner.y = -5;
  const Image under = draw(scene);
  EXPECT_EQ(under.pixel(50, 50), (Rgb{200, 200, 200}));
  EXPECT_EQ(under.pixel(50, 20), (Rgb{200, 200, 200}));
}

TEST_F(SceneTest, NearerPlanesLieOverFartherOnesInAnyOrder) {
  const auto square = [](float y, const Rgb& color) {
    return ScenePlane{{{20, y, 20}, {80, y, 20}, {80, y, 80}, {20, y, 80}}, color, 1, 0};
  };
  Scene scene;
  scene.planes = {square(0, {0, 255, 0}), square(5, {255, 0, 0})};
  EXPECT_EQ(draw(scene).pixel(50, 50), (Rgb{255, 0, 0}));
  std::swap(scene.planes[0], scene.planes[1]);
  EXPECT_EQ(draw(scene).pixel(50, 50), (Rgb{255, 0, 0}));
}

TEST_F(SceneTest, LinesReachFromEndToEndEvenPastTheEye) {
  Scene scene;
  scene.lines = {{{{10, 0, 30}, {90, 0, 30}}, {0, 0, 0}, 2}};
  const Image image = draw(scene);
  for (int x = 10; x < 90; ++x) ASSERT_TRUE(dark(image.pixel(x, 30)) || dark(image.pixel(x, 29))) << x;
  EXPECT_EQ(image.pixel(50, 35), kWhite);
  EXPECT_EQ(image.pixel(5, 30), kWhite);

  View level_view;
  level_view.width = level_view.height = 100;
  level_view.eye = {0, 2, 0};
  level_view.target = {0, 2, -10};
  scene.lines = {{{{0, 0, 50}, {0, 0, -50}}, {0, 0, 0}, 2}};
  const Image along = draw(scene, level_view);
  EXPECT_TRUE(dark(along.pixel(50, 95)) || dark(along.pixel(49, 95)));
  EXPECT_EQ(along.pixel(50, 20), kWhite);
}

TEST_F(SceneTest, OfNothingIsBackground) {
  Scene scene;
  scene.background = {1, 2, 3};
  const TriangleMesh none;
  scene.meshes = {wired(none)};
  EXPECT_EQ(draw(scene).pixel(50, 50), (Rgb{1, 2, 3}));
  EXPECT_EQ(bounds_of(scene).high, glm::vec3(0));
}

TEST(QuadWires, LeaveOutTheDiagonalsOfLevelSteepAndUprightCells) {
  const auto count = [](const std::vector<std::uint8_t>& wires) {
    int kept = 0;
    for (const std::uint8_t mask : wires) kept += __builtin_popcount(mask);
    return kept;
  };
  const int all = 2 * 8 * 8 * 3, diagonals = 2 * 8 * 8;
  EXPECT_EQ(count(quad_wires(level(0, 8))), all - diagonals);
  const TriangleMesh steep = ground(8, 100, [](float x, float z) { return 9 * x - 7 * z; });
  EXPECT_EQ(count(quad_wires(steep)), all - diagonals);
  TriangleMesh wall = level(0, 8);
  for (glm::vec3& at : wall.positions) at = {at.x, at.z, 3};
  EXPECT_EQ(count(quad_wires(wall)), all - diagonals);
  // A single triangle has no diagonal.
  TriangleMesh single;
  single.positions = {{0, 0, 0}, {1, 0, 1}, {1, 0, 0}};
  single.indices = {0, 1, 2};
  EXPECT_EQ(quad_wires(single), std::vector<std::uint8_t>{7});
}

}  // namespace
}  // namespace terrabench
