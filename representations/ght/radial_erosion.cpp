// Radial erosion (Alonso, Joan-Arinyo & Solano, §3.2, figure 13): one heightmap on the root's own samples.
// Particles (§4.2) bring tens of thousands of them, so where all ground is plain no surface is cut out: the
// superseded cells link straight to the new ones and the squares stay plain.
#include <algorithm>
#include <cmath>

#include "representations/ght/apply_event.h"
#include "representations/ght/cut_out.h"

namespace terrabench::ght {
namespace {

// Samples [i0, i1] × [j0, j1].
struct SampleRange {
  int i0, j0, i1, j1;
};

// The samples inside the ellipse, and `more` on each side.
SampleRange samples_inside(const SampleGrid& grid, const events::RadialErosion& e, int more) {
  const glm::dvec2 low = grid.samples_to({e.centre.x - e.radii.x, e.centre.z - e.radii.z}),
                   high = grid.samples_to({e.centre.x + e.radii.x, e.centre.z + e.radii.z});
  return {std::max(0, static_cast<int>(std::ceil(low.x)) - more),
          std::max(0, static_cast<int>(std::ceil(low.y)) - more),
          std::min(grid.width - 1, static_cast<int>(std::floor(high.x)) + more),
          std::min(grid.depth - 1, static_cast<int>(std::floor(high.y)) + more)};
}

// Calls visit(i, j, bottom) for the samples inside the ellipse until one returns true; whether one did.
template <class Visit>
bool any_inside(const SampleGrid& grid, const events::RadialErosion& e, const SampleRange& range,
                const Visit& visit) {
  for (int j = range.j0; j <= range.j1; ++j) {
    for (int i = range.i0; i <= range.i1; ++i) {
      const double y = e.bottom({grid.x(i), grid.z(j)});
      if (y < HUGE_VAL && visit(i, j, y)) return true;
    }
  }
  return false;
}

float ground(const Edit& edit, int i, int j) {
  return edit.model().surface.top(edit.tree(), {edit.grid().x(i), edit.grid().z(j)});
}

// Whether a square around the sample is not plain, or its cell is not outdoor.
bool is_covered(const Edit& edit, int i, int j) {
  const Tree& tree = edit.tree();
  for (int k = 0; k < 4; ++k) {
    const Square s{i - k % 2, j - k / 2};
    if (s.i < 0 || s.j < 0 || s.i + 2 > edit.grid().width || s.j + 2 > edit.grid().depth) continue;
    if (edit.model().surface.covered(s)) return true;
  }
  const CellId c = tree.at_sample(i, j);
  if (tree.kind(c) == CellKind::kVoid) edit.refuse(kNoData, kFillNoData);
  return tree.nodes()[tree.node_of(c)].area != Area::kOutdoor;
}

GroundedHeightmap append_map(Edit& edit, const SampleRange& range) {
  return edit.append({.columns = range.i1 - range.i0 + 1,
                      .rows = range.j1 - range.j0 + 1,
                      .aligned = true,
                      .i0 = range.i0,
                      .j0 = range.j0});
}

// Superseded cells and those of the root link straight to the new ones, whatever was linked in between.
void record_on_plain(Edit& edit, const events::RadialErosion& e, const SampleRange& range) {
  const Tree& tree = edit.tree();
  const GroundedHeightmap map = append_map(edit, range);
  any_inside(edit.grid(), e, range, [&](int i, int j, double y) {
    const CellId now = tree.at_sample(i, j), next = map.cell(i - range.i0, j - range.j0),
                 root = tree.root_cell(i, j);
    edit.set_height(next, static_cast<float>(std::min<double>(y, tree.height(now))));
    edit.supersede(now, next);
    if (root != now) edit.supersede(root, next);
    return false;
  });
  edit.keep_clear_of_carvings();
}

// Counter-clockwise seen from above; z runs south.
std::vector<CellId> outline(const GroundedHeightmap& map) {
  std::vector<CellId> cells;
  for (int j = 0; j + 1 < map.rows; ++j) cells.push_back(map.cell(0, j));
  for (int i = 0; i + 1 < map.columns; ++i) cells.push_back(map.cell(i, map.rows - 1));
  for (int j = map.rows - 1; j > 0; --j) cells.push_back(map.cell(map.columns - 1, j));
  for (int i = map.columns - 1; i > 0; --i) cells.push_back(map.cell(i, 0));
  return cells;
}

int nearest(double at, int first, int last) {
  return std::clamp(static_cast<int>(std::lround(at)), first, last) - first;
}

// Over other heightmaps: the whole rectangle of samples is replaced, becomes plain, and is joined to the
// surface around it.
void record_over_heightmaps(Edit& edit, const events::RadialErosion& e, const SampleRange& range) {
  const Tree& tree = edit.tree();
  const SampleGrid& grid = edit.grid();
  const auto [i0, j0, i1, j1] = range;
  const events::Line east({0, 0}, {1, 0});
  const double margin = kRingMargin * grid.spacing();
  const RemovedPart old = cut_out(edit, TurnedRectangle{east, grid.x(i0) - margin, grid.x(i1) + margin,
                                                        -grid.z(j1) - margin, -grid.z(j0) + margin});
  const GroundedHeightmap map = append_map(edit, range);
  for (int j = j0; j <= j1; ++j) {
    for (int i = i0; i <= i1; ++i) {
      const CellId next = map.cell(i - i0, j - j0);
      const double bottom = e.bottom({grid.x(i), grid.z(j)});
      edit.set_height(next, static_cast<float>(std::min<double>(bottom, ground(edit, i, j))));
      edit.supersede(tree.root_cell(i, j), next);
      if (i < i1 && j < j1) edit.make_plain({i, j});
    }
  }
  for (const CellId c : old.superseded) {
    const glm::dvec2 at = grid.samples_to(tree.plan(c));
    edit.supersede(c, map.cell(nearest(at.x, i0, i1), nearest(at.y, j0, j1)));
  }
  edit.close_ring(old.loop, outline(map));
  edit.keep_clear_of_carvings();
}

}  // namespace

void stage(Edit& edit, const events::RadialErosion& e) {
  const SampleGrid& grid = edit.grid();
  const SampleRange range = samples_inside(grid, e, 0);
  if (!any_inside(grid, e, range, [&](int i, int j, double y) { return y < ground(edit, i, j); })) {
    edit.refuse("does not reach the ground at any of its samples", "lower its centre, or give larger radii");
  }
  if (any_inside(grid, e, range, [&](int i, int j, double) { return is_covered(edit, i, j); })) {
    record_over_heightmaps(edit, e, samples_inside(grid, e, 1));  // the outermost samples keep their heights
  } else {
    record_on_plain(edit, e, range);
  }
}

}  // namespace terrabench::ght
