#include "representations/block_mesh.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "terrain/error.h"

namespace terrabench {
namespace {

using Levels = std::span<const std::uint16_t>;  // of one column: begin, end, begin, end … upward

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// Whether a solid part of the column begins (or ends) at the level.
bool changes_at(Levels column, std::uint16_t level, bool begins) {
  const auto at = std::lower_bound(column.begin(), column.end(), level);
  return at != column.end() && *at == level && (at - column.begin()) % 2 == (begins ? 0 : 1);
}
// One row of the vertical lines where four columns meet. Every level at which one of the four begins or ends
// has a vertex. Where only two diagonal columns are solid between two such levels, four walls share the edge:
// two points in its middle separate them, the first for the northern column, the second for the southern.
struct CornerRow {
  std::vector<std::uint32_t> starts;  // of each corner's levels, and the end
  std::vector<std::uint16_t> levels;
  std::vector<std::uint32_t>
      middles;  // above each level: the first of the two middle points in the row, or kNone
  // Edges of cells with solid below one side and above the other, likewise; key: edge · 2¹⁶ + level. Edge 2i
  // lies north of column i, edge 2i + 1 west of it. The first point is the lower solid's, the second the
  // upper's.
  std::vector<std::uint64_t> crossings;

  std::uint32_t middles_count = 0;
  std::uint32_t first_vertex = 0;

  // Vertices in order: levels, middle points, crossing points.
  std::uint64_t vertices() const { return levels.size() + middles_count + 2 * crossings.size(); }
  std::uint32_t first_middle() const { return first_vertex + static_cast<std::uint32_t>(levels.size()); }
  std::uint32_t crossing(std::size_t edge, std::uint16_t level) const {
    const std::uint64_t key = edge << 16 | level;
    const auto at = std::lower_bound(crossings.begin(), crossings.end(), key) - crossings.begin();
    return first_middle() + middles_count + 2 * static_cast<std::uint32_t>(at);
  }
};

class BlockMesher {
 public:
  BlockMesher(const ColumnGrid& grid, int stride, const std::function<void(int, SurfaceRow&)>& row_of)
      : grid_(grid),
        stride_(stride),
        width_((grid.width + stride - 1) / stride),
        depth_((grid.depth + stride - 1) / stride) {
    rows_.resize(static_cast<std::size_t>(depth_));
    tbb::parallel_for(0, depth_, [&](int j) { read_row(j, row_of); });
  }

  TriangleMesh run() {
    corners_.resize(static_cast<std::size_t>(depth_) + 1);
    tbb::parallel_for(0, depth_ + 1, [&](int j) { find_corners(j); });
    std::uint64_t vertices = 0;
    for (CornerRow& row : corners_) {
      row.first_vertex = static_cast<std::uint32_t>(vertices);
      vertices += row.vertices();
      if (vertices > kNone)
        throw usage_error("the mesh has more than 2³² vertices", "block mesh", "choose larger cells");
    }
    // A closed surface has about two triangles per vertex; they are collected per row first.
    require_memory(static_cast<std::size_t>(vertices) * (sizeof(glm::vec3) + 12 * sizeof(std::uint32_t)),
                   "block mesh");
    TriangleMesh mesh;
    mesh.positions.resize(static_cast<std::size_t>(vertices));
    std::vector<std::vector<std::uint32_t>> triangles(corners_.size());
    tbb::parallel_for(0, depth_ + 1, [&](int j) {
      place_vertices(j, mesh);
      emit(j, triangles[static_cast<std::size_t>(j)]);
    });
    gather(triangles, mesh.indices);
    return mesh;
  }

 private:
  void read_row(int j, const std::function<void(int, SurfaceRow&)>& row_of) {
    SurfaceRow& row = rows_[static_cast<std::size_t>(j)];
    if (stride_ == 1) {
      row_of(j, row);
      return;
    }
    SurfaceRow whole;
    row_of(std::min(j * stride_ + stride_ / 2, grid_.depth - 1), whole);
    for (int i = 0; i < width_; ++i) {
      const Levels column =
          whole.column(static_cast<std::size_t>(std::min(i * stride_ + stride_ / 2, grid_.width - 1)));
      for (std::size_t l = 0; l < column.size(); l += 2) row.add_solid(column[l], column[l + 1]);
      row.end_column();
    }
  }

