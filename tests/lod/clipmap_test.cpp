// The windows hold the ground's heights after any motion of the eye, cover the ground once, and meet without
// gaps.
#include "lod/clipmap/clipmap.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <map>
#include <random>

#include "lod/meters/screen_error.h"
#include "terrain/memory.h"
#include "tests/lod/hybrid_ground.h"

namespace terrabench {
namespace {

Heightfield rough(int width, int depth) {
  std::mt19937 random(7);
  return test::ground_of(
      width, depth, [&](int, int) { return static_cast<float>(random() % 1000) * 0.01F; }, 2, 3);
}

// So wide a view down that everything is in view, from low enough to draw the finest level.
View everything(const Heightfield& field, float x, float z, float above) {
  View view = test::everything_from(x, z);
  view.eye.y = 10 + above;
  view.vertical_fov = 3.14F;
  view.far = 100 * (field.extent_x() + field.extent_z()) + 10 * view.eye.y;
  return view;
}

// Every place once, by triangles whose edges meet to the bit but for those along the border.
void expect_closed(const Heightfield& field, const Frame& frame) {
  const double area = test::plan_area(field);
  EXPECT_NEAR(test::plan_area(frame), area, 1e-6 * area);
  EXPECT_EQ(test::openings_inside(field, frame), 0U);
}

TEST(ClipmapWindow, CoversItsCellsOnceWithoutOddVerticesAtTheBorder) {
  for (const int m : {2, 3, 4, 7, 16}) {
    const clipmap::WindowPattern window = clipmap::make_window_pattern(m);
    const auto twice_area = [&](const clipmap::Block& block) {
      int sum = 0;
      const IndexRange range = block.indices;
      for (std::uint32_t k = range.first_index; k < range.first_index + range.index_count; k += 3) {
        std::array<int, 3> a, b;
        for (int c = 0; c < 3; ++c) {
          a[c] = static_cast<int>(window.indices[k + c]) % window.side;
          b[c] = static_cast<int>(window.indices[k + c]) / window.side;
          EXPECT_TRUE((a[c] != 0 && a[c] != window.n - 1) || b[c] % 2 == 0);
          EXPECT_TRUE((b[c] != 0 && b[c] != window.n - 1) || a[c] % 2 == 0);
        }
        const int area = (b[1] - b[0]) * (a[2] - a[0]) - (a[1] - a[0]) * (b[2] - b[0]);
        EXPECT_GT(area, 0);
        sum += area;
      }
      return sum;
    };
    int whole = 0;
    for (const auto& block : window.ring) whole += twice_area(block);
    for (const auto& block : window.middle) whole += twice_area(block);
    EXPECT_EQ(whole, 2 * (window.n - 1) * (window.n - 1));
    ASSERT_EQ(window.trims.size(), 8U);
    for (std::size_t k = 0; k < 8; k += 2) {
      EXPECT_EQ(twice_area(window.trims[k]) + twice_area(window.trims[k + 1]),
                2 * (4 * m * m - (2 * m - 1) * (2 * m - 1)));
    }
  }
}

TEST(Clipmap, MeetsWithoutGapsWhereverTheEyeIs) {
  std::mt19937 random(3);
  for (const auto& [width, depth] : {std::pair{257, 257}, {300, 141}, {403, 344}, {2, 2}, {3, 100}}) {
    const Heightfield field = rough(width, depth);
    Clipmap lod(heights_in_memory(field), 31);
    for (int k = 0; k < 20; ++k) {
      const float x = field.extent_x() * (static_cast<float>(random() % 1400) / 1000 - 0.2F);
      const float z = field.extent_z() * (static_cast<float>(random() % 1400) / 1000 - 0.2F);
      expect_closed(field, lod.update(everything(field, x, z, 1 + static_cast<float>(random() % 60))));
      if (HasFatalFailure()) return;
    }
  }
}

TEST(Clipmap, HoldsTheGroundsHeightsAfterAnyWalk) {
  const Heightfield field = rough(500, 400);
  Clipmap lod(heights_in_memory(field), 63);
  std::mt19937 random(11);
  float x = 500, z = 600;
  for (int k = 0; k < 200; ++k) {
    const auto step = [&] { return static_cast<float>(random() % 61) - 30; };
    x = k % 50 == 49 ? static_cast<float>(random() % 1000) : x + step();
    z += step();
    const Frame& frame = lod.update(everything(field, x, z, 1));
    for (int l = 0; l < lod.levels(); ++l) {
      const ClipLevel& level = frame.clip_levels[l];
      for (int b = level.corner.y; b < level.corner.y + lod.window(); ++b) {
        for (int a = level.corner.x; a < level.corner.x + lod.window(); ++a) {
          const int i = std::clamp(a * level.spacing, 0, field.width - 1);
          const int j = std::clamp(b * level.spacing, 0, field.depth - 1);
          const int mask = level.side - 1;
          ASSERT_EQ(level.heights[(b & mask) * level.side + (a & mask)], field.at(i, j)) << k << ' ' << l;
        }
      }
    }
  }
}

// For any move, uploads are exactly the samples that are new in each window: n² less those shared with its
// former place.
TEST(Clipmap, UploadsEachNewSampleOnce) {
  const Heightfield field = rough(700, 900);
  Clipmap lod(heights_in_memory(field), 63);
  std::mt19937 random(17);
  std::vector<glm::ivec2> before;
  float i = 300, j = 300;
  for (int k = 0; k < 300; ++k) {
    const auto step = [&](int most) { return static_cast<float>(random() % (2 * most + 1)) - most; };
    const int most = k % 10 == 9 ? 90 : 3;
    i = std::clamp(i + step(most), -20.0F, 720.0F);
    j = std::clamp(j + step(most), -20.0F, 920.0F);
    const Frame& frame = lod.update(everything(field, i * field.cell_x, j * field.cell_z, 1));
    std::size_t expected = k == 0 ? 4 * frame.indices.size() : 0;
    for (std::size_t l = 0; l < frame.clip_levels.size(); ++l) {
      const int n = lod.window();
      const glm::ivec2 by = k == 0 ? glm::ivec2(n) : glm::abs(frame.clip_levels[l].corner - before[l]);
      expected += 4 * static_cast<std::size_t>(n * n - std::max(0, n - by.x) * std::max(0, n - by.y));
    }
    ASSERT_EQ(frame.stats.bytes_uploaded, expected) << k;
    std::map<std::array<int, 3>, int> times;
    for (const DirtyRange& range : frame.uploads) {
      if (range.target != DirtyRange::Target::kClipLevel) continue;
      for (int z = range.z; z < range.z + range.depth; ++z) {
        for (int x = range.x; x < range.x + range.width; ++x) ++times[{range.level, x, z}];
      }
    }
    for (const auto& [sample, count] : times) ASSERT_EQ(count, 1) << k;
    before.clear();
    for (const ClipLevel& level : frame.clip_levels) before.push_back(level.corner);
  }
}

// On a slow flight that climbs through the levels, vertices move gradually; without the transition, they jump
// when they change level.
TEST(Clipmap, TransitionsKeepPoppingSmall) {
  Heightfield field = test::hilly(110, 110, 1);
  field.cell_x = field.cell_z = 3;
  Clipmap lod(heights_in_memory(field), 31);
  std::vector<View> all(100);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto t = static_cast<float>(k);
    all[k].eye = {80 + 0.3F * t, 30 + 0.5F * t, 120 + 0.2F * t};
    all[k].target = all[k].eye + glm::vec3(1, -0.4F, 0.5F);
  }
  double blended = 0, sudden = 0;
  std::unique_ptr<SurfaceRaster> before[2];
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Frame& frame = lod.update(all[k]);
    std::vector<ClipLevel> levels(frame.clip_levels.begin(), frame.clip_levels.end());
    for (ClipLevel& level : levels) level.from = level.to = 0;
    Frame plain = frame;
    plain.clip_levels = levels;
    const SeenSamples seen(field, all[k]);
    for (int which = 0; which < 2; ++which) {
      auto now = std::make_unique<SurfaceRaster>(which == 0 ? frame : plain, field.width, field.depth);
      double& largest = which == 0 ? blended : sudden;
      if (before[which] != nullptr)
        largest = std::max(largest, popping(*before[which], *now, seen).visible.largest);
      before[which] = std::move(now);
    }
  }
  EXPECT_GT(sudden, 0);
  EXPECT_LT(blended, 0.5 * sudden) << "of " << sudden << " px";
}

