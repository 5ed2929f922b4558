// The ground plane of a grounded heightmap (Alonso, Joan-Arinyo & Solano, figure 11): where its cells are and
// in which direction their heights are measured. Locating a cell is O(1).
//
// The paper gives a plane by a point and a normal vector, with an axis-aligned array. Here the two directions
// of the array are stored too, because events run in any direction, and heights need not be measured at right
// angles to them: all outdoor planes measure heights vertically, so that a cell keeps the height of the
// ground it was taken from and only the plane moves it. Measured along the plane's normal, a cell of height r
// would shift sideways by r·sin(inclination), and neighbouring planes would overlap or gape by that much.
#pragma once

#include <glm/vec3.hpp>

namespace terrabench::ght {

struct GroundPlane {
  glm::vec3 origin{0};
  glm::vec3 u{1, 0, 0};       // from column to column, metres
  glm::vec3 v{0, 0, 1};       // from row to row, metres
  glm::vec3 taper{0};         // added to u per row: the rows of a trapezium have equally many cells
  glm::vec3 height{0, 1, 0};  // unit vector of heights

  glm::dvec3 at(double i, double j, double h) const {
    return glm::dvec3(origin) + i * (glm::dvec3(u) + j * glm::dvec3(taper)) + j * glm::dvec3(v) +
           h * glm::dvec3(height);
  }
  bool operator==(const GroundPlane&) const = default;
};

}  // namespace terrabench::ght