  Levels column(int i, int j) const {
    if (i < 0 || j < 0 || i >= width_ || j >= depth_) return {};
    return rows_[static_cast<std::size_t>(j)].column(static_cast<std::size_t>(i));
  }

  void find_corners(int j) {
    CornerRow& row = corners_[static_cast<std::size_t>(j)];
    std::vector<std::uint16_t> merged;
    row.starts.push_back(0);
    for (int i = 0; i <= width_; ++i) {
      const std::array<Levels, 4> around = {column(i - 1, j - 1), column(i, j - 1), column(i - 1, j),
                                            column(i, j)};
      merged.clear();
      for (const Levels levels : around) merged.insert(merged.end(), levels.begin(), levels.end());
      std::sort(merged.begin(), merged.end());
      merged.erase(std::unique(merged.begin(), merged.end()), merged.end());
      std::array<std::size_t, 4> passed{};  // levels of each column up to the current one
      for (const std::uint16_t level : merged) {
        for (std::size_t c = 0; c < 4; ++c) {
          if (passed[c] < around[c].size() && around[c][passed[c]] == level) ++passed[c];
        }
        const bool nw = passed[0] % 2 == 1, ne = passed[1] % 2 == 1, sw = passed[2] % 2 == 1,
                   se = passed[3] % 2 == 1;
        const bool diagonal = nw == se && ne == sw && nw != ne;
        row.middles.push_back(diagonal ? row.middles_count : kNone);
        row.middles_count += diagonal ? 2 : 0;
        row.levels.push_back(level);
      }
      row.starts.push_back(static_cast<std::uint32_t>(row.levels.size()));
      find_crossings(around[1], around[3], 2 * static_cast<std::size_t>(i), row);
      find_crossings(around[2], around[3], 2 * static_cast<std::size_t>(i) + 1, row);
    }
  }

  // Levels at which one of two neighbours ends and the other begins.
  static void find_crossings(Levels a, Levels b, std::size_t edge, CornerRow& row) {
    for (std::size_t p = 0, q = 0; p < a.size() && q < b.size();) {
      if (a[p] == b[q]) {
        if (p % 2 != q % 2) row.crossings.push_back(edge << 16 | a[p]);
        ++p, ++q;
      } else {
        a[p] < b[q] ? ++p : ++q;
      }
    }
  }

  float line_x(int i) const { return grid_.edge_x(std::min(i * stride_, grid_.width)); }
  float line_z(int j) const { return grid_.edge_z(std::min(j * stride_, grid_.depth)); }

  void place_vertices(int j, TriangleMesh& mesh) const {
    const CornerRow& row = corners_[static_cast<std::size_t>(j)];
    glm::vec3* const at = mesh.positions.data() + row.first_vertex;
    glm::vec3* const middle = at + row.levels.size();
    for (int i = 0; i <= width_; ++i) {
      for (std::uint32_t l = row.starts[static_cast<std::size_t>(i)];
           l < row.starts[static_cast<std::size_t>(i) + 1]; ++l) {
        at[l] = {line_x(i), grid_.edge_y(row.levels[l]), line_z(j)};
        if (row.middles[l] == kNone) continue;
        const glm::vec3 above = {line_x(i), grid_.edge_y(row.levels[l + 1]), line_z(j)};
        middle[row.middles[l]] = middle[row.middles[l] + 1] = 0.5F * (at[l] + above);
      }
    }
    glm::vec3* crossing = middle + row.middles_count;
    for (const std::uint64_t key : row.crossings) {
      const int i = static_cast<int>(key >> 17), level = static_cast<int>(key & 0xFFFF);
      const bool west = (key >> 16 & 1) != 0;
      const float x = west ? line_x(i) : 0.5F * (line_x(i) + line_x(i + 1));
      const float z = west ? 0.5F * (line_z(j) + line_z(j + 1)) : line_z(j);
      *crossing++ = {x, grid_.edge_y(level), z};
      *crossing++ = {x, grid_.edge_y(level), z};
    }
  }

