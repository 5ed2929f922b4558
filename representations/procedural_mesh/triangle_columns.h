// Where vertical lines cross a triangle mesh: triangles in the bins of a horizontal grid, for the columns of
// "meshgrow" surfaces used as terrain.
//
// Robust without exact arithmetic. A line never passes through an edge or a vertex: its position counts as
// moved by an infinitesimal step towards +x and +z, and whether an edge lies to its right is computed from
// the edge's ends alone, so the two triangles of an edge answer alike. Signed crossings of a closed mesh
// therefore add up to 0 on every line. Where that finds nothing, the steps towards -x and -z are tried, so
// that the outermost vertices belong to the surface.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "terrain/memory.h"

namespace terrabench {

// A line, followed upward, enters at a triangle that looks down (+1), and leaves at one that looks up (-1).
struct Crossing {
  float y;  // metres
  int weight;
  bool operator==(const Crossing&) const = default;
};

using Triangle = glm::u32vec3;  // vertices, counter-clockwise seen from outside

class TriangleColumns {
 public:
  TriangleColumns() = default;
  // Positions are finite and indices valid. About 10 B per triangle besides the arrays themselves; O(n) on
  // all threads.
  TriangleColumns(std::vector<glm::vec3> positions, std::vector<Triangle> triangles);

  // Replaces `out` by the crossings of the line at (x, z), sorted upward; at one height the entering ones
  // come first. The same for every number of threads. Thread-safe. O(triangles in the line's bin).
  void crossings(float x, float z, std::vector<Crossing>& out) const;

  // Asks the memory for what crossings() will read at these lines, at most kTogether, so that their misses
  // overlap.
  static constexpr std::size_t kTogether = 16;
  void prefetch(std::span<const float> x, std::span<const float> z) const;

  const std::vector<glm::vec3>& positions() const { return positions_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  Memory memory() const;

 private:
  // Bins along one axis; bin() never decreases, which is all that lookups rely on.
  struct Axis {
    float low = 0, high = 0;
    double per_metre = 0;
    int bins = 1;

    bool covers(float at) const { return at >= low && at <= high; }  // false for NaN
    int bin(float at) const {
      const double b = (static_cast<double>(at) - low) * per_metre;
      return b < bins ? (b > 0 ? static_cast<int>(b) : 0) : bins - 1;
    }
    void divide(int into);
  };
  struct Cover {  // of a triangle, in bins; empty when it is seen edge-on from above
    int x0 = 0, x1 = -1, z0 = 0, z1 = -1;
    std::uint64_t bins() const { return static_cast<std::uint64_t>(x1 - x0 + 1) * (z1 - z0 + 1); }
  };

  void choose_bins();
  void fill_bins();
  Cover cover(const Triangle&) const;
  std::uint64_t entries() const;
  template <bool kBeforeX, bool kBeforeZ>
  void collect(float x, float z, std::vector<Crossing>& out) const;

  std::vector<glm::vec3> positions_;
  std::vector<Triangle> triangles_;
  Axis x_, z_;
  std::vector<std::uint32_t> first_;   // per bin, rows along x, and one more
  std::vector<std::uint32_t> inside_;  // triangles, bin by bin
};

}  // namespace terrabench
