#include "lod/mrbsp/visibility/line_of_sight.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lod/mrbsp/bisection_tree.h"

namespace terrabench::mrbsp::visibility {

LineOfSight::LineOfSight(const GroundGrid& ground, const CoarseSquares& squares)
    : ground_(ground), squares_(squares) {
  const int side = squares.side();
  count_ = {(ground.width - 2) / side + 1, (ground.depth - 2) / side + 1};
  for (int x = 0; x <= count_.x; ++x) along_x_.push_back(std::min<float>(x * side, ground.width - 1));
  for (int z = 0; z <= count_.y; ++z) along_z_.push_back(std::min<float>(z * side, ground.depth - 1));
  heights_.reserve(along_x_.size() * along_z_.size());
  for (const float z : along_z_) {
    const float* const row = ground.heights.data() + static_cast<std::size_t>(z) * ground.width;
    for (const float x : along_x_) heights_.push_back(row[static_cast<int>(x)]);
  }
}

LineOfSight::Square LineOfSight::square(glm::ivec2 index) const {
  const auto x = static_cast<std::size_t>(index.x), z = static_cast<std::size_t>(index.y);
  const glm::vec2 low(along_x_[x], along_z_[z]), high(along_x_[x + 1], along_z_[z + 1]);
  const float* const near = heights_.data() + vertex(index);
  const float* const far = near + count_.x + 1;
  return {low, high - low, near[0], near[1], far[0], far[1], CoarseSquares::rising(index)};
}

float LineOfSight::Square::height(float u, float v) const {
  if (rising) {
    return u > v ? y00 + u * (y10 - y00) + v * (y11 - y10) : y00 + v * (y01 - y00) + u * (y11 - y01);
  }
  return u + v < 1 ? y00 + u * (y10 - y00) + v * (y01 - y00)
                   : y11 + (1 - u) * (y01 - y11) + (1 - v) * (y10 - y11);
}

glm::ivec2 LineOfSight::index_at(float x, float z) const {
  const glm::ivec2 index(static_cast<int>(x) / squares_.side(), static_cast<int>(z) / squares_.side());
  return glm::clamp(index, glm::ivec2(0), count_ - 1);
}

float LineOfSight::height(float x, float z) const {
  const Square p = square(index_at(x, z));
  return p.height((x - p.low.x) / p.size.x, (z - p.low.y) / p.size.y);
}

bool LineOfSight::clear(const glm::vec3& from, const glm::vec3& to) const {
  // Rounding error of heights of this size, which must not block.
  const float slack = 1e-5F * (1 + std::max(std::abs(from.y), std::abs(to.y)));
  const glm::vec3 along = to - from;
  const float side = static_cast<float>(squares_.side());
  glm::ivec2 index = index_at(from.x, from.z);
  const glm::ivec2 step(along.x > 0 ? 1 : -1, along.z > 0 ? 1 : -1);
  const auto next_crossing = [&](int axis) {
    const float delta = axis == 0 ? along.x : along.z;
    if (delta == 0) return 2.0F;
    const int line = index[axis] + (step[axis] > 0 ? 1 : 0);
    const float at = static_cast<float>(line) * side - (axis == 0 ? from.x : from.z);
    return at / delta;
  };
  // Each piece of the line lies over one square, whose surface is linear on either side of the diagonal. So
  // it is enough to test the ends of the piece and its crossing of the diagonal.
  const glm::ivec2 last = count_ - 1;
  for (float t0 = 0; t0 < 1;) {
    const float tx = next_crossing(0), tz = next_crossing(1);
    const float t1 = std::clamp(std::min(tx, tz), t0, 1.0F);
    const Square p = square(index);
    const auto uv = [&](float t) {
      return glm::vec2((from.x + t * along.x - p.low.x) / p.size.x,
                       (from.z + t * along.z - p.low.y) / p.size.y);
    };
    const auto blocked = [&](float t) {
      const glm::vec2 at = glm::clamp(uv(t), glm::vec2(0), glm::vec2(1));
      return p.height(at.x, at.y) > from.y + t * along.y + slack;
    };
    const glm::vec2 a = uv(t0), b = uv(t1);
    const float fa = p.rising ? a.x - a.y : a.x + a.y - 1, fb = p.rising ? b.x - b.y : b.x + b.y - 1;
    if (fa * fb < 0 && blocked(t0 + (t1 - t0) * fa / (fa - fb))) return false;
    if (t1 < 1 && blocked(t1)) return false;
    t0 = t1;
    if (t1 >= 1) break;
    index[tx <= tz ? 0 : 1] += step[tx <= tz ? 0 : 1];
    if (glm::min(index, glm::ivec2(0)) != glm::ivec2(0) || glm::max(index, last) != last) break;
  }
  return true;
}

void LineOfSight::add_under(const CellArea& area, int cell, Sets& sets) const {
  const glm::ivec2 first = area.low / squares_.side(), last = (area.high - 1) / squares_.side();
  for (int z = first.y; z <= last.y; ++z) {
    for (int x = first.x; x <= last.x; ++x) {
      for (int half = 0; half < 2; ++half) sets.add(cell, squares_.element({x, z}, half));
    }
  }
}

void LineOfSight::add_seen(const glm::vec3& eye, bool facing, int cell, std::vector<Line>& lines,
                           Sets& sets) const {
  // Vertices of the halves, counter-clockwise from above.
  static constexpr glm::ivec2 kHalves[2][2][3] = {{{{0, 0}, {0, 1}, {1, 0}}, {{1, 1}, {1, 0}, {0, 1}}},
                                                  {{{0, 1}, {1, 1}, {0, 0}}, {{1, 0}, {0, 0}, {1, 1}}}};
  std::fill(lines.begin(), lines.end(), Line::kUnknown);
  const auto sees = [&](glm::ivec2 at) {
    Line& line = lines[vertex(at)];
    if (line == Line::kUnknown) line = clear(eye, vertex_position(at)) ? Line::kClear : Line::kBlocked;
    return line == Line::kClear;
  };
  const auto faces = [&](glm::ivec2 a, glm::ivec2 b, glm::ivec2 c) {
    const glm::vec3 from = vertex_position(a);
    const glm::vec3 normal = glm::cross(vertex_position(b) - from, vertex_position(c) - from);
    return glm::dot(normal, eye - from) > 0;
  };
  for (int z = 0; z < count_.y; ++z) {
    for (int x = 0; x < count_.x; ++x) {
      const glm::ivec2 at(x, z);
      for (int half = 0; half < 2; ++half) {
        const std::uint32_t element = squares_.element(at, half);
        if (sets.sees(cell, element)) continue;
        const glm::ivec2* const corner = kHalves[CoarseSquares::rising(at) ? 1 : 0][half];
        const glm::ivec2 a = at + corner[0], b = at + corner[1], c = at + corner[2];
        if ((!facing || faces(a, b, c)) && (sees(a) || sees(b) || sees(c))) sets.add(cell, element);
      }
    }
  }
}

void LineOfSight::find(int cell, const Sampling& sampling, Sets& sets) const {
  const CellGrid& cells = sets.cells;
  CellArea area;
  area.low = glm::ivec2(cell % cells.columns, cell / cells.columns) * cells.side;
  area.high = glm::min(area.low + cells.side, glm::ivec2(ground_.width - 1, ground_.depth - 1));
  add_under(area, cell, sets);
  glm::ivec2 eyes(2);
  if (sampling.eyes == Eyes::kInside) eyes = glm::ivec2(sampling.per_side);
  if (sampling.eyes == Eyes::kSamples) eyes = area.high - area.low + 1;
  const auto place = [&](int axis, int k) {
    const auto low = static_cast<float>(area.low[axis]), high = static_cast<float>(area.high[axis]);
    const auto count = static_cast<float>(eyes[axis]), at = static_cast<float>(k);
    if (sampling.eyes == Eyes::kInside) return low + (at + 0.5F) / count * (high - low);
    return std::clamp(low + at / (count - 1) * (high - low), low + kInset, high - kInset);
  };
  std::vector<Line> lines(heights_.size());
  for (int b = 0; b < eyes.y; ++b) {
    for (int a = 0; a < eyes.x; ++a) {
      const float x = place(0, a), z = place(1, b);
      const float ground = std::max(sample_height(ground_, x, z), height(x, z));
      add_seen({x, ground + sets.eye_height, z}, sampling.facing, cell, lines, sets);
    }
  }
}

}  // namespace terrabench::mrbsp::visibility