TEST(ClipmapBounds, AreThoseOfTheTilesWhereverTheWindowWent) {
  constexpr int kWindow = 31, kSide = 32, kTile = 8;
  std::mt19937 random(23);
  clipmap::HeightBounds bounds(kWindow);
  std::vector<float> heights(kSide * kSide);
  ClipLevel level{.side = kSide, .heights = heights};
  const auto height = [](int a, int b) { return static_cast<float>((a * 7919 + b * 104729) % 1009); };
  const auto floor8 = [](int lattice) { return lattice & ~(kTile - 1); };
  for (int k = 0; k < 200; ++k) {
    const int most = k % 20 == 19 ? 100 : 4;
    const auto step = [&] { return static_cast<int>(random() % (2 * most + 1)) - most; };
    level.corner += glm::ivec2(step(), step());
    const glm::ivec2 corner = level.corner, end = corner + kWindow - 1;
    std::fill(heights.begin(), heights.end(), 1e9F);  // samples outside the window must not count
    for (int b = corner.y; b <= end.y; ++b) {
      for (int a = corner.x; a <= end.x; ++a)
        heights[static_cast<std::size_t>((b & 31) * kSide + (a & 31))] = height(a, b);
    }
    bounds.update(level);
    const auto inside = [&](int from) { return from + static_cast<int>(random() % kWindow); };
    const glm::ivec2 p(inside(corner.x), inside(corner.y)), q(inside(corner.x), inside(corner.y));
    const glm::ivec2 low = glm::min(p, q), high = glm::max(p, q);
    float lowest = INFINITY, highest = -INFINITY;
    for (int b = std::max(floor8(low.y), corner.y); b <= std::min(floor8(high.y) + kTile - 1, end.y); ++b) {
      for (int a = std::max(floor8(low.x), corner.x); a <= std::min(floor8(high.x) + kTile - 1, end.x); ++a) {
        lowest = std::min(lowest, height(a, b));
        highest = std::max(highest, height(a, b));
      }
    }
    const auto range = bounds.range(low, high);
    ASSERT_EQ(range.lowest, lowest) << k;
    ASSERT_EQ(range.highest, highest) << k;
  }
}

