// Closest hits and visibility of arbitrary rays on triangle meshes, by Embree 3 (Wald et al. 2014): the ray
// tracer's geometry, and a packaged peer for ray casting. The only file that includes Embree is
// ray_index.cpp.
//
// A mesh is indexed once; each placement costs a few hundred bytes whatever its mesh has. Embree takes about
// 60 to 100 bytes per triangle and copies the positions; indices are shared with the mesh.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <span>
#include <string>

#include "terrain/mesh.h"
#include "terrain/progress.h"
#include "terrain/solid.h"

namespace terrabench {

struct RayHit {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  float distance = std::numeric_limits<float>::infinity();  // in lengths of the direction
  float u = 0, v = 0;  // barycentric: (1 - u - v)·a + u·b + v·c of the triangle's corners
  std::uint32_t placement = kNone, triangle = kNone;
  bool hit() const { return placement != kNone; }
  template <class T>
  T interpolate(std::span<const T> values, const std::uint32_t* corners) const {
    return (1 - u - v) * values[corners[0]] + u * values[corners[1]] + v * values[corners[2]];
  }
};

struct MeshPlacement {
  std::uint32_t mesh = 0;  // index into the meshes
  glm::mat4 to_world{1};   // affine; the identity costs nothing when a ray is traced
};

class RayIndex {
 public:
  // The meshes must stay unchanged for as long as the index lives. Throws bad_input for a mesh that
  // check_mesh() refuses or a transform that is not finite, affine and invertible; environment_error without
  // a device or when memory is too small; Error(kInterrupted) after Progress::interrupt(). O(triangles log
  // triangles).
  RayIndex(std::span<const TriangleMesh* const> meshes, std::span<const MeshPlacement> placements,
           Progress* = nullptr);
  explicit RayIndex(const TriangleMesh&, Progress* = nullptr);  // one mesh, placed where it is
  // The same for one of very many indices that exist at once. Each other index has a device of its own, and
  // Embree keeps a thread-local key per device, of which a process has 1024. Threads may call it at once.
  static RayIndex on_shared_device(const TriangleMesh&);
  ~RayIndex();
  RayIndex(RayIndex&&) noexcept;
  RayIndex& operator=(RayIndex&&) noexcept;

  // Both sides of triangles count. A ray that is not finite, or has no direction, hits nothing. Equal for
  // every number of threads. Thread-safe. O(log triangles).
  RayHit closest(const Ray&) const;
  bool occluded(const Ray&) const;  // whether anything lies in [near, far]
  // A batch, in parallel. Both spans have the same size.
  void closest(std::span<const Ray>, std::span<RayHit>) const;

  // Metres from a point to the nearest triangle of `mesh`, the only one of this index. Thread-safe. O(log
  // triangles) near the mesh.
  float distance(const glm::vec3& point, const TriangleMesh& mesh) const;

  std::uint64_t bytes() const;          // held by Embree
  static std::string embree_version();  // "3.13.5"

 private:
  RayIndex();
  struct Embree;
  std::unique_ptr<Embree> embree_;
};

// Throws bad_input, with `where` and the first element at fault, if positions are not finite, normals are
// neither none nor one finite vector per position, or indices are not triples of positions. O(n), parallel.
void check_mesh(const TriangleMesh&, std::string_view where);

}  // namespace terrabench
