// Normal and inverse faults (Alonso, Joan-Arinyo & Solano, §3.2, figure 13): three heightmaps, two blocks
// that tilt, the left one up and the right one down, and the scarp between their lips (the edges along the
// line). Their planes, cut across the line, which points into the page; R is `extent`, `rise` the throw,
// `offset` = rise / tan(dip) the heave, d runs left:
//
//           normal: an open scarp             inverse: the left block overhangs the right
//             __--L                                     __--''L
//   d=R __--''     \       __-- d=-R          d=R __--''    /    __-- d=-R
//                   r__--''                               r__--''
//
// The lips L and r lie half the rise above and below 0. At distance |d| ≤ R from the line, points move by
// (1 − |d| / R) · offset / 2 away from it (inverse: towards and beyond it), and up or down by
// (1 − |d| / R) · rise / 2.
//
// The tree afterwards: the host has three more children (left, right, scarp). Block cells at a lip are links
// to the scarp. Old cells inside the cut, of whatever heightmap, are links to the nearest cell of a block.
// Faces, which are in Model::surface and not in the tree, cover the three heightmaps and the ring around
// them. A height cell holds the old ground's height over its heightmap's plane: when the plane moves, the
// ground on it moves too. To follow one fault: stage(), at the end of this file; the end of apply_event.cpp,
// which calls it; edit.h; steps 2 and 4 in along_line.cpp; Edit::commit() in edit.cpp.
#include <algorithm>
#include <cmath>

#include "representations/ght/along_line.h"
#include "representations/ght/apply_event.h"

namespace terrabench::ght {
namespace {

struct DipFaultMaps {
  events::Line line;
  double extent;                  // of the event, metres
  double lip;                     // d of the left block's lip, negative if inverse; the right one's is -lip
  int columns, rows, scarp_rows;  // steps along the line, outwards in a block, and from lip to lip
  int folded = 0;                 // rows of the right block under the overhang; 0 for a normal fault
  GroundedHeightmap left{}, right{}, scarp{};

