#include "lod/mrbsp/visibility/area_occlusion.h"

#include <tbb/parallel_for.h>

#include <bit>
#include <cmath>
#include <limits>

namespace terrabench::mrbsp::visibility {
namespace {

// Finest blocks along the longer side: more give tighter bounds, the tables grow with the square.
constexpr int kMostBlocks = 256;
// A cell is divided into at most kParts × kParts parts: each halving hides a little more for four times the
// work.
constexpr int kParts = 4;
// Added to the eye height, metres, against rounding of the observer's position.
constexpr float kEyeSlack = 0.01F;

}  // namespace

AreaOcclusion::AreaOcclusion(const GroundGrid& ground, const BisectionTree& tree, const CellGrid& cells,
                             float eye_height)
    : ground_(ground), side_(tree.square_at(tree.depth())), eye_height_(eye_height + kEyeSlack) {
  // A cell must be a block of some level, so the finest blocks are no larger than a cell.
  const int longest = std::max(ground.width, ground.depth) - 1;
  while (2 * side_ <= cells.side && (longest - 1) / side_ + 1 > kMostBlocks) side_ *= 2;
  cell_level_ = std::countr_zero(static_cast<unsigned>(cells.side / side_));
  make_tops();
  make_lines(0);
  make_lines(1);
}

int AreaOcclusion::blocks_along(int axis, int level) const {
  const int cells = (axis == 0 ? ground_.width : ground_.depth) - 1;
  return (cells - 1) / (side_ << level) + 1;
}

void AreaOcclusion::make_tops() {
  const int columns = blocks_along(0, 0), rows = blocks_along(1, 0);
  tops_.emplace_back(static_cast<std::size_t>(columns) * rows);
  tbb::parallel_for(0, rows, [&](int z) {
    for (int x = 0; x < columns; ++x) {
      float highest = -std::numeric_limits<float>::infinity();
      for (int j = z * side_; j <= std::min((z + 1) * side_, ground_.depth - 1); ++j) {
        for (int i = x * side_; i <= std::min((x + 1) * side_, ground_.width - 1); ++i) {
          highest = std::max(highest, ground_.heights[static_cast<std::size_t>(j) * ground_.width + i]);
        }
      }
      tops_[0][static_cast<std::size_t>(z) * columns + x] = highest;
    }
  });
  for (int level = 1; tops_.back().size() > 1 || level <= cell_level_; ++level) {
    const int across = blocks_along(0, level), down = blocks_along(1, level);
    const int finer_across = blocks_along(0, level - 1), finer_down = blocks_along(1, level - 1);
    std::vector<float> coarser(static_cast<std::size_t>(across) * down,
                               -std::numeric_limits<float>::infinity());
    for (int z = 0; z < finer_down; ++z) {
      for (int x = 0; x < finer_across; ++x) {
        float& highest = coarser[static_cast<std::size_t>(z / 2) * across + x / 2];
        highest = std::max(highest, tops_.back()[static_cast<std::size_t>(z) * finer_across + x]);
      }
    }
    tops_.push_back(std::move(coarser));
  }
}

void AreaOcclusion::make_lines(int axis) {
  GridLines& lines = lines_[axis];
  const int length = axis == 0 ? ground_.width : ground_.depth,
            other = axis == 0 ? ground_.depth : ground_.width;
  lines.count = (length - 1) / side_ + 1;
  lines.stretches = blocks_along(1 - axis, 0);
  const std::size_t step = axis == 0 ? static_cast<std::size_t>(ground_.width) : 1;
  const std::size_t line_step = static_cast<std::size_t>(side_) * (axis == 0 ? 1 : ground_.width);
  std::vector<float> lowest(static_cast<std::size_t>(lines.count) * lines.stretches);
  for (int line = 0; line < lines.count; ++line) {
    for (int k = 0; k < lines.stretches; ++k) {
      float low = std::numeric_limits<float>::infinity();
      for (int at = k * side_; at <= std::min((k + 1) * side_, other - 1); ++at) {
        low = std::min(low, ground_.heights[line * line_step + at * step]);
      }
      lowest[static_cast<std::size_t>(line) * lines.stretches + k] = low;
    }
  }
  lines.lowest.push_back(std::move(lowest));
  for (int reach = 1; 2 * reach <= lines.stretches; reach *= 2) {
    std::vector<float> wider = lines.lowest.back();
    for (int line = 0; line < lines.count; ++line) {
      float* const row = wider.data() + static_cast<std::size_t>(line) * lines.stretches;
      for (int k = 0; k + reach < lines.stretches; ++k) row[k] = std::min(row[k], row[k + reach]);
    }
    lines.lowest.push_back(std::move(wider));
  }
}

float AreaOcclusion::GridLines::over(int line, int from, int to) const {
  const int k = std::bit_width(static_cast<unsigned>(to - from + 1)) - 1;
  const float* const row = lowest[k].data() + static_cast<std::size_t>(line) * stretches;
  return std::min(row[from], row[to + 1 - (1 << k)]);
}

float AreaOcclusion::top(const Block& b) const {
  return tops_[b.level][static_cast<std::size_t>(b.z) * blocks_along(0, b.level) + b.x];
}

AreaOcclusion::Interval AreaOcclusion::span(const Block& b, int axis) const {
  const int side = side_ << b.level, at = (axis == 0 ? b.x : b.z) * side;
  const int end = (axis == 0 ? ground_.width : ground_.depth) - 1;
  return {static_cast<float>(at), static_cast<float>(std::min(at + side, end))};
}

bool AreaOcclusion::hidden_across(int axis, Interval k, Interval t, Interval k_side, Interval t_side,
                                  float eye, float top) const {
  const bool forward = t.low >= k.high;
  if (!forward && t.high > k.low) return false;  // side by side
  const float k_near = forward ? k.high : k.low, k_far = forward ? k.low : k.high;
  const float t_near = forward ? t.low : t.high, t_far = forward ? t.high : t.low;
  const float side = static_cast<float>(side_);
  const GridLines& lines = lines_[axis];
  const int first = static_cast<int>(std::ceil(std::min(k_near, t_near) / side));
  const int last = std::min(static_cast<int>(std::max(k_near, t_near) / side), lines.count - 1);
  for (int line = first; line <= last; ++line) {
    const float u = static_cast<float>(line) * side;
    const float s0 = std::abs(u - k_near) / std::abs(t_far - k_near);
    const float s1 = std::abs(u - k_far) / std::abs(t_near - k_far);
    const float low =
        std::min(k_side.low + s0 * (t_side.low - k_side.low), k_side.low + s1 * (t_side.low - k_side.low));
    const float high = std::max(k_side.high + s0 * (t_side.high - k_side.high),
                                k_side.high + s1 * (t_side.high - k_side.high));
    // Bounds the rounding error of both ends of the stretch, in block sides, and of heights.
    constexpr float kSlack = 1e-4F;
    const int from = std::max(static_cast<int>((low - kSlack * side) / side), 0);
    const int to = std::min(static_cast<int>((high + kSlack * side) / side), lines.stretches - 1);
    const float sight = eye + (top > eye ? s1 : s0) * (top - eye);
    if (lines.over(line, from, to) > sight + kSlack * (1 + std::abs(sight))) return true;
  }
  return false;
}

bool AreaOcclusion::hidden(const Block& cell, float eye, const Block& block) const {
  const Interval kx = span(cell, 0), kz = span(cell, 1), tx = span(block, 0), tz = span(block, 1);
  const float height = top(block);
  return hidden_across(0, kx, tx, kz, tz, eye, height) || hidden_across(1, kz, tz, kx, tx, eye, height);
}

// Whether any part of the cell sees a block that the cell as a whole sees.
bool AreaOcclusion::seen_from_part(const Block& cell, const Block& block) const {
  if (cell.level == 0 || (kParts << cell.level) <= (1 << cell_level_)) return true;
  for (int which = 0; which < 4; ++which) {
    const Block part = cell.child(which);
    if (part.x >= blocks_along(0, part.level) || part.z >= blocks_along(1, part.level)) continue;
    if (!hidden(part, top(part) + eye_height_, block) && seen_from_part(part, block)) return true;
  }
  return false;
}

void AreaOcclusion::find(const CoarseSquares& squares, const Block& cell, float eye, const Block& block,
                         int index, Sets& sets) const {
  if (block.x >= blocks_along(0, block.level) || block.z >= blocks_along(1, block.level)) return;
  if (hidden(cell, eye, block)) return;
  const int side = side_ << block.level, square_side = squares.side();
  if (2 * side > square_side && block.level > 0) {
    for (int which = 0; which < 4; ++which) find(squares, cell, eye, block.child(which), index, sets);
    return;
  }
  // The block's side is at most half a square's, so the block lies on one side of the diagonal or has it as
  // its own diagonal; or the block is a finest one, which may contain several squares.
  const glm::ivec2 low(block.x * side, block.z * side);
  bool missing = false;
  const auto each_half = [&](const auto& body) {
    for (int z = low.y / square_side; z * square_side < std::min(low.y + side, ground_.depth - 1); ++z) {
      for (int x = low.x / square_side; x * square_side < std::min(low.x + side, ground_.width - 1); ++x) {
        const glm::ivec2 in = low - glm::ivec2(x, z) * square_side;
        int beyond = 0;  // below 0: in half 0; above: in half 1; 0: in both
        if (side < square_side) {
          beyond = CoarseSquares::rising({x, z}) ? in.x - in.y : in.x + in.y + side - square_side;
        }
        if (beyond <= 0) body(squares.element({x, z}, 0));
        if (beyond >= 0) body(squares.element({x, z}, 1));
      }
    }
  };
  each_half([&](std::uint32_t element) { missing = missing || !sets.sees(index, element); });
  if (missing && seen_from_part(cell, block)) {
    each_half([&](std::uint32_t element) { sets.add(index, element); });
  }
}

void AreaOcclusion::find(const CoarseSquares& squares, int index, Sets& sets) const {
  const Block cell{cell_level_, index % sets.cells.columns, index / sets.cells.columns};
  const int top_level = static_cast<int>(tops_.size()) - 1;
  find(squares, cell, top(cell) + eye_height_, {top_level, 0, 0}, index, sets);
}

}  // namespace terrabench::mrbsp::visibility
