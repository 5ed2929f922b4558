// Ground and views for the tests of the bisection tree.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>

#include "tests/lod/drawing.h"

namespace terrabench {

using test::silent;

// A deterministic number in [0, 1) for a key.
inline float random_share(std::uint32_t key) {
  key = (key ^ (key >> 16)) * 0x7FEB352DU;
  key = (key ^ (key >> 15)) * 0x846CA68BU;
  return static_cast<float>((key ^ (key >> 16)) >> 8) / 16777216.0F;
}

// Hills with noise: nowhere flat, with valleys that are hidden from far away.
inline Heightfield rough_ground(int width, int depth, float relief = 40.0F) {
  const auto rough = [=](int i, int j) {
    const auto x = static_cast<float>(i), z = static_cast<float>(j);
    const float noise = random_share(static_cast<std::uint32_t>(j * 7919 + i));
    return relief * (std::sin(0.35F * x) * std::cos(0.27F * z) + 0.2F * noise);
  };
  return test::ground_of(width, depth, rough, 5, 4);
}

// The view of an observer 1.8 m above the ground; the position is a fraction of the ground's extent.
inline View walker(const Heightfield& field, float share_x, float share_z, float heading) {
  View view;
  const float x = share_x * field.extent_x(), z = share_z * field.extent_z();
  view.eye = {x, field.sample(x, z) + 1.8F, z};
  view.target = view.eye + glm::vec3(std::sin(heading), -0.05F, std::cos(heading));
  view.far = 4 * (field.extent_x() + field.extent_z());
  return view;
}

}  // namespace terrabench
