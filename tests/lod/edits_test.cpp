// After an edit of the ground, every method draws what one draws that is built on the edited ground, and its
// uploads tell all that changed.
#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "lod/clipmap/clipmap.h"
#include "lod/meters/cracks.h"
#include "lod/meters/triangle_set.h"
#include "lod/mrbsp/mrbsp.h"
#include "terrain/error.h"
#include "terrain/memory.h"
#include "tests/lod/drawing.h"
#include "tests/lod/variants.h"

namespace terrabench::test {
namespace {

// A dome or a pit with a ragged edge.
void edit(Heightfield& field, const SampleRect& rect, float by) {
  for (int j = rect.low.y; j <= rect.high.y; ++j) {
    for (int i = rect.low.x; i <= rect.high.x; ++i)
      field.at(i, j) += by + 0.3F * static_cast<float>((i * 7 + j * 3) % 5);
  }
}

// What a renderer holds that follows the uploads alone.
class Uploaded {
 public:
  void take(const Frame& frame) {
    grid_.resize(frame.grid.heights.size());
    levels_.resize(frame.clip_levels.size());
    for (std::size_t l = 0; l < levels_.size(); ++l) levels_[l].resize(frame.clip_levels[l].heights.size());
    for (const DirtyRange& range : frame.uploads) {
      if (range.target == DirtyRange::Target::kHeights) {
        for (std::uint32_t k = range.first; k < range.first + range.count; ++k)
          grid_[k] = frame.grid.heights[k];
      } else if (range.target == DirtyRange::Target::kClipLevel) {
        const ClipLevel& level = frame.clip_levels[range.level];
        for (int z = range.z; z < range.z + range.depth; ++z) {
          for (int x = range.x; x < range.x + range.width; ++x) {
            const std::size_t k = static_cast<std::size_t>(z) * level.side + x;
            levels_[range.level][k] = level.heights[k];
          }
        }
      }
    }
  }
  bool holds_all_of(const Frame& frame) {
    bool all = std::equal(grid_.begin(), grid_.end(), frame.grid.heights.begin(), frame.grid.heights.end());
    for (std::size_t l = 0; l < levels_.size(); ++l) {
      const std::span<const float> heights = frame.clip_levels[l].heights;
      all = all && std::equal(heights.begin(), heights.end(), levels_[l].begin(), levels_[l].end());
    }
    for (const FrameMesh& mesh : frame.meshes) {
      const auto [known, added] = meshes_.try_emplace(mesh.id, mesh.positions.begin(), mesh.positions.end());
      all = all && std::equal(mesh.positions.begin(), mesh.positions.end(), known->second.begin(),
                              known->second.end());
    }
    return all;
  }

