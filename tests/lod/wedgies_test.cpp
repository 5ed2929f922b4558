// Wedgies bound the error of the triangles that they are made for.
#include "lod/roam/wedgies.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lod/lod.h"
#include "tests/lod/roam_ground.h"

namespace terrabench::test {
namespace {

// On high ground floats round off more than the ground's own roughness leaves to spare.
TEST(Wedgies, BoundTheErrorOfHighGround) {
  for (const auto& [width, depth] : kSizes) {
    Heightfield field = hilly(width, depth, 0.002F);
    for (float& height : field.heights) height = 3000 + 0.001F * height;
    const roam::Lattice lattice = roam::lattice_over(width, depth);
    if (lattice.side_log == 0) continue;  // nothing to split
    const roam::Wedgies wedgies(lattice, grid_of(field), silent());
    const auto height = [&](int u, int v) -> double { return field.at(lattice.column[u], lattice.row[v]); };
    std::size_t rough = 0;
    for (int v = 0; v < lattice.depth(); v += 2) {
      for (int u = 1; u + 1 < lattice.width(); u += 2) {
        const std::int32_t* const at = &lattice.column[u];
        const double t = static_cast<double>(at[0] - at[-1]) / (at[1] - at[-1]);
        const double off = std::abs(height(u, v) - ((1 - t) * height(u - 1, v) + t * height(u + 1, v)));
        EXPECT_GE(wedgies.thickness(u, v), off - 1e-9) << width << " x " << depth << ", " << u << ", " << v;
        rough += off > 0;
      }
    }
    EXPECT_GT(rough, 0U);
  }
}

}  // namespace
}  // namespace terrabench::test
