// Tunnels and caves (Alonso, Joan-Arinyo & Solano, §3.2, figures 15 and 16): walls (carving_walls.h), a
// border heightmap at each mouth, and for a cave one that closes its end. The paper carves the root only ("so
// far we only support them on the XZ plane"); here the host is the deepest heightmap that holds all mouths,
// such as the wall of a fault.
//
// The steps of an Edit come in another order here: the walls are the first new heightmaps, their rim at a
// mouth is the outline, the ground over it is cut out, and the links close the ring between the two. So a
// mouth is exact to half a sample spacing along the axis and to one around it. O(cells of the walls · log).
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "representations/ght/apply_event.h"
#include "representations/ght/carving_walls.h"
#include "representations/ght/cut_out.h"
#include "representations/ght/triangulate.h"

namespace terrabench::ght {
namespace {

std::vector<Loop> rims_of(std::span<const Face> faces) {
  std::vector<Edge> edges;
  std::vector<CellId> pinched;
  for (const Face& face : faces) add_edges(face, edges);
  return rims(std::move(edges), pinched);
}

double mean_u(const Tree& tree, const events::Line& line, const Loop& loop) {
  double sum = 0;
  for (const CellId c : loop) sum += line.local(tree.plan(c)).x;
  return sum / static_cast<double>(loop.size());
}

// The rectangle of the root's samples around a hole, as an empty heightmap.
GroundedHeightmap border_around(const Edit& edit, const Loop& loop) {
  const SampleGrid& grid = edit.grid();
  PlanBounds box;
  for (const CellId c : loop) box.add(grid.samples_to(edit.tree().plan(c)));
  const auto [low, high] = box;
  const int i0 = static_cast<int>(std::floor(low.x)), j0 = static_cast<int>(std::floor(low.y));
  return {.columns = std::min(static_cast<int>(std::ceil(high.x)), grid.width - 1) - i0 + 1,
          .rows = std::min(static_cast<int>(std::ceil(high.y)), grid.depth - 1) - j0 + 1,
          .area = Area::kBorder,
          .aligned = true,
          .i0 = i0,
          .j0 = j0};
}

bool overlap(const GroundedHeightmap& a, const GroundedHeightmap& b) {
  return a.i0 < b.i0 + b.columns && b.i0 < a.i0 + a.columns && a.j0 < b.j0 + b.rows && b.j0 < a.j0 + a.rows;
}

// Whether the cell is the ground's at this sample, outside the hole, and a corner of plain squares only.
bool belongs_to_ground(const Edit& edit, Square sample, CellId now, const RemovedPart& hole) {
  const Tree& tree = edit.tree();
  const SampleGrid& grid = edit.grid();
  const ComposedSurface& surface = edit.model().surface;
  if (tree.kind(now) != CellKind::kHeight) return false;
  if (std::binary_search(hole.superseded.begin(), hole.superseded.end(), now)) return false;
  if (tree.plan(now) != glm::vec2(grid.x(sample.i), grid.z(sample.j))) return false;
  bool plain = false, joined = false;
  for (int k = 0; k < 4; ++k) {
    const Square s{sample.i - k % 2, sample.j - k / 2};
    if (s.i < 0 || s.j < 0 || s.i + 1 >= grid.width || s.j + 1 >= grid.depth) continue;
    plain |= surface.plain(tree, s);
    surface.over(s, [&](FaceId f) {
      const Face& face = surface.face(f);
      joined |= std::find(face.begin(), face.end(), now) != face.end() &&
                !std::binary_search(hole.faces.begin(), hole.faces.end(), f);
    });
  }
  return plain && !joined;
}

// Fills the border (FillBorderData, LinkRootToBorder): its cells take over the heights of the ground at their
// samples, except where other heightmaps are joined to them. Superseded cells link to its void cells. Returns
// the hole's loop with the border's cells in place of those taken over.
Loop fill_border(Edit& edit, const GroundedHeightmap& border, const RemovedPart& hole) {
  const Tree& tree = edit.tree();
  for (const CellId c : hole.superseded) {
    const glm::dvec2 at = glm::round(edit.grid().samples_to(tree.plan(c)));
    edit.supersede(c, border.cell(std::clamp(static_cast<int>(at.x) - border.i0, 0, border.columns - 1),
                                  std::clamp(static_cast<int>(at.y) - border.j0, 0, border.rows - 1)));
  }
  std::vector<std::pair<CellId, CellId>> taken;  // from, to
  for (int j = 0; j < border.rows; ++j) {
    for (int i = 0; i < border.columns; ++i) {
      const Square sample{border.i0 + i, border.j0 + j};
      const CellId now = tree.at_sample(sample.i, sample.j), next = border.cell(i, j);
      if (!belongs_to_ground(edit, sample, now, hole)) continue;
      edit.set_height(next, tree.height(now));
      edit.supersede(now, next);
      const CellId root = tree.root_cell(sample.i, sample.j);
      if (root != now) edit.supersede(root, next);
      taken.emplace_back(now, next);
    }
  }
  std::sort(taken.begin(), taken.end());
  Loop loop = hole.loop;
  for (CellId& c : loop) {
    const auto at = std::lower_bound(taken.begin(), taken.end(), std::pair(c, CellId{0}));
    if (at != taken.end() && at->first == c) c = at->second;
  }
  return loop;
}

// Opens the ground where a rim of the walls comes out. `borders` holds those of the mouths before.
void open_mouth(Edit& edit, const Loop& rim, std::vector<GroundedHeightmap>& borders) {
  std::vector<glm::dvec2> plan;
  for (const CellId c : rim) plan.emplace_back(edit.tree().plan(c));
  if (!(doubled_area(map_points(edit.tree(), rim)) > 0)) refuse_mouth(edit);
  const RemovedPart hole = cut_out(edit, WidenedPolygon{plan, kRingMargin * edit.grid().spacing()});
  const GroundedHeightmap border = border_around(edit, hole.loop);
  for (const GroundedHeightmap& other : borders) {
    if (overlap(border, other)) {
      edit.refuse("has two mouths in one place", "make it longer, or its section smaller");
    }
  }
  borders.push_back(edit.append(border));
  edit.close_ring(fill_border(edit, borders.back(), hole), rim);
}

// An upright heightmap across the axis at `to`. Its cells well inside the section hold the height 0.
GroundedHeightmap append_end(Edit& edit, const CarvingWalls& walls, std::span<const glm::dvec2> section) {
  PlanBounds box;
  for (const glm::dvec2 p : section) box.add(p);
  const auto [low, high] = box;
  const double spacing = edit.grid().spacing();
  const glm::ivec2 steps = glm::max(glm::ivec2(glm::ceil((high - low) / spacing)), glm::ivec2(4));
  const glm::dvec2 pitch = (high - low) / glm::dvec2(steps);
  const glm::dvec2 plan = walls.line.plan({walls.line.length, 0});
  const glm::vec3 inwards(-walls.line.along.x, 0, -walls.line.along.y);
  const GroundedHeightmap end =
      edit.append({.plane = {.origin = glm::dvec3(plan.x, walls.event.to.y, plan.y) + walls.vector(low),
                             .u = walls.vector({pitch.x, 0}),
                             .v = walls.vector({0, pitch.y}),
                             .height = inwards},
                   .columns = steps.x + 1,
                   .rows = steps.y + 1,
                   .area = Area::kIndoor});
  const double margin = 0.4 * std::min(pitch.x, pitch.y);
  for (int j = 0; j < end.rows; ++j) {
    for (int i = 0; i < end.columns; ++i) {
      if (well_inside(section, low + pitch * glm::dvec2(i, j), margin)) edit.set_height(end.cell(i, j), 0);
    }
  }
  return end;
}

// Closes the far end of a cave. A ring joins the end's cells to the rim of the walls; where there are too few
// of them, triangles between the cells of the rim close it.
void close_end(Edit& edit, const CarvingWalls& walls, const Loop& rim) {
  const auto section_points = [&](const Loop& cells) {
    std::vector<glm::dvec2> points;
    for (const CellId c : cells) {
      const glm::vec3 p = edit.tree().position(c);
      points.emplace_back(-walls.line.local({p.x, p.z}).y, p.y - walls.event.to.y);
    }
    return points;
  };
  const std::vector<glm::dvec2> outer = section_points(rim);
  const GroundedHeightmap end = append_end(edit, walls, outer);
  const std::size_t before = edit.faces().size();
  edit.quads(end, false);
  Loop cells = rim;
  std::optional<std::vector<Triangle>> triangles;
  const std::vector<Loop> inner = rims_of(edit.faces().subspan(before));
  if (inner.size() == 1) {
    triangles = triangulate_ring(outer, section_points(inner[0]));
    cells.insert(cells.end(), inner[0].begin(), inner[0].end());
  }
  if (!triangles) {
    edit.drop_faces(before);
    triangles = triangulate(outer);
  }
  if (!triangles) edit.refuse("has an end that cannot be closed", "take a smoother or simpler section");
  for (const Triangle& t : *triangles) edit.face(cells[t[0]], cells[t[1]], cells[t[2]]);
}

}  // namespace

void stage(Edit& edit, const events::Carving& e) {
  const CarvingWalls walls = append_walls(edit, e);
  const std::vector<Loop> ends = rims_of(edit.faces());
  if (ends.size() != 2) refuse_mouth(edit);
  const bool first_is_from =
      mean_u(edit.tree(), walls.line, ends[0]) < mean_u(edit.tree(), walls.line, ends[1]);
  const Loop &from = ends[first_is_from ? 0 : 1], &to = ends[first_is_from ? 1 : 0];
  std::vector<GroundedHeightmap> borders;
  open_mouth(edit, from, borders);
  if (e.cave) {
    close_end(edit, walls, {to.rbegin(), to.rend()});
  } else {
    open_mouth(edit, to, borders);
  }
}

}  // namespace terrabench::ght
