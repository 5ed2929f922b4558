// Frames whose arrays grow and shrink look in a renderer that has drawn all before as in a new one, in every
// kind of context. On a GPU this also shows whether the driver keeps the order of writes.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "lod/lod.h"
#include "renderers/frame_renderer.h"
#include "terrain/frame.h"
#include "terrain/view.h"
#include "tests/renderers/virtual_display.h"
#include "tests/terrain/errors.h"
#include "tests/terrain/ground.h"

namespace terrabench {
namespace {

class GrowingFrames : public ::testing::TestWithParam<std::string> {
 protected:
  GrowingFrames() {
    if (GetParam() == "glfw") start_virtual_display();
    context_ = open_context(GetParam(), 16, 16);
    view_.eye = {16, 40, 50};
    view_.target = {16, 0, 14};
    view_.width = 160;
    view_.height = 120;
    style_.lowest = -3;
    style_.highest = 3;
  }

  void expect_same(FrameRenderer& kept, const Frame& frame, const View& view, int step) {
    kept.draw(frame, view, style_);
    const Image drawn = kept.image();
    FrameRenderer fresh(*context_);
    fresh.draw(frame, view, style_);
    ASSERT_EQ(drawn.rgb, fresh.image().rgb) << "step " << step;
    Frame again = frame;  // uploaded already
    again.uploads = {};
    ASSERT_EQ(kept.triangle_numbers(again, view), fresh.triangle_numbers(again, view)) << "step " << step;
  }

  std::unique_ptr<GlContext> context_;
  View view_;
  FrameStyle style_;
};

TEST_P(GrowingFrames, LookAsInANewRenderer) {
  constexpr std::uint32_t kSide = 33;
  Heightfield field = test::waves(kSide, kSide, 2, 2, 3);
  std::vector<std::uint32_t> all;  // of full detail
  for (std::uint32_t j = 0; j + 1 < kSide; ++j) {
    for (std::uint32_t i = 0; i + 1 < kSide; ++i) {
      const std::uint32_t a = j * kSide + i, b = a + kSide;
      all.insert(all.end(), {a, b, a + 1, a + 1, b, b + 1});
    }
  }
  FrameRenderer kept(*context_);
  std::mt19937 random(7);
  std::vector<std::uint32_t> indices;
  int step = 0;
  for (const std::size_t count : {2, 5, 9, 20, 44, 90, 180, 340, 600, 1100, 1900, 700, 30, 1, 800, 2048}) {
    const std::size_t before = std::min(indices.size(), 3 * count);
    indices.resize(3 * count);
    std::vector<DirtyRange> uploads;
    const auto change = [&](std::size_t first, std::size_t end) {
      for (std::size_t k = first; k < end; k += 3) {
        std::copy_n(&all[3 * (random() % (all.size() / 3))], 3, &indices[k]);
      }
      uploads.push_back(
          {.first = static_cast<std::uint32_t>(first), .count = static_cast<std::uint32_t>(end - first)});
    };
    change(0, before / 6 * 3);
    change(before, indices.size());
    const std::uint32_t height = random() % (kSide * kSide);
    field.heights[height] += 1;
    uploads.push_back({.target = DirtyRange::Target::kHeights, .first = height, .count = 1});
    std::vector<Batch> batches;
    for (std::uint32_t first = 0; first < indices.size(); first += 60) {
      batches.push_back({first, std::min(60U, static_cast<std::uint32_t>(indices.size()) - first)});
    }
    Frame frame{.grid = {kSide, kSide, 1, 1, field.heights}};
    frame.indices = indices;
    frame.batches = batches;
    frame.uploads = uploads;
    expect_same(kept, frame, view_, step++);
  }
  EXPECT_GT(kept.bytes_resent(), 0U);
}

// Builds for tests read the arrays back: what a frame forgot to name looks like a driver's fault.
TEST_P(GrowingFrames, NameBothReasonsForOtherArrays) {
#ifdef NDEBUG
  GTEST_SKIP() << "release builds read nothing back";
#endif
  Heightfield field = test::flat(5, 5);
  const std::vector<std::uint32_t> indices{0, 5, 1};
  const std::vector<Batch> batches{{0, 3}};
  Frame frame{.grid = {5, 5, 1, 1, field.heights}};
  frame.indices = indices;
  frame.batches = batches;
  FrameRenderer kept(*context_);
  kept.draw(frame, view_, style_);
  field.heights[1] += 1;  // and no range in frame.uploads
  const Failure failure = failure_of([&] { kept.draw(frame, view_, style_); });
  EXPECT_NE(failure.advice.find("Frame::uploads"), std::string::npos) << failure.advice;
  EXPECT_NE(failure.advice.find("driver"), std::string::npos) << failure.advice;
}

// Each method between its coarsest and its finest knob, there and back.
TEST_P(GrowingFrames, OfEachMethodLookAsInANewRenderer) {
  const Heightfield field = test::waves(100, 80, 12, 2, 3);
  Progress silent;
  style_.lowest = -20;
  style_.highest = 20;
  for (const LodType& type : lods()) {
    const std::unique_ptr<Lod> lod = type.build(field, Parameters(type.parameters), silent);
    FrameRenderer kept(*context_);
    for (int step = 0; step < 9; ++step) {
      if (step % 3 == 0) lod->tune(step == 3 ? type.knob.finest : type.knob.coarsest);
      View view = view_;
      view.eye = {20.0F + 4.0F * static_cast<float>(step), 30, 60};
      view.target = {50, 0, 20};
      SCOPED_TRACE(type.name);
      expect_same(kept, lod->update(view), view, step);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryContext, GrowingFrames, ::testing::Values("osmesa", "egl", "glfw"),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace terrabench
