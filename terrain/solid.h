// A volumetric source: a predicate in space that says which material fills a point.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>

namespace terrabench {

// The material of a point. Air is 0, so that a byte grid set to zero is empty; numbers above bedrock are free
// for further materials.
enum class Material : std::uint8_t { kAir = 0, kBedrock = 1 };
std::string_view name(Material);

struct Bounds {
  glm::vec3 low{0}, high{0};  // metres
  glm::vec3 size() const { return high - low; }
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
