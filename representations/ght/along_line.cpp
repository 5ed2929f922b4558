#include "representations/ght/along_line.h"

#include <algorithm>
#include <cmath>

namespace terrabench::ght {

int steps(double length, const SampleGrid& grid) {
  return std::max(1, static_cast<int>(std::ceil(length / grid.spacing() - 1e-6)));
}

int nearest_step(double share, int steps) {
  return static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * steps));
}

GroundedHeightmap append_along(Edit& edit, const events::Line& line, int columns, int rows,
                               const PlaneAlong& plane, Area area) {
  const auto in_space = [](glm::dvec2 plan, double y) { return glm::vec3(plan.x, y, plan.y); };
  const auto vector = [&](glm::dvec3 v) { return in_space(v.x * line.along + v.y * line.left, v.z); };
  const glm::dvec3 origin = plane.origin;
  return edit.append({.plane = {.origin = in_space(line.plan({origin.x, origin.y}), origin.z),
                                .u = vector(plane.column),
                                .v = vector(plane.row),
                                .taper = plane.taper == 0 ? glm::vec3(0) : vector({plane.taper, 0, 0})},
                      .columns = columns + 1,
                      .rows = rows + 1,
                      .area = area});
}

RemovedPart cut_out_with_margin(Edit& edit, TurnedRectangle shape) {
  const double margin = kRingMargin * edit.grid().spacing();
  return cut_out(edit,
                 {shape.line, shape.u0 - margin, shape.u1 + margin, shape.d0 - margin, shape.d1 + margin});
}

void join_to_ground(Edit& edit, const events::Line& line, const RemovedPart& old, std::vector<CellId> outline,
                    const std::function<CellId(glm::dvec2)>& nearest) {
  const Tree& tree = edit.tree();
  for (CellId& c : outline) c = tree.resolve(c);
  outline.erase(std::unique(outline.begin(), outline.end()), outline.end());
  while (outline.size() > 1 && outline.back() == outline.front()) outline.pop_back();
  edit.close_ring(old.loop, outline);
  edit.keep_clear_of_carvings();
  for (const CellId c : old.superseded) edit.supersede(c, tree.resolve(nearest(line.local(tree.plan(c)))));
}

}  // namespace terrabench::ght
