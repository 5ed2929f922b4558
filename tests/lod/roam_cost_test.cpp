// The cost of a frame of ROAM: the limits on triangles and time, memory, and the bytes to upload.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "lod/roam/roam.h"
#include "terrain/error.h"
#include "terrain/memory.h"
#include "tests/lod/roam_ground.h"
#include "tests/terrain/errors.h"

namespace terrabench::test {
namespace {

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
  // The queues meet at the error of the unlimited mesh, to a bucket.
  expect_kept(limited, frame, field, view, 4 * 1.0625);
  EXPECT_GT(RoamAudit::exact_from(limited), RoamAudit::max_error_bucket());
}

// No diamond is in a lower bucket than a leaf. Its present priority may be lower than its bucket: by at most
// 24 buckets on these flights, never below max_error, and in a new mesh not below a leaf's.
TEST(Roam, MergesLateAtItsLimitWhileTheCameraMoves) {
  const Heightfield field = ground(257, 257);
  int latest = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(-1, 1);
    Roam roam(field, {.max_error = 0.01, .triangles = 1000}, silent());
    View view = random_view(field, random);
    view.eye.y += 20;
    const float metres = seed % 3 == 0 ? 0.3F : seed % 3 == 1 ? 2 : 8;
    const glm::vec3 way = metres * glm::vec3(unit(random), 0.5F * unit(random), unit(random));
    for (int step = 0; step < 60; ++step, view.eye += way, view.target += way) {
      SCOPED_TRACE(::testing::Message() << "flight " << seed << ", step " << step);
      roam.update(view);
      EXPECT_EQ(RoamAudit::first_problem(roam), "");
      const int highest = RoamAudit::highest_leaf_bucket(roam);
      if (highest <= RoamAudit::max_error_bucket()) continue;  // the limit does not bind
      for (const RoamAudit::Diamond& diamond : RoamAudit::diamonds(roam)) {
        EXPECT_GE(diamond.bucket, highest);
        EXPECT_GE(diamond.present, step == 0 ? highest : RoamAudit::max_error_bucket());
        latest = std::max(latest, diamond.bucket - diamond.present);
      }
    }
  }
  EXPECT_LE(latest, 24);
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

// A copy of the indices, updated by each frame's uploads, equals what the frame draws.
TEST(Roam, UploadsOnlyWhatChanges) {
  const Heightfield field = ground(150, 201);
  Roam roam(field, {.max_error = 1}, silent());
  std::vector<std::uint32_t> copy;
  const auto apply = [&](const Frame& frame) {
    copy.resize(frame.indices.size());
    for (const DirtyRange& range : frame.uploads) {
      if (range.target != DirtyRange::Target::kIndices) continue;
      ASSERT_LE(range.first + range.count, frame.indices.size());
      std::copy_n(frame.indices.begin() + range.first, range.count, copy.begin() + range.first);
    }
    ASSERT_TRUE(std::equal(copy.begin(), copy.end(), frame.indices.begin(), frame.indices.end()));
  };
  std::mt19937 random(9);
  for (int k = 0; k < 20; ++k) apply(roam.update(random_view(field, random)));
  View view = random_view(field, random);
  view.eye = {200, 30, 190};
  apply(roam.update(view));
  const Frame& same = roam.update(view);
  EXPECT_EQ(same.stats.bytes_uploaded, 0U);
  EXPECT_EQ(same.stats.changes, 0U);
  view.eye.x += 0.05F;
  view.target.x += 0.05F;
  const Frame& next = roam.update(view);
  apply(next);
  EXPECT_GT(next.stats.triangles, 1000U);
  EXPECT_LT(next.stats.bytes_uploaded, next.stats.triangles * 12 / 20);
}

TEST(Roam, CountsItsHeapBytesAtItsLimit) {
  const Heightfield field = ground(150, 201);
  std::mt19937 random(2);
  std::vector<View> views;
  for (int k = 0; k < 5; ++k) views.push_back(random_view(field, random));
  Roam(field, {}, silent());  // creates the thread pool, which stays
  const HeapScope heap;
  const auto roam = std::make_unique<Roam>(field, RoamOptions{.triangles = 1000}, silent());
  for (const View& view : views) roam->update(view);
  EXPECT_EQ(heap.held(), static_cast<std::int64_t>(roam->memory().total()));
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

TEST(Roam, AllocatesBeforeItChangesAnything) {
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

}  // namespace
}  // namespace terrabench::test
