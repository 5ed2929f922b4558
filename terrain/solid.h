// Space: boxes, rays, and a volumetric source, a predicate that says which material fills a point.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace terrabench {

// The material of a point. Air is 0, so that a byte grid set to zero is empty; numbers above bedrock are free
// for further materials.
enum class Material : std::uint8_t { kAir = 0, kBedrock = 1 };

inline bool is_finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

struct Bounds {
  glm::vec3 low{0}, high{0};  // metres
  glm::vec3 size() const { return high - low; }
  // k = 0 … 7: bit 0 chooses x, bit 1 y, bit 2 z.
  glm::vec3 corner(int k) const {
    return {(k & 1) != 0 ? high.x : low.x, (k & 2) != 0 ? high.y : low.y, (k & 4) != 0 ? high.z : low.z};
  }
};

// Part of a half-line in space.
struct Ray {
  glm::vec3 origin{0};     // metres
  glm::vec3 direction{0};  // of any length but zero; distances are in its lengths
  float near = 0, far = std::numeric_limits<float>::infinity();
};

// Points (x, y0 + i·dy, z), i = 0 … n-1: the samples of one vertical line, bottom up.
struct ColumnSamples {
  float x, z, y0, dy;
};

struct Solid {
  Bounds bounds;         // nothing is solid outside, except that the ground continues below
  std::string checksum;  // of what defines the solid (graph, seed), 32 hex digits
  // Writes the materials of the samples: a whole column per call, so that the indirect call is paid once.
  // Thread-safe. The same samples give the same answer on every machine.
  std::function<void(const ColumnSamples&, std::span<Material>)> column;
};

}  // namespace terrabench