  struct Emitter {
    std::vector<std::uint32_t>& indices;
    std::vector<std::uint32_t> left{}, right{};  // a wall's upright sides, bottom to top
    std::vector<std::uint32_t> polygon{};

    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      indices.push_back(a);
      indices.push_back(b);
      indices.push_back(c);
    }
    // All triangles around the first point of `polygon`.
    void fan() {
      for (std::size_t p = 1; p + 1 < polygon.size(); ++p) triangle(polygon[0], polygon[p], polygon[p + 1]);
    }
  };

  // The points of corner (i, j) from level `bottom` to `top`, as the column to its south (or north) sees
  // them.
  void side(int i, int j, std::uint16_t bottom, std::uint16_t top, bool south,
            std::vector<std::uint32_t>& points) const {
    const CornerRow& row = corners_[static_cast<std::size_t>(j)];
    points.assign(1, corner(i, j, bottom));
    std::uint32_t l = points[0] - row.first_vertex;
    for (; row.levels[l] < top; ++l) {
      if (row.middles[l] != kNone) points.push_back(row.first_middle() + row.middles[l] + (south ? 1 : 0));
      points.push_back(row.first_vertex + l + 1);
    }
  }

  std::uint32_t corner(int i, int j, std::uint16_t level) const {
    const CornerRow& row = corners_[static_cast<std::size_t>(j)];
    const auto levels = row.levels.begin();
    return row.first_vertex +
           static_cast<std::uint32_t>(std::lower_bound(levels + row.starts[static_cast<std::size_t>(i)],
                                                       levels + row.starts[static_cast<std::size_t>(i) + 1],
                                                       level) -
                                      levels);
  }

  void emit(int j, std::vector<std::uint32_t>& indices) const {
    Emitter out{indices};
    for (int i = 0; i <= width_; ++i) {
      emit_walls(column(i, j - 1), column(i, j), i, j, false, out);
      emit_walls(column(i - 1, j), column(i, j), i, j, true, out);
      const Levels own = column(i, j);
      for (std::size_t l = 0; l < own.size(); ++l) emit_flat(i, j, own[l], l % 2 == 1, out);
    }
  }

  // The walls between columns a and b, which lie north and south of the line from corner (i, j) eastward, or
  // (west) to the west and east of the line from it southward.
  void emit_walls(Levels a, Levels b, int i, int j, bool west, Emitter& out) const {
    std::size_t p = 0, q = 0;
    while (p < a.size() || q < b.size()) {
      const std::uint16_t bottom = q == b.size() || (p < a.size() && a[p] <= b[q]) ? a[p] : b[q];
      const bool flips_below = p < a.size() && q < b.size() && a[p] == b[q] && p % 2 != q % 2;
      p += p < a.size() && a[p] == bottom ? 1U : 0U;
      q += q < b.size() && b[q] == bottom ? 1U : 0U;
      if (p % 2 == q % 2) continue;
      const std::uint16_t top = q == b.size() || (p < a.size() && a[p] <= b[q]) ? a[p] : b[q];
      const bool flips_above = p < a.size() && q < b.size() && a[p] == b[q] && p % 2 != q % 2;
      emit_wall(i, j, west, p % 2 == 1, bottom, top, flips_below, flips_above, out);
    }
  }

  void emit_wall(int i, int j, bool west, bool first_is_solid, std::uint16_t bottom, std::uint16_t top,
                 bool flips_below, bool flips_above, Emitter& out) const {
    // Seen from the air, which side of the wall is left depends on which column is solid.
    std::vector<std::uint32_t>& here = west == first_is_solid ? out.right : out.left;
    std::vector<std::uint32_t>& there = west == first_is_solid ? out.left : out.right;
    if (west) {  // both columns lie south of the first corner and north of the second
      side(i, j, bottom, top, true, here);
      side(i, j + 1, bottom, top, false, there);
    } else {
      side(i, j, bottom, top, !first_is_solid, here);
      side(i + 1, j, bottom, top, !first_is_solid, there);
    }
    const CornerRow& row = corners_[static_cast<std::size_t>(j)];
    const std::size_t edge = 2 * static_cast<std::size_t>(i) + (west ? 1 : 0);
    if (!flips_below && !flips_above) {
      zip(out);
      return;
    }
    out.polygon.clear();
    if (flips_below) out.polygon.push_back(row.crossing(edge, bottom) + 1);
    if (flips_below) out.polygon.insert(out.polygon.end(), out.right.begin(), out.right.end());
    if (flips_above) out.polygon.push_back(row.crossing(edge, top));
    out.polygon.insert(out.polygon.end(), out.left.rbegin(), out.left.rend());
    if (!flips_below) out.polygon.insert(out.polygon.end(), out.right.begin(), out.right.end());
    out.fan();
  }

