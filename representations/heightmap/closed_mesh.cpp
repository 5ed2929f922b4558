#include "representations/heightmap/closed_mesh.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "representations/column_grid.h"
#include "terrain/error.h"

namespace terrabench {
namespace {

// The four cells around a sample, as bits.
enum Quadrant : unsigned { kNorthWest = 1, kNorthEast = 2, kSouthWest = 4, kSouthEast = 8 };

class ClosedMesher {
 public:
  ClosedMesher(std::span<const float> x, std::span<const float> z, std::span<const float> heights,
               float floor)
      : x_(x),
        z_(z),
        heights_(heights),
        floor_(floor),
        columns_(static_cast<int>(x.size())),
        rows_(static_cast<int>(z.size())) {}

  TriangleMesh run() {
    number_vertices();
    const std::size_t vertices = 2 * static_cast<std::size_t>(tops_), indices = 3 * count_triangles();
    require_memory(vertices * sizeof(glm::vec3) + indices * sizeof(std::uint32_t), "mesh of a heightmap");
    TriangleMesh mesh;
    mesh.positions.resize(vertices);
    mesh.indices.resize(indices);
    tbb::parallel_for(0, rows_, [&](int j) { place_vertices(j, mesh); });
    tbb::parallel_for(0, rows_, [&](int j) {
      if (std::uint32_t* out = mesh.indices.data() + first_index_[j]; j + 1 < rows_) emit_row(j, out);
    });
    return mesh;
  }

 private:
  bool valid(int i, int j) const { return !std::isnan(heights_[static_cast<std::size_t>(j) * columns_ + i]); }
  bool cell(int i, int j) const {
    return i >= 0 && j >= 0 && i + 1 < columns_ && j + 1 < rows_ && valid(i, j) && valid(i + 1, j) &&
           valid(i, j + 1) && valid(i + 1, j + 1);
  }
  unsigned around(int i, int j) const {
    return (cell(i - 1, j - 1) ? kNorthWest : 0U) | (cell(i, j - 1) ? kNorthEast : 0U) |
           (cell(i - 1, j) ? kSouthWest : 0U) | (cell(i, j) ? kSouthEast : 0U);
  }
  static bool doubled(unsigned cells) {
    return cells == (kNorthWest | kSouthEast) || cells == (kNorthEast | kSouthWest);
  }

  void number_vertices() {
    first_.assign(heights_.size() + 1, 0);
    std::uint64_t count = 0;
    for (int j = 0; j < rows_; ++j) {
      for (int i = 0; i < columns_; ++i) {
        first_[static_cast<std::size_t>(j) * columns_ + i] = static_cast<std::uint32_t>(count);
        const unsigned cells = around(i, j);
        count += cells == 0 ? 0 : doubled(cells) ? 2 : 1;
        if (2 * count > std::numeric_limits<std::uint32_t>::max()) {
          throw usage_error("the mesh has more than 2³² vertices", "mesh of a heightmap",
                            "choose larger cells");
        }
      }
    }
    tops_ = static_cast<std::uint32_t>(count);
  }

  std::size_t count_triangles() {
    first_index_.assign(static_cast<std::size_t>(rows_) + 1, 0);
    tbb::parallel_for(0, rows_, [&](int j) {
      std::size_t triangles = 0;
      for (int i = 0; i < columns_; ++i) {
        if (!cell(i, j)) continue;
        const int walls = !cell(i - 1, j) + !cell(i + 1, j) + !cell(i, j - 1) + !cell(i, j + 1);
        triangles += 4 + 2 * static_cast<std::size_t>(walls);
      }
      first_index_[static_cast<std::size_t>(j) + 1] = 3 * triangles;
    });
    for (int j = 0; j < rows_; ++j) first_index_[static_cast<std::size_t>(j) + 1] += first_index_[j];
    return first_index_.back() / 3;
  }

  void place_vertices(int j, TriangleMesh& mesh) const {
    for (int i = 0; i < columns_; ++i) {
      const std::size_t at = static_cast<std::size_t>(j) * columns_ + i;
      for (std::uint32_t v = first_[at]; v < (at + 1 < heights_.size() ? first_[at + 1] : tops_); ++v) {
        mesh.positions[v] = {x_[i], heights_[at], z_[j]};
        mesh.positions[tops_ + v] = {x_[i], floor_, z_[j]};
      }
    }
  }

  // The top vertex of sample (i, j) as the cell on its south (or north) side uses it.
  std::uint32_t vertex(int i, int j, bool south) const {
    return first_[static_cast<std::size_t>(j) * columns_ + i] +
           static_cast<std::uint32_t>(south && doubled(around(i, j)));
  }

  void emit_row(int j, std::uint32_t* out) const {
    const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      *out++ = a;
      *out++ = b;
      *out++ = c;
    };
    // From a to b with the block on the left, seen from above: the wall faces right.
    const auto wall = [&](std::uint32_t a, std::uint32_t b) {
      triangle(tops_ + a, tops_ + b, b);
      triangle(tops_ + a, b, a);
    };
    for (int i = 0; i < columns_; ++i) {
      if (!cell(i, j)) continue;
      const std::uint32_t nw = vertex(i, j, true), ne = vertex(i + 1, j, true);
      const std::uint32_t sw = vertex(i, j + 1, false), se = vertex(i + 1, j + 1, false);
      triangle(nw, sw, ne);
      triangle(ne, sw, se);
      triangle(tops_ + nw, tops_ + ne, tops_ + sw);
      triangle(tops_ + ne, tops_ + se, tops_ + sw);
      if (!cell(i, j + 1)) wall(sw, se);
      if (!cell(i + 1, j)) wall(se, ne);
      if (!cell(i, j - 1)) wall(ne, nw);
      if (!cell(i - 1, j)) wall(nw, sw);
    }
  }

  std::span<const float> x_, z_, heights_;
  float floor_;
  int columns_, rows_;
  std::uint32_t tops_ = 0;            // vertices of the surface; those of the floor follow, equal in number
  std::vector<std::uint32_t> first_;  // first vertex of each sample
  std::vector<std::size_t> first_index_;  // where each row's triangles begin
};

}  // namespace

TriangleMesh closed_mesh(std::span<const float> x, std::span<const float> z, std::span<const float> heights,
                         float floor) {
  return ClosedMesher(x, z, heights, floor).run();
}

}  // namespace terrabench
