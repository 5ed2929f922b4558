// Linear erosion (Alonso, Joan-Arinyo & Solano, §3.2, figure 13): four heightmaps, two sides and two ends of
// a trench. Sides are trapezia whose rows taper towards the bottom edge, ends are triangles on a square
// array; both have equally many rows, so that they share the hips between them.
#include <algorithm>
#include <cmath>

#include "representations/ght/along_line.h"
#include "representations/ght/apply_event.h"

namespace terrabench::ght {
namespace {

struct LinearErosionMaps {
  events::Line line;
  double width, depth;  // metres; width in plan, of a side
  int rows, columns;    // steps of a side outwards and along the line
  GroundedHeightmap left{}, right{}, from{}, to{};

  double step() const { return width / rows; }  // metres in plan from row to row
};

// On the left (sign 1) or right (-1) of the bottom edge, rows outwards.
GroundedHeightmap append_side(Edit& edit, const LinearErosionMaps& maps, int sign) {
  const double step = maps.step();
  return append_along(edit, maps.line, maps.columns, maps.rows,
                      {.origin = {0, 0, -maps.depth},
                       .column = {maps.line.length / maps.columns, 0, 0},
                       .row = {-step, sign * step, maps.depth / maps.rows},
                       .taper = 2 * step / maps.columns});
}

// Beyond `from` (sign -1) or `to` (1): rows outwards, 2j + 1 cells in row j, columns so that the array runs
// counter-clockwise.
GroundedHeightmap append_end(Edit& edit, const LinearErosionMaps& maps, int sign) {
  const double step = maps.step();
  return append_along(edit, maps.line, 2 * maps.rows, maps.rows,
                      {.origin = {sign < 0 ? 0 : maps.line.length, sign * maps.width, -maps.depth},
                       .column = {0, -sign * step, 0},
                       .row = {sign * step, 0, maps.depth / maps.rows}});
}

LinearErosionMaps append_maps(Edit& edit, const events::LinearErosion& e) {
  const events::Line line = e.line();
  const double w = e.width();
  LinearErosionMaps maps{line, w, e.depth, steps(std::hypot(w, e.depth), edit.grid()),
                         steps(line.length + 2 * w, edit.grid())};
  maps.left = append_side(edit, maps, 1);
  maps.right = append_side(edit, maps, -1);
  maps.from = append_end(edit, maps, -1);
  maps.to = append_end(edit, maps, 1);
  return maps;
}

// The cell of an end on its hip with the left (across 1) or right (-1) side.
CellId hip(const LinearErosionMaps& maps, int sign, int across, int j) {
  return (sign < 0 ? maps.from : maps.to).cell(maps.rows - sign * across * j, j);
}

// Links lead to later cells: the ends hold the hips, and the right side holds the bottom edge.
void fill_side(Edit& edit, const LinearErosionMaps& maps, int sign) {
  const GroundedHeightmap& side = sign > 0 ? maps.left : maps.right;
  for (int j = 0; j <= maps.rows; ++j) {
    const double d = j * maps.step(), width = maps.line.length + 2 * d;
    for (int i = 0; i <= maps.columns; ++i) {
      const CellId c = side.cell(i, j);
      if (i == 0) {
        edit.set_link(c, hip(maps, -1, sign, j));
      } else if (i == maps.columns) {
        edit.set_link(c, hip(maps, 1, sign, j));
      } else if (sign > 0 && j == 0) {
        edit.set_link(c, maps.right.cell(i, 0));
      } else {
        edit.set_height(c, edit.ground(maps.line.plan({-d + width * i / maps.columns, sign * d})));
      }
    }
  }
}

void fill_end(Edit& edit, const LinearErosionMaps& maps, int sign) {
  const double u0 = sign < 0 ? 0 : maps.line.length, step = maps.step();
  for (int j = 0; j <= maps.rows; ++j) {
    for (int k = -j; k <= j; ++k) {
      edit.set_height((sign < 0 ? maps.from : maps.to).cell(maps.rows + k, j),
                      edit.ground(maps.line.plan({u0 + sign * j * step, -sign * k * step})));
    }
  }
}

std::vector<CellId> outline(const LinearErosionMaps& maps) {
  const int rows = maps.rows;
  std::vector<CellId> cells;
  for (int i = 0; i <= maps.columns; ++i) cells.push_back(maps.right.cell(i, rows));
  for (int k = 0; k <= 2 * rows; ++k) cells.push_back(maps.to.cell(2 * rows - k, rows));
  for (int i = maps.columns; i >= 0; --i) cells.push_back(maps.left.cell(i, rows));
  for (int k = 0; k <= 2 * rows; ++k) cells.push_back(maps.from.cell(2 * rows - k, rows));
  return cells;
}

CellId nearest(const LinearErosionMaps& maps, glm::dvec2 p) {
  const double length = maps.line.length;
  const double d = std::min(std::abs(p.y), maps.width), beyond = std::max(-p.x, p.x - length);
  if (beyond > d) {
    const int j = nearest_step(beyond / maps.width, maps.rows);
    const int sign = p.x < 0 ? -1 : 1;
    const int k = std::clamp(static_cast<int>(std::lround(-sign * p.y / maps.step())), -j, j);
    return (sign < 0 ? maps.from : maps.to).cell(maps.rows + k, j);
  }
  const int j = nearest_step(d / maps.width, maps.rows);
  const double at = j * maps.step();
  return (p.y >= 0 ? maps.left : maps.right)
      .cell(nearest_step((p.x + at) / (length + 2 * at), maps.columns), j);
}

}  // namespace

void stage(Edit& edit, const events::LinearErosion& e) {
  const events::Line line = e.line();
  const double w = e.width();
  const RemovedPart old = cut_out_with_margin(edit, {line, -w, line.length + w, -w, w});
  const LinearErosionMaps maps = append_maps(edit, e);
  for (const int sign : {1, -1}) fill_side(edit, maps, sign);
  for (const int sign : {-1, 1}) fill_end(edit, maps, sign);
  edit.quads(maps.left, false);
  edit.quads(maps.right, true);
  edit.quads(maps.from, false);
  edit.quads(maps.to, false);
  join_to_ground(edit, line, old, outline(maps), [&](glm::dvec2 local) { return nearest(maps, local); });
}

}  // namespace terrabench::ght
