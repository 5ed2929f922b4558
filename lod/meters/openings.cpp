#include "lod/meters/openings.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>
#include <vector>

#include "lod/meters/projector.h"

namespace terrabench {
namespace {

// A side of a triangle, the lesser end first; `forward` 1 when the triangle has it in this direction, else
// -1.
struct Edge {
  glm::vec3 low, high;
  int forward;
};

auto order(const glm::vec3& p) { return std::tie(p.x, p.z, p.y); }
auto place(const Edge& e) { return std::tuple_cat(order(e.low), order(e.high)); }

std::vector<Edge> edges_of(const Frame& frame) {
  std::vector<Edge> edges;
  edges.reserve(3 * frame.stats.triangles);
  triangles(frame, [&](std::span<const glm::vec3> corners) {
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const glm::vec3 &from = corners[k], &to = corners[k % 3 == 2 ? k - 2 : k + 1];
      if (from == to) continue;
      const bool forward = order(from) < order(to);
      edges.push_back({forward ? from : to, forward ? to : from, forward ? 1 : -1});
    }
  });
  tbb::parallel_sort(edges.begin(), edges.end(),
                     [](const Edge& a, const Edge& b) { return place(a) < place(b); });
  return edges;
}

// From `from` to `to`, as often as it is missing in the other direction.
struct OpenEdge {
  glm::dvec3 from, to;
};

std::vector<OpenEdge> open_edges(const Frame& frame, const Heightfield& ground) {
  const auto on_border = [&](const Edge& e) {
    return std::max(e.low.x, e.high.x) <= 0 || std::min(e.low.x, e.high.x) >= ground.extent_x() ||
           std::max(e.low.z, e.high.z) <= 0 || std::min(e.low.z, e.high.z) >= ground.extent_z();
  };
  const std::vector<Edge> edges = edges_of(frame);
  std::vector<OpenEdge> open;
  for (std::size_t first = 0, end; first < edges.size(); first = end) {
    int sum = 0;
    for (end = first; end < edges.size() && place(edges[end]) == place(edges[first]); ++end) {
      sum += edges[end].forward;
    }
    const Edge& e = edges[first];
    if (sum != 0 && !on_border(e))
      open.push_back(sum > 0 ? OpenEdge{e.low, e.high} : OpenEdge{e.high, e.low});
  }
  return open;
}

glm::dvec3 nearest_on(const OpenEdge& edge, const glm::dvec3& p) {
  const glm::dvec3 along = edge.to - edge.from;
  const double t = glm::dot(p - edge.from, along) / glm::dot(along, along);
  return edge.from + std::clamp(t, 0.0, 1.0) * along;
}

// The point nearest to p on the open edges that run against `edge`; NaN when there is none.
glm::dvec3 across(const std::vector<OpenEdge>& open, const OpenEdge& edge, const glm::dvec3& p) {
  glm::dvec3 best(std::numeric_limits<double>::quiet_NaN());
  double least = std::numeric_limits<double>::infinity();
  for (const OpenEdge& other : open) {
    if (!(glm::dot(other.to - other.from, edge.to - edge.from) < 0)) continue;
    const glm::dvec3 there = nearest_on(other, p);
    const double distance = glm::distance(there, p);
    if (distance < least) std::tie(least, best) = std::tuple(distance, there);
  }
  return best;
}

}  // namespace

OpenEdges find_open_edges(const Frame& frame, const Heightfield& ground, const View& view) {
  const Projector project(view);
  const std::vector<OpenEdge> open = open_edges(frame, ground);
  struct Found {
    bool in_view = false;
    double metres = 0, pixels = 0;
  };
  std::vector<Found> found(open.size());
  tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t k) {
    const OpenEdge& edge = open[k];
    Found& here = found[k];
    here.in_view = project.sees_segment(edge.from, edge.to);
    if (!here.in_view) return;
    for (const glm::dvec3& p : {edge.from, edge.to}) {
      const glm::dvec3 q = across(open, edge, p);
      here.metres = std::isnan(q.x) ? -1 : std::max(here.metres, glm::distance(p, q));
      if (project.sees_segment(p, q)) here.pixels = std::max(here.pixels, project.pixels_between(p, q));
    }
  });
  OpenEdges report;
  for (const Found& edge : found) {
    report.edges += edge.in_view ? 1 : 0;
    report.unmatched += edge.metres < 0 ? 1 : 0;
    report.largest_gap_m = std::max(report.largest_gap_m, edge.metres);
    report.largest_gap_px = std::max(report.largest_gap_px, edge.pixels);
  }
  return report;
}

}  // namespace terrabench
