#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "terrain/error.h"
#include "terrain/hydrology/channels.h"
#include "terrain/hydrology/flow.h"
#include "tests/terrain/ground.h"

namespace terrabench {
namespace {

using test::flat;
using test::ground_of;
using test::with_holes;

// The documented rule, literally: a list searched linearly for each pixel taken, and accumulation by
// following every pixel's path to its end. O(n²).
class SlowRouter {
 public:
  explicit SlowRouter(const Heightfield& field) : field_(field) {
    direction.assign(field.heights.size(), FlowNetwork::kNoData);
    for (int j = 0; j < field.depth; ++j) {
      for (int i = 0; i < field.width; ++i) {
        if (has_data(i, j) && on_border(i, j)) wait(i, j, FlowNetwork::kOutlet);
      }
    }
    while (!waiting_.empty()) take();
    accumulate();
  }

  std::vector<std::uint8_t> direction;
  std::vector<std::uint32_t> accumulation;

 private:
  struct Waiting {
    float height;
    int i, j;
  };
  static constexpr int kX[] = {1, 1, 0, -1, -1, -1, 0, 1}, kZ[] = {0, 1, 1, 1, 0, -1, -1, -1};

  bool has_data(int i, int j) const {
    return i >= 0 && j >= 0 && i < field_.width && j < field_.depth && !std::isnan(field_.at(i, j));
  }
  bool on_border(int i, int j) const {
    for (int d = 0; d < 8; ++d) {
      if (!has_data(i + kX[d], j + kZ[d])) return true;
    }
    return false;
  }
  std::uint8_t& direction_at(int i, int j) {
    return direction[static_cast<std::size_t>(j) * field_.width + i];
  }
  void wait(int i, int j, int toward) {
    direction_at(i, j) = static_cast<std::uint8_t>(toward);
    waiting_.push_back({field_.at(i, j), i, j});
  }
  bool waits(int i, int j) const {
    return std::any_of(waiting_.begin(), waiting_.end(),
                       [&](const Waiting& w) { return w.i == i && w.j == j; });
  }
  void take() {
    // The first of the lowest: the list is in the order of waiting.
    const auto lowest =
        std::min_element(waiting_.begin(), waiting_.end(),
                         [](const Waiting& a, const Waiting& b) { return a.height < b.height; });
    const Waiting pixel = *lowest;
    waiting_.erase(lowest);
    for (int d = 0; d < 8; ++d) {
      const int i = pixel.i + kX[d], j = pixel.j + kZ[d], back = (d + 4) % 8;
      if (!has_data(i, j)) continue;
      if (direction_at(i, j) == FlowNetwork::kNoData) {
        wait(i, j, back);
      } else if (direction_at(i, j) == FlowNetwork::kOutlet && waits(i, j) &&
                 field_.at(i, j) > pixel.height) {
        direction_at(i, j) = static_cast<std::uint8_t>(back);
      }
    }
  }
  void accumulate() {
    accumulation.assign(direction.size(), 0);
    for (std::size_t start = 0; start < direction.size(); ++start) {
      if (direction[start] == FlowNetwork::kNoData) continue;
      int i = static_cast<int>(start) % field_.width, j = static_cast<int>(start) / field_.width;
      for (std::size_t steps = 0;; ++steps) {
        ASSERT_LT(steps, direction.size()) << "the reference runs in a circle";
        ++accumulation[static_cast<std::size_t>(j) * field_.width + i];
        const int d = direction_at(i, j);
        if (d >= 8) break;
        i += kX[d];
        j += kZ[d];
      }
    }
  }

