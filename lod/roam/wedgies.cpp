#include "lod/roam/wedgies.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace terrabench::roam {
namespace {

std::uint16_t encode_up(double bound) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  // With heights of ±1e38 m the bound may exceed the range of float; infinity is then used.
  float up = bound <= std::numeric_limits<float>::max() ? static_cast<float>(bound) : kInfinity;
  if (up < bound) up = std::nextafter(up, kInfinity);
  return static_cast<std::uint16_t>((std::bit_cast<std::uint32_t>(up) + 0xFFFFU) >> 16);
}

}  // namespace

// In double: on high ground, the float rounding of an interpolated height is a visible fraction of a pixel.
struct Wedgies::Builder {
  const Lattice& lattice;
  const GroundGrid& grid;
  Wedgies& wedgies;

  double height(int u, int v) const {
    return grid.heights[static_cast<std::size_t>(lattice.row[v]) * grid.width + lattice.column[u]];
  }
  double below(int u, int v) const {
    const bool inside = u >= 0 && v >= 0 && u < lattice.width() && v < lattice.depth();
    return inside ? wedgies.thickness(u, v) : 0.0;
  }
  // The position of line b as a share of the way from line a to line c.
  static double share(const std::vector<std::int32_t>& lines, int a, int b, int c) {
    return static_cast<double>(lines[b] - lines[a]) / static_cast<double>(lines[c] - lines[a]);
  }

  // The middle of an edge of 2s steps along an axis, where the triangles on both sides have the same height.
  void edge(int u, int v, int s, bool along_x) {
    const double t = along_x ? share(lattice.column, u - s, u, u + s) : share(lattice.row, v - s, v, v + s);
    const double before = along_x ? height(u - s, v) : height(u, v - s);
    const double after = along_x ? height(u + s, v) : height(u, v + s);
    double bound = std::abs(height(u, v) - (before + t * (after - before)));
    if (s > 1) {
      const int h = s / 2;
      bound += std::max(std::max(below(u - h, v - h), below(u + h, v - h)),
                        std::max(below(u - h, v + h), below(u + h, v + h)));
    }
    store(u, v, bound);
  }

  // The middle of a square of 2s × 2s steps, which lies on the square's diagonal, or off it by less than a
  // sample where lattice lines share samples. It is compared with the planes of both triangles, so that the
  // wedgies nest in that case too.
  void centre(int u, int v, int s) {
    const bool falling = ((u - s) / (2 * s) + (v - s) / (2 * s)) % 2 == 0;
    const double t = share(lattice.column, u - s, u, u + s), r = share(lattice.row, v - s, v, v + s);
    const double west_north = height(u - s, v - s), east_north = height(u + s, v - s);
    const double west_south = height(u - s, v + s), east_south = height(u + s, v + s);
    const double here = height(u, v);
    double one, other;
    if (falling) {
      one = east_north + (1 - t) * (west_north - east_north) + r * (east_south - east_north);
      other = west_south + t * (east_south - west_south) + (1 - r) * (west_north - west_south);
    } else {
      one = west_north + t * (east_north - west_north) + r * (west_south - west_north);
      other = east_south + (1 - t) * (west_south - east_south) + (1 - r) * (east_north - east_south);
    }
    store(
        u, v,
        std::max(std::abs(here - one), std::abs(here - other)) +
            std::max(std::max(below(u - s, v), below(u + s, v)), std::max(below(u, v - s), below(u, v + s))));
  }

  // All points of step size s from (u0, v0) to (u1, v1), both included; edges before centres, which need
  // them.
  void points(int s, int u0, int v0, int u1, int v1) {
    const int first = (v0 + s - 1) / s, last = v1 / s;  // rows of edges
    // The least place from `u0` on that is an odd or an even multiple of s.
    const auto begin = [&](bool odd) {
      return (u0 + (odd ? s : 2 * s) - 1) / (2 * s) * 2 * s + (odd ? s : 0);
    };
    tbb::parallel_for(first, last + 1, [&](int row) {
      const bool along_x = row % 2 == 0;
      for (int u = begin(along_x); u <= u1; u += 2 * s) edge(u, row * s, s, along_x);
    });
    tbb::parallel_for(first | 1, last + 1, 2, [&](int row) {
      for (int u = begin(true); u <= u1; u += 2 * s) centre(u, row * s, s);
    });
  }

  void store(int u, int v, double bound) { wedgies.bounds_[wedgies.place(u, v)] = encode_up(bound); }
};

Wedgies::Wedgies(const Lattice& lattice, const GroundGrid& grid, Progress& progress)
    : last_u_(lattice.width() - 1) {
  const int width = lattice.width(), depth = lattice.depth();
  for (int k = 0; k < lattice.side_log; ++k) {
    first_[k + 1] = first_[k] + 3 * squares(width - 1, k) * squares(depth - 1, k);
  }
  bounds_.resize(first_[lattice.side_log]);
  progress.begin("bounding the triangle trees", static_cast<std::uint64_t>(lattice.side_log));
  Builder builder{lattice, grid, *this};
  for (int s = 1; s < 1 << lattice.side_log; s *= 2) {
    builder.points(s, 0, 0, width - 1, depth - 1);
    progress.advance();
  }
  progress.end();
}

void Wedgies::update(const Lattice& lattice, const GroundGrid& grid, int u0, int v0, int u1, int v1) {
  Builder builder{lattice, grid, *this};
  for (int s = 1; s < 1 << lattice.side_log; s *= 2) {
    builder.points(s, std::max(u0 - 3 * s, 0), std::max(v0 - 3 * s, 0),
                   std::min(u1 + 3 * s, lattice.width() - 1), std::min(v1 + 3 * s, lattice.depth() - 1));
  }
}

}  // namespace terrabench::roam
