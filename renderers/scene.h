// Pictures as papers draw structures: meshes lit, as wireframes with their hidden lines removed, or both,
// with planes and lines beside them. relief.h is the short way to one lit mesh.
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
  kLit,   // sun and sky, coloured by height or by vertex
  kFlat,  // all of `fill`: under wires, it hides the lines behind
};

struct SceneMesh {
  const TriangleMesh* mesh = nullptr;  // outlives the drawing; without normals its facets show
  Shading shading = Shading::kLit;
  Rgb fill{255, 255, 255};
  std::vector<Rgb> colors{};  // one a vertex, for kLit; empty: by height, and backs of triangles grey
  // How much steeper the light takes slopes to be than they are; shape and outline stay true. 0 chooses by
  // the mesh: 1 for steep ground, more for gentle, whose relief would not show.
  float shading_exaggeration = 0;

  float wire_width = 0;  // pixels; 0 draws no wires
  Rgb wire_color{13, 13, 15};
  float wire_opacity = 1;
  // Which edges are wires, one byte a triangle: bit k for the edge from its corner k to the next. Empty: all.
  // quad_wires() leaves out diagonals. Where the surface turns away from the eye its outline is drawn too.
  std::vector<std::uint8_t> wires{};
};

// A convex plane, such as the ground plane of a heightmap: a fill to see through and an outline, both hidden
// where a mesh stands before them.
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
  glm::vec3 sun{-0.5F, 0.7F, -0.5F};  // towards the light: from the north-west, the cartographers' convention
  Rgb background{255, 255, 255};
};

// The box around everything in the scene; overview() makes a view of it. O(vertices).
Bounds bounds_of(const Scene&);

// Draws with 4x multisampling into view.width × view.height, which the context's picture takes as its size;
// the context is current afterwards. The depth range is the scene's, not the view's. The same scene and view
// give the same bytes whatever the number of threads. O(triangles + pixels), with wires O(triangles log
// triangles).
Image render_scene(GlContext&, const Scene&, const View&);

// For SceneMesh::wires: all edges but the diagonals of four-sided cells, that is, those that are the longest
// edge of both triangles beside them, seen from above (upright triangles: from the side). O(triangles log
// triangles).
std::vector<std::uint8_t> quad_wires(const TriangleMesh&);

}  // namespace terrabench
