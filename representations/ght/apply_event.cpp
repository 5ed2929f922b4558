// Read from the end: apply_event(). What precedes it finds the host.
#include "representations/ght/apply_event.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <new>

#include "representations/ght/edit.h"
#include "terrain/error.h"

namespace terrabench::ght {
namespace {

// Column and row of a heightmap's array at a point in plan; NaN when it has none.
glm::dvec2 locate(const SampleGrid& grid, const GroundedHeightmap& node, glm::dvec2 plan) {
  if (node.aligned) return grid.samples_to(plan) - glm::dvec2(node.i0, node.j0);
  const auto flat = [](glm::vec3 v) { return glm::dvec2(v.x, v.z); };
  const glm::dvec2 origin = flat(node.plane.origin), u = flat(node.plane.u), v = flat(node.plane.v),
                   taper = flat(node.plane.taper);
  glm::dvec2 at{0.5 * node.columns, 0.5 * node.rows};
  constexpr int kSteps = 8;  // of Newton's method; the first is exact when there is no taper
  for (int step = 0; step < kSteps; ++step) {
    const glm::dvec2 di = u + at.y * taper, dj = v + at.x * taper;
    const glm::dvec2 miss = plan - (origin + at.x * di + at.y * v);
    const double area = di.x * dj.y - di.y * dj.x;
    at += glm::dvec2(miss.x * dj.y - miss.y * dj.x, di.x * miss.y - di.y * miss.x) / area;
  }
  return at;
}

// Whether p is inside a convex region or on its edge.
bool inside_convex(std::span<const glm::dvec2> region, glm::dvec2 p) {
  for (std::size_t k = 0; k < region.size(); ++k) {
    const glm::dvec2 a = region[k], b = region[(k + 1) % region.size()];
    if ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) > 0) return false;  // z runs south
  }
  return true;
}

bool holds(const Tree& tree, const GroundedHeightmap& node, std::span<const glm::dvec2> region) {
  constexpr double kSlip = 1e-4;  // tolerance, in columns and rows
  PlanBounds box;
  for (const glm::dvec2 p : region) {
    const glm::dvec2 at = locate(tree.grid(), node, p);
    if (!(at.x >= -kSlip && at.y >= -kSlip && at.x <= node.columns - 1 + kSlip &&
          at.y <= node.rows - 1 + kSlip)) {
      return false;
    }
    box.add(at);
  }
  const auto [low, high] = box;
  const auto whole = [](double v) { return static_cast<int>(v); };
  for (int j = whole(std::ceil(low.y - kSlip)); j <= whole(high.y + kSlip); ++j) {
    for (int i = whole(std::ceil(low.x - kSlip)); i <= whole(high.x + kSlip); ++i) {
      if (tree.kind(node.cell(i, j)) != CellKind::kVoid) continue;
      const glm::dvec3 p = node.plane.at(i, j, 0);
      const glm::dvec2 plan = node.aligned
                                  ? glm::dvec2(tree.grid().x(node.i0 + i), tree.grid().z(node.j0 + j))
                                  : glm::dvec2(p.x, p.z);
      if (inside_convex(region, plan)) return false;
    }
  }
  return true;
}

}  // namespace

NodeId identify_host(const Model& model, std::span<const glm::dvec2> region) {
  glm::dvec2 centre{0};
  for (const glm::dvec2 p : region) centre += p / static_cast<double>(region.size());
  const SquareRange at = model.surface.range(centre, centre);
  NodeId best = 0;
  model.index.over({at.i0, at.j0}, [&](NodeId n) {
    const GroundedHeightmap& node = model.tree.nodes()[n];
    if (node.depth > model.tree.nodes()[best].depth && holds(model.tree, node, region)) best = n;
  });
  return best;
}

void apply_event(Model& model, const events::Event& event, std::size_t number) {
  const SampleGrid& grid = model.tree.grid();
  const std::string where = events::where(event, number);
  if (grid.origin_x != 0 || grid.origin_z != 0) {
    throw usage_error("cannot be applied to the surface of a solid", where, "build the tree from heights");
  }
  events::validate(event, {grid.x(grid.width - 1), grid.z(grid.depth - 1)}, number);
  constexpr std::string_view kNoMemory = "does not fit into memory", kFewer = "apply fewer or smaller events";
  try {
    // The region that a carving opens depends on the ground; append_walls() finds its host.
    const bool carving = std::holds_alternative<events::Carving>(event);
    Edit edit(model, carving ? 0 : identify_host(model, events::outline(event)), where);
    std::visit([&](const auto& e) { stage(edit, e); }, event);
    edit.commit(events::kind(event));
  } catch (const std::bad_alloc&) {
    throw environment_error(kNoMemory, where, kFewer);
  } catch (const std::length_error&) {
    throw environment_error(kNoMemory, where, kFewer);
  }
}

}  // namespace terrabench::ght
