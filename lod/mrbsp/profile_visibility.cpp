#include "lod/mrbsp/profile_visibility.h"

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>

#include "terrain/error.h"
#include "terrain/files.h"

namespace terrabench {
namespace {

constexpr int kEyes = 2;  // a cell, in the middles of equal parts

float height_at(std::span<const float> heights, float step, float x) {
  const auto k = std::min(static_cast<std::size_t>(x / step), heights.size() - 2);
  const float t = x / step - static_cast<float>(k);
  return heights[k] * (1 - t) + heights[k + 1] * t;
}

// Is the way from an eye to a coarse vertex free of the coarse profile? Grazing it is free.
bool clear(std::span<const float> coarse, float step, glm::vec2 eye, std::size_t vertex) {
  constexpr float kSlack = 1e-5F;
  const glm::vec2 to(static_cast<float>(vertex) * step, coarse[vertex]);
  for (std::size_t k = 0; k < coarse.size(); ++k) {
    const float x = static_cast<float>(k) * step;
    if (x <= std::min(eye.x, to.x) || x >= std::max(eye.x, to.x)) continue;
    const float sight = eye.y + (to.y - eye.y) * (x - eye.x) / (to.x - eye.x);
    if (coarse[k] > sight + kSlack) return false;
  }
  return true;
}

}  // namespace

const ProfileScene& table1_profile() {
  // Two valleys between a ridge in the middle and higher rims. From a rim (cells a and h) the far rim shows
  // above the ridge, and from nowhere else the valley beyond.
  static const ProfileScene kProfile{{10.0F, 7.9F, 4.6F, 2.2F, 0.0F, 1.7F, 4.9F, 6.4F, 9.0F, 7.1F, 4.2F, 2.6F,
                                      0.0F, 2.9F, 5.4F, 7.2F, 10.0F},
                                     4,
                                     2,
                                     8,
                                     0.0F};
  return kProfile;
}

VisibleSets find_visible(const ProfileScene& profile) {
  const int segments = 1 << profile.depth;
  if (profile.depth < 1 || profile.depth > 16 || profile.coarse_depth < 1 ||
      profile.coarse_depth > profile.depth || profile.cells < 1 || segments % profile.cells != 0 ||
      profile.heights.size() != static_cast<std::size_t>(segments) + 1) {
    throw usage_error("the profile's heights, depths and cells do not fit each other", "",
                      "give 2^depth + 1 heights, no deeper coarse segments, and cells of whole segments");
  }
  const int stride = segments >> profile.coarse_depth;
  const auto step = static_cast<float>(stride);
  std::vector<float> coarse;
  for (int k = 0; k <= segments; k += stride) coarse.push_back(profile.heights[static_cast<std::size_t>(k)]);

  const int side = segments / profile.cells;
  VisibleSets sets({profile.cells, 1, side}, profile.coarse_depth, profile.eye_height);
  const std::string name = checksum(std::as_bytes(std::span(profile.heights)));
  std::copy_n(name.begin(), sets.surface.size(), sets.surface.begin());
  for (int cell = 0; cell < profile.cells; ++cell) {
    for (int e = 0; e < kEyes; ++e) {
      const float share = (static_cast<float>(e) + 0.5F) / static_cast<float>(kEyes);
      const float x = (static_cast<float>(cell) + share) * static_cast<float>(side);
      const float ground = std::max(height_at(profile.heights, 1, x), height_at(coarse, step, x));
      const glm::vec2 eye(x, ground + profile.eye_height);
      for (std::uint32_t s = 0; s + 1 < coarse.size(); ++s) {
        const float begin = static_cast<float>(s) * step;
        const bool under =
            begin < static_cast<float>((cell + 1) * side) && begin + step > static_cast<float>(cell * side);
        const float line = coarse[s] + (coarse[s + 1] - coarse[s]) * (x - begin) / step;
        const bool faces = eye.y > line;
        if (under || (faces && (clear(coarse, step, eye, s) || clear(coarse, step, eye, s + 1)))) {
          sets.add(cell, s);
        }
      }
    }
  }
  return sets;
}

}  // namespace terrabench
