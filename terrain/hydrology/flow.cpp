#include "terrain/hydrology/flow.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <memory>

#include "terrain/hydrology/accumulate.h"
#include "terrain/hydrology/pixel_queues.h"

namespace terrabench {
namespace {

using hydrology::BucketQueue;
using hydrology::SortedBucketQueue;

// The properties of the heights that decide how they become keys.
struct HeightKind {
  float lowest = std::numeric_limits<float>::infinity();
  float highest = -std::numeric_limits<float>::infinity();
  bool whole = true, holes = false;
};

HeightKind join(const HeightKind& a, const HeightKind& b) {
  return {std::min(a.lowest, b.lowest), std::max(a.highest, b.highest), a.whole && b.whole,
          a.holes || b.holes};
}

HeightKind kind_of(const float* heights, std::size_t count) {
  // Adding and taking away 1.5·2^23 rounds to a whole number; exact for magnitudes below 2^22. Lanes, because
  // compilers may not reorder comparisons of floats by themselves.
  constexpr float kRound = 12582912.0F;
  constexpr std::size_t kLanes = 16;
  std::array<float, kLanes> lowest, highest;
  std::array<unsigned, kLanes> fractions{}, holes{};
  lowest.fill(HeightKind{}.lowest);
  highest.fill(HeightKind{}.highest);
  const auto take = [&](std::size_t lane, float h) {
    lowest[lane] = h < lowest[lane] ? h : lowest[lane];
    highest[lane] = h > highest[lane] ? h : highest[lane];
    holes[lane] |= unsigned{h != h};
    fractions[lane] |= unsigned{(h + kRound) - kRound != h} & unsigned{h == h};
  };
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) take(lane, heights[i + lane]);
  }
  for (; i < count; ++i) take(0, heights[i]);
  HeightKind kind;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    kind = join(kind, {lowest[lane], highest[lane], fractions[lane] == 0, holes[lane] != 0});
  }
  return kind;
}

HeightKind kind_of(const Heightfield& field) {
  using Range = tbb::blocked_range<std::size_t>;
  return tbb::parallel_reduce(
      Range(0, field.heights.size(), std::size_t{1} << 16), HeightKind{},
      [&](const Range& range, const HeightKind& before) {
        return join(before, kind_of(field.heights.data() + range.begin(), range.size()));
      },
      join);
}

// The search's grid: the field with a rim of one pixel, so that no neighbour needs a bounds check, and in
// each cell the key in the low bits and the pixel's state in the high bits. Cells that a neighbour may still
// claim compare lower than all others.
template <class Cell, int kKeyBits>
struct SearchGrid {
  enum Tag : unsigned {
    kUnmet = 0,
    kBorder = 1,    // waits as a border pixel and drains out unless a lower neighbour takes it
    kSettled = 2,   // + direction; kSettled + kOutlet for outlets
    kOutside = 11,  // rim or no-data
  };
  static constexpr Cell kKeyMask = (Cell{1} << kKeyBits) - 1;
  static constexpr Cell tag(unsigned t) { return static_cast<Cell>(t) << kKeyBits; }
  static unsigned tag_of(Cell cell) { return static_cast<unsigned>(cell >> kKeyBits); }
  static std::uint32_t key_of(Cell cell) { return static_cast<std::uint32_t>(cell & kKeyMask); }

  int width, depth;
  std::ptrdiff_t stride;
  std::unique_ptr<Cell[]> cells;

  // Not initialised before fill(), so that its threads share the first touch of the memory.
  SearchGrid(int w, int d)
      : width(w),
        depth(d),
        stride(w + 2),
        cells(std::make_unique_for_overwrite<Cell[]>(static_cast<std::size_t>(stride) * (d + 2))) {}
  Cell* row(int j) { return cells.get() + (j + 1) * stride + 1; }
  const Cell* row(int j) const { return cells.get() + (j + 1) * stride + 1; }

