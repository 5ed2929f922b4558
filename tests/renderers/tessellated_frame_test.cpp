// What the GPU's tessellator draws is what the frame's batches draw: the triangles of PatchTriangles.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "renderers/frame_renderer.h"
#include "tests/lod/drawing.h"
#include "tests/lod/patch_frame.h"

namespace terrabench::test {
namespace {

// The share of pixels with another colour. Triangles may start at another corner, which rounds differently.
double differing(const Image& a, const Image& b) {
  std::size_t pixels = 0;
  for (std::size_t k = 0; k < a.rgb.size(); k += 3) {
    int most = 0;
    for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(a.rgb[k + c] - b.rgb[k + c]));
    pixels += most > 2 ? 1 : 0;
  }
  return static_cast<double>(pixels) / (static_cast<double>(a.rgb.size()) / 3);
}

class TessellatedFrame : public ::testing::TestWithParam<int> {
 protected:
  Image picture(const Frame& frame, const View& view) {
    FrameRenderer renderer(*context_);
    FrameStyle style;
    style.lowest = -5;
    style.highest = 25;
    renderer.draw(frame, view, style);
    return renderer.image();
  }
  std::unique_ptr<GlContext> context_ = open_context("osmesa", 16, 16);
};

View above(const Heightfield& field) {
  View view = from_above(field);
  view.width = view.height = 700;
  view.vertical_fov = 2 * std::atan(0.5F * field.extent_z() / view.eye.y);
  return view;
}

// On ground so rough that another diagonal has another colour.
TEST_P(TessellatedFrame, HasTheTrianglesOfItsBatches) {
  const int side = GetParam(), logs = std::bit_width(static_cast<unsigned>(side)) - 1;
  const Heightfield field = random_ground(5 * side + 1 + side / 3, 5 * side + 1, 3, 0, 20);
  const View view = above(field);
  std::mt19937 random(7);
  for (int round = 0; round < 6; ++round) {
    const PatchFrame patches(field, side, [&](int, int) { return random_factors(random, logs); });
    const Frame frame = patches.frame();
    const Image divided = picture(frame, view);
    EXPECT_LT(differing(divided, picture(untessellated(frame), view)), 2e-4) << round;
    const PatchFrame others(field, side, [&](int, int) { return random_factors(random, logs); });
    EXPECT_GT(differing(divided, picture(others.frame(), view)), 0.1);
  }
}

INSTANTIATE_TEST_SUITE_P(Sides, TessellatedFrame, ::testing::Values(4, 8, 16, 32, 64));

// From the north-west, as for any ground: winding and positions, not the pattern alone.
TEST_F(TessellatedFrame, LooksTheSameFromTheSide) {
  const Heightfield field = hilly(130, 97, 0.5F);
  View view;
  view.eye = {-20, 60, -20};
  view.target = {60, 0, 50};
  view.width = 500;
  view.height = 300;
  std::mt19937 random(3);
  const PatchFrame patches(field, 32, [&](int, int) { return random_factors(random, 5); });
  const Image divided = picture(patches.frame(), view);
  EXPECT_LT(differing(divided, picture(untessellated(patches.frame()), view)), 1e-3);
}

}  // namespace
}  // namespace terrabench::test
