#include "lod/tessellated/factor_errors.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace terrabench::tessellated {
namespace {

// Of the samples of the triangles that count, metres.
template <class Counts>
float largest_error(const GroundGrid& grid, const PatchGrid::Patch& patch,
                    std::span<const std::uint32_t> indices, const Counts& counts) {
  const auto height = [&](int x, int z) {
    return grid.heights[static_cast<std::size_t>(z) * grid.width + x];
  };
  float largest = 0;
  for (std::size_t k = 0; k < indices.size(); k += 3) {
    std::array<Corner, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) {
      const int index = static_cast<int>(indices[k + c]);
      const int x = patch.i0 + index % grid.width, z = patch.j0 + index / grid.width;
      corners[c] = {x, z, height(x, z)};
    }
    for_samples_on(corners.data(), grid.width, grid.depth, [&](int x, int z, float y) {
      if (counts(x, z)) largest = std::max(largest, std::abs(y - height(x, z)));
    });
  }
  return largest;
}

// The samples of a patch's side, from the lowest coordinate on.
struct Line {
  Line(const GroundGrid& grid, const PatchGrid::Patch& patch, int side)
      : along_x(side == kNorth || side == kSouth),
        last(along_x ? patch.columns : patch.rows),
        low(patch.i0 + (side == kEast ? patch.columns : 0), patch.j0 + (side == kSouth ? patch.rows : 0)),
        grid(grid) {}

  Corner sample(int k) const {
    const int x = low.x + (along_x ? k : 0), z = low.y + (along_x ? 0 : k);
    return {x, z, grid.heights[static_cast<std::size_t>(z) * grid.width + x]};
  }

  bool along_x;
  int last;
  glm::ivec2 low;
  const GroundGrid& grid;
};

float largest_error(const Line& line, int step) {
  float largest = 0;
  for (int k = 0; k < line.last; k += step) {
    plan_triangle::visit_edge(line.sample(k), line.sample(std::min(k + step, line.last)),
                              [&](int x, int z, float y) {
                                const int at = line.along_x ? x - line.low.x : z - line.low.y;
                                largest = std::max(largest, std::abs(y - line.sample(at).y));
                              });
  }
  return largest;
}

Sphere sphere_around(const Line& line) {
  const auto position = [&](int k) {
    const Corner at = line.sample(k);
    return glm::dvec3(static_cast<double>(at.x) * line.grid.cell_x, at.y,
                      static_cast<double>(at.z) * line.grid.cell_z);
  };
  glm::dvec3 low = position(0), high = low;
  for (int k = 1; k <= line.last; ++k) {
    low = glm::min(low, position(k));
    high = glm::max(high, position(k));
  }
  const glm::vec3 centre = 0.5 * (low + high);
  const double radius =
      std::max(glm::distance(glm::dvec3(centre), low), glm::distance(glm::dvec3(centre), high));
  return {centre, static_cast<float>((1 + 1e-6) * radius)};
}

}  // namespace

FactorErrors::FactorErrors(const GroundGrid& grid, const PatchGrid& cut, const PatchTriangles& triangles,
                           bool measured, Progress& progress)
    : logs_(triangles.logs()), measured_(measured), offsets_(cut.offsets()), spheres_(2 * cut.slots()) {
  if (measured) {
    of_sides_.resize(spheres_.size() * static_cast<std::size_t>(logs_ + 1));
    of_patches_.resize(place(static_cast<std::uint32_t>(cut.slots()), 1));
  }
  progress.begin("measuring patches", static_cast<std::uint64_t>(cut.down()));
  tbb::parallel_for(0, cut.down(), [&](int z) {
    measure(grid, cut, triangles, {0, cut.across() - 1, z, z});
    progress.advance();
  });
  progress.end();
}

// Beyond the ground's border the errors are 0.
float FactorErrors::beside(std::size_t side, int outside) const {
  const auto slot = static_cast<std::uint32_t>(side / 2);
  const int own = side % 2 == 0 ? kNorth : kWest, inside = std::max(outside, 1);
  const std::uint32_t other = slot + offsets_[static_cast<std::size_t>(own)];
  return std::max(of_strip(slot, inside, own, outside), of_strip(other, inside, own ^ 2, outside));
}

void FactorErrors::measure(const GroundGrid& grid, const PatchGrid& cut, const PatchTriangles& triangles,
                           const PatchGrid::PatchRect& patches) {
  tbb::parallel_for(patches.z0, patches.z1 + 1, [&](int z) {
    for (int x = patches.x0; x <= patches.x1; ++x) {
      measure_side(grid, cut, x, z, kNorth);
      measure_side(grid, cut, x, z, kWest);
      // The next patch measures the others.
      if (z == cut.down() - 1) measure_side(grid, cut, x, z, kSouth);
      if (x == cut.across() - 1) measure_side(grid, cut, x, z, kEast);
      if (measured_) measure_patch(grid, cut, triangles, x, z);
    }
  });
}

void FactorErrors::measure_side(const GroundGrid& grid, const PatchGrid& cut, int x, int z, int side) {
  const Line line(grid, cut.patch(x, z), side);
  const std::size_t number = this->side(cut.slot(x, z), side);
  spheres_[number] = sphere_around(line);
  if (!measured_) return;
  float* const errors = &of_sides_[number * static_cast<std::size_t>(logs_ + 1)];
  for (int outside = 0; outside <= logs_; ++outside) {
    errors[outside] = largest_error(line, cut.side >> outside);
  }
}

void FactorErrors::measure_patch(const GroundGrid& grid, const PatchGrid& cut,
                                 const PatchTriangles& triangles, int x, int z) {
  const PatchGrid::Patch patch = cut.patch(x, z);
  const std::uint32_t slot = cut.slot(x, z);
  const int shape = cut.shape(patch);
  const auto indices = [&](const IndexRange& range) {
    return triangles.indices().subspan(range.first_index, range.index_count);
  };
  for (int inside = 1; inside <= logs_; ++inside) {
    float* next = &of_patches_[place(slot, inside)];
    *next++ =
        largest_error(grid, patch, indices(triangles.inner(shape, inside)), [](int, int) { return true; });
    for (const int side : {kNorth, kEast, kSouth, kWest}) {
      const Line line(grid, patch, side);
      const auto counts = [&](int at_x, int at_z) {
        return line.along_x ? at_z != line.low.y : at_x != line.low.x;
      };
      for (int outside = 0; outside <= logs_; ++outside) {
        *next++ = largest_error(grid, patch, indices(triangles.strip(shape, inside, side, outside)), counts);
      }
    }
  }
}

}  // namespace terrabench::tessellated
