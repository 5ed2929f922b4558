// The dual of marching cubes over a block of cells, plane by plane. An open block has one more layer of flat
// cells around it, whose vertices are means over crossings on the block's border alone, so that the surface
// ends on the border with the same vertices as the neighbouring block's.
#include <glm/geometric.hpp>

#include "representations/implicit/block_sweep.h"
#include "representations/implicit/cell_cases.h"

namespace terrabench {
namespace {

constexpr std::array<std::array<int, 2>, 3> kAcross{{{1, 2}, {0, 2}, {0, 1}}};

class SurfaceNets {
 public:
  explicit SurfaceNets(const BlockTask& task)
      : task_(task), sweep_(task), width_(task.end.x - task.begin.x + 2) {
    if (sweep_.empty()) return;
    const std::size_t size = static_cast<std::size_t>(width_) * static_cast<std::size_t>(sweep_.points());
    for (std::vector<std::uint32_t>& plane : cells_) plane.resize(size);
  }

  SurfaceBlock run() {
    if (sweep_.empty()) return {};
    make_vertices(task_.begin.y - 1);
    const int planes_end = task_.closed ? task_.end.y : task_.end.y + 1;
    for (int j = task_.begin.y; j < planes_end; sweep_.advance(), ++j) {
      make_vertices(j);
      make_faces(j);
    }
    return std::move(out_);
  }

 private:
  std::size_t at(int i, int n) const {
    return static_cast<std::size_t>(i - task_.begin.x + 1) * static_cast<std::size_t>(sweep_.points()) +
           static_cast<std::size_t>(n);
  }
  // In an open block, whether the edge lies in it.
  bool inside(int axis, int i, int j, int n) const {
    if (task_.closed) return true;
    return i >= task_.begin.x && i + (axis == 0) <= task_.end.x && j >= task_.begin.y &&
           j + (axis == 2) <= task_.end.y && n >= 1 && n + (axis == 1) <= sweep_.points() - 2;
  }

  // Of the cells between planes j and j + 1: one vertex per loop, numbered one after another.
  void make_vertices(int j) {
    const std::array<CellCase, 256>& cases = cell_cases();
    const int last = task_.closed ? task_.end.x - 1 : task_.end.x;
    for (int i = task_.begin.x - 1; i <= last; ++i) {
      const bool foreign = task_.closed && (i < task_.begin.x || j < task_.begin.y);
      BlockSweep::for_each_bit(
          0, sweep_.points() - 1, [&](std::size_t w) { return sweep_.crossed_cells(i, j, w); },
          [&](int n) {
            const CellCase& cell = cases[static_cast<std::size_t>(sweep_.cell_case(i, j, n))];
            const std::uint64_t key = task_.lattice.key(0, i, j, sweep_.first_y() + n);
            cells_[static_cast<std::size_t>(j & 1)][at(i, n)] =
                foreign ? SurfaceBlock::kForeign | static_cast<std::uint32_t>(out_.foreign.size())
                        : static_cast<std::uint32_t>(out_.positions.size());
            for (std::uint8_t loop = 0; loop < cell.loops; ++loop) {
              if (foreign) {
                out_.foreign.push_back(key + loop);
              } else {
                make_vertex(cell, loop, i, j, n, key + loop);
              }
            }
          });
    }
  }

  void make_vertex(const CellCase& cell, std::uint8_t loop, int i, int j, int n, std::uint64_t key) {
    glm::vec3 position(0), normal(0);
    int crossings = 0;
    for (int edge = 0; edge < 12; ++edge) {
      if (cell.loop_of[static_cast<std::size_t>(edge)] != loop) continue;
      const int axis = edge >> 2;
      glm::ivec3 from{i, n, j};
      from[kAcross[static_cast<std::size_t>(axis)][0]] += edge & 1;
      from[kAcross[static_cast<std::size_t>(axis)][1]] += edge >> 1 & 1;
      if (!inside(axis, from.x, from.z, from.y)) continue;
      const BlockSweep::Crossing crossing = sweep_.crossing(axis, from.x, from.z, from.y);
      position += crossing.position;
      normal += crossing.normal;
      ++crossings;
    }
    // A flat cell's loop that lies wholly outside has no crossing and no face.
    if (crossings > 0) position /= static_cast<float>(crossings);
    const float length = glm::length(normal);
    if (task_.closed && (i == task_.end.x - 1 || j == task_.end.y - 1)) {
      out_.border.emplace_back(key, static_cast<std::uint32_t>(out_.positions.size()));
    }
    out_.positions.push_back(position);
    out_.normals.push_back(length > 0 ? normal / length : glm::vec3(0, 1, 0));
  }

  // Around the edges in plane j, and between planes j and j + 1.
  void make_faces(int j) {
    const int points = sweep_.points();
    const int last = task_.closed ? task_.end.x - 1 : task_.end.x;
    for (int i = task_.begin.x; i <= last; ++i) {
      const std::uint64_t *column = sweep_.solid(i, j), *right = sweep_.solid(i + 1, j),
                          *next = sweep_.solid(i, j + 1);
      const auto faces = [&](int axis, int end, const auto& crossed) {
        BlockSweep::for_each_bit(0, end, crossed, [&](int n) {
          if (inside(axis, i, j, n)) make_face(axis, i, j, n);
        });
      };
      faces(0, points, [&](std::size_t w) { return column[w] ^ right[w]; });
      faces(1, points - 1, [&](std::size_t w) { return column[w] ^ sweep_.above(column, w); });
      faces(2, points, [&](std::size_t w) { return column[w] ^ next[w]; });
    }
  }

  void make_face(int axis, int i, int j, int n) {
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    std::array<std::uint32_t, 4> corners;
    constexpr std::array<std::array<int, 2>, 4> kAround{{{-1, -1}, {0, -1}, {0, 0}, {-1, 0}}};
    for (std::size_t m = 0; m < 4; ++m) {
      glm::ivec3 cell{i, n, j};
      cell[b] += kAround[m][0];
      cell[c] += kAround[m][1];
      // The edge's place in that cell.
      const int along_b = -kAround[m][0], along_c = -kAround[m][1];
      const int edge = 4 * axis + (b < c ? along_b + 2 * along_c : along_c + 2 * along_b);
      const CellCase& passed =
          cell_cases()[static_cast<std::size_t>(sweep_.cell_case(cell.x, cell.z, cell.y))];
      corners[m] = cells_[static_cast<std::size_t>(cell.z & 1)][at(cell.x, cell.y)] +
                   passed.loop_of[static_cast<std::size_t>(edge)];
    }
    if (!BlockSweep::bit(sweep_.solid(i, j), n)) std::swap(corners[1], corners[3]);
    for (const std::size_t m : {0, 1, 2, 0, 2, 3}) out_.indices.push_back(corners[m]);
  }

  BlockTask task_;
  BlockSweep sweep_;
  int width_;
  std::array<std::vector<std::uint32_t>, 2> cells_;  // the first vertex of each cell, by j & 1
  SurfaceBlock out_;
};

}  // namespace

SurfaceBlock surface_nets(const BlockTask& task) { return SurfaceNets(task).run(); }

}  // namespace terrabench
