// Concurrent binary trees on the GPU against those on the processor, in every kind of context: the same bits
// and sums after every frame.
#include "renderers/cbt/gpu_cbt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <string>
#include <vector>

#include "lod/camera/camera_path.h"
#include "lod/cbt/cbt.h"
#include "terrain/metrics/image_error.h"
#include "tests/renderers/virtual_display.h"
#include "tests/terrain/errors.h"
#include "tests/terrain/ground.h"

namespace terrabench {
namespace {

// Every `every`-th view of each path: the eye jumps from each to the next.
std::vector<View> some_views(const Heightfield& field, std::size_t every) {
  std::vector<View> some;
  for (const CameraPath& path : camera_paths()) {
    const std::vector<View> all = views(path, field);
    for (std::size_t k = 0; k < all.size(); k += every) some.push_back(all[k]);
  }
  return some;
}

class GpuCbtTest : public ::testing::TestWithParam<std::string> {
 protected:
  GpuCbtTest() {
    if (GetParam() == "glfw") start_virtual_display();
    context_ = open_context(GetParam(), 16, 16);
  }

  // Triangles that only one of the two has split. Each is a bit of the finest level, the last quarter.
  static std::size_t splits_differing(const Cbt& processor, const GpuCbt& gpu) {
    const std::span<const std::uint64_t> a = processor.tree().words();
    const std::vector<std::uint64_t> b = gpu.tree();
    EXPECT_EQ(a.size(), b.size());
    std::size_t differing = 0;
    for (std::size_t k = 3 * a.size() / 4; k < a.size(); ++k) {
      differing += static_cast<std::size_t>(std::popcount(a[k] ^ b[k]));
    }
    EXPECT_EQ(differing == 0, std::ranges::equal(a, b)) << "sums";
    return differing;
  }
  // See the header: a GPU may round otherwise.
  std::size_t allowed(const Cbt& processor) const {
    return context_->software() ? 0 : processor.tree().leaves() / 1000;
  }

  std::unique_ptr<GlContext> context_;
  Progress silent_;
};

TEST_P(GpuCbtTest, HasTheProcessorsLeavesInEveryFrame) {
  for (const auto& [width, depth] :
       {std::pair{202, 173}, {129, 129}, {100, 37}, {65, 260}, {3, 40}, {2, 2}}) {
    SCOPED_TRACE(width);
    const Heightfield field = test::hilly(width, depth, 0.7F, 1, 5, 5);
    Cbt processor(field, {.passes = 1}, silent_);
    GpuCbt gpu(*context_, processor.split_ground());
    ASSERT_EQ(splits_differing(processor, gpu), 0U);
    std::size_t changes = 0, most_leaves = 0;
    for (const double pixels : {2.0, 0.3}) {
      processor.tune(pixels);
      for (const View& view : some_views(field, 90)) {
        for (int frame = 0; frame < 3; ++frame) {  // the last jump is not caught up with when the next comes
          changes += processor.update(view).stats.changes;
          gpu.update(processor.split_rule(view));
          ASSERT_LE(splits_differing(processor, gpu), allowed(processor));
        }
        most_leaves = std::max(most_leaves, processor.tree().leaves());
      }
    }
    EXPECT_GE(changes + 1, most_leaves / 2);  // 2 × 2 samples: no change
  }
}

TEST_P(GpuCbtTest, GoesOnFromTheProcessorsTreeByALevelPerFrame) {
  const Heightfield field = test::hilly(202, 173, 0.7F, 1, 5, 5);
  const std::vector<View> views = some_views(field, 100);
  Cbt processor(field, {}, silent_);
  processor.update(views.front());
  GpuCbt gpu(*context_, processor.split_ground());
  EXPECT_EQ(gpu.tree_bytes(), std::size_t{1} << (processor.tree().depth() - 1));
  for (const bool jumps : {false, true}) {
    const View& view = jumps ? views.back() : views.front();
    processor.update(view);  // passes until nothing changes
    int behind = 0;
    for (int frame = 1; frame <= 40; ++frame) {
      if (splits_differing(processor, gpu) > allowed(processor)) behind = frame;
      gpu.update(processor.split_rule(view));
    }
    EXPECT_EQ(behind > 4, jumps);
    EXPECT_LT(behind, 40);
  }
}

TEST_P(GpuCbtTest, DrawsThePictureOfTheProcessorsFrame) {
  const Heightfield field = test::hilly(202, 173, 0.7F, 1, 5, 5);
  Cbt processor(field, {.passes = 1}, silent_);
  GpuCbt gpu(*context_, processor.split_ground());
  FrameRenderer renderer(*context_);
  const FrameStyle style{.lowest = -20, .highest = 20, .wire_width = 1};
  for (const View& view : some_views(field, 100)) {
    renderer.draw(processor.update(view), view, style);
    const Image of_processor = renderer.image();
    gpu.update(processor.split_rule(view));
    gpu.draw(view, style);
    const Image of_gpu = renderer.image();
    EXPECT_GE(ssim(of_processor, of_gpu), 0.99);
    if (context_->software()) {
      EXPECT_TRUE(of_processor.rgb == of_gpu.rgb);
    }
  }
}

TEST_P(GpuCbtTest, SaysWhatHasNoRoom) {
  const Heightfield field = test::flat(3, 3);
  const Cbt processor(field, {}, silent_);
  SplitGround ground = processor.split_ground();
  const auto refused = [&] { return failure_of([&] { GpuCbt(*context_, ground); }); };
  ground.depth = 31;
  EXPECT_EQ(refused().code, ExitCode::kEnvironment);
  EXPECT_NE(refused().what.find("31 levels"), std::string::npos) << refused().what;
  ground.depth = processor.tree().depth();
  // Never read: the size alone is refused.
  ground.tree = {ground.tree.data(), (std::size_t{1} << 40) / sizeof(std::uint64_t)};
  EXPECT_EQ(refused().code, ExitCode::kEnvironment);
  EXPECT_NE(refused().what.find("the bits of cbt take 1048576 MiB"), std::string::npos) << refused().what;
}

INSTANTIATE_TEST_SUITE_P(EveryContext, GpuCbtTest, ::testing::Values("osmesa", "egl", "glfw"),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace terrabench