  template <class KeyOf>
  void fill(const Heightfield& field, const KeyOf& key) {
    std::fill_n(row(-1) - 1, stride, tag(kOutside));
    std::fill_n(row(depth) - 1, stride, tag(kOutside));
    tbb::parallel_for(0, depth, [&](int j) {
      const float* const heights = field.heights.data() + static_cast<std::size_t>(j) * width;
      Cell* const out = row(j);
      out[-1] = out[width] = tag(kOutside);
      for (int i = 0; i < width; ++i) {
        out[i] = Heightfield::is_no_data(heights[i]) ? tag(kOutside) : static_cast<Cell>(key(heights[i]));
      }
    });
  }

  // Without holes only the edge of the grid is examined. Reads heights, not cells, which other threads
  // change.
  void mark_border(const Heightfield& field, bool holes) {
    const auto open_to = [&](int i, int j) {
      return i < 0 || j < 0 || i >= width || j >= depth || Heightfield::is_no_data(field.at(i, j));
    };
    tbb::parallel_for(0, depth, [&](int j) {
      const int step = holes || j == 0 || j == depth - 1 ? 1 : std::max(1, width - 1);
      for (int i = 0; i < width; i += step) {
        Cell& cell = row(j)[i];
        if (tag_of(cell) == kUnmet && std::any_of(kFlowSteps.begin(), kFlowSteps.end(),
                                                  [&](FlowStep s) { return open_to(i + s.x, j + s.z); })) {
          cell |= tag(kBorder);
        }
      }
    });
  }

  std::array<std::ptrdiff_t, 8> neighbours() const {
    std::array<std::ptrdiff_t, 8> offsets{};
    for (int d = 0; d < 8; ++d) offsets[d] = kFlowSteps[d].z * stride + kFlowSteps[d].x;
    return offsets;
  }
};

template <class Grid, class Queue>
void search(Grid& grid, bool holes, Queue& queue, Progress* progress) {
  auto* const cells = grid.cells.get();
  for (int j = 0; j < grid.depth; ++j) {
    const int step = holes || j == 0 || j == grid.depth - 1 ? 1 : std::max(1, grid.width - 1);
    for (int i = 0; i < grid.width; i += step) {
      const auto* const cell = grid.row(j) + i;
      if (Grid::tag_of(*cell) == Grid::kBorder) {
        queue.push(Grid::key_of(*cell), static_cast<std::uint32_t>(cell - cells));
      }
    }
  }
  const auto offsets = grid.neighbours();
  const auto fetch = [&](std::uint32_t pixel) {
    __builtin_prefetch(cells + pixel - grid.stride, 1);
    __builtin_prefetch(cells + pixel, 1);
    __builtin_prefetch(cells + pixel + grid.stride, 1);
  };
  std::uint32_t taken = 0;
  while (!queue.empty()) {
    const std::uint32_t pixel = queue.pop(fetch);
    auto* const cell = cells + pixel;
    const auto key = Grid::key_of(*cell);
    if (Grid::tag_of(*cell) == Grid::kBorder) {
      *cell = key | Grid::tag(Grid::kSettled + FlowNetwork::kOutlet);
    }
    // Comparing all eight before acting on any saves most of the mispredicted branches: on average one
    // neighbour is met for the first time.
    unsigned open = 0;
    for (unsigned d = 0; d < 8; ++d) open |= unsigned{cell[offsets[d]] < Grid::tag(Grid::kSettled)} << d;
    for (; open != 0; open &= open - 1) {
      const auto d = static_cast<unsigned>(std::countr_zero(open));
      auto& neighbour = cell[offsets[d]];
      const auto its_key = Grid::key_of(neighbour);
      const auto settled = its_key | Grid::tag(Grid::kSettled + (d ^ 4U));
      if (Grid::tag_of(neighbour) == Grid::kUnmet) {
        neighbour = settled;
        queue.push(its_key, static_cast<std::uint32_t>(&neighbour - cells));
      } else if (its_key > key) {
        neighbour = settled;  // a border pixel, already in the queue
      }
    }
    if (++taken % 65536 == 0 && progress != nullptr) progress->advance(65536);
  }
}

