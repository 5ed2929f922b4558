// Grounds, views and checks that the tests of ROAM share.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "lod/meters/cracks.h"
#include "lod/meters/screen_error.h"
#include "tests/lod/drawing.h"
#include "tests/lod/roam_audit.h"

namespace terrabench::test {

struct Sizes {
  int width, depth;
};
// 2ⁿ + 1 samples and other numbers, square and long, down to a single cell.
inline constexpr Sizes kSizes[] = {{2, 2},   {3, 2},    {2, 9},    {4, 4},    {33, 33},
                                   {34, 65}, {100, 37}, {129, 65}, {150, 201}};

inline Heightfield ground(int width, int depth, float noise = 1) {
  return hilly(width, depth, noise, 1, 3, 2);
}

// An eye over the field or near it, sometimes underground, looking in any direction.
inline View random_view(const Heightfield& field, std::mt19937& random) {
  std::uniform_real_distribution<float> share(-0.2F, 1.2F), turn(-3.14F, 3.14F), height(-5, 60);
  View view;
  view.eye = {share(random) * field.extent_x(), 0, share(random) * field.extent_z()};
  view.eye.y = height(random);
  const float heading = turn(random), pitch = 0.3F * turn(random);
  view.target = view.eye + glm::vec3(std::cos(heading) * std::cos(pitch), std::sin(pitch),
                                     std::sin(heading) * std::cos(pitch));
  view.width = 320;
  view.height = 240;
  view.far = 5000;
  return view;
}

// Checks the invariants, the absence of cracks and the error in the frustum, which is returned.
inline double expect_kept(const Roam& roam, const Frame& frame, const Heightfield& field, const View& view,
                          double max_error = std::numeric_limits<double>::infinity()) {
  EXPECT_EQ(RoamAudit::first_problem(roam), "");
  const CrackReport cracks = find_cracks(frame, field.width, field.depth, view);
  EXPECT_TRUE(cracks.tight()) << cracks.gaps << " gaps, " << cracks.bare_edges << " bare edges, "
                              << cracks.overlaps << " overlaps";
  EXPECT_EQ(cracks.t_junctions, 0U);
  const SeenSamples seen(field, view);
  const ScreenDeviation error = screen_error(SurfaceRaster(frame, field.width, field.depth), field, seen);
  EXPECT_LE(error.in_frustum.largest, max_error * (1 + 1e-5) + 1e-4);
  EXPECT_EQ(error.in_frustum.undrawn, 0U);
  return error.in_frustum.largest;
}

}  // namespace terrabench::test
