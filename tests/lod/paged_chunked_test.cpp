// Chunks on disk: the same triangles as in memory, the error bound, the budget, files of chunks and damage.
#include "lod/chunked/paged_chunked.h"

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "lod/camera/camera_path.h"
#include "lod/chunked/chunked.h"
#include "terrain/files.h"
#include "tests/lod/drawing.h"
#include "tests/lod/promises.h"
#include "tests/lod/settle.h"
#include "tests/terrain/errors.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench::test {
namespace {

using chunked::ChunkFile, chunked::ChunkFileOptions, chunked::ChunkPlace;

constexpr std::size_t kPlenty = std::size_t{1} << 28;

class PagedChunks : public ::testing::Test {
 protected:
  void build(const Heightfield& field, const ChunkFileOptions& options) const {
    ChunkFile::build(*heights_in_memory(field), options, path_, silent());
  }
  TemporaryFolder folder_;
  const std::string path_ = folder_ / "chunks";
};

using Triangle = std::array<std::array<float, 3>, 3>;

// Without skirts, which are vertical: on disk they hang lower, and all are drawn.
std::vector<Triangle> surface_of(const Frame& frame) {
  std::vector<Triangle> all;
  const std::vector<glm::vec3> corners = corners_of(frame);
  for (std::size_t k = 0; k < corners.size(); k += 3) {
    const glm::vec3 u = corners[k + 1] - corners[k], v = corners[k + 2] - corners[k];
    if (u.z * v.x == u.x * v.z) continue;
    Triangle triangle;
    for (std::size_t c = 0; c < 3; ++c) triangle[c] = {corners[k + c].x, corners[k + c].y, corners[k + c].z};
    std::ranges::rotate(triangle, std::ranges::min_element(triangle));
    all.push_back(triangle);
  }
  std::ranges::sort(all);
  return all;
}

TEST_F(PagedChunks, DrawTheTrianglesOfThoseInMemory) {
  std::mt19937 random(3);
  std::size_t coarse = 0;
  for (const auto& [width, depth] : {std::pair{2, 2}, {3, 100}, {150, 77}, {257, 257}}) {
    const Heightfield field = rounded(hilly(width, depth, 2, 3, 2, 3));
    build(field, {4, 512, 0.05});
    PagedChunked paged(path_, kPlenty);
    Chunked whole(field, {4, 0.05}, silent());
    for (int k = 0; k < 12; ++k) {
      const double pixels = std::array{0.5, 2.0, 20.0}[static_cast<std::size_t>(k % 3)];
      paged.tune(pixels);
      whole.tune(pixels);
      const View view = random_view(field, random);
      const std::vector<Triangle> expected = surface_of(whole.update(view));
      ASSERT_EQ(surface_of(settle(paged, view)), expected) << width << " × " << depth << ", " << k;
      coarse += std::ranges::count_if(whole.update(view).batches, [](const Batch& b) { return b.level > 0; });
    }
  }
  EXPECT_GT(coarse, 100U);
}

// Rounding to steps of a power of two is part of the errors: of heights that take more than 16 bits.
TEST_F(PagedChunks, KeepTheBoundOnHeightsThatAreRounded) {
  std::mt19937 random(7);
  double closest = 0;
  for (const auto& [width, depth] : {std::pair{65, 65}, {131, 70}, {300, 344}}) {
    Heightfield field = hilly(width, depth, 0.5F, static_cast<unsigned>(width));
    for (float& height : field.heights) height *= 300;  // steps of an eighth of a metre
    field.cell_x = field.cell_z = 300;
    build(field, {16, 64, 0.004});
    PagedChunked lod(path_, kPlenty);
    EXPECT_GT(lod.file().error({0, 0, 0}), 0.05F);
    for (int k = 0; k < 18; ++k) {
      const double pixels = std::array{0.5, 2.0, 9.0}[static_cast<std::size_t>(k % 3)];
      lod.tune(pixels);
      View view = random_view(field, random);
      view.near = 100;
      const Frame& frame = settle(lod, view);
      const CrackReport cracks = find_cracks(frame, field.width, field.depth, view);
      ASSERT_EQ(cracks.bare_edges + cracks.overlaps + cracks.covered_again + cracks.flipped, 0U);
      const Deviation error =
          screen_error(SurfaceRaster(frame, field.width, field.depth), field, SeenSamples(field, view))
              .in_frustum;
      ASSERT_LE(error.largest, pixels);
      ASSERT_EQ(error.undrawn, 0U);
      closest = std::max(closest, error.largest / pixels);
    }
  }
  EXPECT_GT(closest, 0.5);
}

// Frames that do not wait: along a path through ground of which the budget holds a part.
TEST_F(PagedChunks, KeepTheBudgetToTheByteAndTheChunksAbove) {
  const Heightfield field = hilly(700, 600, 1);
  build(field, {16, 256, 0.008});
  constexpr std::size_t kBudget = 3 << 20;
  const std::vector<View> path = views(camera_path("fly"), field);
  const HeapScope heap;
  auto lod = std::make_unique<PagedChunked>(path_, kBudget);
  lod->tune(1);
  std::size_t most = 0;
  for (const View& view : path) {
    const Frame& frame = lod->update(view);
    std::size_t bytes = 0;
    for (const FrameMesh& mesh : frame.meshes) {
      const bool shared = mesh.positions.size() == 17 * 17 + 64;  // indices, of level 0
      bytes += mesh.bytes() - (shared ? mesh.indices.size_bytes() : 0);
    }
    ASSERT_LE(bytes, lod->held_bytes());
    ASSERT_LE(lod->held_bytes(), kBudget);
    most = std::max(most, bytes);
  }
  EXPECT_GT(most, kBudget * 9 / 10);
  EXPECT_GT(lod->bytes_read(), most / 2);
  EXPECT_GT(lod->chunks_read(), lod->update(path.back()).meshes.size());
  const chunked::NodeTree& tree = lod->file().tree();
  for (int level = 0; level + 1 < tree.levels(); ++level) {
    for (int z = 0; z < tree.grid(level).down(); ++z) {
      for (int x = 0; x < tree.grid(level).across(); ++x) {
        EXPECT_TRUE(!lod->is_there({level, x, z}) || lod->is_there({level + 1, x / 2, z / 2}));
      }
    }
  }
  EXPECT_LE(lod->memory().payload, kBudget);  // waits for those being loaded
  EXPECT_EQ(static_cast<std::int64_t>(lod->memory().total()), heap.held());
}

TEST_F(PagedChunks, AreLateUntilTheyHaveComeAndUploadedOnce) {
  const Heightfield field = hilly(300, 200, 1);
  build(field, {16, 128, 0.004});
  PagedChunked lod(path_, kPlenty);
  const View view = views(camera_path("fly"), field).front();
  const FrameStats first = lod.update(view).stats;
  const std::size_t coarse = first.triangles;
  EXPECT_GT(first.changes, 0U);
  EXPECT_EQ(lod.late_frames(), 1U);
  EXPECT_GT(settle(lod, view).stats.triangles, coarse);
  const std::uint64_t late = lod.late_frames();
  const Frame& frame = lod.update(view);
  EXPECT_EQ(lod.late_frames(), late);
  EXPECT_EQ(frame.stats.changes, 0U);
  EXPECT_EQ(frame.stats.bytes_uploaded, 0U);
  View back = view;  // turned around, without waiting
  back.target = 2.0F * view.eye - view.target;
  lod.update(back);
  EXPECT_EQ(lod.late_frames(), late);
}

TEST_F(PagedChunks, FilesAreEqualForAnyNumberOfThreads) {
  const Heightfield field = hilly(300, 200, 1);
  build(field, {16, 64, 0.004});
  const std::string first = read_file(path_);
  build(field, {16, 64, 0.004});
  EXPECT_EQ(read_file(path_), first);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  build(field, {16, 64, 0.004});
  EXPECT_EQ(read_file(path_), first);
}

// Cut anywhere, or with any byte changed: refused when it is opened or when the chunk is loaded.
TEST_F(PagedChunks, DamageIsNamed) {
  const Heightfield field = hilly(100, 70, 1);
  build(field, {16, 64, 0.004});
  const std::string whole = read_file(path_);
  std::mt19937 random(5);
  const auto refused = [&](const std::string& content) {
    write_file(path_, content);
    const Failure failure = failure_of([&] {
      const ChunkFile file(path_);
      for (int level = 0; level < file.tree().levels(); ++level) {
        for (int z = 0; z < file.tree().grid(level).down(); ++z) {
          for (int x = 0; x < file.tree().grid(level).across(); ++x) (void)file.load({level, x, z});
        }
      }
    });
    EXPECT_EQ(failure.code, ExitCode::kBadInput);
    EXPECT_THAT(failure.what, testing::HasSubstr(path_));
  };
  refused("");
  refused(std::string(5000, 'x'));
  for (int k = 0; k < 40; ++k) refused(whole.substr(0, random() % whole.size()));
  for (int k = 0; k < 200; ++k) {
    std::string changed = whole;
    // Half of the changes in the entries and the tail.
    const std::size_t end = std::min<std::size_t>(whole.size(), 2000);
    const std::size_t at = k % 2 == 0 ? random() % whole.size() : whole.size() - 1 - random() % end;
    changed[at] = static_cast<char>(changed[at] ^ static_cast<char>(1 + random() % 255));
    refused(changed);
  }
  EXPECT_EQ(failure_of([&] { const PagedChunked lod(folder_ / "none", kPlenty); }).code, ExitCode::kBadInput);
}

TEST_F(PagedChunks, AFailureToLoadReachesTheNextUpdate) {
  const Heightfield field = hilly(100, 70, 1);
  build(field, {16, 64, 0.004});
  PagedChunked lod(path_, kPlenty);
  std::filesystem::resize_file(path_, 10);
  const View view = views(camera_path("fly"), field).front();
  lod.update(view);
  lod.finish();
  EXPECT_EQ(failure_of([&] { lod.update(view); }).code, ExitCode::kBadInput);
}

TEST_F(PagedChunks, RefuseWhatTheyCannotHold) {
  Heightfield field = hilly(60, 50, 1);
  const auto code_of = [&](const ChunkFileOptions& options) {
    return failure_of([&] { build(field, options); }).code;
  };
  for (const ChunkFileOptions wrong :
       {ChunkFileOptions{3, 64, 0.1}, {64, 32, 0.1}, {16, 1 << 16, 0.1}, {16, 64, 0}}) {
    EXPECT_EQ(code_of(wrong), ExitCode::kUsage);
  }
  EXPECT_TRUE(folder_.names().empty());
  build(field, {16, 64, 0.004});
  EXPECT_EQ(failure_of([&] { const PagedChunked lod(path_, 1000); }).code, ExitCode::kUsage);
  PagedChunked lod(path_, kPlenty);
  EXPECT_EQ(failure_of([&] { lod.edited({{0, 0}, {1, 1}}); }).code, ExitCode::kUsage);
  field.at(5, 5) = Heightfield::kNoData;
  EXPECT_EQ(code_of({16, 64, 0.1}), ExitCode::kUsage);
  const Heightfield rough = random_ground(513, 513, 1, 0, 100);  // one chunk of nearly all samples
  EXPECT_EQ(failure_of([&] {
              ChunkFile::build(*heights_in_memory(rough), {256, 512, 1e-6}, path_, silent());
            }).code,
            ExitCode::kUsage);
}

}  // namespace
}  // namespace terrabench::test