  // Between two upright rows of points, climbing both in step: no triangle has its corners on one line.
  static void zip(Emitter& out) {
    const std::size_t left_end = out.left.size() - 1, right_end = out.right.size() - 1;
    for (std::size_t l = 0, r = 0; l < left_end || r < right_end;) {
      if (l == left_end || (r < right_end && r * left_end <= l * right_end)) {
        out.triangle(out.left[l], out.right[r], out.right[r + 1]);
        ++r;
      } else {
        out.triangle(out.left[l], out.right[r], out.left[l + 1]);
        ++l;
      }
    }
  }

  void emit_flat(int i, int j, std::uint16_t level, bool top, Emitter& out) const {
    const auto crossed = [&](int ni, int nj) { return changes_at(column(ni, nj), level, top); };
    const CornerRow& north = corners_[static_cast<std::size_t>(j)];
    const CornerRow& south = corners_[static_cast<std::size_t>(j) + 1];
    const std::size_t edge = 2 * static_cast<std::size_t>(i);
    const std::uint32_t own = top ? 0 : 1;  // the point of the solid below, or above
    out.polygon.clear();
    std::size_t middle = 0;  // the position of the last middle point in the polygon
    const auto add = [&](std::uint32_t point) { out.polygon.push_back(point); };
    const auto add_middle = [&](std::uint32_t point) {
      middle = out.polygon.size();
      out.polygon.push_back(point + own);
    };
    add(corner(i, j + 1, level));  // south-west, then counter-clockwise from above
    if (crossed(i, j + 1)) add_middle(south.crossing(edge, level));
    add(corner(i + 1, j + 1, level));
    if (crossed(i + 1, j)) add_middle(north.crossing(edge + 3, level));
    add(corner(i + 1, j, level));
    if (crossed(i, j - 1)) add_middle(north.crossing(edge, level));
    add(corner(i, j, level));
    if (crossed(i - 1, j)) add_middle(north.crossing(edge + 1, level));
    std::rotate(out.polygon.begin(), out.polygon.begin() + static_cast<std::ptrdiff_t>(middle),
                out.polygon.end());
    if (!top) std::reverse(out.polygon.begin() + 1, out.polygon.end());
    out.fan();
  }

  static void gather(const std::vector<std::vector<std::uint32_t>>& rows,
                     std::vector<std::uint32_t>& indices) {
    std::vector<std::size_t> starts(rows.size() + 1, 0);
    for (std::size_t r = 0; r < rows.size(); ++r) starts[r + 1] = starts[r] + rows[r].size();
    indices.resize(starts.back());
    tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t r) {
      std::copy(rows[r].begin(), rows[r].end(), indices.begin() + static_cast<std::ptrdiff_t>(starts[r]));
    });
  }

  const ColumnGrid& grid_;
  int stride_, width_, depth_;
  std::vector<SurfaceRow> rows_;
  std::vector<CornerRow> corners_;
};

}  // namespace

TriangleMesh block_mesh(const ColumnGrid& grid, MeshDetail detail,
                        const std::function<void(int j, SurfaceRow& row)>& row_of) {
  const double cell = std::min(grid.cell_x, grid.cell_z), longest = std::max(grid.width, grid.depth);
  const int stride =
      detail.cell > 0 ? static_cast<int>(std::clamp(std::round(detail.cell / cell), 1.0, longest)) : 1;
  return BlockMesher(grid, stride, row_of).run();
}

}  // namespace terrabench