  bool at_end(int column) const { return column == 0 || column == columns; }
  double u(int column) const { return line.length * column / columns; }
};

// A heightmap whose columns run along the line and whose rows run from `from` to `to`, both (d, y).
GroundedHeightmap append_rows(Edit& edit, const DipFaultMaps& maps, glm::dvec2 from, glm::dvec2 to, int rows,
                              Area area = Area::kOutdoor) {
  const glm::dvec2 step = (to - from) / static_cast<double>(rows);
  return append_along(edit, maps.line, maps.columns, rows,
                      {.origin = {0, from.x, from.y},
                       .column = {maps.line.length / maps.columns, 0, 0},
                       .row = {0, step.x, step.y}},
                      area);
}

// Number of the right block's rows, counted from its lip, that lie under the left block's lip.
int rows_under_overhang(const Edit& edit, const DipFaultMaps& maps) {
  const double tolerance = 1e-3 * edit.grid().spacing(), step = (maps.extent - maps.lip) / maps.rows;
  const int rows = static_cast<int>(std::floor((-2 * maps.lip + tolerance) / step)) + 1;
  if (rows > maps.rows) {
    edit.refuse("overhangs the whole downthrown block", "give a larger 'extent' or a smaller 'throw'");
  }
  return rows;
}

DipFaultMaps append_maps(Edit& edit, const events::DipFault& e) {
  const SampleGrid& grid = edit.grid();
  const events::Line line = e.line();
  const double lip = (e.inverse ? -0.5 : 0.5) * e.offset();
  DipFaultMaps maps{line,
                    e.extent,
                    lip,
                    std::max(2, steps(line.length, grid)),
                    steps(std::hypot(std::max(e.extent, e.extent - lip), e.rise / 2), grid),
                    steps(std::hypot(e.offset(), e.rise), grid)};
  if (e.inverse) maps.folded = rows_under_overhang(edit, maps);
  const glm::dvec2 left_lip(lip, e.rise / 2), right_lip = -left_lip;
  maps.left = append_rows(edit, maps, left_lip, {e.extent, 0}, maps.rows);
  maps.right = append_rows(edit, maps, right_lip, {-e.extent, 0}, maps.rows);
  // kIndoor keeps an overhanging scarp out of the index of hosts: no later event can be applied to it.
  maps.scarp = append_rows(edit, maps, right_lip, left_lip, maps.scarp_rows,
                           e.inverse ? Area::kIndoor : Area::kOutdoor);
  return maps;
}

// What the cells hold: a link, or the height of the old ground at the place that the table gives, over the
// heightmap's plane:
//                          inner columns                        the two end columns, at_end()
//   block, row 0           link to the scarp's lip              link to the scarp's lip
//   block, other rows      ground at the point that moves here  ground at the cell: joins what is around
//   scarp                  ground at the line                   ground at the cell
// Last, fold_end_columns() changes what an overhang has in the end columns.

// Height over its plane of a cell that stays on the ground as it was before the event.
float height_on_ground(const Edit& edit, const events::Line& line, const GroundedHeightmap& map, int column,
                       int row) {
  const glm::dvec3 p = map.plane.at(column, row, 0);
  // plan(local(p)) is p, rounded; recorded bytes depend on that rounding.
  return edit.ground(line.plan(line.local({p.x, p.z}))) - static_cast<float>(p.y);
}

// `sign`: 1 for the left block, -1 for the right one. Links lead to later cells only, so row 0 links to the
// scarp, which holds the heights of both lips.
void fill_block(Edit& edit, const DipFaultMaps& maps, int sign) {
  const GroundedHeightmap& block = sign > 0 ? maps.left : maps.right;
  for (int i = 0; i <= maps.columns; ++i) {
    edit.set_link(block.cell(i, 0), maps.scarp.cell(i, sign < 0 ? 0 : maps.scarp_rows));
    for (int j = 1; j <= maps.rows; ++j) {
      const double d = sign * maps.extent * j / maps.rows;
      edit.set_height(block.cell(i, j), maps.at_end(i) ? height_on_ground(edit, maps.line, block, i, j)
                                                       : edit.ground(maps.line.plan({maps.u(i), d})));
    }
  }
}

void fill_scarp(Edit& edit, const DipFaultMaps& maps) {
  for (int i = 0; i <= maps.columns; ++i) {
    for (int j = 0; j <= maps.scarp_rows; ++j) {
      edit.set_height(maps.scarp.cell(i, j), maps.at_end(i)
                                                 ? height_on_ground(edit, maps.line, maps.scarp, i, j)
                                                 : edit.ground(maps.line.plan({maps.u(i), 0})));
    }
  }
}

// An overhang has no width in the end columns: there the right block's cells under it and the scarp's cells
// below the left lip become links to the left lip.
void fold_end_columns(Edit& edit, const DipFaultMaps& maps) {
  for (const int i : {0, maps.columns}) {
    const CellId lip = maps.scarp.cell(i, maps.scarp_rows);
    for (int j = 0; j < maps.folded; ++j) edit.set_link(maps.right.cell(i, j), lip);
    for (int j = 0; j < maps.scarp_rows; ++j) edit.set_link(maps.scarp.cell(i, j), lip);
  }
}

// Appends the cells across the fault at one of its ends, from right to left.
void add_profile(const DipFaultMaps& maps, int column, std::vector<CellId>& cells) {
  for (int j = maps.rows; j >= 0; --j) cells.push_back(maps.right.cell(column, j));
  for (int j = 0; j <= maps.scarp_rows; ++j) cells.push_back(maps.scarp.cell(column, j));
  for (int j = 0; j <= maps.rows; ++j) cells.push_back(maps.left.cell(column, j));
}

// Boundary cells, counter-clockwise seen from above: right edge, far end, left edge, near end.
std::vector<CellId> outline(const DipFaultMaps& maps) {
  std::vector<CellId> cells, back;
  for (int i = 0; i <= maps.columns; ++i) cells.push_back(maps.right.cell(i, maps.rows));
  add_profile(maps, maps.columns, cells);
  for (int i = maps.columns; i >= 0; --i) cells.push_back(maps.left.cell(i, maps.rows));
  add_profile(maps, 0, back);
  cells.insert(cells.end(), back.rbegin(), back.rend());
  return cells;
}

}  // namespace

void stage(Edit& edit, const events::DipFault& e) {
  const events::Line line = e.line();
  // Step 1: cut out.
  const RemovedPart old = cut_out_with_margin(edit, {line, 0, line.length, -e.extent, e.extent});
  // Step 2: new heightmaps. Set links first: quads() replaces each link by its target. `true`: mirrored,
  // because the right block's rows run to the other side.
  const DipFaultMaps maps = append_maps(edit, e);
  for (const int sign : {1, -1}) fill_block(edit, maps, sign);
  fill_scarp(edit, maps);
  if (e.inverse) fold_end_columns(edit, maps);
  edit.quads(maps.left, false);
  edit.quads(maps.right, true);
  edit.quads(maps.scarp, false);
  // Steps 3 and 4: outline and join; old cells are superseded by the nearest ones. apply_event() then
  // commits.
  join_to_ground(edit, line, old, outline(maps), [&](glm::dvec2 p) {
    return (p.y >= 0 ? maps.left : maps.right)
        .cell(nearest_step(p.x / line.length, maps.columns),
              nearest_step(std::abs(p.y) / e.extent, maps.rows));
  });
}

}  // namespace terrabench::ght
