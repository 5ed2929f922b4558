#include "lod/tessellated/patch_triangles.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace terrabench::tessellated {

PatchTriangles::PatchTriangles(const PatchGrid& grid)
    : side_(grid.side),
      width_(grid.width),
      logs_(std::bit_width(static_cast<unsigned>(grid.side)) - 1),
      parts_(1 + 4 * (logs_ + 1)),
      patterns_(static_cast<std::size_t>(4 * logs_ * parts_)) {
  std::array<bool, 4> known{};
  for (const int z : {0, grid.down() - 1}) {
    for (const int x : {0, grid.across() - 1}) {
      const PatchGrid::Patch patch = grid.patch(x, z);
      const int shape = grid.shape(patch);
      if (!std::exchange(known[static_cast<std::size_t>(shape)], true)) add_shape(patch, shape);
    }
  }
  indices_.shrink_to_fit();
}

void PatchTriangles::add_shape(const PatchGrid::Patch& patch, int shape) {
  const auto size = [&] { return static_cast<std::uint32_t>(indices_.size()); };
  for (int inside = 1; inside <= logs_; ++inside) {
    IndexRange* next = &patterns_[static_cast<std::size_t>((shape * logs_ + inside - 1) * parts_)];
    const auto take = [&](std::uint32_t first) { *next++ = {first, size() - first}; };
    const std::uint32_t first = size();
    add_inner(patch, inside);
    take(first);
    for (const int side : {kNorth, kEast, kSouth, kWest}) {
      for (int outside = 0; outside <= logs_; ++outside) {
        const std::uint32_t of_strip = size();
        add_strip(patch, inside, side, outside);
        take(of_strip);
      }
    }
  }
}

void PatchTriangles::add_inner(const PatchGrid::Patch& patch, int inside) {
  const int n = 1 << inside, step = side_ >> inside;
  for (int j = 1; j < n - 1; ++j) {
    for (int i = 1; i < n - 1; ++i) {
      const Point north_west{i * step, j * step}, south_east{(i + 1) * step, (j + 1) * step};
      const Point north_east{south_east.x, north_west.z}, south_west{north_west.x, south_east.z};
      if ((2 * i < n) == (2 * j < n)) {
        add(patch, north_west, south_west, south_east);
        add(patch, north_west, south_east, north_east);
      } else {
        add(patch, north_west, south_west, north_east);
        add(patch, north_east, south_west, south_east);
      }
    }
  }
}

void PatchTriangles::add_strip(const PatchGrid::Patch& patch, int inside, int side, int outside) {
  const int n = 1 << inside, step = side_ >> inside;
  // A point by its cells along the side and away from it.
  const auto place = [&](int along, int away) {
    const int far = side_ - away;
    const Point places[] = {{along, away}, {far, along}, {along, far}, {away, along}};
    return places[side];
  };
  int out = 0, in = 0;  // segments done
  const auto outer = [&](int k) { return place(k * (side_ >> outside), 0); };
  const auto inner = [&](int k) { return place((k + 1) * step, step); };
  const auto advance_outer = [&] {
    add(patch, outer(out), inner(in), outer(out + 1));
    ++out;
  };
  const auto advance_inner = [&] {
    add(patch, outer(out), inner(in), inner(in + 1));
    ++in;
  };
  if (outside == 0) {  // its only segment lies between the halves of the inner row
    while (in < (n - 2) / 2) advance_inner();
    advance_outer();
    while (in < n - 2) advance_inner();
    return;
  }
  // Fractions of a half in units of the finer row's segments.
  const int half = std::max(n, 1 << outside) / 2, in_step = 2 * half >> inside,
            out_step = 2 * half >> outside;
  advance_outer();
  for (int at = 1; at < half; ++at) {
    if (at % in_step == 0) advance_inner();
    if (at % out_step == 0) advance_outer();
  }
  for (int at = half - 1; at > 0; --at) {
    if (at % out_step == 0) advance_outer();
    if (at % in_step == 0) advance_inner();
  }
  advance_outer();
}

// Counter-clockwise from above. Points beyond the border move to it along the axes: each triangle has a side
// along an axis, so it keeps its orientation or loses its area.
void PatchTriangles::add(const PatchGrid::Patch& patch, const Point& a, const Point& b, const Point& c) {
  std::array<Corner, 3> corners;
  for (std::size_t k = 0; const Point& p : {a, b, c}) {
    corners[k++] = {std::min(p.x, patch.columns), std::min(p.z, patch.rows)};
  }
  const long long area = doubled_plan_area(corners.data());
  if (area == 0) return;
  if (area < 0) std::swap(corners[1], corners[2]);
  for (const Corner& corner : corners) {
    indices_.push_back(static_cast<std::uint32_t>(corner.z * width_ + corner.x));
  }
}

void PatchTriangles::append(const TessellatedPatch& patch, int shape, std::vector<Batch>& batches) const {
  const int inside = factor_log(patch.factors, kInside);
  const auto level = static_cast<std::uint16_t>(logs_ - inside);
  const auto add = [&](const IndexRange& range) {
    if (range.index_count > 0) {
      batches.push_back({range.first_index, range.index_count, patch.corner, level});
    }
  };
  add(inner(shape, inside));
  for (const int side : {kNorth, kEast, kSouth, kWest}) {
    add(strip(shape, inside, side, factor_log(patch.factors, side)));
  }
}

Memory PatchTriangles::memory() const {
  Memory memory = index_memory(patterns_);
  memory += payload_memory(indices_);
  return memory;
}

}  // namespace terrabench::tessellated
