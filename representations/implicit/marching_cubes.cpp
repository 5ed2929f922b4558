// Marching cubes (Lorensen & Cline 1987) over a block of cells, plane by plane: vertices on crossed edges
// first, each made once, then the triangles of crossed cells, both found 64 lattice points at a time. The
// vertices' numbers are kept for two planes. O(points / 64 + triangles) after sampling.
#include "representations/implicit/block_sweep.h"
#include "representations/implicit/cell_cases.h"

namespace terrabench {
namespace {

class MarchingCubes {
 public:
  explicit MarchingCubes(const BlockTask& task)
      : task_(task), sweep_(task), width_(task.end.x - task.begin.x + 1) {
    if (sweep_.empty()) return;
    // Open: only edges and cells inside the block. Closed: all.
    first_ = task.closed ? 0 : 1;
    last_ = sweep_.points() - (task.closed ? 1 : 2);
    const std::size_t size = static_cast<std::size_t>(width_) * static_cast<std::size_t>(sweep_.points());
    for (std::vector<std::uint32_t>* plane :
         {&along_x_[0], &along_x_[1], &along_y_[0], &along_y_[1], &along_z_}) {
      plane->resize(size);
    }
  }

  SurfaceBlock run() {
    if (sweep_.empty()) return {};
    for (int j = task_.begin.y;; sweep_.advance(), ++j) {
      make_vertices_in_plane(j);
      if (j > task_.begin.y) make_triangles(j - 1);
      if (j == task_.end.y) break;
      make_vertices_between(j);
    }
    return std::move(out_);
  }

 private:
  std::size_t at(int i, int n) const {
    return static_cast<std::size_t>(i - task_.begin.x) * static_cast<std::size_t>(sweep_.points()) +
           static_cast<std::size_t>(n);
  }

  std::uint32_t make_vertex(int axis, int i, int j, int n) {
    const auto key = [&] { return task_.lattice.key(axis, i, j, sweep_.first_y() + n); };
    if (task_.closed && (i == task_.end.x || j == task_.end.y)) {
      out_.foreign.push_back(key());
      return SurfaceBlock::kForeign | static_cast<std::uint32_t>(out_.foreign.size() - 1);
    }
    const auto number = static_cast<std::uint32_t>(out_.positions.size());
    const BlockSweep::Crossing crossing = sweep_.crossing(axis, i, j, n);
    out_.positions.push_back(crossing.position);
    out_.normals.push_back(crossing.normal);
    if (task_.closed && (i == task_.begin.x || j == task_.begin.y)) out_.border.emplace_back(key(), number);
    return number;
  }

  void make_vertices_in_plane(int j) {
    std::vector<std::uint32_t>&along_x = along_x_[j & 1], &along_y = along_y_[j & 1];
    for (int i = task_.begin.x; i <= task_.end.x; ++i) {
      const std::uint64_t* column = sweep_.solid(i, j);
      BlockSweep::for_each_bit(
          first_, last_, [&](std::size_t w) { return column[w] ^ sweep_.above(column, w); },
          [&](int n) { along_y[at(i, n)] = make_vertex(1, i, j, n); });
      if (i == task_.end.x) break;
      const std::uint64_t* next = sweep_.solid(i + 1, j);
      BlockSweep::for_each_bit(
          first_, last_ + 1, [&](std::size_t w) { return column[w] ^ next[w]; },
          [&](int n) { along_x[at(i, n)] = make_vertex(0, i, j, n); });
    }
  }

  void make_vertices_between(int j) {
    for (int i = task_.begin.x; i <= task_.end.x; ++i) {
      const std::uint64_t *column = sweep_.solid(i, j), *next = sweep_.solid(i, j + 1);
      BlockSweep::for_each_bit(
          first_, last_ + 1, [&](std::size_t w) { return column[w] ^ next[w]; },
          [&](int n) { along_z_[at(i, n)] = make_vertex(2, i, j, n); });
    }
  }

  // Of the cells between planes j and j + 1.
  void make_triangles(int j) {
    const std::array<CellCase, 256>& cases = cell_cases();
    for (int i = task_.begin.x; i < task_.end.x; ++i) {
      // Where the vertices on the twelve edges of the column's cells are, as cell_cases() numbers edges.
      std::array<const std::uint32_t*, 12> vertices;
      for (std::size_t o = 0; o < 4; ++o) {
        const int first = static_cast<int>(o & 1), second = static_cast<int>(o >> 1);
        vertices[o] = &along_x_[(j + second) & 1][at(i, first)];
        vertices[4 + o] = &along_y_[(j + second) & 1][at(i + first, 0)];
        vertices[8 + o] = &along_z_[at(i + first, second)];
      }
      BlockSweep::for_each_bit(
          first_, last_, [&](std::size_t w) { return sweep_.crossed_cells(i, j, w); },
          [&](int n) {
            const CellCase& cell = cases[static_cast<std::size_t>(sweep_.cell_case(i, j, n))];
            const std::size_t size = out_.indices.size(), corners = 3U * cell.triangles;
            out_.indices.resize(size + corners);
            for (std::size_t c = 0; c < corners; ++c) out_.indices[size + c] = vertices[cell.corners[c]][n];
          });
    }
  }

  BlockTask task_;
  BlockSweep sweep_;
  int width_, first_ = 0, last_ = 0;  // edges along y and cells [first_, last_), other edges one more
  std::array<std::vector<std::uint32_t>, 2> along_x_, along_y_;  // of the last two planes, by j & 1
  std::vector<std::uint32_t> along_z_;
  SurfaceBlock out_;
};

}  // namespace

SurfaceBlock marching_cubes(const BlockTask& task) { return MarchingCubes(task).run(); }

}  // namespace terrabench
