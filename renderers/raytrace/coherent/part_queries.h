// Closest hits and visibility of many rays among parts that are expanded on demand. Rays are not traced one
// after the other but queued at the parts that they enter next, so that a part is opened once for all rays
// that wait for it (Pharr et al. 1997, §3): what is expanded again for lack of memory stays bounded by the
// rounds of a batch, not by its rays.
#pragma once

#include <functional>
#include <glm/mat4x4.hpp>
#include <span>
#include <vector>

#include "renderers/raytrace/coherent/box_tree.h"
#include "renderers/raytrace/ray_scene.h"
#include "terrain/memory.h"

namespace terrabench {

// A scene whose parts exist only while rays need them, for memory-coherent ray tracing (Pharr, Kolb,
// Gershbein and Hanrahan 1997). All that is known of a part beforehand is a box around it.

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

// What is kept of a hit when its part is closed again.
struct PartHit {
  float distance = std::numeric_limits<float>::infinity();  // in lengths of the ray's direction
  glm::vec3 facet{0};  // of unit length, on the side from which the ray comes, as is point.normal
  float offset = 0;    // metres by which rays start off the facet
  SurfacePoint point;  // `instance`: the part; `mesh`: the tag
  bool hit() const { return distance < std::numeric_limits<float>::infinity(); }
};

class PartQueries {
 public:
  explicit PartQueries(const PartScene&);  // which must outlive it

  // Both spans have the same size. In parallel; equal for every number of threads and every order in which
  // parts are opened: a ray visits its parts from near to far, and a hit ends its way. Throws what the
  // scene's open() throws, and Error(kInterrupted).
  void closest(std::span<const Ray> rays, std::span<PartHit> hits) const;
  // 1 where anything lies in [near, far] of the ray.
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const;

 private:
  // Lets each ray visit the parts on its way: visit(part opened, its number, the ray's number, how far it
  // looks) returns how far the ray looks from then on, below 0 to end it.
  template <class Visit>
  void run(std::span<const Ray> rays, const Visit& visit) const;

  const PartScene& scene_;
  BoxTree tree_;
  std::vector<glm::mat4> to_local_;
};

}  // namespace terrabench