  const Heightfield& field_;
  std::vector<Waiting> waiting_;
};

// What must hold of any network, whatever the rule.
void check_sound(const Heightfield& field, const FlowNetwork& network) {
  ASSERT_EQ(network.width, field.width);
  ASSERT_EQ(network.depth, field.depth);
  ASSERT_EQ(network.direction.size(), field.heights.size());
  ASSERT_EQ(network.accumulation.size(), field.heights.size());
  std::size_t data = 0, drained = 0;
  for (std::size_t i = 0; i < network.size(); ++i) {
    const bool hole = std::isnan(field.heights[i]);
    ASSERT_EQ(network.direction[i] == FlowNetwork::kNoData, hole);
    ASSERT_EQ(network.accumulation[i] == 0, hole);
    data += !hole;
    if (network.direction[i] == FlowNetwork::kOutlet) drained += network.accumulation[i];
    if (!network.flows(i)) continue;
    const std::size_t to = network.receiver(i);
    ASSERT_LT(to, network.size());
    ASSERT_NE(network.direction[to], FlowNetwork::kNoData);
    // Strictly more at every step: no circle, and every path ends in an outlet.
    ASSERT_GT(network.accumulation[to], network.accumulation[i]);
  }
  EXPECT_EQ(drained, data);
}

void check_against_slow(const Heightfield& field) {
  const FlowNetwork network = route_flow(field);
  check_sound(field, network);
  const SlowRouter slow(field);
  EXPECT_EQ(network.direction, slow.direction);
  EXPECT_EQ(network.accumulation, slow.accumulation);
}

Heightfield random_grid(int width, int depth, unsigned seed, float range, bool whole) {
  const Heightfield field = test::random_ground(width, depth, seed, -range, range);
  return whole ? test::rounded(field) : field;
}

TEST(Hydrology, AgreesWithTheSlowRouterOnWholeHeights) {
  unsigned seed = 1;
  for (const float range : {1.0F, 4.0F, 100.0F, 30000.0F, 500000.0F}) {
    check_against_slow(random_grid(41, 23, seed++, range, true));
  }
}

TEST(Hydrology, AgreesWithTheSlowRouterOnAnyHeights) {
  check_against_slow(random_grid(37, 29, 7, 1.0F, false));
  check_against_slow(random_grid(16, 50, 8, 1e30F, false));
  // Whole but too wide for buckets, and whole but too large for exact sums.
  check_against_slow(random_grid(20, 20, 9, 3e6F, true));
  check_against_slow(
      ground_of(12, 12, [](int i, int j) { return 3e9F + static_cast<float>((i * 7 + j * 5) % 9) * 512; }));
}

TEST(Hydrology, AgreesWithTheSlowRouterOnFlatsAndPits) {
  check_against_slow(flat(33, 21, 5));
  check_against_slow(flat(33, 21, 5.5F));
  // A bowl, a bowl with a hill in it, and a staircase of pits behind one gate.
  check_against_slow(ground_of(31, 31, [](int i, int j) { return std::hypot(i - 15.0F, j - 15.0F); }));
  check_against_slow(ground_of(
      31, 31, [](int i, int j) { return std::round(std::abs(10 - std::hypot(i - 15.0F, j - 15.0F))); }));
  check_against_slow(ground_of(40, 9, [](int i, int j) {
    return j == 0 || j == 8 || i == 0 || i == 39 ? 50.0F : static_cast<float>((i * 13) % 29 - i);
  }));
  check_against_slow(ground_of(25, 25, [](int i, int j) { return (i / 5 + j / 5) % 2 == 0 ? 3.0F : -3.0F; }));
}

TEST(Hydrology, AgreesWithTheSlowRouterAroundHoles) {
  unsigned seed = 20;
  for (const double share : {0.02, 0.3, 0.8, 0.99}) {
    for (const bool whole : {true, false}) {
      const Heightfield field = with_holes(random_grid(35, 27, seed, 6, whole), seed + 1, share);
      check_against_slow(field);
      seed += 2;
    }
  }
}

TEST(Hydrology, AgreesWithTheSlowRouterOnThinGrids) {
  for (const auto& [width, depth] :
       {std::pair{1, 1}, {1, 2}, {2, 1}, {2, 2}, {1, 17}, {17, 1}, {2, 17}, {17, 2}, {3, 3}}) {
    for (const bool whole : {true, false}) check_against_slow(random_grid(width, depth, 40, 3, whole));
  }
}

TEST(Hydrology, OneSampleIsAnOutlet) {
  const FlowNetwork network = route_flow(flat(1, 1));
  EXPECT_EQ(network.direction[0], FlowNetwork::kOutlet);
  EXPECT_EQ(network.accumulation[0], 1U);
}

TEST(Hydrology, NothingFlowsWithoutData) {
  const Heightfield field = flat(5, 4, Heightfield::kNoData);
  const FlowNetwork network = route_flow(field);
  check_sound(field, network);
  EXPECT_TRUE(channel_pixels(network, 1).empty());
}

TEST(Hydrology, InfiniteHeightsAreOrdered) {
  Heightfield field = random_grid(15, 15, 3, 4, true);
  field.at(7, 7) = std::numeric_limits<float>::infinity();
  field.at(0, 3) = -std::numeric_limits<float>::infinity();
  check_against_slow(field);
}

TEST(Hydrology, HeightsThatHardlyDifferAreOrdered) {
  Heightfield field = random_grid(15, 15, 4, 4, true);
  const Heightfield whole = field;
  for (float& h : field.heights) h = (h + 4) * std::numeric_limits<float>::denorm_min();
  check_against_slow(field);
  EXPECT_EQ(route_flow(field).direction, route_flow(whole).direction);
}

// One height that lies far from all others leaves these a single bucket, and basins among them a large heap.
TEST(Hydrology, AgreesWithTheSlowRouterBesideAnOutlier) {
  Heightfield field = random_grid(60, 70, 31, 1, false);
  field.at(20, 30) = 1e12F;
  check_against_slow(field);
}

TEST(Hydrology, NegativeZeroIsZero) {
  Heightfield plus = random_grid(15, 15, 11, 1, false), minus = plus;
  for (std::size_t i = 0; i < plus.heights.size(); i += 3) {
    plus.heights[i] = 0.0F;
    minus.heights[i] = -0.0F;
  }
  EXPECT_EQ(route_flow(plus).direction, route_flow(minus).direction);
}

TEST(Hydrology, WholeAndFractionalHeightsFlowAlike) {
  const Heightfield whole = random_grid(200, 150, 5, 50, true);
  Heightfield quarter = whole;
  for (float& h : quarter.heights) h *= 0.25F;
  EXPECT_EQ(route_flow(whole).direction, route_flow(quarter).direction);
}

TEST(Hydrology, AllFlowLeavesAValleyThroughItsMouth) {
  // A V-shaped valley that falls to the south.
  const FlowNetwork network = route_flow(
      ground_of(21, 30, [](int i, int j) { return static_cast<float>(std::abs(i - 10) * 3 - j + 100); }));
  const std::size_t mouth = 29 * 21 + 10;
  EXPECT_EQ(network.direction[mouth], FlowNetwork::kOutlet);
  EXPECT_EQ(network.accumulation[mouth], 21U * 30U);
}

TEST(Hydrology, SameForAnyNumberOfThreads) {
  // Several bands of rows.
  const Heightfield field = with_holes(random_grid(150, 1100, 77, 40, true), 78, 0.001);
  const FlowNetwork all = route_flow(field);
  check_sound(field, all);
  for (const int threads : {1, 2, 8}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    const FlowNetwork network = tbb::task_arena(threads).execute([&] { return route_flow(field); });
    EXPECT_EQ(network.direction, all.direction);
    EXPECT_EQ(network.accumulation, all.accumulation);
  }
}

TEST(Hydrology, ManyPixelsOfOneHeightQueueInOrder) {
  // More than one block of the queue a bucket, filled and drained many times over.
  check_against_slow(
      ground_of(90, 70, [](int i, int j) { return static_cast<float>((i / 30 + j / 35) % 2); }));
}

TEST(Hydrology, ChannelsAreListedDownstreamChainByChain) {
  const Heightfield field = random_grid(120, 90, 13, 30, true);
  const FlowNetwork network = route_flow(field);
  for (const std::uint32_t tau : {1U, 5U, 40U}) {
    const std::vector<std::uint32_t> channels = channel_pixels(network, tau);
    std::vector<int> place(network.size(), -1);
    for (std::size_t k = 0; k < channels.size(); ++k) {
      ASSERT_EQ(place[channels[k]], -1);
      place[channels[k]] = static_cast<int>(k);
    }
    std::size_t chains = 0, heads = 0;
    std::vector<int> tributaries(network.size(), 0);
    for (std::size_t i = 0; i < network.size(); ++i) {
      ASSERT_EQ(place[i] >= 0, network.accumulation[i] >= tau);
      if (place[i] < 0 || !network.flows(i)) continue;
      ASSERT_LT(place[i], place[network.receiver(i)]);
      ++tributaries[network.receiver(i)];
    }
    for (std::size_t k = 0; k < channels.size(); ++k) {
      heads += tributaries[channels[k]] == 0;
      chains += k == 0 || !network.flows(channels[k - 1]) || network.receiver(channels[k - 1]) != channels[k];
    }
    EXPECT_EQ(chains, heads);
  }
}

TEST(Hydrology, RastersCarryFlowAndTheDirectionsOfGisTools) {
  Heightfield field = random_grid(9, 7, 2, 5, true);
  field.cell_x = 30;
  field.georeference.crs = "somewhere";
  field.at(4, 3) = Heightfield::kNoData;
  const FlowNetwork network = route_flow(field);
  const Heightfield flow = accumulation_raster(network, field), direction = direction_raster(network, field);
  EXPECT_EQ(flow.cell_x, 30);
  EXPECT_EQ(direction.georeference, field.georeference);
  const float codes[] = {1, 2, 4, 8, 16, 32, 64, 128, 0};
  for (std::size_t i = 0; i < network.size(); ++i) {
    if (std::isnan(field.heights[i])) {
      EXPECT_TRUE(std::isnan(flow.heights[i]) && std::isnan(direction.heights[i]));
      continue;
    }
    EXPECT_EQ(flow.heights[i], static_cast<float>(network.accumulation[i]));
    EXPECT_EQ(direction.heights[i], codes[network.direction[i]]);
  }
}

TEST(Hydrology, StopsWhenInterrupted) {
  Progress progress;
  Progress::interrupt();
  EXPECT_THROW(route_flow(flat(512, 512), &progress), Error);
  Progress::clear_interrupt();
}

}  // namespace
}  // namespace terrabench
