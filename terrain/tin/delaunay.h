// The Delaunay triangulation of lattice points in a rectangle, built point by point: the triangles whose
// circumcircles hold a point are replaced by a fan around it (Bowyer 1981, Watson 1981).
//
// All tests are exact, in whole numbers. Of four points on one circle, which a lattice has everywhere, the
// diagonal takes the one that comes first in rows from north to south: so the triangulation depends on the
// set of points alone, not on their order, and a file needs no connectivity.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "terrain/memory.h"

namespace terrabench::tin {

// A sample of the heightmap, column and row. Sides up to 65,536 samples.
struct Sample {
  std::uint16_t i, j;
  bool operator==(const Sample&) const = default;
};
// Rows from north to south, each from west to east.
constexpr bool before(Sample a, Sample b) { return a.j != b.j ? a.j < b.j : a.i < b.i; }

// Twice the area of (a, b, c), in cells; positive where they turn from the first axis to the second.
constexpr std::int64_t twice_area(Sample a, Sample b, Sample c) {
  return (std::int64_t{b.i} - a.i) * (std::int64_t{c.j} - a.j) -
         (std::int64_t{b.j} - a.j) * (std::int64_t{c.i} - a.i);
}

struct Triangle {
  std::array<std::uint32_t, 3> vertex;     // twice_area() > 0
  std::array<std::uint32_t, 3> neighbour;  // across the edge opposite the vertex; kNone beyond the rectangle
};

// A square of samples; all samples if `side` is 0.
struct Tile {
  Sample north_west{0, 0};
  int side = 0;
  bool holds(Sample s) const {
    return side == 0 || (static_cast<unsigned>(s.i - north_west.i) < static_cast<unsigned>(side) &&
                         static_cast<unsigned>(s.j - north_west.j) < static_cast<unsigned>(side));
  }
};

// GCC takes a function that only prefetches for one without effects, and drops calls of it.
[[gnu::always_inline]] inline void prefetch(const void* from) { __builtin_prefetch(from); }

class Delaunay {
 public:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  Delaunay() = default;
  // The rectangle of the samples [0, width - 1] × [0, depth - 1], both sides at least 2, as two triangles;
  // its corners are vertices 0 to 3.
  Delaunay(int width, int depth);

