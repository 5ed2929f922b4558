#include "lod/mrbsp/visibility/line_of_sight.h"

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lod/mrbsp/surface_height.h"

namespace terrabench::mrbsp::visibility {

float LineOfSight::sample(int i, int j) const {
  i = std::min(i, ground_.width - 1);
  j = std::min(j, ground_.depth - 1);
  return ground_.heights[static_cast<std::size_t>(j) * ground_.width + i];
}

LineOfSight::Square LineOfSight::square(glm::ivec2 index) const {
  const int side = squares_.side();
  const glm::ivec2 low = index * side;
  const glm::ivec2 high = glm::min(low + side, glm::ivec2(ground_.width - 1, ground_.depth - 1));
  return {glm::vec2(low),        glm::vec2(high - low),  sample(low.x, low.y),        sample(high.x, low.y),
          sample(low.x, high.y), sample(high.x, high.y), CoarseSquares::rising(index)};
}

float LineOfSight::Square::height(float u, float v) const {
  if (rising) {
    return u > v ? y00 + u * (y10 - y00) + v * (y11 - y10) : y00 + v * (y01 - y00) + u * (y11 - y01);
  }
  return u + v < 1 ? y00 + u * (y10 - y00) + v * (y01 - y00)
                   : y11 + (1 - u) * (y01 - y11) + (1 - v) * (y10 - y11);
}

glm::ivec2 LineOfSight::index_at(float x, float z) const {
  const auto along = [&](float at, int samples) {
    return std::clamp(static_cast<int>(at) / squares_.side(), 0, (samples - 2) / squares_.side());
  };
  return {along(x, ground_.width), along(z, ground_.depth)};
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
  const glm::ivec2 last = index_at(static_cast<float>(ground_.width), static_cast<float>(ground_.depth));
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

void LineOfSight::add_seen(const Square& p, glm::ivec2 index, std::span<const glm::vec3> eyes, int cell,
                           Sets& sets) const {
  const std::array<glm::vec3, 4> corners{{{p.low.x, p.y00, p.low.y},
                                          {p.low.x + p.size.x, p.y10, p.low.y},
                                          {p.low.x, p.y01, p.low.y + p.size.y},
                                          {p.low.x + p.size.x, p.y11, p.low.y + p.size.y}}};
  // Corners of the halves, counter-clockwise from above.
  static constexpr int kHalves[2][2][3] = {{{0, 2, 1}, {3, 1, 2}}, {{2, 3, 0}, {1, 0, 3}}};
  for (int half = 0; half < 2; ++half) {
    const int* const corner = kHalves[p.rising ? 1 : 0][half];
    const glm::vec3& a = corners[corner[0]];
    const glm::vec3 normal = glm::cross(corners[corner[1]] - a, corners[corner[2]] - a);
    const std::uint32_t element = squares_.element(index, half);
    for (const glm::vec3& eye : eyes) {
      if (!(glm::dot(normal, eye - a) > 0)) continue;
      const auto seen = [&](int k) { return clear(eye, corners[corner[k]]); };
      if (seen(0) || seen(1) || seen(2)) {
        sets.add(cell, element);
        break;
      }
    }
  }
}

std::vector<glm::vec3> LineOfSight::eyes_in(glm::ivec2 low, glm::ivec2 high, int eyes_per_side,
                                            float eye_height) const {
  std::vector<glm::vec3> eyes;
  eyes.reserve(static_cast<std::size_t>(eyes_per_side) * eyes_per_side);
  for (int b = 0; b < eyes_per_side; ++b) {
    for (int a = 0; a < eyes_per_side; ++a) {
      const glm::vec2 share = (glm::vec2(a, b) + 0.5F) / static_cast<float>(eyes_per_side);
      const glm::vec2 place = glm::vec2(low) + share * glm::vec2(high - low);
      const float fine = sample_height(ground_, place.x, place.y);
      eyes.emplace_back(place.x, std::max(fine, height(place.x, place.y)) + eye_height, place.y);
    }
  }
  return eyes;
}

void LineOfSight::find(int cell, int eyes_per_side, Sets& sets) const {
  const CellGrid& cells = sets.cells;
  const glm::ivec2 low = glm::ivec2(cell % cells.columns, cell / cells.columns) * cells.side;
  const glm::ivec2 high = glm::min(low + cells.side, glm::ivec2(ground_.width - 1, ground_.depth - 1));
  const std::vector<glm::vec3> eyes = eyes_in(low, high, eyes_per_side, sets.eye_height);
  const glm::ivec2 last = index_at(static_cast<float>(ground_.width), static_cast<float>(ground_.depth));
  for (int z = 0; z <= last.y; ++z) {
    for (int x = 0; x <= last.x; ++x) {
      const Square p = square({x, z});
      add_seen(p, {x, z}, eyes, cell, sets);
      const bool under_cell =
          p.low.x < static_cast<float>(high.x) && p.low.x + p.size.x > static_cast<float>(low.x) &&
          p.low.y < static_cast<float>(high.y) && p.low.y + p.size.y > static_cast<float>(low.y);
      for (int half = 0; under_cell && half < 2; ++half) sets.add(cell, squares_.element({x, z}, half));
    }
  }
}

}  // namespace terrabench::mrbsp::visibility
