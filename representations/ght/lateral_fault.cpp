// Lateral fault (Alonso, Joan-Arinyo & Solano, §3.2, figure 13): two heightmaps, blocks whose ground comes
// from further along the line, with a vertical cliff between them. Both ends of each stay on the ground as it
// was.
#include <algorithm>
#include <cmath>

#include "representations/ght/along_line.h"
#include "representations/ght/apply_event.h"

namespace terrabench::ght {
namespace {

struct LateralFaultMaps {
  events::Line line;
  int columns, rows;  // steps along the line and outwards
  GroundedHeightmap left{}, right{};
};

void fill_block(Edit& edit, const LateralFaultMaps& maps, const events::LateralFault& e, int sign) {
  for (int j = 0; j <= maps.rows; ++j) {
    const double d = sign * e.extent * j / maps.rows;
    for (int i = 0; i <= maps.columns; ++i) {
      const CellId c = (sign > 0 ? maps.left : maps.right).cell(i, j);
      const bool at_end = i == 0 || i == maps.columns;
      if (sign > 0 && j == 0 && at_end) {
        edit.set_link(c, maps.right.cell(i, 0));
      } else {
        const double shift = at_end ? 0 : sign * e.slip / 2 * (1 - static_cast<double>(j) / maps.rows);
        edit.set_height(c, edit.ground(maps.line.plan({maps.line.length * i / maps.columns - shift, d})));
      }
    }
  }
}

std::vector<CellId> outline(const LateralFaultMaps& maps) {
  const auto& [line, columns, rows, left, right] = maps;
  std::vector<CellId> cells;
  for (int i = 0; i <= columns; ++i) cells.push_back(right.cell(i, rows));
  for (int j = rows; j >= 0; --j) cells.push_back(right.cell(columns, j));
  for (int j = 0; j <= rows; ++j) cells.push_back(left.cell(columns, j));
  for (int i = columns; i >= 0; --i) cells.push_back(left.cell(i, rows));
  for (int j = rows; j >= 0; --j) cells.push_back(left.cell(0, j));
  for (int j = 0; j <= rows; ++j) cells.push_back(right.cell(0, j));
  return cells;
}

}  // namespace

void stage(Edit& edit, const events::LateralFault& e) {
  const events::Line line = e.line();
  const RemovedPart old = cut_out_with_margin(edit, {line, 0, line.length, -e.extent, e.extent});
  check_ground(edit, {line, -e.slip / 2, line.length + e.slip / 2, -e.extent, e.extent});
  LateralFaultMaps maps{line, std::max(2, steps(line.length, edit.grid())), steps(e.extent, edit.grid())};
  const auto append = [&](int sign) {
    return append_along(edit, line, maps.columns, maps.rows,
                        {.origin = {0, 0, 0},
                         .column = {line.length / maps.columns, 0, 0},
                         .row = {0, sign * e.extent / maps.rows, 0}});
  };
  maps.left = append(1);
  maps.right = append(-1);
  for (const int sign : {1, -1}) fill_block(edit, maps, e, sign);
  for (int i = 0; i < maps.columns; ++i) {  // the cliff
    edit.quad(
        {maps.right.cell(i, 0), maps.right.cell(i + 1, 0), maps.left.cell(i + 1, 0), maps.left.cell(i, 0)});
  }
  edit.quads(maps.left, false);
  edit.quads(maps.right, true);
  join_to_ground(edit, line, old, outline(maps), [&](glm::dvec2 p) {
    return (p.y >= 0 ? maps.left : maps.right)
        .cell(nearest_step(p.x / line.length, maps.columns),
              nearest_step(std::abs(p.y) / e.extent, maps.rows));
  });
}

}  // namespace terrabench::ght
