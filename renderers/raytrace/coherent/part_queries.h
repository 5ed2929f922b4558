// Closest hits and visibility of many rays among parts that are expanded on demand. Rays are not traced one
// after the other but queued at the parts that they enter next, so that a part is opened once for all rays
// that wait for it (Pharr et al. 1997, §3): what is expanded again for lack of memory stays bounded by the
// rounds of a batch, not by its rays.
#pragma once

#include <span>
#include <vector>

#include "renderers/raytrace/coherent/box_tree.h"
#include "renderers/raytrace/coherent/part_scene.h"

namespace terrabench {

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