 private:
  std::vector<float> grid_;
  std::vector<std::vector<float>> levels_;
  std::map<std::uint64_t, std::vector<glm::vec3>> meshes_;  // by id
};

class EditedMethod : public ::testing::TestWithParam<Variant> {
 protected:
  std::unique_ptr<Lod> build() { return test::build(GetParam(), field_, silent()); }
  void change(Lod& lod, const SampleRect& rect, float by) {
    (void)lod.memory();  // waits for threads that read the ground
    edit(field_, rect, by);
    lod.edited(rect);
  }
  Heightfield field_ = hilly(202, 173, 0.7F, 1, 5, 5);
  const std::vector<View> path_ = path_over(field_, 60);
};

constexpr SampleRect kInside{{60, 70}, {123, 120}}, kPoint{{101, 86}, {101, 86}},
    kCorner{{170, 140}, {201, 172}}, kStrip{{0, 31}, {201, 33}};

TEST_P(EditedMethod, DrawsWhatOneBuiltOnTheEditedGroundDraws) {
  const std::unique_ptr<Lod> lod = build();
  for (const View& view : path_) lod->update(view);
  for (const auto& [rect, by] : {std::pair(kInside, 12.0F), std::pair(kPoint, -20.0F),
                                 std::pair(kCorner, 5.0F), std::pair(kStrip, -3.0F)}) {
    change(*lod, rect, by);
    const std::unique_ptr<Lod> fresh = build();
    std::size_t differing = 0;
    for (const View& view : path_)
      differing += TriangleSet(lod->update(view)) == TriangleSet(fresh->update(view)) ? 0 : 1;
    ASSERT_EQ(differing, 0U) << "after the edit by " << by;
  }
}

TEST_P(EditedMethod, TakesSeveralEditsAtOnceAndSomeBeforeTheFirstFrame) {
  const std::unique_ptr<Lod> lod = build();
  change(*lod, kInside, 9);
  lod->update(path_.front());
  change(*lod, kCorner, 4);
  change(*lod, kPoint, 30);
  const std::unique_ptr<Lod> fresh = build();
  for (const View& view : path_) ASSERT_EQ(TriangleSet(lod->update(view)), TriangleSet(fresh->update(view)));
}

// From high up, level: only the raised part is in view, and only if it is culled by its new height.
TEST_P(EditedMethod, CullsByTheNewHeights) {
  View view;
  view.eye = {0, 400, 0};
  view.target = {0.5F * field_.extent_x(), 400, 0.5F * field_.extent_z()};
  view.vertical_fov = 0.5F;
  const std::unique_ptr<Lod> lod = build();
  const std::size_t before = lod->update(view).stats.triangles;
  change(*lod, kInside, 400);
  const std::unique_ptr<Lod> fresh = build();
  const Frame& frame = lod->update(view);
  EXPECT_EQ(TriangleSet(frame), TriangleSet(fresh->update(view)));
  EXPECT_GT(frame.stats.triangles, before);
}

TEST_P(EditedMethod, UploadsAllThatChanged) {
  const std::unique_ptr<Lod> lod = build();
  Uploaded uploaded;
  for (std::size_t k = 0; k < path_.size(); ++k) {
    if (k == 2) change(*lod, kInside, 7);
    if (k == 4) change(*lod, kCorner, -4);
    const Frame& frame = lod->update(path_[k]);
    uploaded.take(frame);
    ASSERT_TRUE(uploaded.holds_all_of(frame)) << k;
    std::size_t bytes = 0;
    for (const DirtyRange& range : frame.uploads) bytes += range.bytes();
    EXPECT_EQ(frame.stats.bytes_uploaded, bytes);
  }
}

TEST_P(EditedMethod, CountsItsHeapBytes) {
  build();  // creates the thread pool, which stays
  const HeapScope heap;
  const std::unique_ptr<Lod> lod = build();
  const auto expect_counted = [&](const char* when) {
    const auto counted = static_cast<std::int64_t>(lod->memory().total());  // first: waits for other threads
    EXPECT_EQ(heap.held(), counted) << when;
  };
  expect_counted("built");
  for (const View& view : path_) lod->update(view);
  expect_counted("used");
  change(*lod, kInside, 3);
  change(*lod, kStrip, 1);
  lod->update(path_.back());
  expect_counted("edited");
}

TEST_P(EditedMethod, RefusesSamplesThatAreNotOnTheGround) {
  const std::unique_ptr<Lod> lod = build();
  for (const SampleRect& bad : {SampleRect{{-1, 0}, {3, 3}}, SampleRect{{0, 0}, {202, 3}},
                                SampleRect{{5, 5}, {4, 6}}, SampleRect{{0, 0}, {3, 173}}})
    EXPECT_THROW(lod->edited(bad), Error);
}

INSTANTIATE_TEST_SUITE_P(Registry, EditedMethod, ::testing::ValuesIn(variants()), name_of);

// Beyond the ground's border, too.
TEST(EditedClipmap, WindowsHoldWhatFreshOnesHold) {
  Heightfield field = hilly(202, 173, 0.7F, 1, 5, 5);
  Clipmap lod(heights_in_memory(field), 63);
  View view = from_above(field);
  view.eye = {3, 30, 4};
  view.target = {60, 0, 60};
  view.up = {0, 1, 0};
  lod.update(view);
  const SampleRect rect{{0, 0}, {20, 9}};
  edit(field, rect, 6);
  lod.edited(rect);
  Clipmap fresh(heights_in_memory(field), 63);
  EXPECT_EQ(windows_of(lod.update(view), lod.window()), windows_of(fresh.update(view), fresh.window()));
}

// Where all of the ground matters, everything is computed anew.
TEST(EditedMrbsp, FindsInterpolatedHeightsAndHiddenTrianglesAnew) {
  for (const bool nearest : {true, false}) {
    Heightfield field = hilly(65, 65, 0.7F, 1, 5, 5);
    MrbspOptions options{.three_nearest = nearest, .visibility = !nearest};
    options.visible.cells = 4;
    Mrbsp lod(field, options, silent());
    const std::vector<View> path = path_over(field, 60);
    for (const View& view : path) lod.update(view);
    const SampleRect rect{{20, 20}, {40, 40}};
    edit(field, rect, 25);
    lod.edited(rect);
    Mrbsp fresh(field, options, silent());
    for (const View& view : path) ASSERT_EQ(TriangleSet(lod.update(view)), TriangleSet(fresh.update(view)));
  }
}

}  // namespace
}  // namespace terrabench::test
