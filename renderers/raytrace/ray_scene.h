// What the ray tracer draws: triangle meshes with materials, placed once or many times, in daylight.
//
// Colours are linear-light sRGB. Both sides of triangles are visible and have the same material, so leaves
// need no thickness. A scene refers to the caller's arrays, which must outlive it.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "renderers/raytrace/ray_index.h"
#include "renderers/raytrace/sky.h"

namespace terrabench {

struct RayMaterial {
  glm::vec3 albedo{0.5F};  // 0 to 1: the share of light reflected (of metal: straight from the front)
  float translucency = 0;  // 0 to 1: the share of diffuse light that leaves on the other side, as of leaves
  float specular = 0;      // 0 to 1: mirrored share straight from the front; 0.04 for paint or wet rock
  float metal = 0;         // 0 to 1: 1 mirrors with the albedo's colour and has no diffuse light
  float roughness = 0.5F;  // 0 to 1: of the mirroring (GGX, alpha = roughness²); at least 0.6 in reflections
};

// A place on a surface, for materials that vary over it.
struct SurfacePoint {
  glm::vec3 position{0}, normal{0};  // in the world; the normal is of unit length, on the triangle's front
  glm::vec3 local{0};                // the position in the mesh
  glm::vec2 texture{0};              // zero for a mesh without texture coordinates
  std::uint32_t mesh = 0, instance = 0, triangle = 0;
};

struct RayMesh {
  const TriangleMesh* mesh = nullptr;  // without normals, facets are flat
  RayMaterial material{};
  std::span<const glm::vec2> texture{};  // per position, or empty
  // In place of `material`; called from many threads at once.
  std::function<RayMaterial(const SurfacePoint&)> material_at{};

  float wire_width = 0;  // pixels; 0 draws no wires
  glm::vec3 wire_color{0.004F, 0.004F, 0.005F};
  float wire_opacity = 1;
  // Which edges are wires, one byte per triangle: bit k for the edge from corner k to the next. Empty: all.
  std::span<const std::uint8_t> wires{};
};

struct RayScene {
  std::vector<RayMesh> meshes{};
  std::vector<MeshPlacement> instances{};  // a mesh without any is not drawn
  Daylight light{};
  // The picture's colour where the eye would see the sky, 0 to 1; no light. Such as white for print.
  std::optional<glm::vec3> background{};

  // Adds a mesh and returns its number; adds one that stands where its positions are.
  std::uint32_t add(RayMesh mesh);
  std::uint32_t add_placed(RayMesh mesh);
};

// Throws bad_input for arrays of a wrong size, values out of the ranges above, and what RayIndex refuses.
// O(n), parallel.
void check_scene(const RayScene&);

// A square of ground around the middle of the box in plan, at its lowest height or at `height`, whose sides
// are `times` the longer side of the box. Two triangles.
TriangleMesh ground_plane(const Bounds&, float times = 100, std::optional<float> height = {});

// A terrain's mesh as a ray-traced relief for print: coloured by height with ramp.h's colours, steep sides in
// rock grey, in a clear day's light on white paper.
// `lowest` and `highest`: metres at the ends of the colour ramp. The scene refers to the mesh.
RayScene relief_scene(const TriangleMesh&, float lowest, float highest);

}  // namespace terrabench
