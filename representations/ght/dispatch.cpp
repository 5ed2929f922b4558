#include "representations/ght/dispatch.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <new>

namespace terrabench::ght {
namespace {

// Column and row of a node's array at a point in plan; NaN when it has none.
glm::dvec2 locate(const Lattice& lattice, const Node& node, glm::dvec2 plan) {
  if (node.aligned) return lattice.samples_to(plan) - glm::dvec2(node.i0, node.j0);
  const auto flat = [](glm::vec3 v) { return glm::dvec2(v.x, v.z); };
  const glm::dvec2 origin = flat(node.frame.origin), u = flat(node.frame.u), v = flat(node.frame.v),
                   taper = flat(node.frame.taper);
  glm::dvec2 at{0.5 * node.columns, 0.5 * node.rows};
  constexpr int kSteps = 8;  // of Newton's method; without a taper the first one is exact
  for (int step = 0; step < kSteps; ++step) {
    const glm::dvec2 di = u + at.y * taper, dj = v + at.x * taper;
    const glm::dvec2 miss = plan - (origin + at.x * di + at.y * v);
    const double area = di.x * dj.y - di.y * dj.x;
    at += glm::dvec2(miss.x * dj.y - miss.y * dj.x, di.x * miss.y - di.y * miss.x) / area;
  }
  return at;
}

bool inside(std::span<const glm::dvec2> region, glm::dvec2 p) {
  for (std::size_t k = 0; k < region.size(); ++k) {
    const glm::dvec2 a = region[k], b = region[(k + 1) % region.size()];
    if ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) > 0) return false;  // z runs south
  }
  return true;
}

bool holds(const Tree& tree, const Node& node, std::span<const glm::dvec2> region) {
  constexpr double kSlip = 1e-4;  // cells
  glm::dvec2 low(HUGE_VAL), high(-HUGE_VAL);
  for (const glm::dvec2 p : region) {
    const glm::dvec2 at = locate(tree.lattice(), node, p);
    if (!(at.x >= -kSlip && at.y >= -kSlip && at.x <= node.columns - 1 + kSlip &&
          at.y <= node.rows - 1 + kSlip)) {
      return false;
    }
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  const auto whole = [](double v) { return static_cast<int>(v); };
  for (int j = whole(std::ceil(low.y - kSlip)); j <= whole(high.y + kSlip); ++j) {
    for (int i = whole(std::ceil(low.x - kSlip)); i <= whole(high.x + kSlip); ++i) {
      if (tree.kind(node.cell(i, j)) != CellKind::kVoid) continue;
      const glm::dvec3 p = node.frame.at(i, j, 0);
      const glm::dvec2 plan = node.aligned
                                  ? glm::dvec2(tree.lattice().x(node.i0 + i), tree.lattice().z(node.j0 + j))
                                  : glm::dvec2(p.x, p.z);
      if (inside(region, plan)) return false;
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
    const Node& node = model.tree.nodes()[n];
    if (node.depth > model.tree.nodes()[best].depth && holds(model.tree, node, region)) best = n;
  });
  return best;
}

void dispatch(Model& model, const events::Event& event, std::size_t number) {
  const Lattice& lattice = model.tree.lattice();
  if (lattice.origin_x != 0 || lattice.origin_z != 0) {
    throw usage_error("cannot be applied to the surface of a solid", events::where(event, number),
                      "build the tree from heights");
  }
  events::validate(event, {lattice.x(lattice.width - 1), lattice.z(lattice.depth - 1)}, number);
  const std::string where = events::where(event, number);
  const Refusal refusal(where);
  try {
    // Carvings are applied to the root alone, as in the paper: their heightmaps are not above any other.
    const bool carving = std::holds_alternative<events::Carving>(event);
    const NodeId host = carving ? 0 : identify_host(model, events::outline(event));
    std::visit([&](const auto& e) { apply(model, e, host, refusal); }, event);
  } catch (const std::bad_alloc&) {
    throw environment_error("does not fit into memory", where, "apply fewer or smaller events");
  } catch (const std::length_error&) {
    throw environment_error("does not fit into memory", where, "apply fewer or smaller events");
  }
}

}  // namespace terrabench::ght
