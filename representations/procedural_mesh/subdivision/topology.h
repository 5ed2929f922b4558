// Connectivity of a mesh for Catmull–Clark refinement (Catmull and Clark 1978; "meshgrow" §3, "mesh
// refinement"), apart from positions: which edges and faces meet where, and which of them are sharp.
//
// Sharpness follows DeRose, Kass and Truong 1998 for whole numbers: a crease of sharpness s is sharp for s
// refinements and smooth after them. As in OpenSubdiv, a sharpness of 10 or more never decreases. Boundary
// edges are sharp for ever.
//
// A vertex is, by its number of sharp edges: smooth (0), dart (1), on a crease (2) or a corner (3 and more).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "representations/procedural_mesh/face_mesh.h"

namespace terrabench::subdivision {

// A vector whose elements are not set to zero when it is sized: tables are filled by several threads, and a
// pass over hundreds of megabytes only to clear them would cost as much as filling them.
template <class T>
struct UninitialisedAllocator : std::allocator<T> {
  static_assert(std::is_trivially_copyable_v<T>);
  template <class U>
  struct rebind {
    using other = UninitialisedAllocator<U>;
  };
  template <class U>
  void construct(U* at) noexcept {
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class... Args>
  void construct(U* at, Args&&... args) {
    ::new (static_cast<void*>(at)) U(std::forward<Args>(args)...);
  }
};

template <class T>
using Array = std::vector<T, UninitialisedAllocator<T>>;

// Frees the block of a vector; assigning {} would keep it.
template <class Vector>
void release(Vector& v) {
  Vector().swap(v);
}

inline constexpr std::uint32_t kNone = 0xFFFFFFFFU;
inline constexpr int kInfinitelySharp = 10;

// kEdge: boundary edges interpolate, a vertex with one face is rounded off; kEdgeAndCorner: it stays.
enum class Boundary : std::uint8_t { kEdge, kEdgeAndCorner };

// The corners whose edges to their next corner are this edge; the second is kNone on a boundary. The edge's
// first end is the vertex of the first corner.
struct Edge {
  std::uint32_t half[2];
};

// A "corner" is a vertex of a face, and names the edge from it to the next corner of the face.
struct Topology {
  std::uint32_t vertices = 0;
  std::vector<std::uint32_t> first_corner;  // faces + 1 numbers, or empty: all faces are quadrilaterals
  std::vector<std::uint32_t> corners;       // vertices, face by face
  Array<std::uint32_t> corner_face;         // per corner; empty when all faces are quadrilaterals
  // The leaves of a refinement may lack what follows.
  Array<std::uint32_t> corner_edge;  // per corner
  Array<Edge> edges;
  Array<std::uint8_t> sharpness;          // per edge, 0 … 10; boundary edges 10
  Array<std::uint32_t> first_use;         // vertices + 1 numbers
  Array<std::uint32_t> uses;              // the corners at each vertex
  std::vector<SharpVertex> sharp_points;  // sorted by vertex, sharpness 1 … 10

  std::uint32_t faces() const {
    return static_cast<std::uint32_t>(first_corner.empty() ? corners.size() / 4 : first_corner.size() - 1);
  }
  std::span<const std::uint32_t> uses_of(std::uint32_t v) const {
    return {uses.data() + first_use[v], first_use[v + 1] - first_use[v]};
  }
};

// Throws bad_input, naming the face or edge, when an array has the wrong length, a face has fewer than 3
// corners or a vertex twice, an index is out of range, an edge has more than two faces or two in the same
// direction, a crease is no edge, a sharpness is negative, or there are 2^30 corners or more. Positions are
// not read. A vertex where several fans of faces meet becomes a corner, as in OpenSubdiv.
// O(corners · log valence).
Topology make_topology(const FaceMesh&, Boundary = Boundary::kEdge);

// The edge with these ends, or kNone. The vertices need not exist. O(valence): creases are few.
std::uint32_t edge_between(const Topology&, std::uint32_t a, std::uint32_t b);

// The sharpness after one refinement.
constexpr int sharpness_after(int s) { return s >= kInfinitelySharp ? s : s > 0 ? s - 1 : 0; }

}  // namespace terrabench::subdivision
