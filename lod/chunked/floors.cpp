#include "lod/chunked/floors.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace terrabench::chunked {

Floors::Floors(const GroundGrid& grid, const NodeTree& tree, const ChunkStore& chunks)
    : grid_(grid), tree_(tree), chunks_(chunks) {
  std::size_t sides = 0;
  for (const int axis : {0, 1}) {
    for (int level = 0; level < tree.levels(); ++level) {
      firsts_.push_back(sides);
      sides += static_cast<std::size_t>(last_line(axis, level) + 1) *
               static_cast<std::size_t>(chunks_along(axis, level));
    }
  }
  floors_.resize(sides);
  update({{0, 0}, {grid.width - 1, grid.depth - 1}});
}

int Floors::last_line(int axis, int level) const {
  return axis == 0 ? tree_.grid(level).across() : tree_.grid(level).down();
}

int Floors::chunks_along(int axis, int level) const { return last_line(1 - axis, level); }

std::size_t Floors::number(const Place& at) const {
  return firsts_[static_cast<std::size_t>(at.axis * tree_.levels() + at.level)] +
         static_cast<std::size_t>(at.line) * static_cast<std::size_t>(chunks_along(at.axis, at.level)) +
         static_cast<std::size_t>(at.along);
}

float Floors::at(int level, int x, int z, Side side) const {
  const int axis = side == kWest || side == kEast ? 0 : 1;
  const int line = (axis == 0 ? x : z) + (side == kEast || side == kSouth ? 1 : 0);
  return floors_[number({axis, level, line, axis == 0 ? z : x})];
}

// The lines of the coarsest level, and those that each finer level has besides.
void Floors::update(const SampleRect& rect) {
  const PatchGrid::PatchRect coarsest = tree_.grid(tree_.levels() - 1).holding(rect.low, rect.high);
  for (int level = 0; level < tree_.levels(); ++level) {
    const int ratio = 1 << (tree_.levels() - 1 - level);
    for (const int axis : {0, 1}) {
      const auto [x0, x1, z0, z1] = coarsest;
      const int first_line = ratio * (axis == 0 ? x0 : z0), first = ratio * (axis == 0 ? z0 : x0);
      const int lines = std::min(ratio * ((axis == 0 ? x1 : z1) + 1), last_line(axis, level));
      const int end = std::min(ratio * ((axis == 0 ? z1 : x1) + 1), chunks_along(axis, level));
      tbb::parallel_for(first_line, lines + 1, [&](int line) {
        if (ratio > 1 && (line % 2 == 0 || line == last_line(axis, level)))
          return;  // also of a coarser level
        for (int along = first; along < end; ++along) measure_from({axis, level, line, along});
      });
    }
  }
}

void Floors::measure_from(const Place& at) {
  const PatchGrid& grid = tree_.grid(at.level);
  const int across = at.axis == 0 ? grid_.width : grid_.depth,
            down = at.axis == 0 ? grid_.depth : grid_.width;
  const int line = std::min(at.line * grid.side, across - 1);
  const int first = at.along * grid.side, last = std::min(first + grid.side, down - 1);
  std::vector<float> lowest;
  for (int k = first; k <= last; ++k) {
    const std::size_t i = static_cast<std::size_t>(at.axis == 0 ? line : k),
                      j = static_cast<std::size_t>(at.axis == 0 ? k : line);
    lowest.push_back(grid_.heights[j * static_cast<std::size_t>(grid_.width) + i]);
  }
  measure(at, lowest);
}

// `lowest`: per sample of the side, the lowest of the ground and of coarser sides, metres.
void Floors::measure(const Place& at, std::span<float> lowest) {
  if (at.level > 0) {
    if (at.line > 0) lower_to(at, at.line - 1, at.axis == 0 ? kEast : kSouth, lowest);
    if (at.line < last_line(at.axis, at.level)) lower_to(at, at.line, at.axis == 0 ? kWest : kNorth, lowest);
  }
  floors_[number(at)] = *std::ranges::min_element(lowest);
  if (at.level == 0) return;
  const int finer = at.level - 1, line = std::min(2 * at.line, last_line(at.axis, finer));
  const auto half = static_cast<std::size_t>(tree_.grid(finer).side);
  for (std::size_t k = 0; k < 2 && k * half + 1 < lowest.size(); ++k) {
    measure({at.axis, finer, line, 2 * at.along + static_cast<int>(k)},
            lowest.subspan(k * half, std::min(half + 1, lowest.size() - k * half)));
  }
}

// Of the chunk on one side of the line.
void Floors::lower_to(const Place& at, int across, Side side, std::span<float> lowest) const {
  const int x = at.axis == 0 ? across : at.along, z = at.axis == 0 ? at.along : across;
  const auto width = static_cast<std::uint32_t>(grid_.width);
  const int first = at.along * tree_.grid(at.level).side;
  std::vector<std::uint32_t> tops;
  chunks_.append_tops(at.level, x, z, side, tops);
  const auto place = [&](std::uint32_t vertex) {
    const std::uint32_t sample = chunks_.sample(vertex);
    return static_cast<int>(at.axis == 0 ? sample / width : sample % width) - first;
  };
  const auto lower = [&](std::size_t k) {
    float& least = lowest[static_cast<std::size_t>(place(tops[k]))];
    least = std::min(least, chunks_.lowest(tops[k]));
  };
  for (std::size_t k = 0; k < tops.size(); ++k) lower(k);
  for (std::size_t k = 0; k + 1 < tops.size(); ++k) {
    const int from = place(tops[k]), to = place(tops[k + 1]);
    const double low = chunks_.lowest(tops[k]), rise = chunks_.lowest(tops[k + 1]) - low;
    for (int s = from + 1; s < to; ++s) {
      float& least = lowest[static_cast<std::size_t>(s)];
      least = std::min(least, static_cast<float>(low + rise * (s - from) / (to - from)));
    }
  }
}

}  // namespace terrabench::chunked
