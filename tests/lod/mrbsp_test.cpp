// Level of detail by bisection: which triangles are drawn, at which depth, and without holes.
#include "lod/mrbsp/mrbsp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "lod/meters/cracks.h"
#include "lod/meters/screen_error.h"
#include "tests/lod/mrbsp_ground.h"
#include "tests/terrain/errors.h"

namespace terrabench {
namespace {

using test::plan_area;

MrbspOptions options_of(bool area, bool conforming, int depth = 0) {
  MrbspOptions options;
  options.depth = depth;
  options.area_consistent = area;
  options.holes = conforming ? HoleRule::kConforming : HoleRule::kPrinted;
  return options;
}

TEST(Mrbsp, DrawsThePapersNumberOfTriangles) {
  const Heightfield field = rough_ground(257, 257);
  Mrbsp lod(field, options_of(true, true, 16), silent());
  lod.tune(Mrbsp::knob().finest);
  EXPECT_EQ(lod.update(test::from_above(field)).stats.triangles, 65536U);
  EXPECT_NEAR(lod.short_side(), std::sqrt(2 * 5.0 * 4.0), 1e-4);
}

TEST(Mrbsp, CoversFieldsOfAnySizeOnceAtAnyDepth) {
  for (const auto& [width, depth] : {std::pair{2, 2}, {3, 2}, {33, 33}, {34, 65}, {100, 37}, {2, 40}}) {
    const Heightfield field = rough_ground(width, depth);
    const double area = plan_area(field);
    for (const bool conforming : {true, false}) {
      const int deepest = BisectionTree::over(width, depth).depth();
      for (int levels = 1; levels <= deepest; ++levels) {
        Mrbsp lod(field, options_of(false, conforming, levels), silent());
        lod.tune(Mrbsp::knob().finest);
        EXPECT_NEAR(plan_area(lod.update(test::from_above(field))), area, 1e-5 * area)
            << width << " × " << depth << ", depth " << levels;
      }
    }
    Mrbsp lod(field, options_of(false, true), silent());
    lod.tune(Mrbsp::knob().finest);
    EXPECT_EQ(lod.update(test::from_above(field)).stats.triangles,
              std::size_t{2} * (width - 1) * (depth - 1));
  }
}

TEST(Mrbsp, TakesTheDepthThatTheFormulaSays) {
  const Heightfield field = rough_ground(65, 65, 0);
  for (const bool area : {false, true}) {
    Mrbsp lod(field, options_of(area, false), silent());
    const double s = lod.short_side();
    for (double d = 0.3; d < 1e4; d *= 1.37) {
      const double formula = 13 - (area ? 2 : 1) * std::log2(d / s);
      const int expected = std::clamp(static_cast<int>(std::ceil(formula)), 1, 13);
      EXPECT_EQ(lod.threshold({0, 0, 0}, {0, static_cast<float>(d), 0}), expected) << d;
    }
  }
}

// Each triangle is drawn at the depth given by its furthest corner, never at a coarser one. A deeper triangle
// is half of a triangle that had to be split: either all corners of that one exceed its depth, though the
// centre of its hypotenuse is further away, or the printed hole rule applies.
TEST(Mrbsp, DrawsEachTriangleAtTheDepthOfItsFurthestCorner) {
  const Heightfield field = rough_ground(65, 65);
  Mrbsp lod(field, options_of(false, false), silent());
  lod.tune(3);
  const View view = walker(field, 0.3F, 0.4F, 0.7F);
  std::set<int> depths;
  std::size_t deeper = 0, count = 0;
  // Either end of the half's hypotenuse may be the right angle of the whole triangle.
  const auto had_to_be_split = [&](std::span<const glm::vec3> half, int depth) {
    for (const auto& [apex, end] : {std::pair{half[1], half[2]}, {half[2], half[1]}}) {
      const float x = 2 * half[0].x - end.x, z = 2 * half[0].z - end.z;
      if (x < 0 || z < 0 || x > field.extent_x() || z > field.extent_z()) continue;
      const glm::vec3 other(x, field.sample(x, z), z);
      const int at_apex = lod.threshold(view.eye, apex);
      const int at_ends = std::min(lod.threshold(view.eye, end), lod.threshold(view.eye, other));
      if (std::min(at_apex, at_ends) >= depth || (at_apex < depth && at_apex < at_ends)) return true;
    }
    return false;
  };
  triangles(lod.update(view), [&](std::span<const glm::vec3> corners) {
    for (std::size_t k = 0; k < corners.size(); k += 3) {
      const glm::vec3 u = corners[k + 1] - corners[k], v = corners[k + 2] - corners[k];
      const double doubled = static_cast<double>(u.z) * v.x - static_cast<double>(u.x) * v.z;
      const int depth = static_cast<int>(std::lround(std::log2(2.0 * 64 * 64 * 20 / doubled)));
      int threshold = 13;
      for (int c = 0; c < 3; ++c) threshold = std::min(threshold, lod.threshold(view.eye, corners[k + c]));
      EXPECT_GE(depth, threshold);
      if (depth > threshold) {
        ++deeper;
        EXPECT_TRUE(had_to_be_split(corners.subspan(k, 3), depth));
      }
      ++count;
      depths.insert(depth);
    }
  });
  EXPECT_GT(depths.size(), 3U);
  EXPECT_GT(deeper, 0U);
  EXPECT_LT(deeper, count / 8);
}

TEST(Mrbsp, ConformingIsTightAndWholeAndThePrintedRuleIsNot) {
  const Heightfield field = rough_ground(129, 100);
  std::size_t printed_gaps = 0;
  for (const bool area : {false, true}) {
    Mrbsp sealed(field, options_of(area, true), silent()), printed(field, options_of(area, false), silent());
    for (const double size : {0.7, 3.0, 11.0}) {
      sealed.tune(size);
      printed.tune(size);
      for (int k = 0; k < 12; ++k) {
        const auto share = static_cast<float>(k) / 12;
        const View view = walker(field, 0.05F + 0.9F * share, 0.9F - 0.8F * share, 5 * share);
        const Frame& frame = sealed.update(view);
        const CrackReport report = find_cracks(frame, field.width, field.depth, view);
        EXPECT_TRUE(report.tight()) << report.gaps << " gaps, " << report.bare_edges << " bare edges";
        EXPECT_EQ(report.t_junctions, 0U);
        const SurfaceRaster drawn(frame, field.width, field.depth);
        EXPECT_EQ(screen_error(drawn, field, SeenSamples(field, view)).visible.undrawn, 0U);
        printed_gaps += find_cracks(printed.update(view), field.width, field.depth, view).gaps;
      }
    }
  }
  EXPECT_GT(printed_gaps, 0U);
}

TEST(Mrbsp, CullsOnlyWhatTheViewDoesNotSee) {
  const Heightfield field = rough_ground(65, 65);
  MrbspOptions options = options_of(true, true);
  Mrbsp culled(field, options, silent());
  options.cull = false;
  Mrbsp whole(field, options, silent());
  culled.tune(8);
  whole.tune(8);
  const View view = walker(field, 0.5F, 0.5F, 1);
  const std::size_t all = whole.update(view).stats.triangles, some = culled.update(view).stats.triangles;
  EXPECT_GT(some, 0U);
  EXPECT_LT(some, 2 * all / 3);
  EXPECT_NEAR(plan_area(whole.update(view)), plan_area(field), 1);
  // Every triangle left out projects outside the picture or the depth range.
  std::set<std::array<float, 9>> drawn;
  const auto each = [](const Frame& frame, const auto& body) {
    triangles(frame, [&](std::span<const glm::vec3> c) {
      for (std::size_t k = 0; k < c.size(); k += 3) {
        body(std::array<float, 9>{c[k].x, c[k].y, c[k].z, c[k + 1].x, c[k + 1].y, c[k + 1].z, c[k + 2].x,
                                  c[k + 2].y, c[k + 2].z});
      }
    });
  };
  // At the finest level both draw the same triangles.
  culled.tune(Mrbsp::knob().finest);
  whole.tune(Mrbsp::knob().finest);
  each(culled.update(view), [&](const auto& t) { drawn.insert(t); });
  const glm::mat4 clip = world_to_clip(view);
  each(whole.update(view), [&](const auto& t) {
    if (drawn.contains(t)) return;
    for (int c = 0; c < 3; ++c) {
      const glm::vec4 at = clip * glm::vec4(t[3 * c], t[3 * c + 1], t[3 * c + 2], 1);
      const bool inside = std::abs(at.x) < at.w && std::abs(at.y) < at.w && std::abs(at.z) < at.w;
      EXPECT_FALSE(inside);
    }
  });
}

TEST(Mrbsp, UploadsNothingWhileNothingChanges) {
  const Heightfield field = rough_ground(65, 65);
  Mrbsp lod(field, {}, silent());
  const View view = walker(field, 0.5F, 0.5F, 1);
  const Frame& frame = lod.update(view);
  EXPECT_EQ(frame.stats.bytes_uploaded, 4 * (frame.indices.size() + 65 * 65));
  EXPECT_EQ(lod.update(view).stats.bytes_uploaded, 0U);
  std::vector<std::uint32_t> on_gpu(frame.indices.begin(), frame.indices.end());
  // Replaying the uploads keeps the copy equal.
  for (int k = 0; k < 20; ++k) {
    const Frame& next = lod.update(walker(field, 0.5F + 0.01F * static_cast<float>(k), 0.5F, 1));
    on_gpu.resize(next.indices.size());
    for (const DirtyRange& range : next.uploads) {
      std::copy_n(next.indices.begin() + range.first, range.count, on_gpu.begin() + range.first);
    }
    EXPECT_TRUE(std::equal(on_gpu.begin(), on_gpu.end(), next.indices.begin(), next.indices.end()));
  }
}

TEST(Mrbsp, LooksForNoCellUnderAnEyeThatIsInNone) {
  const Heightfield field = rough_ground(65, 40);
  MrbspOptions options;
  options.visibility = true;
  options.visible.cells = 4;
  Mrbsp lod(field, options, silent());
  View view = walker(field, 0.5F, 0.5F, 0);
  view.target = {160.5F, 3, 80};
  for (const glm::vec3 eye : {glm::vec3(0, -1e4F, 0),
                              {1e6F, 10, -1e6F},
                              {1e30F, 1e30F, 1e30F},
                              {-1e38F, 3e38F, 0},
                              {160, 0, 80},
                              {320, 5, 156}}) {
    view.eye = eye;
    EXPECT_NO_THROW(lod.update(view));
  }
}

TEST(Mrbsp, RefusesBadParameters) {
  const Heightfield field = rough_ground(9, 9);
  EXPECT_EQ(failure_of([&] { Mrbsp(field, options_of(false, true, 8), silent()); }).code, ExitCode::kUsage);
  for (const char* const text : {"threshold=none", "holes=some", "visibility=yes", "heights=exact"}) {
    Parameters parameters(Mrbsp::parameters());
    EXPECT_EQ(failure_of([&] { parameters.set_from_text(text); }).code, ExitCode::kUsage) << text;
  }
}

TEST(Mrbsp, EveryCombinationBuildsFromParametersAndCountsItsBytes) {
  const Heightfield field = rough_ground(70, 50);
  for (const char* const threshold : {"threshold=printed", "threshold=area"}) {
    for (const char* const holes : {"holes=printed", "holes=conforming", "holes=left"}) {
      for (const char* const visibility :
           {"visibility=off", "visibility=sampled", "visibility=facing", "visibility=conservative"}) {
        for (const char* const heights : {"heights=samples", "heights=nearest"}) {
          Parameters parameters(Mrbsp::parameters());
          for (const char* const text : {threshold, holes, visibility, heights, "cells=4"}) {
            parameters.set_from_text(text);
          }
          Mrbsp::build(field, parameters, silent())->update(walker(field, 0.2F, 0.8F, 2));  // warms up
          const HeapScope heap;
          const auto lod = Mrbsp::build(field, parameters, silent());
          lod->update(walker(field, 0.2F, 0.8F, 2));
          lod->update(walker(field, 0.8F, 0.2F, 2));
          EXPECT_EQ(heap.held(), static_cast<std::int64_t>(lod->memory().total()));
        }
      }
    }
  }
}

TEST(Mrbsp, InterpolatedHeightsAreALatticeOfTheirOwn) {
  const Heightfield field = rough_ground(50, 41);
  MrbspOptions options = options_of(true, true, 12);
  options.three_nearest = true;
  Mrbsp lod(field, options, silent());
  lod.tune(Mrbsp::knob().finest);
  const Frame& frame = lod.update(test::from_above(field));
  EXPECT_EQ(frame.stats.triangles, 4096U);
  EXPECT_EQ(frame.grid.width, 65);
  EXPECT_NEAR(plan_area(frame), plan_area(field), 1);
}

}  // namespace
}  // namespace terrabench
