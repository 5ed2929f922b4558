// Endless ground under a clipmap: a frame depends only on the eye's place, not on its path or its distance
// from sample 0, and no edge is visible.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <climits>
#include <cmath>
#include <memory>
#include <vector>

#include "lod/clipmap/clipmap.h"
#include "lod/clipmap/height_source.h"
#include "lod/meters/cracks.h"
#include "terrain/error.h"
#include "terrain/sources/noise/lattice_noise.h"
#include "tests/lod/drawing.h"

namespace terrabench {
namespace {

constexpr EndlessGround kGround{.seed = 9, .cell = 30, .relief = 2000, .cell_bits = 8, .octaves = 7};

Clipmap endless(int window) { return {endless_heights(kGround), window}; }

float height(std::int32_t i, std::int32_t j) {
  static const noise::LatticeNoise noise({.seed = 9, .cell_bits = 8, .octaves = 7});
  float value = 0;
  noise.points({&i, 1}, {&j, 1}, {&value, 1});
  return kGround.relief * value;
}

// Looking east and a little south, low over sample (i, j).
View over(int i, int j, glm::ivec2 origin = glm::ivec2(0), float far = 20000) {
  View view;
  view.eye = {kGround.cell * static_cast<float>(i - origin.x), height(i, j) + 2,
              kGround.cell * static_cast<float>(j - origin.y)};
  view.target = view.eye + glm::vec3(1, -0.1F, 0.3F);
  view.far = far;
  return view;
}

using test::windows_of;

TEST(Endless, AWalkOf120KilometresAndBackFindsTheSameGround) {
  const auto lod = std::make_unique<Clipmap>(endless_heights(kGround), 63);
  constexpr int kSteps = 200, kBy = 20;  // 600 m each
  std::vector<std::vector<float>> there;
  const auto memory = [&] { return lod->memory().total(); };
  std::size_t at_first = 0;
  for (int k = 0; k <= kSteps; ++k) {
    there.push_back(windows_of(lod->update(over(kBy * k, -7 * k)), lod->window()));
    if (k == 0) at_first = memory();
  }
  ASSERT_GE(kSteps * kBy * kGround.cell, 100000);
  for (int k = kSteps; k >= 0; --k) {
    const std::vector<float> back = windows_of(lod->update(over(kBy * k, -7 * k)), lod->window());
    ASSERT_EQ(back, there[k]) << k;
    if (k % 40 == 0) {
      Clipmap fresh = endless(63);
      ASSERT_EQ(back, windows_of(fresh.update(over(kBy * k, -7 * k)), fresh.window())) << k;
    }
  }
  // Only the draw lists may grow, with the blocks in view.
  EXPECT_LE(memory(), at_first + at_first / 100);
}

TEST(Endless, WindowsHoldTheNoiseOfTheirSamples) {
  for (const int far : {0, 1 << 20, -(1 << 27) - 999}) {
    Clipmap lod = endless(31);
    lod.move_origin({far, -far});
    const Frame& frame = lod.update(over(far + 17, 5 - far, lod.origin()));
    for (const ClipLevel& level : frame.clip_levels) {
      const int mask = level.side - 1;
      for (int b = level.corner.y; b < level.corner.y + lod.window(); b += 3) {
        for (int a = level.corner.x; a < level.corner.x + lod.window(); a += 3) {
          ASSERT_EQ(level.heights[(b & mask) * level.side + (a & mask)],
                    height(a * level.spacing, b * level.spacing));
        }
      }
    }
  }
}

// The expected bytes follow from the eye's samples: windows begin at even samples, so level l moves when the
// eye crosses a multiple of 2^(l+1).
TEST(Endless, UploadsTheStripsThatTheEyesPathAsksFor) {
  Clipmap lod = endless(63);
  const auto floor_to = [](int value, int step) {
    return value >= 0 ? value / step : -((step - 1 - value) / step);
  };
  glm::ivec2 eye(-300, 200);
  lod.update(over(eye.x, eye.y));
  std::size_t most = 0;
  for (int k = 0; k < 400; ++k) {
    const glm::ivec2 next = eye + glm::ivec2(1 + k % 5, k % 3 - 2) * (k % 50 == 49 ? 40 : 1);
    std::size_t expected = 0;
    for (int l = 0; l < lod.levels(); ++l) {
      const int n = lod.window(), step = 2 << l;
      const int x = 2 * std::abs(floor_to(next.x, step) - floor_to(eye.x, step));
      const int z = 2 * std::abs(floor_to(next.y, step) - floor_to(eye.y, step));
      expected += 4 * static_cast<std::size_t>(n * n - std::max(0, n - x) * std::max(0, n - z));
    }
    ASSERT_EQ(lod.update(over(next.x, next.y)).stats.bytes_uploaded, expected) << k;
    most = std::max(most, expected);
    eye = next;
  }
  EXPECT_GT(most, 0U);
}

// The coarsest window ends beyond the far plane; otherwise its rim would count as bare edges.
TEST(Endless, HasNeitherCracksNorAnEdgeInView) {
  for (const float far : {3000.0F, 60000.0F}) {
    for (const glm::ivec2 place :
         {glm::ivec2(0), glm::ivec2(5000, -777), glm::ivec2(1 << 27, -(1 << 28) + 1)}) {
      Clipmap lod = endless(31);
      // Makes all coordinates positive, because find_cracks() takes 0 for the ground's border.
      lod.move_origin(place - (1 << 14));
      View view = over(place.x, place.y, lod.origin(), far);
      for (int turn = 0; turn < 6; ++turn) {
        view.eye += glm::vec3(70, 40 * turn, -33);
        view.target = view.eye + glm::vec3(std::cos(turn), -0.2F, std::sin(turn));
        const Frame& frame = lod.update(view);
        const CrackReport cracks = find_cracks(frame, INT_MAX, INT_MAX, view);
        EXPECT_TRUE(cracks.tight()) << cracks.gaps << " gaps, " << cracks.bare_edges << " bare edges";
        EXPECT_EQ(cracks.t_junctions, 0U);
        View farther = view;
        farther.far = 8 * far;
        EXPECT_GT(find_cracks(frame, INT_MAX, INT_MAX, farther).bare_edges, 0U) << "the rim is not found";
      }
    }
  }
}

TEST(Endless, MovingTheOriginUploadsNothing) {
  Clipmap lod = endless(63);
  constexpr int kFar = (1 << 28) + 11;
  lod.move_origin({kFar, 3});
  lod.update(over(kFar + 100, 50, lod.origin()));
  const std::vector<glm::vec3> before = test::corners_of(lod.update(over(kFar + 100, 50, lod.origin())));
  lod.move_origin({kFar + 96, 40});
  const Frame& frame = lod.update(over(kFar + 100, 50, lod.origin()));
  EXPECT_EQ(frame.stats.bytes_uploaded, 0U);
  const std::vector<glm::vec3> after = test::corners_of(frame);
  ASSERT_EQ(before.size(), after.size());
  const glm::vec3 by(96 * kGround.cell, 0, 37 * kGround.cell);
  for (std::size_t k = 0; k < after.size(); ++k) ASSERT_EQ(after[k] + by, before[k]);
}

TEST(Endless, ReadsTheSameOnAnyNumberOfThreads) {
  const auto read = [](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    std::vector<float> heights(300 * 200);
    endless_heights(kGround)->read(2, -123, 45678, 300, 200, heights.data(), 300);
    return heights;
  };
  const std::vector<float> one = read(1);
  EXPECT_EQ(one, read(2));
  EXPECT_EQ(one, read(7));
  EXPECT_EQ(one[300 * 17 + 250], height(4 * (-123 + 250), 4 * (45678 + 17)));
}

TEST(Endless, LevelsFollowTheFarPlane) {
  Clipmap lod = endless(63);
  for (const float far : {1000.0F, 100000.0F, 1e7F}) {
    const Frame& frame = lod.update(over(0, 0, glm::ivec2(0), far));
    const ClipLevel& coarsest = frame.clip_levels.back();
    EXPECT_GE((lod.window() / 2 - 1) * coarsest.spacing * kGround.cell, far);
  }
  const int levels = lod.levels();
  lod.update(over(0, 0));
  EXPECT_EQ(lod.levels(), levels) << "levels are kept";
}

TEST(Endless, TakesAnyEyeAndRefusesInvalidGround) {
  Clipmap lod = endless(15);
  View view;
  view.far = 1e30F;
  view.up = {0.1F, 1, 0.2F};
  for (const glm::vec3 eye :
       {glm::vec3(1e30F, 5, -1e30F), glm::vec3(-1e9F, 1e20F, 50), glm::vec3(0, -1e4F, 0)}) {
    view.eye = eye;
    view.target = {0, 1, 0};
    EXPECT_NO_THROW(lod.update(view));
  }
  EXPECT_THROW(lod.move_origin({INT_MAX, 0}), Error);
  EXPECT_THROW(endless_heights({.cell = 0}), Error);
  EXPECT_THROW(endless_heights({.relief = NAN}), Error);
  EXPECT_THROW(endless_heights({.cell_bits = 40}), Error);
}

}  // namespace
}  // namespace terrabench
