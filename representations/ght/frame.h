// The ground plane of a grounded heightmap (Alonso, Joan-Arinyo & Solano, figure 11): where its cells stand
// and which way their heights go. Evaluating a cell is O(1).
//
// The paper gives a plane by a point and a direction vector, and its array is axis aligned. Here the array's
// two directions are kept too, as events run any way, and the direction of heights need not be square to
// them: all outdoor planes measure upright, so that the height in a cell is that of the ground it came from
// and the plane alone says what became of it. Along each plane's own normal a cell of relief r would shift by
// r·sin(inclination) sideways, and neighbouring planes would overlap or gape by as much.
#pragma once

#include <glm/vec3.hpp>

namespace terrabench::ght {

struct Frame {
  glm::vec3 origin{0};
  glm::vec3 u{1, 0, 0};       // from column to column, metres
  glm::vec3 v{0, 0, 1};       // from row to row
  glm::vec3 taper{0};         // by which u grows from row to row: rows of a trapezium have as many cells
  glm::vec3 height{0, 1, 0};  // a metre of height

  glm::dvec3 at(double i, double j, double h) const {
    return glm::dvec3(origin) + i * (glm::dvec3(u) + j * glm::dvec3(taper)) + j * glm::dvec3(v) +
           h * glm::dvec3(height);
  }
  bool operator==(const Frame&) const = default;
};

}  // namespace terrabench::ght
