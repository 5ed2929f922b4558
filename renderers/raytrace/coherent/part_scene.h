// A scene whose parts exist only while rays need them, for memory-coherent ray tracing (Pharr, Kolb,
// Gershbein and Hanrahan 1997). All that is known of a part beforehand is a box around it.
#pragma once

#include <functional>
#include <glm/mat4x4.hpp>
#include <vector>

#include "renderers/raytrace/ray_scene.h"
#include "terrain/memory.h"

namespace terrabench {

// The triangles of a part and their index.
struct RayPart {
  TriangleMesh mesh;                // with or without normals
  std::vector<glm::vec2> texture;   // per position, or empty
  std::vector<std::uint32_t> tags;  // per triangle, or empty: what the scene's material is told
  RayIndex index;

  // Throws as RayIndex; bad_input for arrays of a wrong size.
  RayPart(TriangleMesh, std::vector<glm::vec2> texture, std::vector<std::uint32_t> tags);
  RayPart(const RayPart&) = delete;
  RayPart& operator=(const RayPart&) = delete;

  Memory memory() const;      // on the heap, without Embree's bytes
  std::size_t bytes() const;  // with them

  // What Embree takes on the heap for an index besides the bytes that it reports. Measured at the first call,
  // while no other thread may allocate.
  static std::size_t index_objects();
};

// Neither copied nor changed while it is traced.
struct PartScene {
  struct Placement {
    Bounds box;  // in the world; what lies outside is not seen
    glm::mat4 to_world{1};
  };
  std::vector<Placement> parts;
  // Calls use() with the part, which must stay while use() runs. The same part has the same triangles every
  // time. Called from many threads at once.
  std::function<void(std::uint32_t part, const std::function<void(const RayPart&)>& use)> open;
  // SurfacePoint::instance is the part and SurfacePoint::mesh the triangle's tag. Called from many threads.
  std::function<RayMaterial(const SurfacePoint&)> material;
  Daylight light{};
};

}  // namespace terrabench
