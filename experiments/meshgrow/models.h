// The models of "meshgrow" as triangles with materials, for ray-traced pictures (§6).
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "renderers/raytrace/ray_scene.h"
#include "representations/procedural_mesh/model.h"
#include "terrain/mesh.h"
#include "terrain/view.h"

namespace terrabench::meshgrow {

struct ModelMesh {
  TriangleMesh mesh;  // with normals
  std::vector<glm::vec2> texture;
  std::vector<std::uint32_t> symbols;  // per triangle
  std::vector<std::uint8_t> wires;     // per triangle: the edges of the polygons, as in RayMesh
};

// Each polygon becomes a fan of triangles around a corner; a quadrilateral is cut along its shorter diagonal.
// Vertices at sharp edges become several, with a normal each. O(corners), and at each
// vertex O(triangles²), of which most vertices have six.
ModelMesh triangles_of(const FaceMesh&);

// A model with what its surfaces look like.
struct PaintedModel {
  std::string_view model;  // as in model_names()
  // `symbol` is the name of the face's symbol, empty for none.
  RayMaterial (*material)(std::string_view symbol, const SurfacePoint&);
};
const PaintedModel& painted(std::string_view model);  // throws unknown_name

// The model's mesh in its materials; refers to all arguments. `system` names the symbols.
RayMesh in_materials(const ModelMesh&, const PaintedModel&, const growing::RuleSystem& system);

// overview() frames a box; this frames the points, seen along the same direction. `margin`: size of the
// picture per size of what it frames.
View close_view(std::span<const glm::vec3> points, View, float margin = 1.1F);

// A clear day with the sun on the left, in front of the model; its shadows have soft edges.
Daylight model_daylight();

}  // namespace terrabench::meshgrow
