// Renders meshes the way papers draw structures: lit, as wireframes with hidden lines removed, or both,
// together with planes and lines. For a single lit mesh, render_relief() is shorter.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "renderers/context.h"
#include "terrain/image.h"
#include "terrain/mesh.h"
#include "terrain/view.h"

namespace terrabench {

enum class Shading : std::uint8_t {
  kLit,   // by sun and sky, coloured by height or per vertex
  kFlat,  // the colour `fill` everywhere; with wires: a hidden-line drawing
};

struct SceneMesh {
  const TriangleMesh* mesh = nullptr;  // must outlive the call; without normals, facets are lit flat
  Shading shading = Shading::kLit;
  Rgb fill{255, 255, 255};
  std::vector<Rgb> colors{};  // per vertex, for kLit; empty: by height, with grey backs of triangles
  // Factor by which slopes are steepened for the light only. 0: chosen by choose_exaggeration(), 1 for steep
  // ground and more for gentle ground, whose relief would not be visible.
  float shading_exaggeration = 0;

  float wire_width = 0;  // pixels; 0 draws no wires
  Rgb wire_color{13, 13, 15};
  float wire_opacity = 1;
  // Which edges are wires, one byte per triangle: bit k for the edge from corner k to the next. Empty: all.
  // See quad_wires(). Silhouette edges, where the surface turns away from the eye, are always drawn.
  std::vector<std::uint8_t> wires{};
};

// A convex polygon, such as the ground plane of a heightmap: a translucent fill and an outline, both hidden
// behind meshes.
struct ScenePlane {
  std::vector<glm::vec3> corners;  // three or more, in order
  Rgb color{40, 90, 180};
  float fill_opacity = 0.15F;
  float line_width = 1.5F;  // pixels
};

struct SceneLine {
  std::vector<glm::vec3> points;  // two or more
  Rgb color{13, 13, 15};
  float width = 1.5F;  // pixels
};

struct Scene {
  std::vector<SceneMesh> meshes{};
  std::vector<ScenePlane> planes{};
  std::vector<SceneLine> lines{};
  float lowest = 0, highest = 1;      // metres at the two ends of the colour ramp
  glm::vec3 sun{-0.5F, 0.7F, -0.5F};  // towards the light; by cartographers' convention from the north-west
  Rgb background{255, 255, 255};
};

// The bounding box of the scene, for overview(). O(vertices).
Bounds bounds_of(const Scene&);

// Draws with 4x multisampling and resizes the context's picture to view.width × view.height; the context is
// current afterwards. Replaces the view's depth range by that of the scene. The same scene and view give the
// same bytes for any number of threads. O(triangles + pixels), with wires O(triangles log triangles).
Image render_scene(GlContext&, const Scene&, const View&);

// For SceneMesh::wires: all edges except the diagonals of quadrilateral cells. An edge is taken for a
// diagonal if it is the longest edge of both its triangles in plan (of vertical triangles: in side view).
// O(triangles log triangles).
std::vector<std::uint8_t> quad_wires(const TriangleMesh&);

// Shaded relief: a lit mesh, coloured by height, as in papers and atlases. Level ground in the sun has
// exactly the ramp's colour (ramp.h), so that it can be compared with a legend.
struct ReliefStyle {
  float lowest = 0, highest = 1;      // metres at the two ends of the colour ramp
  glm::vec3 sun{-0.5F, 0.7F, -0.5F};  // towards the light; by cartographers' convention from the north-west
  Rgb background{255, 255, 255};
  float shading_exaggeration = 0;  // as in SceneMesh
};

// render_scene() of one lit mesh. A mesh without normals has flat facets, one without triangles gives the
// background; backs of triangles are grey. O(triangles + pixels).
Image render_relief(GlContext&, const TriangleMesh&, const View&, const ReliefStyle&);

}  // namespace terrabench