template <class Grid>
void read_directions(const Grid& grid, std::vector<std::uint8_t>& direction) {
  tbb::parallel_for(0, grid.depth, [&](int j) {
    const auto* const cells = grid.row(j);
    std::uint8_t* const out = direction.data() + static_cast<std::size_t>(j) * grid.width;
    for (int i = 0; i < grid.width; ++i) {
      const unsigned tag = Grid::tag_of(cells[i]);
      assert(tag >= Grid::kSettled);
      out[i] = tag == Grid::kOutside ? FlowNetwork::kNoData : static_cast<std::uint8_t>(tag - Grid::kSettled);
    }
  });
}

void route_whole(const Heightfield& field, const HeightKind& kind, FlowNetwork& network, Progress* progress) {
  SearchGrid<std::uint32_t, 20> grid(field.width, field.depth);
  grid.fill(field, [&](float h) { return static_cast<std::uint32_t>(h - kind.lowest); });
  grid.mark_border(field, kind.holes);
  BucketQueue queue(static_cast<std::uint32_t>(kind.highest - kind.lowest) + 1);
  search(grid, kind.holes, queue, progress);
  read_directions(grid, network.direction);
}

// Floats as unsigned numbers of the same order; -0 equals 0.
std::uint32_t ordered_bits(float height) {
  const auto bits = std::bit_cast<std::uint32_t>(height + 0.0F);
  return (bits & 0x80000000U) != 0 ? ~bits : bits | 0x80000000U;
}
float from_ordered_bits(std::uint32_t key) {
  return std::bit_cast<float>((key & 0x80000000U) != 0 ? key & 0x7FFFFFFFU : ~key);
}

// The quickest of 2^12 to 2^17, or nearly, on mountains of 512² to 4096² pixels.
constexpr std::uint32_t kBuckets = 1U << 16;
constexpr float kLeastRange = 1e-30F;  // the scale stays finite

void route_any(const Heightfield& field, const HeightKind& kind, FlowNetwork& network, Progress* progress) {
  SearchGrid<std::uint64_t, 32> grid(field.width, field.depth);
  grid.fill(field, ordered_bits);
  grid.mark_border(field, kind.holes);
  // Infinite or almost equal heights cannot be divided into buckets and share one.
  const float range = kind.highest - kind.lowest;
  const std::uint32_t buckets = range > kLeastRange && std::isfinite(range) ? kBuckets : 1;
  const float scale = buckets > 1 ? static_cast<float>(buckets - 1) / range : 0;
  const auto bucket_of = [=, lowest = kind.lowest](std::uint32_t key) {
    return buckets == 1 ? 0U : static_cast<std::uint32_t>((from_ordered_bits(key) - lowest) * scale);
  };
  SortedBucketQueue queue(buckets, bucket_of);
  search(grid, kind.holes, queue, progress);
  read_directions(grid, network.direction);
}

}  // namespace

FlowNetwork route_flow(const Heightfield& field, Progress* progress) {
  const std::size_t size = field.heights.size();
  assert(field.width >= 1 && field.depth >= 1 && size < (std::size_t{1} << 31));
  assert((field.width + std::size_t{2}) * (field.depth + std::size_t{2}) < (std::size_t{1} << 32));
  FlowNetwork network{field.width, field.depth, std::vector<std::uint8_t>(size), {}};
  if (progress != nullptr) progress->begin("routing flow", size);
  const HeightKind kind = kind_of(field);
  // All no-data: lowest > highest, and nothing enters the queue.
  const bool buckets = kind.whole && kind.highest - kind.lowest < static_cast<float>(1 << 20) &&
                       std::abs(kind.lowest) < static_cast<float>(1 << 22);
  if (buckets) {
    route_whole(field, kind, network, progress);
  } else {
    route_any(field, kind, network, progress);
  }
  network.accumulation = hydrology::accumulate(network);
  if (progress != nullptr) progress->end();
  return network;
}

}  // namespace terrabench
