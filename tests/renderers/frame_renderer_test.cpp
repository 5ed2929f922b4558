// The GPU draws the triangles of triangles(Frame), and dirty ranges contain every change.
#include "renderers/frame_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <random>

#include "lod/clipmap/clipmap.h"
#include "lod/clipmap/height_source.h"
#include "lod/lod.h"
#include "terrain/metrics/image_error.h"
#include "tests/lod/drawing.h"
#include "tests/lod/variants.h"
#include "tests/terrain/ground.h"

namespace terrabench {
namespace {

View walk(const Heightfield& field, float t) {
  View view;
  view.eye = {field.extent_x() * (0.2F + 0.5F * t), 40, field.extent_z() * 0.6F};
  view.target = {field.extent_x() * 0.5F, 0, field.extent_z() * (0.3F * t)};
  view.width = 160;
  view.height = 120;
  view.near = 1;
  view.far = 2000;
  return view;
}

// The first triangle on the ray through the point (x, y) of the screen, counted from 1. Brute force.
std::uint32_t nearest_triangle(const std::vector<glm::vec3>& corners, const glm::mat4& to_clip, float x,
                               float y) {
  std::uint32_t nearest = 0;
  float least = 2;
  for (std::size_t k = 0; k < corners.size(); k += 3) {
    glm::vec4 p[3];
    bool behind = false;
    for (int c = 0; c < 3; ++c) {
      p[c] = to_clip * glm::vec4(corners[k + c], 1);
      behind = behind || p[c].w <= 0;
    }
    if (behind) continue;
    const glm::vec2 a = glm::vec2(p[0]) / p[0].w, b = glm::vec2(p[1]) / p[1].w, c = glm::vec2(p[2]) / p[2].w;
    const auto cross = [](glm::vec2 u, glm::vec2 v) { return u.x * v.y - u.y * v.x; };
    const float area = cross(b - a, c - a);
    const glm::vec2 at(x, y);
    const float wa = cross(b - at, c - at) / area, wb = cross(c - at, a - at) / area, wc = 1 - wa - wb;
    if (!(wa >= 0 && wb >= 0 && wc >= 0)) continue;
    const float depth = wa * p[0].z / p[0].w + wb * p[1].z / p[1].w + wc * p[2].z / p[2].w;
    if (depth < least && depth >= -1) {
      least = depth;
      nearest = static_cast<std::uint32_t>(k / 3 + 1);
    }
  }
  return nearest;
}

std::size_t bytes_named(const Frame& frame, const ClipLevel& level) {
  std::size_t bytes = 0;
  for (const DirtyRange& range : frame.uploads) {
    const bool of_level =
        range.target == DirtyRange::Target::kClipLevel && &frame.clip_levels[range.level] == &level;
    if (of_level) bytes += range.bytes();
  }
  return bytes;
}

FrameStyle style_of_waves() {
  FrameStyle style;
  style.lowest = -20;
  style.highest = 20;
  return style;
}

class FrameRendererTest : public ::testing::TestWithParam<test::Variant> {
 protected:
  std::unique_ptr<Lod> build() { return test::build(GetParam(), field_, silent_); }
  std::unique_ptr<GlContext> context_ = open_context("osmesa", 16, 16);
  Heightfield field_ = test::waves(150, 120, 20, 2, 3);
  Progress silent_;
  FrameStyle style_ = style_of_waves();
};

// Compares random pixels.
void expect_shown(FrameRenderer& renderer, const Frame& frame, const View& view, std::mt19937& random) {
  const std::vector<glm::vec3> corners = test::corners_of(frame);
  const std::vector<std::uint32_t> shown = renderer.triangle_numbers(frame, view);
  const glm::mat4 to_clip = world_to_clip(view);
  int agree = 0, asked = 0;
  for (int k = 0; k < 300; ++k) {
    const int x = static_cast<int>(random() % 160), y = static_cast<int>(random() % 120);
    const std::uint32_t expected = nearest_triangle(corners, to_clip, (static_cast<float>(x) + 0.5F) / 80 - 1,
                                                    1 - (static_cast<float>(y) + 0.5F) / 60);
    ++asked;
    agree += shown[static_cast<std::size_t>(y) * 160 + x] == expected ? 1 : 0;
  }
  // A pixel centre on an edge may belong to either side.
  EXPECT_GE(agree, asked * 98 / 100);
}

TEST_P(FrameRendererTest, ShowsTheTrianglesOfTheFrame) {
  const std::unique_ptr<Lod> lod = build();
  FrameRenderer renderer(*context_);
  std::mt19937 random(2);
  for (const float t : {0.1F, 0.7F}) {
    const View view = walk(field_, t);
    expect_shown(renderer, lod->update(view), view, random);
  }
}

// So far from sample 0 that metres from there in a float could not distinguish samples; and with levels that
// are added when the far plane moves away.
TEST(EndlessFrames, ShowTheirTrianglesFarFromSample0) {
  const std::unique_ptr<GlContext> context = open_context("osmesa", 16, 16);
  FrameRenderer renderer(*context);
  Clipmap lod(endless_heights({.cell = 2, .relief = 100, .cell_bits = 5, .octaves = 4}), 31);
  lod.move_origin({1 << 28, -(1 << 27)});
  std::mt19937 random(4);
  for (const float t : {0.0F, 30.0F, 300.0F}) {
    View view;
    view.width = 160;
    view.height = 120;
    view.eye = {t, 60, -2 * t};
    view.target = view.eye + glm::vec3(1, -0.4F, 0.5F);
    view.far = 400 + 4 * t;
    expect_shown(renderer, lod.update(view), view, random);
  }
}

// Halfway the knob is set to the finest value, so that buffers must grow.
TEST_P(FrameRendererTest, SendsTheBytesThatTheFrameSaysAndTheyAreEnough) {
  const Knob& knob = lod(GetParam().method).knob;
  const std::unique_ptr<Lod> lod = build();
  lod->tune(knob.coarsest);
  FrameRenderer renderer(*context_);
  std::size_t before = 0;
  for (int step = 0; step <= 8; ++step) {
    if (step == 4) lod->tune(knob.finest);
    const View view = walk(field_, static_cast<float>(step) / 10);
    const Frame& frame = lod->update(view);
    const std::size_t per_batch =
        frame.patches.empty() ? kBytesPerBatch * frame.batches.size() : kBytesPerPatch * frame.patches.size();
    EXPECT_EQ(frame.stats.bytes_commands,
              per_batch + kBytesPerClipLevel * (frame.clip_levels.size() + frame.morph_ranges.size()));
    renderer.upload(frame);
    renderer.draw_uploaded(view, style_);
    // The first frame is sent whole; a clipmap's arrays are one row and one column larger than the windows,
    // the only part that its dirty ranges contain.
    std::size_t expected = frame.stats.bytes_sent();
    for (const ClipLevel& level : frame.clip_levels) {
      if (step == 0) expected += level.heights.size_bytes() - bytes_named(frame, level);
    }
    EXPECT_EQ(renderer.bytes_uploaded() - renderer.bytes_resent() - before, expected) << step;
    before = renderer.bytes_uploaded() - renderer.bytes_resent();
    FrameRenderer fresh(*context_);
    const Image kept = renderer.image();
    fresh.draw(frame, view, style_);
    ASSERT_EQ(kept.rgb, fresh.image().rgb) << step;
  }
}

TEST_P(FrameRendererTest, DrawsWires) {
  const std::unique_ptr<Lod> lod = build();
  FrameRenderer renderer(*context_);
  const View view = walk(field_, 0.4F);
  const Frame& frame = lod->update(view);
  renderer.draw(frame, view, style_);
  const Image plain = renderer.image();
  style_.wire_width = 1;
  renderer.draw(frame, view, style_);
  const Image wired = renderer.image();
  std::size_t darker = 0;
  for (std::size_t k = 0; k < plain.rgb.size(); k += 3) darker += wired.rgb[k] + 20 < plain.rgb[k];
  EXPECT_GT(darker, plain.rgb.size() / 3 / 50);
}

TEST_P(FrameRendererTest, ShowsWhatFullDetailShowsWhereTheKnobIsFinest) {
  const std::unique_ptr<Lod> finest = build();
  finest->tune(lod(GetParam().method).knob.finest);
  const std::unique_ptr<Lod> full = lod("brute_force").build(field_, {}, silent_);
  FrameRenderer renderer(*context_), reference(*context_);
  for (const float t : {0.0F, 0.5F, 1.0F}) {
    View view = walk(field_, t);
    view.width = 320;
    view.height = 240;
    renderer.draw(finest->update(view), view, style_);
    const Image image = renderer.image();
    reference.draw(full->update(view), view, style_);
    EXPECT_GT(ssim(image, reference.image()), 0.9) << t;
    EXPECT_GT(psnr(image, reference.image()), 30) << t;
  }
}

// Along ridges, where the slope behind has the same depth, no pixel has the colour of the underside.
TEST_P(FrameRendererTest, RidgesHideTheSlopeBehind) {
  Heightfield steep = field_;
  std::mt19937 random(5);
  for (float& height : steep.heights) height += static_cast<float>(random() % 400) * 0.01F;
  const std::unique_ptr<Lod> lod = test::build(GetParam(), steep, silent_);
  FrameRenderer renderer(*context_);
  style_.lowest = -1000;  // one colour for all heights
  style_.highest = -999;
  style_.sun = {0, 1, 0};
  View view = walk(steep, 0.3F);
  view.width = 640;
  view.height = 480;
  renderer.draw(lod->update(view), view, style_);
  const Image image = renderer.image();
  // The underside is grey, the lowest and highest colours are not.
  std::size_t grey = 0;
  for (std::size_t k = 0; k < image.rgb.size(); k += 3) {
    const auto [low, high] = std::minmax({image.rgb[k], image.rgb[k + 1], image.rgb[k + 2]});
    grey += high < 200 && high - low < 8;
  }
  EXPECT_EQ(grey, 0U);
}

// The picture equals that of a ground whose heights were morphed beforehand, and differs from that of the
// ground itself.
void expect_morphed(const test::Variant& variant, double knob) {
  const std::unique_ptr<GlContext> context = open_context("osmesa", 16, 16);
  const Heightfield field = test::waves(150, 120, 20, 2, 3);
  Progress silent;
  const std::unique_ptr<Lod> lod = test::build(variant, field, silent);
  lod->tune(knob);
  const FrameStyle style = style_of_waves();
  for (const float t : {0.0F, 0.3F, 0.8F}) {
    const View view = walk(field, t);
    Frame frame = lod->update(view);
    std::vector<Batch> batches(frame.batches.begin(), frame.batches.end());
    if (!frame.morph_ranges.empty()) {  // no vertex in the place of another
      for (Batch& batch : batches) batch.morph = 0;
    }
    frame.batches = batches;
    const auto picture = [&] {
      FrameRenderer renderer(*context);
      renderer.draw(frame, view, style);
      return renderer.image().rgb;
    };
    const auto moving = picture();
    std::vector<float> moved = field.heights;
    for (const Batch& batch : frame.batches) {
      for (std::uint32_t k = 0; k < batch.index_count; ++k) {
        const std::uint32_t vertex = batch.base_vertex + frame.indices[batch.first_index + k];
        moved[vertex] = vertex_position(frame, batch, vertex).y;
      }
    }
    frame.morphs = {};
    frame.morph_ranges = {};
    frame.patch_side = 0;
    EXPECT_NE(moving, picture());
    frame.grid.heights = moved;
    EXPECT_EQ(moving, picture());
  }
}

TEST(FrameRenderer, MorphsVerticesOfPatches) { expect_morphed({"geomipmap", "morph", true}, 20); }
TEST(FrameRenderer, MorphsVerticesOfNodes) { expect_morphed({"cdlod"}, 20); }

// Seen from above: the whole field is in view, and level ground in the sun has its colour as it is.
struct FlatGround {
  std::unique_ptr<GlContext> context = open_context("osmesa", 16, 16);
  Heightfield field = test::flat(33, 33);
  Progress silent;
  std::unique_ptr<Lod> lod = test::build({"brute_force"}, field, silent);
  FrameRenderer renderer{*context};
  Image draw(const FrameStyle& style) {
    View view = test::from_above(field);
    view.width = view.height = 100;
    view.vertical_fov = 2 * std::atan(0.5F * field.extent_x() / view.eye.y);
    renderer.draw(lod->update(view), view, style);
    return renderer.image();
  }
};

void expect_near(const Rgb& a, const Rgb& b) {
  for (std::size_t c = 0; c < a.size(); ++c) EXPECT_NEAR(a[c], b[c], 1) << c;
}

TEST(FrameRenderer, PaintLiesOverTheSamples) {
  FlatGround ground;
  Image paint(33, 33, {200, 40, 30});
  for (int j = 0; j < 33; ++j) {
    for (int i = 17; i < 33; ++i) paint.set(i, j, {20, 60, 180});
  }
  for (int i = 0; i < 66; ++i) paint.set(i % 33, i / 33, {240, 240, 20});
  EXPECT_NE(ground.draw({.colours = GroundColours::kPaint}).pixel(20, 50), (Rgb{200, 40, 30}));  // none yet
  ground.renderer.paint(paint, {ground.field.extent_x(), ground.field.extent_z()});
  const Image picture = ground.draw({.colours = GroundColours::kPaint});
  expect_near(picture.pixel(20, 50), {200, 40, 30});
  expect_near(picture.pixel(80, 50), {20, 60, 180});
  expect_near(picture.pixel(80, 1), {240, 240, 20});  // the north at the top
}

TEST(FrameRenderer, TrianglesHaveTheColoursOfTheirSizes) {
  FlatGround ground;
  expect_near(ground.draw({.colours = GroundColours::kTriangleSize}).pixel(50, 50),
              triangle_size_colours()[0]);
  // Two triangles of 32 cells.
  ground.lod = test::build({"roam"}, ground.field, ground.silent);
  FrameRenderer renderer(*ground.context);
  View view = test::from_above(ground.field);
  view.width = view.height = 100;
  view.vertical_fov = 2 * std::atan(0.5F * ground.field.extent_x() / view.eye.y);
  const Frame& frame = ground.lod->update(view);
  ASSERT_EQ(frame.stats.triangles, 2U);
  renderer.draw(frame, view, {.colours = GroundColours::kTriangleSize});
  expect_near(renderer.image().pixel(50, 60), triangle_size_colours()[5]);
}

// The shader for ground without wires leaves out what wires need, and nothing else.
TEST(FrameRenderer, WiresOfNoInkChangeNothing) {
  const Heightfield field = test::waves(150, 120, 20, 2, 3);
  const auto context = open_context("osmesa", 16, 16);
  Progress silent;
  const std::unique_ptr<Lod> lod = test::build({"roam"}, field, silent);
  FrameRenderer renderer(*context);
  FrameStyle style = style_of_waves();
  const View view = walk(field, 0.4F);
  renderer.draw(lod->update(view), view, style);
  const Image plain = renderer.image();
  style.wire_width = 1;
  style.wire_opacity = 0;
  renderer.draw_uploaded(view, style);
  // Without wires another shader draws, whose light may be rounded otherwise.
  const Image without_ink = renderer.image();
  int most = 0;
  for (std::size_t k = 0; k < plain.rgb.size(); ++k)
    most = std::max(most, std::abs(static_cast<int>(without_ink.rgb[k]) - static_cast<int>(plain.rgb[k])));
  EXPECT_LE(most, 1);
  style.wire_opacity = 1;
  renderer.draw_uploaded(view, style);
  EXPECT_NE(renderer.image().rgb, plain.rgb);
}

INSTANTIATE_TEST_SUITE_P(EachMethod, FrameRendererTest, ::testing::ValuesIn(test::variants()), test::name_of);

}  // namespace
}  // namespace terrabench
