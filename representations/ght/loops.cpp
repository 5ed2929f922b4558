#include "representations/ght/loops.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "representations/ght/triangulate.h"

namespace terrabench::ght {
namespace {

// Those without an opposite edge, sorted.
std::vector<Edge> open_edges(std::vector<Edge> edges) {
  const auto undirected = [](const Edge& e) { return std::minmax(e.from, e.to); };
  std::sort(edges.begin(), edges.end(),
            [&](const Edge& a, const Edge& b) { return undirected(a) < undirected(b); });
  std::vector<Edge> open;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    if (k + 1 < edges.size() && edges[k] == Edge{edges[k + 1].to, edges[k + 1].from}) {
      ++k;
    } else {
      open.push_back(edges[k]);
    }
  }
  std::sort(open.begin(), open.end());
  return open;
}

double distance_to_segment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
  const glm::dvec2 along = b - a;
  const double length = glm::dot(along, along);
  const double at = length > 0 ? std::clamp(glm::dot(p - a, along) / length, 0.0, 1.0) : 0;
  return glm::distance(p, a + at * along);
}

}  // namespace

std::vector<Loop> rims(std::vector<Edge> edges, std::vector<CellId>& pinched) {
  const std::vector<Edge> open = open_edges(std::move(edges));
  for (std::size_t k = 1; k < open.size(); ++k) {
    if (open[k].from == open[k - 1].from) pinched.push_back(open[k].from);
  }
  std::vector<Loop> loops;
  if (!pinched.empty()) return loops;
  std::vector<char> used(open.size(), 0);
  for (std::size_t start = 0; start < open.size(); ++start) {
    if (used[start] != 0) continue;
    loops.emplace_back();
    for (std::size_t at = start; used[at] == 0;) {
      used[at] = 1;
      loops.back().push_back(open[at].from);
      const CellId next = open[at].to;
      at = static_cast<std::size_t>(std::lower_bound(open.begin(), open.end(), Edge{next, 0}) - open.begin());
      if (at == open.size() || open[at].from != next) return {};
    }
  }
  return loops;
}

std::vector<glm::dvec2> map_points(const Tree& tree, std::span<const CellId> cells) {
  std::vector<glm::dvec2> points;
  points.reserve(cells.size());
  for (const CellId c : cells) points.push_back(map_point(tree.position(c)));
  return points;
}

double doubled_area(std::span<const glm::dvec2> polygon) {
  double area = 0;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) area += turn(polygon[0], polygon[k], polygon[k + 1]);
  return area;
}

bool inside(std::span<const glm::dvec2> polygon, glm::dvec2 p) {
  bool in = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const glm::dvec2 a = polygon[k], b = polygon[(k + 1) % polygon.size()];
    if ((a.y <= p.y) != (b.y <= p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) in = !in;
  }
  return in;
}

bool well_inside(std::span<const glm::dvec2> polygon, glm::dvec2 p, double margin) {
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    if (distance_to_segment(p, polygon[k], polygon[(k + 1) % polygon.size()]) < margin) return false;
  }
  return inside(polygon, p);
}

bool segments_within(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d, double margin) {
  if (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0) return true;
  return std::min({distance_to_segment(a, c, d), distance_to_segment(b, c, d), distance_to_segment(c, a, b),
                   distance_to_segment(d, a, b)}) < margin;
}

}  // namespace terrabench::ght
