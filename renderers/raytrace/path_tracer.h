// Follows light from the eye through a scene: sunlight by a shadow ray at each surface, sky light and light
// from other surfaces along one sampled direction (Kajiya 1986).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "renderers/raytrace/ray_index.h"
#include "renderers/raytrace/ray_scene.h"
#include "renderers/raytrace/sample_sequence.h"
#include "renderers/raytrace/scattering.h"
#include "renderers/raytrace/sky.h"
#include "renderers/raytrace/sun.h"
#include "terrain/progress.h"

namespace terrabench {

struct RaytraceSettings {
  int samples = 64;  // per pixel, 1 to 65536
  int bounces = 2;   // 0 to 64: reflections between surfaces before the light of sun or sky
  std::uint32_t seed = 1;
};

class PathTracer {
 public:
  // Checks and indexes the scene, which must stay unchanged for as long as the tracer lives. Throws
  // usage_error for settings out of range, and as check_scene() and RayIndex do.
  PathTracer(const RayScene&, const RaytraceSettings&, Progress* = nullptr);

  RayHit closest(const Ray& ray) const { return index_.closest(ray); }
  // What the eye sees along a ray of unit length that hits `hit`, by one random path. O(bounces) rays.
  glm::vec3 radiance(const Ray& from_eye, const RayHit& hit, SampleSequence&) const;

  const RayScene& scene() const { return scene_; }
  const RayIndex& index() const { return index_; }

 private:
  struct Surface {
    SurfacePoint point;
    glm::vec3 facet, normal;  // of unit length, on the eye's side
    float offset;             // metres by which rays start off the facet
  };
  Surface surface(const Ray&, const RayHit&) const;
  RayMaterial material(const Surface&, const RayHit&) const;
  Ray ray_from(const Surface&, const glm::vec3& direction) const;
  glm::vec3 sunlight(const Surface&, const Scattering&, SampleSequence&) const;

  const RayScene& scene_;
  RaytraceSettings settings_;
  RayIndex index_;
  Sky sky_;
  Sun sun_;
};

}  // namespace terrabench
