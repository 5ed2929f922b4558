// What the tests of the hybrid method share: eyes around the meso ground, and its surface's edges.
#pragma once

#include <array>
#include <bit>
#include <map>
#include <random>
#include <vector>

#include "lod/hybrid/hybrid.h"
#include "tests/lod/drawing.h"
#include "tests/lod/meso_ground.h"

namespace terrabench::test {

// At walking height at a place, looking along `heading` (radians).
inline View standing(const Heightfield& field, float x, float z, float heading, float above = 1.8F) {
  View view;
  view.eye = {x, field.sample(x, z) + above, z};
  view.target = view.eye + glm::vec3(std::cos(heading), -0.2F, std::sin(heading));
  view.near = 0.1F;
  view.far = 1000;
  view.width = 200;
  view.height = 150;
  return view;
}

// So wide a view down that nothing is culled, from above everything; for options with this height.
inline constexpr double kAboveAll = 200;
inline View everything_from(float x, float z) {
  View view;
  view.eye = {x, 100, z};
  view.target = {x, 0, z};
  view.up = {0, 0, -1};
  view.vertical_fov = 3.1415F;
  view.width = view.height = 100;
  view.near = 0.001F;
  view.far = 1e5F;
  return view;
}

inline std::vector<glm::vec2> random_places(const Heightfield& field, int n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> x(0, field.extent_x()), z(0, field.extent_z());
  std::vector<glm::vec2> places;
  for (int k = 0; k < n; ++k) places.emplace_back(x(random), z(random));
  return places;
}

using Bits = std::array<std::uint32_t, 3>;
inline Bits bits_of(const glm::vec3& p) {
  return {std::bit_cast<std::uint32_t>(p.x + 0.0F), std::bit_cast<std::uint32_t>(p.y + 0.0F),
          std::bit_cast<std::uint32_t>(p.z + 0.0F)};
}

// The edges that triangles have more often in one direction than in the other, by the bits of their ends.
// Not the meter's code.
inline std::vector<std::array<glm::vec3, 2>> unpaired_edges(const Frame& frame) {
  struct Count {
    int times = 0;
    std::array<glm::vec3, 2> ends;
  };
  std::map<std::array<Bits, 2>, Count> counts;
  triangles(frame, [&](std::span<const glm::vec3> corners) {
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const glm::vec3 from = corners[k], to = corners[k % 3 == 2 ? k - 2 : k + 1];
      const bool swap = bits_of(to) < bits_of(from);
      Count& count =
          counts[swap ? std::array{bits_of(to), bits_of(from)} : std::array{bits_of(from), bits_of(to)}];
      count.times += swap ? -1 : 1;
      count.ends = {from, to};
    }
  });
  std::vector<std::array<glm::vec3, 2>> unpaired;
  for (const auto& [key, count] : counts) {
    if (count.times != 0) unpaired.push_back(count.ends);
  }
  return unpaired;
}

inline bool on_border(const Heightfield& field, const glm::vec3& p) {
  return p.x == 0 || p.z == 0 || p.x == field.extent_x() || p.z == field.extent_z();
}

inline std::size_t openings_inside(const Heightfield& field, const Frame& frame) {
  std::size_t inside = 0;
  for (const auto& [from, to] : unpaired_edges(frame)) {
    inside += on_border(field, from) && on_border(field, to) ? 0 : 1;
  }
  return inside;
}

}  // namespace terrabench::test