  const std::vector<Sample>& vertices() const { return vertices_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  Sample vertex(const Triangle& t, int k) const { return vertices_[t.vertex[static_cast<std::size_t>(k)]]; }
  std::array<Sample, 3> corners(const Triangle& t) const {
    return {vertices_[t.vertex[0]], vertices_[t.vertex[1]], vertices_[t.vertex[2]]};
  }

  // A triangle that holds the point, on its border at least, by a walk from `start`. O(√triangles) at worst.
  std::uint32_t locate(Sample, std::uint32_t start) const;
  // The vertex of this triangle at the sample; kNone if it has none there.
  std::uint32_t vertex_at(Sample, std::uint32_t triangle) const;
  // Adds a vertex that lies in this triangle; returns its index, or that of the vertex already there.
  // Triangles keep their indices but change their corners; those that changed or are new are appended to
  // `changed`, some twice.
  std::uint32_t insert(Sample, std::uint32_t triangle, std::vector<std::uint32_t>& changed);
  // Appends the triangles that insert() would change: those with the sample in their circumcircle.
  void append_conflicts(Sample, std::uint32_t triangle, std::vector<std::uint32_t>& to) const;

 private:
  struct RingEdge {  // from a vertex to that of the next edge in the ring
    std::uint32_t from, beyond;
  };
  // What a new vertex replaces.
  struct Cavity {
    std::vector<std::uint32_t> triangles;
    std::vector<RingEdge> ring;  // around them, as they turn from the first axis to the second
    bool at_border = false;      // the last edge holds the new vertex
    struct Side {
      std::uint32_t triangle;
      int edge;
    };
    std::vector<Side> open;
  };

 public:
  // Free indices of vertices and triangles, and what one thread works with.
  struct Workspace {
    std::vector<std::uint32_t> vertices, triangles;
    Cavity cavity;
  };
  // Adds free elements, for insert_in().
  Workspace make_workspace(std::size_t vertices);
  // Those that are left are free for insert() and make_workspace().
  void take_back(Workspace&&);
  // As insert(), by several threads at once, each with its own workspace and tile. Returns kNone and changes
  // nothing unless all triangles to be changed lie wholly in the tile. Triangles beyond the cavity's edges
  // only get a new neighbour there, so no two threads write the same element. The workspace needs one vertex
  // and two triangles.
  std::uint32_t insert_in(const Tile&, Sample, std::uint32_t triangle, Workspace&,
                          std::vector<std::uint32_t>& changed);
  bool all_in(const Tile& tile, const Triangle& t) const {
    return tile.holds(vertex(t, 0)) && tile.holds(vertex(t, 1)) && tile.holds(vertex(t, 2));
  }

  // Appends the triangles around a vertex, one of which is given, as they turn from the first axis to the
  // second; at the border from one side to the other.
  void append_star(std::uint32_t vertex, std::uint32_t triangle, std::vector<std::uint32_t>& to) const;
  // Takes out a vertex, not a corner of the rectangle, of which one triangle is given. Only triangles around
  // it change. Their indices are appended to `changed`; those left over, and the vertex's, are free until
  // insert() takes them or both compact_…() are called. O(n³) for n triangles, six in the mean.
  void remove(std::uint32_t vertex, std::uint32_t triangle, std::vector<std::uint32_t>& changed);
  bool in_use(std::uint32_t triangle) const {
    return triangle < triangles_.size() && triangles_[triangle].vertex[0] != kNone;
  }
  // Makes the triangle begin with the corner that comes first in rows.
  void rotate(std::uint32_t triangle);

  // An element that has another index now.
  struct Move {
    std::uint32_t from, to;
  };
  // Fills free indices with the last triangles, then with the last vertices; find(sample) returns a triangle
  // that holds the sample. Frees all memory that only changes need.
  std::vector<Move> compact_triangles();
  template <class Find>
  std::vector<Move> compact_vertices(const Find& find);

  void reserve(std::size_t vertices);
  // Room for one insert() at least, growing by a 64th instead of doubling: an edited triangulation keeps its
  // slack. Moving the arrays then takes amortised O(1) per vertex, O(vertices) at worst.
  void make_room();
  // The former index of each vertex and triangle.
  struct Former {
    std::vector<std::uint32_t> vertices, triangles;
  };
  // Numbers vertices by rows and triangles by their corners, the first vertex first, so that the same
  // vertices give the same arrays, without slack and free elements. O(n log n) at worst.
  Former put_in_order();

 private:
  std::uint32_t new_vertex(Sample);
  std::uint32_t new_triangle();
  void fill(std::uint32_t triangle, const std::array<RingEdge, 3>& ring);
  bool is_ear(const std::vector<RingEdge>& ring, std::size_t first) const;
  std::vector<Move> free_and_last(std::vector<std::uint32_t>& free, std::size_t size) const;
  void renumber(const Move&, std::uint32_t triangle);
  bool find_cavity(const Tile&, Sample, std::uint32_t triangle, Cavity&) const;
  template <class NewTriangle>
  void fan_out(Cavity&, std::uint32_t vertex, const NewTriangle&);
  void replace(std::uint32_t triangle, std::uint32_t neighbour, std::uint32_t by);

  std::vector<Sample> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> free_vertices_, free_triangles_;
  Cavity cavity_;  // of insert()
};

template <class Find>
std::vector<Delaunay::Move> Delaunay::compact_vertices(const Find& find) {
  std::vector<Move> moves = free_and_last(free_vertices_, vertices_.size());
  for (const Move& move : moves) {
    const Sample at = vertices_[move.from];
    renumber(move, find(at));
    vertices_[move.to] = at;
  }
  vertices_.resize(vertices_.size() - free_vertices_.size());
  free_vertices_ = std::vector<std::uint32_t>();
  cavity_ = {};
  return moves;
}

// The elements with these indices, one after another.
template <class T>
std::vector<T> gathered(const std::vector<T>& from, const std::vector<std::uint32_t>& indices) {
  std::vector<T> to(indices.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, to.size(), 4096), [&](const auto& range) {
    for (std::size_t k = range.begin(); k < range.end(); ++k) to[k] = from[indices[k]];
  });
  return to;
}

// Calls visit(k) once for each k below n, coarse to fine: row by row each vertex would change many triangles.
template <class Visit>
void coarse_to_fine(std::size_t n, const Visit& visit) {
  const std::size_t longest = std::bit_floor(n);
  for (std::size_t stride = longest; stride > 0; stride /= 2) {
    for (std::size_t k = 0; k < n; k += stride) {
      if (stride == longest || k % (2 * stride) != 0) visit(k);
    }
  }
}

}  // namespace terrabench::tin
