// What methods with an error bound and without cracks promise, from eyes anywhere.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "lod/meters/cracks.h"
#include "lod/meters/screen_error.h"
#include "terrain/heightfield.h"

namespace terrabench::test {

// An eye near the ground, high above it, below it or outside, looking in any direction.
inline View random_view(const Heightfield& field, std::mt19937& random) {
  std::uniform_real_distribution<float> unit(0, 1);
  const float size = std::max(field.extent_x(), field.extent_z());
  View view;
  view.eye = {(1.4F * unit(random) - 0.2F) * field.extent_x(), 0,
              (1.4F * unit(random) - 0.2F) * field.extent_z()};
  view.eye.y = unit(random) < 0.5F ? 20 * unit(random) : -15 + size * unit(random);
  view.target = view.eye + glm::vec3(unit(random) - 0.5F, 0.6F * unit(random) - 0.5F, unit(random) - 0.5F);
  view.vertical_fov = 0.3F + 1.5F * unit(random);
  view.width = 50 + static_cast<int>(700 * unit(random));
  view.height = 50 + static_cast<int>(500 * unit(random));
  view.near = 0.1F + unit(random);
  view.far = 4 * size + 100;
  return view;
}

// Checks that there are no cracks, no error above the bound, and no undrawn samples. Returns the largest
// error.
inline double expect_promises(const Frame& frame, const Heightfield& field, const View& view, double pixels) {
  const CrackReport cracks = find_cracks(frame, field.width, field.depth, view);
  EXPECT_TRUE(cracks.tight()) << cracks.gaps << " gaps, " << cracks.bare_edges << " bare, "
                              << cracks.overlaps;
  EXPECT_EQ(cracks.t_junctions, 0U);
  const ScreenDeviation error =
      screen_error(SurfaceRaster(frame, field.width, field.depth), field, SeenSamples(field, view));
  EXPECT_LE(error.in_frustum.largest, pixels);
  EXPECT_EQ(error.in_frustum.undrawn, 0U);
  return error.in_frustum.largest;
}

}  // namespace terrabench::test
