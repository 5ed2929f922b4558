// Vertices that lie inside edges, sought among the edges of a boundary: where two borders should meet and one
// has a vertex that the other lacks ("T-vertex"), rounding may open a crack.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

namespace terrabench {

using VertexPair = std::pair<std::uint32_t, std::uint32_t>;
struct VertexInEdge {
  std::uint32_t vertex;
  VertexPair edge;
};

// The ends of the edges that are nearer to another edge than `tolerance` times its length or the rounding of
// a point that was computed inside it in single precision (the larger of both), and farther than that from
// the edge's ends; sorted by edge as given, then by vertex. Edges with an end that is not finite are skipped.
// O(b log b) for b edges of similar lengths: a k-d tree of the ends is walked along each edge.
std::vector<VertexInEdge> vertices_in_edges(std::span<const glm::vec3> positions,
                                            std::span<const VertexPair> edges, float tolerance);

}  // namespace terrabench
