#include "representations/ght/carving_walls.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "representations/ght/apply_event.h"
#include "representations/ght/cut_out.h"
#include "terrain/events/section.h"

namespace terrabench::ght {
namespace {

constexpr double kRowsPerSpacing = 2;
// In sample spacings: a narrower section has no room for cells inside its walls.
constexpr double kLeastSection = 2;
// In sample spacings: the ground left between a carving and everything else, which are exact to one each.
constexpr double kClearance = 1;
// Of one carving: more than any terrain has room for, less than would exhaust memory.
constexpr double kMostWallCells = 1 << 26;

constexpr std::string_view kTooManyCells = "has walls of too many cells";

double side_length(const events::Carving& e, std::size_t side) {
  return glm::distance(e.section[side], e.section[(side + 1) % e.section.size()]) *
         std::max(e.scale_from, e.scale_to);
}

// Rows are at most half a sample spacing apart along the axis, columns at most one across the sides.
CarvingWalls divide(const Edit& edit, const events::Carving& e) {
  const double spacing = edit.grid().spacing();
  const double rows = std::max(1.0, std::ceil(kRowsPerSpacing * glm::length(e.to - e.from) / spacing));
  PlanBounds box;
  double columns = 0;
  for (std::size_t k = 0; k < e.section.size(); ++k) {
    box.add(e.section[k]);
    columns += std::ceil(side_length(e, k) / spacing);
  }
  const double smallest = std::min(e.scale_from, e.scale_to);
  const glm::dvec2 size = box.high - box.low;
  if (!(std::min(size.x, size.y) * smallest >= kLeastSection * spacing)) {
    edit.refuse("has a section less than two sample spacings wide or high", "take a larger section or scale");
  }
  if (!(rows * columns < kMostWallCells)) {
    edit.refuse(kTooManyCells, "make it shorter, or its section smaller");
  }
  CarvingWalls walls{e, e.line(), static_cast<int>(rows)};
  walls.step = walls.line.length / walls.steps;
  walls.first_column.push_back(0);
  for (std::size_t k = 0; k < e.section.size(); ++k) {
    walls.first_column.push_back(walls.first_column.back() +
                                 std::max(1, static_cast<int>(std::ceil(side_length(e, k) / spacing))));
  }
  return walls;
}

glm::dvec3 point(const CarvingWalls& walls, std::size_t side, int column, int row) {
  const double u = row * walls.step;
  const glm::dvec2 wall = walls.event.wall(side, u, static_cast<double>(column) / walls.columns(side));
  const glm::dvec2 plan = walls.line.plan({u, -wall.x});
  return {plan.x, walls.event.height(u) + wall.y, plan.y};
}

bool on_terrain(const SampleGrid& grid, glm::dvec2 plan) {
  return plan.x >= 0 && plan.y >= 0 && plan.x <= grid.x(grid.width - 1) && plan.y <= grid.z(grid.depth - 1);
}

// Calls visit(a, plan) across the section at u and `beyond` it on both sides.
template <class Visit>
void across(const Edit& edit, const CarvingWalls& walls, double u, double beyond, const Visit& visit) {
  const events::SectionRange reach = events::section_reach(walls.event, u);
  const double low = reach.low - beyond, high = reach.high + beyond;
  const int samples = 2 + static_cast<int>(2 * (high - low) / edit.grid().spacing());
  for (int s = 0; s <= samples; ++s) {
    const double a = low + (high - low) * s / samples;
    const glm::dvec2 plan = walls.line.plan({u, -a});
    if (on_terrain(edit.grid(), plan)) visit(a, plan);
  }
}

// Between `from` and `to` the whole section must be under ground.
void check_cover(const Edit& edit, const CarvingWalls& walls) {
  const double clearance = kClearance * edit.grid().spacing();
  std::vector<events::SectionRange> ranges;
  const auto check = [&](double u, std::string_view what) {
    across(edit, walls, u, 0, [&](double a, glm::dvec2 plan) {
      events::section_ranges(walls.event, u, a, ranges);
      if (!ranges.empty() && walls.event.height(u) + ranges.back().high + clearance > edit.ground(plan)) {
        edit.refuse(what, "move 'from' and 'to' deeper into the ground, or take a smaller section");
      }
    });
  };
  check(0, "starts in the air, or less than one sample spacing under ground");
  check(walls.line.length, "ends in the air, or less than one sample spacing under ground");
  for (int j = 1; j < walls.steps; ++j) {
    check(j * walls.step, "leaves the ground, or comes within one sample spacing of it");
  }
}

int last_row_under_ground(const Edit& edit, const CarvingWalls& walls, std::size_t side, int column, int row,
                          int step) {
  for (;; row += step) {
    if (std::abs(row) * static_cast<double>(walls.first_column.back()) > kMostWallCells) {
      edit.refuse(kTooManyCells, "make its axis less steep, or make it shorter");
    }
    const glm::dvec3 p = point(walls, side, column, row + step);
    const glm::dvec2 plan{p.x, p.z};
    if (!on_terrain(edit.grid(), plan) || walls.event.scale((row + step) * walls.step) <= 0) {
      edit.refuse(step < 0 ? "does not come out of the ground beyond 'from'"
                           : "does not come out of the ground beyond 'to'",
                  "let the axis rise to the surface, and more steeply than the ground");
    }
    if (p.y >= edit.ground(plan)) return row;
  }
}

// One row beyond the outermost end, the whole section must be in the air. Up to there a column may enter the
// ground again by at most one sample spacing, because it has no wall beyond the place where it first comes
// out.
void check_out(const Edit& edit, const CarvingWalls& walls, const std::vector<int>& ends, int sign) {
  const int last = sign < 0 ? *std::min_element(ends.begin(), ends.end()) - 1
                            : *std::max_element(ends.begin(), ends.end()) + 1;
  for (std::size_t k = 0; k < walls.event.section.size(); ++k) {
    for (int i = 0; i < walls.columns(k); ++i) {
      for (int row = ends[walls.around(k, i)] + sign; row != last + sign; row += sign) {
        const glm::dvec3 p = point(walls, k, i, row);
        const glm::dvec2 plan{p.x, p.z};
        const double tolerance = row == last ? 0 : edit.grid().spacing();
        if (!on_terrain(edit.grid(), plan) || p.y + tolerance < edit.ground(plan)) refuse_mouth(edit);
      }
    }
  }
}

// A cell more than one row beyond both neighbouring columns would be part of no face.
void trim(std::vector<int>& ends, int sign) {
  const std::vector<int> before = ends;
  const std::size_t n = ends.size();
  for (std::size_t r = 0; r < n; ++r) {
    const int further = std::max(sign * before[(r + n - 1) % n], sign * before[(r + 1) % n]);
    ends[r] = sign * std::min(sign * before[r], further + 1);
  }
}

// The row in which each column of the walls comes out of the ground.
void find_ends(const Edit& edit, CarvingWalls& walls) {
  const bool cave = walls.event.cave;
  walls.low_row.assign(static_cast<std::size_t>(walls.first_column.back()), 0);
  walls.high_row.assign(walls.low_row.size(), walls.steps);
  for (std::size_t k = 0; k < walls.event.section.size(); ++k) {
    for (int i = 0; i < walls.columns(k); ++i) {
      const std::size_t r = walls.around(k, i);
      walls.low_row[r] = last_row_under_ground(edit, walls, k, i, 0, -1);
      if (!cave) walls.high_row[r] = last_row_under_ground(edit, walls, k, i, walls.steps, 1);
    }
  }
  check_out(edit, walls, walls.low_row, -1);
  if (!cave) check_out(edit, walls, walls.high_row, 1);
  trim(walls.low_row, -1);
  trim(walls.high_row, 1);
  walls.row0 = *std::min_element(walls.low_row.begin(), walls.low_row.end());
  walls.row1 = *std::max_element(walls.high_row.begin(), walls.high_row.end());
}

bool has_overhangs(const Tree& tree) {
  return std::any_of(tree.events().begin(), tree.events().end(),
                     [](const Applied& a) { return a.kind == events::Kind::kInverseFault; });
}

// Only the ground above may be near: no other carving, no overhang.
void check_clearance(const Edit& edit, const CarvingWalls& walls) {
  const Model& model = edit.model();
  if (!model.carved && !has_overhangs(model.tree)) return;
  const events::Carving& e = walls.event;
  const auto [lowest, highest] = std::minmax_element(e.section.begin(), e.section.end(),
                                                     [](glm::dvec2 a, glm::dvec2 b) { return a.y < b.y; });
  const double far = kClearance * edit.grid().spacing(), near_rows = std::ceil(far / walls.step);
  std::vector<Crossing> crossed;
  for (double j = walls.row0 - near_rows; j <= walls.row1 + near_rows; ++j) {
    const double u = j * walls.step, scale = e.scale(u);
    const double low = e.height(u) + lowest->y * scale - e.roughness - far;
    const double high = e.height(u) + highest->y * scale + e.roughness + far;
    across(edit, walls, u, far, [&](double, glm::dvec2 plan) {
      const auto x = static_cast<float>(plan.x), z = static_cast<float>(plan.y);
      Square s;
      if (!model.surface.find(x, z, s)) return;
      crossed.clear();
      model.surface.crossings(model.tree, x, z, s, crossed);
      const auto top = std::max_element(crossed.begin(), crossed.end(),
                                        [](const Crossing& a, const Crossing& b) { return a.y < b.y; });
      for (auto c = crossed.begin(); c != crossed.end(); ++c) {
        if (c == top || c->y < low || c->y > high) continue;
        edit.refuse(model.carved && !has_overhangs(model.tree)
                        ? "comes within one sample spacing of another tunnel or cave"
                    : !model.carved
                        ? "comes within one sample spacing of an overhang"
                        : "comes within one sample spacing of another tunnel or cave, or of an overhang",
                    "move it away");
      }
    });
  }
}

// The rectangle in plan of the ground that a carving opens: a cave's mouth, or both mouths of a tunnel and
// what lies between.
TurnedRectangle opened_region(const CarvingWalls& walls) {
  const int first = walls.row0 - 1;
  const int last =
      walls.event.cave ? *std::max_element(walls.low_row.begin(), walls.low_row.end()) : walls.row1 + 1;
  events::SectionRange reach = events::section_reach(walls.event, first * walls.step);
  const events::SectionRange other = events::section_reach(walls.event, last * walls.step);
  reach = {std::min(reach.low, other.low), std::max(reach.high, other.high)};
  return {walls.line, first * walls.step, last * walls.step, -reach.high, -reach.low};
}

// Heights are measured inwards from the flat side.
GroundedHeightmap append_side(Edit& edit, const CarvingWalls& walls, std::size_t side) {
  const events::Carving& e = walls.event;
  const glm::dvec2 a = e.section[side], b = e.section[(side + 1) % e.section.size()];
  const double u0 = walls.row0 * walls.step, m = walls.columns(side);
  const double growth = (e.scale_to - e.scale_from) / walls.steps;  // of the scale, per row
  const glm::dvec2 plan = walls.line.plan({u0, 0}), along = walls.line.along;
  const double rise = (e.to.y - e.from.y) / walls.steps;
  const glm::dvec3 forward(along.x * walls.step, rise, along.y * walls.step);
  return edit.append({.plane = {glm::dvec3(plan.x, e.height(u0), plan.y) + walls.vector(e.scale(u0) * a),
                                walls.vector(e.scale(u0) / m * (b - a)), forward + walls.vector(growth * a),
                                walls.vector(growth / m * (b - a)),
                                walls.vector(glm::normalize(glm::dvec2(a.y - b.y, b.x - a.x)))},
                      .columns = walls.columns(side) + 1,
                      .rows = walls.row1 - walls.row0 + 1,
                      .area = Area::kIndoor});
}

// Links lead to later cells: the last side holds both its edges, the others hold their first.
void fill_side(Edit& edit, const CarvingWalls& walls, std::size_t k) {
  const std::size_t sides = walls.sides.size();
  const GroundedHeightmap& side = walls.sides[k];
  for (int i = 0; i < side.columns; ++i) {
    const std::size_t r = walls.around(k, i);
    for (int row = walls.low_row[r]; row <= walls.high_row[r]; ++row) {
      const int j = row - walls.row0;
      const CellId c = side.cell(i, j);
      if (i == walls.columns(k) && k + 1 < sides) {
        edit.set_link(c, walls.sides[k + 1].cell(0, j));
      } else if (i == 0 && k == 0) {
        edit.set_link(c, walls.sides[sides - 1].cell(walls.columns(sides - 1), j));
      } else {
        const double share = static_cast<double>(i) / walls.columns(k);
        edit.set_height(c, static_cast<float>(-walls.event.bulge(k, row * walls.step, share)));
      }
    }
  }
}

}  // namespace

CarvingWalls append_walls(Edit& edit, const events::Carving& event) {
  CarvingWalls walls = divide(edit, event);
  check_cover(edit, walls);
  find_ends(edit, walls);
  check_clearance(edit, walls);
  edit.set_host(identify_host(edit.model(), opened_region(walls).corners()));
  const std::size_t sides = event.section.size();
  for (std::size_t k = 0; k < sides; ++k) walls.sides.push_back(append_side(edit, walls, k));
  for (std::size_t k = 0; k < sides; ++k) fill_side(edit, walls, k);
  for (const GroundedHeightmap& side : walls.sides) edit.quads(side, false);
  return walls;
}

void refuse_mouth(const Edit& edit) {
  edit.refuse("has a mouth that is not one simple hole in the ground",
              "let it come out of a slope that is smoother, and neither flat nor upright");
}

}  // namespace terrabench::ght