TEST(Clipmap, WindowsAreNoLargerThanTheGroundAsks) {
  const Heightfield field = rough(100, 60);
  Clipmap lod(heights_in_memory(field), 4095);
  EXPECT_EQ(lod.levels(), 1);
  EXPECT_LE(lod.window(), 2 * 100 + 10);
  expect_closed(field, lod.update(everything(field, 0, 0, 1)));
  expect_closed(field, lod.update(everything(field, field.extent_x(), field.extent_z(), 1)));
}

TEST(Clipmap, StepsBackWhenTheEyeRises) {
  const Heightfield field = rough(1025, 1025);
  Clipmap lod(heights_in_memory(field), 63);
  const auto finest = [&](float above) {
    const Frame& frame = lod.update(everything(field, 1000, 1000, above));
    std::uint16_t least = 99;
    for (const Batch& batch : frame.batches) least = std::min(least, batch.level);
    return least;
  };
  EXPECT_EQ(finest(1), 0);
  EXPECT_EQ(finest(0.5F * 63 * 3), 1);
  EXPECT_EQ(finest(1.0e6F), lod.levels() - 1);
  EXPECT_EQ(finest(1), 0);
}

TEST(Clipmap, CullsBlocksBehindTheEye) {
  const Heightfield field = rough(1025, 1025);
  Clipmap lod(heights_in_memory(field), 127);
  View view;
  view.eye = {1000, 20, 1500};
  view.target = {1000, 20, 0};
  const std::size_t ahead = lod.update(view).stats.triangles;
  const std::size_t around = lod.update(everything(field, 1000, 1500, 10)).stats.triangles;
  EXPECT_GT(ahead, 0U);
  EXPECT_LT(ahead, around / 2);
}

TEST(Clipmap, CountsItsHeapBytes) {
  const Heightfield field = rough(600, 600);
  const HeapScope heap;
  auto lod = std::make_unique<Clipmap>(heights_in_memory(field), 63);
  lod->update(everything(field, 300, 300, 1));
  EXPECT_EQ(heap.held(), static_cast<std::int64_t>(lod->memory().total()));
  lod->tune(127);
  lod->update(everything(field, 400, 300, 1));
  EXPECT_EQ(heap.held(), static_cast<std::int64_t>(lod->memory().total()));
}

}  // namespace
}  // namespace terrabench
