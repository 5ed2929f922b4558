// Whether a polygon mesh is well formed ("meshgrow" §4: rule-based growing makes "no T-vertices or malformed
// faces"). Every fault is counted, and the first few are named.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "representations/procedural_mesh/face_mesh.h"

namespace terrabench {

enum class MeshFault : std::uint8_t {
  kBadIndex,         // a face's corners or an index lie outside their arrays; such faces are not looked at
  kFewCorners,       // a face with fewer than 3 corners
  kRepeatedVertex,   // a face uses a vertex twice
  kNotFinite,        // a position that is infinite or NaN
  kZeroArea,         // a face without area, compared with the square of its perimeter
  kZeroEdge,         // an edge between vertices at one place
  kDirectedTwice,    // two faces run through an edge in the same direction
  kManyFaces,        // an edge with more than two faces
  kSeveralFans,      // the faces at a vertex form several fans
  kTVertex,          // a vertex inside another face's edge, within the tolerance
  kUnmeantBoundary,  // an edge with one face that is not meant to be a boundary
  kUnusedVertex,     // a vertex of no face
  kCount
};

struct MeshReport {
  std::array<std::size_t, static_cast<std::size_t>(MeshFault::kCount)> counts{};
  std::size_t edges = 0, boundary_edges = 0;
  std::vector<std::string> first;  // the first faults, at most 16: "face 12: …"

  std::size_t operator[](MeshFault fault) const { return counts[static_cast<std::size_t>(fault)]; }
  std::size_t faults() const;
};

struct MeshCheckOptions {
  bool boundary_meant = true;  // otherwise every boundary edge is a fault
  // A vertex is inside an edge when it is nearer than this, as a share of the edge's length, or than the
  // rounding of single precision at the edge's place. Edges of a few roundings cannot be looked into.
  float tolerance = 1e-5F;
  // A face has no area when it is at most this share of its squared perimeter. A square has 1/16.
  float least_area = 1e-10F;
};

// Any mesh may be given. T-vertices are sought among vertices that lie on a boundary, since the edges of a
// mesh without cracks have two faces. O(corners), and for b boundary edges O(b log b + b · those beside along
// x).
MeshReport check_mesh(const FaceMesh&, const MeshCheckOptions& = {});

using VertexPair = std::pair<std::uint32_t, std::uint32_t>;
struct VertexInEdge {
  std::uint32_t vertex;
  VertexPair edge;
};
// T-vertices: the ends of the edges that are nearer to another edge than `tolerance` times its length or the
// rounding of a point that was computed inside it in single precision (the larger of both), and farther than
// that from the edge's ends; sorted by edge as given, then by vertex. Edges with an end that is not finite
// are skipped.
std::vector<VertexInEdge> vertices_in_edges(std::span<const glm::vec3> positions,
                                            std::span<const VertexPair> edges, float tolerance);

}  // namespace terrabench
