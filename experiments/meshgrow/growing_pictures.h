// Polygon meshes as the figures of §4 and §5 of "meshgrow" show them: faces with words on them.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "experiments/figures/sheet.h"
#include "renderers/context.h"
#include "representations/procedural_mesh/face_mesh.h"
#include "terrain/mesh.h"
#include "terrain/view.h"

namespace terrabench::meshgrow {

// Polygons as fans around their first corners, which suits convex ones.
struct Fans {
  TriangleMesh mesh;                 // without normals
  std::vector<std::uint8_t> wires;   // the polygons' edges, as in SceneMesh
  std::vector<std::uint32_t> faces;  // per triangle: its polygon
};
Fans fans_of(const FaceMesh&);

glm::vec3 middle_of(const FaceMesh&, std::uint32_t face);

// Faces in flat colours under a light from the upper left, with their edges. O(faces · pixels)
Image face_picture(GlContext&, const FaceMesh&, const View&, const std::function<Rgb(std::uint32_t face)>&);

// A picture on a sheet, for what is drawn over it.
class OverPicture {
 public:
  // The place of the picture's upper left corner; the picture has Sheet::kPixels pixels per unit.
  OverPicture(const FaceMesh&, const View&, figures::SheetPoint corner);
  figures::SheetPoint at(const glm::vec3&) const;
  // Whether no face hides the point. A point on a face is visible when the face is.
  bool visible(const glm::vec3&) const;

 private:
  TriangleMesh mesh_;
  View view_;
  figures::SheetPoint corner_;
};

// With a head at `to`, `head` units long.
void add_arrow(figures::Sheet&, figures::SheetPoint from, figures::SheetPoint to, Rgb, double thickness,
               double head);
// Words on a white plate.
void add_label(figures::Sheet&, figures::SheetPoint, std::string_view words, int size, Rgb,
               double half_width);

}  // namespace terrabench::meshgrow
