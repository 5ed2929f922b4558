// ROAM as a whole: what it promises of error, cracks, limits and uploads, over fields and views of all kinds.
#include "lod/roam/roam.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "lod/camera/camera_path.h"
#include "lod/meters/cracks.h"
#include "lod/meters/screen_error.h"
#include "terrain/error.h"
#include "terrain/memory.h"
#include "tests/lod/drawing.h"
#include "tests/lod/roam_audit.h"
#include "tests/terrain/errors.h"

namespace terrabench::test {
namespace {

Progress& silent() {
  static Progress progress;
  return progress;
}

struct Sizes {
  int width, depth;
};
// 2ⁿ + 1 and not, square and long, down to a single cell.
constexpr Sizes kSizes[] = {{2, 2},   {3, 2},    {2, 9},    {4, 4},    {33, 33},
                            {34, 65}, {100, 37}, {129, 65}, {150, 201}};

Heightfield ground(int width, int depth, float noise = 1) {
  Heightfield field = hilly(width, depth, noise);
  field.cell_x = 3;
  field.cell_z = 2;
  return field;
}

// Anywhere over the field and around it, under ground now and then, looking anywhere.
View random_view(const Heightfield& field, std::mt19937& random) {
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

// What every frame promises; the error where it is not limited otherwise. Returns the largest one.
double expect_kept(const Roam& roam, const Frame& frame, const Heightfield& field, const View& view,
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

TEST(Roam, KeepsItsErrorFromAnyView) {
  std::mt19937 random(7);
  double closest = 0;
  for (const auto& [width, depth] : kSizes) {
    const Heightfield field = ground(width, depth);
    Roam roam(field, {.max_error = 2}, silent());
    for (int k = 0; k < 12; ++k) {
      SCOPED_TRACE(::testing::Message() << width << " x " << depth << ", view " << k);
      const View view = random_view(field, random);
      closest = std::max(closest, expect_kept(roam, roam.update(view), field, view, 2) / 2);
    }
  }
  EXPECT_GT(closest, 0.9);  // a bound that is never neared is no choice of detail
}

// On high ground floats round off more than the ground's own roughness leaves to spare.
TEST(Roam, BoundsTheErrorOfHighGround) {
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

TEST(Roam, KeepsItsErrorOnHighGround) {
  std::mt19937 random(19);
  Heightfield field = ground(129, 65);
  for (float& height : field.heights) height += 3000;
  Roam roam(field, {.max_error = 0.5}, silent());
  for (int k = 0; k < 12; ++k) {
    SCOPED_TRACE(::testing::Message() << "view " << k);
    View view = random_view(field, random);
    view.eye.y += 3000;
    view.target.y += 3000;
    expect_kept(roam, roam.update(view), field, view, 0.5);
  }
}

TEST(Roam, AsksForMemoryBeforeItChangesAnything) {
  const Heightfield field = ground(40, 30);
  roam::Mesh mesh(grid_of(field), 0, silent());
  const std::size_t leaves = mesh.leaves(), nodes = mesh.nodes().size();
  EXPECT_EQ(failure_of([&] { mesh.make_room(std::size_t{1} << 44); }).code, ExitCode::kEnvironment);
  EXPECT_EQ(mesh.leaves(), leaves);
  EXPECT_EQ(mesh.nodes().size(), nodes);
  mesh.make_room(100);
  EXPECT_GE(mesh.nodes().size(), nodes + 200);
  EXPECT_EQ(mesh.leaves(), leaves);
  EXPECT_EQ(failure_of([] { require_memory(std::size_t{1} << 60, "a test"); }).code, ExitCode::kEnvironment);
}

TEST(Roam, IsExactWhereNoErrorIsAllowed) {
  for (const auto& [width, depth] : kSizes) {
    SCOPED_TRACE(::testing::Message() << width << " x " << depth);
    const Heightfield field = ground(width, depth);
    Roam roam(field, {.max_error = 1e-3}, silent());
    const View view = from_above(field);
    const Frame& frame = roam.update(view);
    expect_kept(roam, frame, field, view, 1e-3);
    double area = 0;
    triangles(frame, [&](std::span<const glm::vec3> corners) {
      for (std::size_t k = 0; k < corners.size(); k += 3) {
        const glm::vec3 u = corners[k + 1] - corners[k], v = corners[k + 2] - corners[k];
        const double twice = static_cast<double>(u.z) * v.x - static_cast<double>(u.x) * v.z;
        EXPECT_GT(twice, 0);
        area += 0.5 * twice;
      }
    });
    EXPECT_NEAR(area, static_cast<double>(field.extent_x()) * field.extent_z(), 1e-6 * area);
  }
}

TEST(Roam, KeepsItsErrorAlongPaths) {
  for (const auto& [width, depth] : {Sizes{129, 129}, {150, 201}}) {
    const Heightfield field = ground(width, depth, 0.3F);
    double closest = 0;
    for (const CameraPath& path : camera_paths()) {
      Roam roam(field, {.max_error = 3}, silent());
      const std::vector<View> frames = views(path, field);
      const std::size_t step = std::max<std::size_t>(frames.size() / 10, 1);
      for (std::size_t k = 0; k < frames.size(); ++k) {
        const Frame& frame = roam.update(frames[k]);
        if (k % step != 0) continue;
        SCOPED_TRACE(::testing::Message() << path.name << ", frame " << k);
        closest = std::max(closest, expect_kept(roam, frame, field, frames[k], 3) / 3);
      }
    }
    EXPECT_GT(closest, 0.9);
  }
}

// What was kept from earlier views costs a few triangles at most.
TEST(Roam, ComesFromAfarToWhatItMakesFromNothing) {
  const Heightfield field = ground(150, 201, 0.5F);
  std::mt19937 random(3);
  Roam warm(field, {.max_error = 1}, silent());
  for (int k = 0; k < 20; ++k) {
    View view = random_view(field, random);
    warm.update(view);
    for (int step = 0; step < 30; ++step) {
      view.eye.x += 0.2F;
      view.target += glm::vec3(0.2F, 0.001F, 0.01F);
      warm.update(view);
    }
    const std::size_t kept = warm.update(view).stats.triangles;
    const std::size_t fresh = Roam(field, {.max_error = 1}, silent()).update(view).stats.triangles;
    EXPECT_GE(kept, fresh);
    EXPECT_LE(static_cast<double>(kept), 1.1 * static_cast<double>(fresh) + 20);
  }
}

TEST(Roam, StaysWithinItsTriangles) {
  std::mt19937 random(11);
  for (const auto& [width, depth] : {Sizes{129, 129}, {150, 201}, {100, 37}}) {
    const Heightfield field = ground(width, depth);
    for (const std::size_t limit : {500U, 2000U}) {
      Roam roam(field, {.max_error = 0.01, .triangles = limit}, silent());
      for (int k = 0; k < 20; ++k) {
        SCOPED_TRACE(::testing::Message() << width << " x " << depth << ", view " << k);
        View view = random_view(field, random);
        for (int step = 0; step < 5; ++step) {
          view.eye.y += 0.1F;
          const Frame& frame = roam.update(view);
          EXPECT_LE(RoamAudit::leaves(roam), limit);
          expect_kept(roam, frame, field, view);
        }
      }
    }
  }
}

// With the limit lifted, or the same error asked in another way, the error is kept again.
TEST(Roam, SpendsItsTrianglesWhereTheErrorIsLargest) {
  const Heightfield field = ground(129, 129);
  View view;
  view.eye = {190, 30, 250};
  view.target = {190, 5, 0};
  Roam unlimited(field, {.max_error = 4}, silent());
  unlimited.update(view);
  const std::size_t enough = RoamAudit::leaves(unlimited);
  Roam limited(field, {.max_error = 0.01, .triangles = enough + 4}, silent());
  const Frame& frame = limited.update(view);
  // The queues meet at the error that so many triangles allow, to a bucket.
  expect_kept(limited, frame, field, view, 4 * 1.0625);
  EXPECT_GT(RoamAudit::reference(limited), RoamAudit::asked());
}

TEST(Roam, FollowsItsKnob) {
  const Heightfield field = ground(129, 129);
  View view;
  view.eye = {190, 30, 250};
  view.target = {190, 5, 0};
  Roam roam(field, {.max_error = 1}, silent());
  const std::size_t fine = roam.update(view).stats.triangles;
  roam.tune(8);
  const Frame& coarse = roam.update(view);
  expect_kept(roam, coarse, field, view, 8);
  EXPECT_LT(coarse.stats.triangles, fine / 2);
  roam.tune(1);
  EXPECT_EQ(roam.update(view).stats.triangles, fine);
}

TEST(Roam, TurnsOnTheSpot) {
  const Heightfield field = ground(150, 201);
  Roam roam(field, {.max_error = 2}, silent());
  View view;
  view.eye = {200, 20, 190};
  std::size_t first = 0;
  for (int degrees = 0; degrees <= 360; degrees += 5) {
    const float angle = static_cast<float>(degrees) * 0.0174532925F;
    view.target = view.eye + glm::vec3(std::cos(angle), -0.1F, std::sin(angle));
    const Frame& frame = roam.update(view);
    if (degrees == 0) first = frame.stats.triangles;
    if (degrees % 30 == 0) expect_kept(roam, frame, field, view, 2);
    if (degrees < 360) continue;
    EXPECT_NEAR(static_cast<double>(frame.stats.triangles), first, 0.05 * first);
  }
}

// As when it is kept just behind the ground, alone or while the eye moves.
TEST(Roam, FollowsAFarPlaneThatMoves) {
  const Heightfield field = ground(150, 201);
  for (const float step : {0.0F, 0.5F}) {
    Roam roam(field, {.max_error = 2}, silent());
    View view;
    view.eye = {200, 20, 390};
    view.target = {200, 15, 0};
    view.far = 500;
    const std::size_t all = roam.update(view).stats.triangles;
    std::size_t fewest = all;
    for (int k = 0; k < 60; ++k) {
      SCOPED_TRACE(::testing::Message() << step << " m a frame, frame " << k);
      view.far += k < 30 ? -14.0F : 14.0F;
      view.eye.z -= step;
      const Frame& frame = roam.update(view);
      fewest = std::min(fewest, frame.stats.triangles);
      if (k % 10 == 9) expect_kept(roam, frame, field, view, 2);
    }
    EXPECT_LT(fewest, all / 2);
    if (step == 0) {
      EXPECT_EQ(roam.update(view).stats.triangles, all);
    }
  }
}

TEST(Roam, TakesAnyView) {
  const Heightfield field = ground(150, 201);
  Roam roam(field, {.max_error = 2, .triangles = 20000}, silent());
  const auto take = [&](auto change) {
    View view;
    view.eye = {200, 40, 190};
    view.target = {100, 0, 50};
    change(view);
    roam.update(view);
    EXPECT_EQ(RoamAudit::first_problem(roam), "");
  };
  take([](View&) {});
  take([](View& v) { v.eye.y = -500; });
  take([](View& v) { v.eye = {-1e5F, 3, 1e5F}; });
  take([](View& v) { v.eye.y = 1e30F, v.up = {0, 0, -1}; });
  take([](View& v) { v.eye = glm::vec3(-3e38F), v.target = glm::vec3(3e38F); });
  take([](View& v) { v.width = v.height = 1; });
  take([](View& v) { v.width = 100000, v.height = 1; });
  take([](View& v) { v.vertical_fov = 1e-6F; });
  take([](View& v) { v.vertical_fov = 3.14159F; });
  take([](View& v) { v.up = {0, -1, 0}; });
  take([](View& v) { v.up = {0, 0, -1e-20F}, v.target = v.eye - glm::vec3(0, 1, 0); });
  take([](View& v) { v.near = 1e-6F, v.far = 1e30F; });
  take([](View& v) { v.near = 100, v.far = 101; });
  take([](View&) {});
}

TEST(Roam, RefusesWhatIsNoViewAndGoesOn) {
  const Heightfield field = ground(40, 30);
  Roam roam(field, {}, silent());
  const View view = from_above(field);
  const std::size_t triangles = roam.update(view).stats.triangles;
  View none = view;
  none.up = glm::vec3(0);
  EXPECT_THROW(roam.update(none), Error);
  none.up = {0, std::numeric_limits<float>::quiet_NaN(), 0};
  EXPECT_THROW(roam.update(none), Error);
  const FrameStats& after = roam.update(view).stats;
  EXPECT_EQ(after.triangles, triangles);
  EXPECT_EQ(after.changes, 0U);
}

TEST(Roam, StandsHeightsAsLargeAsFloatsAre) {
  Heightfield field = ground(20, 20);
  field.at(3, 3) = std::numeric_limits<float>::max();
  field.at(4, 4) = std::numeric_limits<float>::lowest();
  Roam roam(field, {}, silent());
  roam.update(from_above(ground(20, 20)));
  EXPECT_EQ(RoamAudit::first_problem(roam), "");
}

TEST(Roam, IsTheSameEveryTime) {
  const Heightfield field = ground(150, 201);
  Roam one(field, {.max_error = 1, .triangles = 3000}, silent());
  Roam other(field, {.max_error = 1, .triangles = 3000}, silent());
  std::mt19937 random(5);
  for (int k = 0; k < 20; ++k) {
    const View view = random_view(field, random);
    const std::span<const std::uint32_t> a = one.update(view).indices, b = other.update(view).indices;
    ASSERT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
  }
}

// Whoever keeps a copy of the indices and puts in what each frame names has what the frame draws.
TEST(Roam, UploadsWhatChangesAndNoMore) {
  const Heightfield field = ground(150, 201);
  Roam roam(field, {.max_error = 1}, silent());
  std::vector<std::uint32_t> copy;
  const auto put_in = [&](const Frame& frame) {
    copy.resize(frame.indices.size());
    for (const DirtyRange& range : frame.uploads) {
      if (range.target != DirtyRange::Target::kIndices) continue;
      ASSERT_LE(range.first + range.count, frame.indices.size());
      std::copy_n(frame.indices.begin() + range.first, range.count, copy.begin() + range.first);
    }
    ASSERT_TRUE(std::equal(copy.begin(), copy.end(), frame.indices.begin(), frame.indices.end()));
  };
  std::mt19937 random(9);
  for (int k = 0; k < 20; ++k) put_in(roam.update(random_view(field, random)));
  View view = random_view(field, random);
  view.eye = {200, 30, 190};
  put_in(roam.update(view));
  const Frame& same = roam.update(view);
  EXPECT_EQ(same.stats.bytes_uploaded, 0U);
  EXPECT_EQ(same.stats.changes, 0U);
  view.eye.x += 0.05F;
  view.target.x += 0.05F;
  const Frame& next = roam.update(view);
  put_in(next);
  EXPECT_GT(next.stats.triangles, 1000U);
  EXPECT_LT(next.stats.bytes_uploaded, next.stats.triangles * 12 / 20);
}

TEST(Roam, UploadsEverythingAtFirst) {
  const Heightfield field = ground(40, 30);
  Roam roam(field, {}, silent());
  const Frame& frame = roam.update(from_above(field));
  EXPECT_EQ(frame.stats.bytes_uploaded, 4 * (frame.indices.size() + 40 * 30));
}

TEST(Roam, StopsInTimeAndGoesOnLater) {
  const Heightfield field = ground(150, 201);
  Roam roam(field, {.max_error = 0.5, .milliseconds = 1e-6}, silent());
  View view;
  view.eye = {200, 40, 190};
  view.target = {100, 0, 50};
  Roam unlimited(field, {.max_error = 0.5}, silent());
  const std::size_t whole = unlimited.update(view).stats.triangles;
  const Frame& hurried = roam.update(view);
  EXPECT_LT(hurried.stats.triangles, whole / 4);
  expect_kept(roam, hurried, field, view);
  for (int k = 0; k < 10000 && roam.update(view).stats.changes > 0; ++k) {
  }
  expect_kept(roam, roam.update(view), field, view, 0.5);
}

TEST(Roam, CountsItsHeapBytes) {
  const Heightfield field = ground(150, 201);
  std::mt19937 random(2);
  std::vector<View> views;
  for (int k = 0; k < 5; ++k) views.push_back(random_view(field, random));
  Roam(field, {}, silent());  // the thread pool is made once
  for (const std::size_t limit : {0U, 1000U}) {
    const HeapScope heap;
    auto roam = std::make_unique<Roam>(field, RoamOptions{.triangles = limit}, silent());
    for (const View& view : views) roam->update(view);
    EXPECT_EQ(heap.held(), static_cast<std::int64_t>(roam->memory().total()));
  }
}

TEST(Roam, TakesNoMemoryOnceItHasWarmedUp) {
  const Heightfield field = ground(150, 201);
  Roam roam(field, {.max_error = 1, .triangles = 3000}, silent());
  const auto around = [&] {
    for (int degrees = 0; degrees < 360; degrees += 3) {
      View view;
      view.eye = {200, 20, 190};
      const float angle = static_cast<float>(degrees) * 0.0174532925F;
      view.target = view.eye + glm::vec3(std::cos(angle), -0.1F, std::sin(angle));
      roam.update(view);
    }
  };
  around();
  around();
  HeapCounter::reset_peak();
  const std::int64_t before = HeapCounter::live();
  around();
  EXPECT_EQ(HeapCounter::peak(), before);
}

TEST(Roam, IsBuiltByName) {
  const Heightfield field = ground(40, 30);
  Parameters parameters(lod("roam").parameters);
  parameters.set("triangles", std::int64_t{300});
  const std::unique_ptr<Lod> roam = lod("roam").build(field, parameters, silent());
  EXPECT_GT(roam->update(from_above(field)).stats.triangles, 0U);
}

}  // namespace
}  // namespace terrabench::test
