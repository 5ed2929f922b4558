// Meshes that the tests draw.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>

#include "terrain/mesh.h"

namespace terrabench::testing {

// (n + 1)² vertices over [0, size]² with y = height(x, z).
inline TriangleMesh ground(int n, float size, const std::function<float(float, float)>& height) {
  TriangleMesh mesh;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const float x = size * static_cast<float>(i) / static_cast<float>(n);
      const float z = size * static_cast<float>(j) / static_cast<float>(n);
      mesh.positions.emplace_back(x, height(x, z), z);
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const auto a = static_cast<std::uint32_t>(j * (n + 1) + i), b = a + 1;
      const auto c = a + static_cast<std::uint32_t>(n + 1), d = c + 1;
      mesh.indices.insert(mesh.indices.end(), {a, c, b, b, c, d});
    }
  }
  compute_normals(mesh);
  return mesh;
}

inline void append(TriangleMesh& to, const TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(to.positions.size());
  to.positions.insert(to.positions.end(), mesh.positions.begin(), mesh.positions.end());
  to.normals.insert(to.normals.end(), mesh.normals.begin(), mesh.normals.end());
  for (const std::uint32_t index : mesh.indices) to.indices.push_back(first + index);
}

// Octaves of rotated waves, from 0 to about 1000 m for size 10 km.
inline float hills(float x, float z) {
  float height = 0, amplitude = 260, frequency = 6.0e-4F;
  for (int octave = 0; octave < 7; ++octave) {
    height += amplitude * (1 - std::abs(std::sin(x * frequency + 1.7F * static_cast<float>(octave)) *
                                        std::cos(z * frequency * 1.13F + 0.9F * static_cast<float>(octave))));
    const float turned = 0.8F * x - 0.6F * z;
    z = 0.6F * x + 0.8F * z + 900;
    x = turned;
    amplitude *= 0.47F;
    frequency *= 1.93F;
  }
  return height;
}

}  // namespace terrabench::testing
