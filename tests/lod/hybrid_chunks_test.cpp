// Chunks are built ahead of the eye, once per version; frames depend neither on threads nor on what was built
// when, and every byte is counted.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <map>
#include <set>

#include "lod/camera/camera_path.h"
#include "lod/hybrid/height_chunks.h"
#include "terrain/memory.h"
#include "tests/lod/hybrid_ground.h"
#include "tests/terrain/errors.h"

namespace terrabench::test {
namespace {

class HybridChunks : public ::testing::Test {
 protected:
  MesoGround meso_;
  const Heightfield field_ = meso_.heights();
};

std::vector<View> walk_over(const Heightfield& field) {
  std::vector<View> all;
  for (const CameraPath& path : camera_paths()) {
    if (path.kind != CameraPath::Kind::kWalk) continue;
    const std::vector<View> some = views(path, field);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

TEST_F(HybridChunks, NoneIsLateOnTheCommittedWalks) {
  Hybrid lod({field_, &meso_}, {.radius = 1});
  const std::vector<View> walk = walk_over(field_);
  ASSERT_GT(walk.size(), 50U);
  lod.update(walk.front());
  const std::size_t at_first = lod.late();
  EXPECT_GT(at_first, 0U);
  for (const View& view : walk) lod.update(view);
  EXPECT_EQ(lod.late(), at_first);
  EXPECT_GT(lod.built(), at_first);
}

TEST_F(HybridChunks, WithoutFetchingAheadEachNewOneIsLate) {
  Hybrid lod({field_, &meso_}, {.radius = 1, .ahead = 0});
  const std::vector<View> walk = walk_over(field_);
  lod.update(walk.front());
  const std::size_t at_first = lod.late();
  for (const View& view : walk) lod.update(view);
  EXPECT_GT(lod.late(), at_first + 5);
}

TEST_F(HybridChunks, TheBudgetLimitsWhatIsQueuedPerFrame) {
  Hybrid lod({field_, &meso_}, {.radius = 1, .ahead = 2});
  const View view = standing(field_, 40, 40, 0);
  lod.update(view);
  for (int frame = 1; frame < 12; ++frame) {
    lod.finish();
    // Nine near chunks, then two per frame of the sixteen around them.
    ASSERT_EQ(lod.built(), static_cast<std::size_t>(9 + std::min(2 * frame, 16))) << frame;
    lod.update(view);
  }
}

TEST_F(HybridChunks, FramesDependOnNoThreads) {
  std::vector<std::vector<glm::vec3>> reference;
  std::vector<std::size_t> late;
  for (const int threads : {1, 2, 5}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    tbb::task_arena(threads).execute([&] {
      Hybrid lod({field_, &meso_}, {.radius = 1, .ahead = 1});
      std::vector<std::vector<glm::vec3>> frames;
      for (const glm::vec2 at : random_places(field_, 12, 4)) {
        frames.push_back(corners_of(lod.update(standing(field_, at.x, at.y, 1))));
      }
      if (reference.empty()) reference = frames;
      EXPECT_EQ(frames, reference) << threads;
      late.push_back(lod.late());
    });
  }
  EXPECT_EQ(late, std::vector(3, late.front()));
}

TEST_F(HybridChunks, AnEditRebuildsItsChunksAlone) {
  Hybrid lod({field_, &meso_}, {.radius = 1, .height = kAboveAll});
  const View view = everything_from(40, 40);
  const auto ids = [](const Frame& frame) {
    std::set<std::uint64_t> all;
    for (const FrameMesh& mesh : frame.meshes) all.insert(mesh.id);
    return all;
  };
  const std::set<std::uint64_t> before = ids(lod.update(view));
  ASSERT_EQ(before.size(), 9U);
  lod.finish();
  const std::size_t built = lod.built();
  meso_.dig({40, field_.sample(40, 40), 40}, 5);  // within chunk (2, 2)
  const Frame& frame = lod.update(view);
  std::set<std::uint64_t> kept;
  for (const std::uint64_t id : ids(frame)) {
    if (before.contains(id)) kept.insert(id);
  }
  EXPECT_EQ(kept.size(), 8U);
  EXPECT_EQ(frame.uploads.size(), 1U);
  EXPECT_EQ(openings_inside(field_, frame), 0U);
  Hybrid fresh({field_, &meso_}, {.radius = 1, .height = kAboveAll});
  EXPECT_EQ(corners_of(frame), corners_of(fresh.update(view)));
  lod.finish();
  EXPECT_EQ(lod.built(), built + 1 + 4);  // and four more of the next ring
}

TEST_F(HybridChunks, ListsAndUploadsWhatANewFrameNeeds) {
  Hybrid lod({field_, &meso_}, {.radius = 1});
  std::map<std::uint64_t, std::vector<glm::vec3>> on_gpu;
  for (const glm::vec2 at : {glm::vec2(20, 20), glm::vec2(40, 20), glm::vec2(40, 20), glm::vec2(20, 20),
                             glm::vec2(80, 80), glm::vec2(20, 20)}) {
    const Frame& frame = lod.update(standing(field_, at.x, at.y, 0));
    std::map<std::uint64_t, std::vector<glm::vec3>> now;
    std::size_t bytes = 0;
    for (const DirtyRange& range : frame.uploads) {
      bytes += range.bytes();
      if (range.target != DirtyRange::Target::kMesh) continue;
      const FrameMesh& mesh = frame.meshes[range.first];
      EXPECT_EQ(range.bytes(), mesh.positions.size() * 24 + mesh.indices.size() * 4);
      EXPECT_FALSE(on_gpu.contains(mesh.id));  // else sent twice
      now[mesh.id] = {mesh.positions.begin(), mesh.positions.end()};
    }
    EXPECT_EQ(frame.stats.bytes_uploaded, bytes);
    for (const FrameMesh& mesh : frame.meshes) {
      if (on_gpu.contains(mesh.id)) now[mesh.id] = on_gpu[mesh.id];
      ASSERT_TRUE(now.contains(mesh.id)) << "listed, but never sent";
      EXPECT_TRUE(std::equal(mesh.positions.begin(), mesh.positions.end(), now[mesh.id].begin()));
      EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
    }
    on_gpu = now;
  }
}

TEST_F(HybridChunks, CountsItsHeapBytes) {
  const std::vector<glm::vec2> places = random_places(field_, 12, 4);
  Hybrid({field_, &meso_}, {.radius = 1}).update(standing(field_, 40, 40, 0));  // creates the threads
  const HeapScope heap;
  const auto lod = std::make_unique<Hybrid>(LodGround(field_, &meso_), HybridOptions{.radius = 1});
  for (const glm::vec2 at : places) {
    lod->update(standing(field_, at.x, at.y, 1));
    const auto counted = static_cast<std::int64_t>(lod->memory().total());
    EXPECT_EQ(heap.held(), counted);
  }
}

TEST_F(HybridChunks, AChunkThatCannotBeBuiltIsReportedAndTriedAgain) {
  Hybrid lod({field_, &meso_}, {.radius = 1});
  const View view = standing(field_, 40, 40, 0);
  meso_.fail_at = {2, 2};
  EXPECT_THROW(lod.update(view), std::runtime_error);
  EXPECT_THROW(lod.update(view), std::runtime_error);
  lod.finish();
  meso_.fail_at = {-1, -1};
  EXPECT_EQ(lod.update(view).meshes.size(), 9U);
}

TEST_F(HybridChunks, MayEndWhileChunksAreBeingBuilt) {
  for (int k = 0; k < 20; ++k) {
    Hybrid lod({field_, &meso_}, {.radius = 1, .ahead = 16});
    lod.update(standing(field_, 40, 40, 0));
  }
}

Failure failure_of(const LodGround& ground, const HybridOptions& options = {}) {
  return terrabench::failure_of([&] { Hybrid(ground, options).update(standing(ground.heights, 40, 40, 0)); });
}

TEST_F(HybridChunks, WhatDoesNotFitIsRefused) {
  EXPECT_EQ(failure_of({flat(1, 1), &meso_}).code, ExitCode::kUsage);
  for (const HybridOptions& options : {HybridOptions{.radius = -1}, HybridOptions{.radius = 17},
                                       HybridOptions{.band = 0}, HybridOptions{.band = 17}}) {
    EXPECT_EQ(failure_of({field_, &meso_}, options).code, ExitCode::kUsage);
  }
  for (const MesoOptions& options :
       {MesoOptions{.cell = 0.7F}, MesoOptions{.low = {0.5F, 0}}, MesoOptions{.low = {-16, 0}},
        MesoOptions{.low = {96, 0}}, MesoOptions{.cells = 128}, MesoOptions{.cell = 1.0F / 32}}) {
    const MesoGround meso(options);
    EXPECT_EQ(failure_of({field_, &meso}).code, ExitCode::kUsage) << options.cell << " " << options.low.x;
  }
  Heightfield oblong = field_;
  oblong.cell_z = 1.5F;
  EXPECT_EQ(failure_of({oblong, &meso_}).code, ExitCode::kUsage);
}

// A near surface that does not cover its bounds cannot meet the clipmap.
TEST_F(HybridChunks, ANearSurfaceWithOpeningsAtTheRimIsRefused) {
  const MesoGround bottomless({.relief = 30, .floor = false});
  EXPECT_EQ(failure_of({field_, &bottomless}).code, ExitCode::kBadInput);
  struct Nothing final : MeshChunks {
    Bounds bounds() const override { return {{0, 0, 0}, {96, 1, 96}}; }
    float cell() const override { return 1; }
    int cells() const override { return 16; }
    glm::ivec2 chunks() const override { return {6, 6}; }
    TriangleMesh chunk(glm::ivec2, int) const override { return {}; }
    std::uint64_t version(glm::ivec2) const override { return 0; }
  } const nothing;
  EXPECT_EQ(failure_of({field_, &nothing}).code, ExitCode::kBadInput);
}

TEST_F(HybridChunks, ASmallWindowHoldsFewer) {
  Hybrid lod({field_, &meso_}, {.radius = 2});
  const View view = standing(field_, 40, 40, 0);
  EXPECT_EQ(lod.update(view).meshes.size(), 25U);
  lod.tune(63);
  EXPECT_EQ(lod.update(view).meshes.size(), 1U);
  lod.tune(15);
  EXPECT_EQ(lod.update(view).meshes.size(), 0U);
  lod.tune(lod.least_window());
  EXPECT_EQ(lod.update(view).meshes.size(), 25U);
}

TEST_F(HybridChunks, EyesAnywhereAreDrawn) {
  Hybrid lod({field_, &meso_}, {.radius = 1});
  for (const glm::vec3 eye : {glm::vec3(48, -500, 48), glm::vec3(48, -8, 48), glm::vec3(-1e6F, 5, 40),
                              glm::vec3(1e30F, 1e30F, -1e30F), glm::vec3(96, 8, 96), glm::vec3(0, 8, 0)}) {
    View view = standing(field_, 48, 48, 0);
    view.eye = eye;
    view.target = eye.x > 1e9F ? glm::vec3(48, 0, 48) : eye + glm::vec3(1, -0.3F, 0);
    view.far = 1e32F;
    const Frame& frame = lod.update(view);
    EXPECT_EQ(frame.stats.triangles, corners_of(frame).size() / 3);
  }
}

// Versions lie in tiles of 1024² samples, which exist where something was edited; a plain array is the model.
TEST(HeightChunks, CountEditsOverTheBordersOfTiles) {
  Heightfield field;
  field.width = 1100;
  field.depth = 2200;
  field.heights.assign(std::size_t{1100} * 2200, 1);
  const HeapScope heap;
  hybrid::HeightChunks chunks(field);
  const glm::ivec2 all = chunks.chunks();
  std::vector<std::uint64_t> model(static_cast<std::size_t>(all.x) * all.y);
  const std::int64_t empty = heap.held() - static_cast<std::int64_t>(heap_bytes(model.data()));
  EXPECT_EQ(chunks.memory().total(), static_cast<std::size_t>(empty)) << "six tiles, none edited";
  const std::pair<glm::ivec2, glm::ivec2> edits[] = {{{1000, 10}, {1050, 40}},
                                                     {{5, 1020}, {9, 2060}},
                                                     {{1099, 2199}, {1099, 2199}},
                                                     {{1020, 1020}, {1030, 1030}}};
  constexpr int kCells = 16;
  for (const auto& [low, high] : edits) {
    chunks.edited(low, high);
    for (int b = 0; b < all.y; ++b) {
      for (int a = 0; a < all.x; ++a) {
        // A chunk shares its last samples with the next, and a normal depends on the samples beside its own.
        const glm::ivec2 first = glm::ivec2(a, b) * kCells - 1, last = first + kCells + 2;
        model[static_cast<std::size_t>(b) * all.x + a] +=
            low.x <= last.x && high.x >= first.x && low.y <= last.y && high.y >= first.y;
      }
    }
  }
  for (int b = 0; b < all.y; ++b) {
    for (int a = 0; a < all.x; ++a) {
      ASSERT_EQ(chunks.version({a, b}), model[static_cast<std::size_t>(b) * all.x + a]) << a << " " << b;
    }
  }
  EXPECT_EQ(chunks.memory().total(), static_cast<std::size_t>(heap.held()) - heap_bytes(model.data()));
  EXPECT_GT(chunks.memory().total(), static_cast<std::size_t>(empty));
}

}  // namespace
}  // namespace terrabench::test
