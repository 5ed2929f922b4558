// No error above the bound, errors and floors as measured, edits, morphing, and the cost of a frame.
#include "lod/chunked/chunked.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <vector>

#include "lod/camera/camera_path.h"
#include "lod/meters/triangle_set.h"
#include "terrain/error.h"
#include "tests/lod/drawing.h"
#include "tests/lod/promises.h"

namespace terrabench::test {
namespace {

using chunked::kSurface;

Chunked make(const Heightfield& field, const Chunked::Options& options, double pixels) {
  Chunked lod(field, options, silent());
  lod.tune(pixels);
  return lod;
}

// Without and with morphing.
class ChunkedBothWays : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Morph, ChunkedBothWays, ::testing::Bool(),
                         [](const auto& info) { return std::string(info.param ? "morphing" : "still"); });

// There are cracks, so promises.h does not apply.
TEST_P(ChunkedBothWays, KeepsItsBoundOnAnyFieldFromAnywhere) {
  std::mt19937 random(7);
  double closest = 0;
  for (const auto& [width, depth] : {std::pair{2, 2}, {3, 100}, {65, 65}, {131, 70}, {603, 344}}) {
    const Heightfield field = hilly(width, depth, 0.5F, static_cast<unsigned>(width));
    for (const int side : {2, 8, 64}) {
      Chunked lod(field, {side, 0.008, true, GetParam()}, silent());
      for (int k = 0; k < 18; ++k) {
        const double pixels = std::array{0.5, 2.0, 9.0}[static_cast<std::size_t>(k % 3)];
        lod.tune(pixels);
        const View view = random_view(field, random);
        const Frame& frame = lod.update(view);
        const CrackReport cracks = find_cracks(frame, field.width, field.depth, view);
        ASSERT_EQ(cracks.bare_edges + cracks.overlaps + cracks.covered_again + cracks.flipped, 0U);
        const Deviation error =
            screen_error(SurfaceRaster(frame, field.width, field.depth), field, SeenSamples(field, view))
                .in_frustum;
        ASSERT_LE(error.largest, pixels) << width << " × " << depth << ", chunks of " << side;
        ASSERT_EQ(error.undrawn, 0U);
        closest = std::max(closest, error.largest / pixels);
      }
    }
  }
  EXPECT_GT(closest, 0.5);  // the bound is not met by drawing more than necessary
}

SurfaceRaster surface_of(const Chunked& lod, const Heightfield& field, int level, int x, int z,
                         float share = 0) {
  const IndexRange range = lod.chunks().part(level, x, z, kSurface);
  const Batch batch{.first_index = range.first_index, .index_count = range.index_count, .share = share};
  return {{.grid = grid_of(field),
           .indices = lod.chunks().indices(),
           .batches = {&batch, 1},
           .chunk_vertices = lod.chunks().vertices()},
          field.width,
          field.depth};
}

template <class Use>
void for_chunks(const Chunked& lod, int from_level, const Use& use) {
  for (int level = from_level; level < lod.tree().levels(); ++level) {
    for (int z = 0; z < lod.tree().grid(level).down(); ++z) {
      for (int x = 0; x < lod.tree().grid(level).across(); ++x) use(level, x, z);
    }
  }
}

TEST(Chunked, ErrorsAreMeasuredAndNoLessThanThoseBelow) {
  const Heightfield field = hilly(150, 77, 1, 3);
  const Chunked lod(field, {4, 0.02}, silent());
  ASSERT_EQ(lod.tree().levels(), 7);
  for_chunks(lod, 1, [&](int level, int x, int z) {
    const SurfaceRaster drawn = surface_of(lod, field, level, x, z);
    const PatchGrid::Patch square = lod.tree().grid(level).patch(x, z);
    float error = 0;
    for (int j = square.j0; j <= square.j0 + square.rows; ++j) {
      for (int i = square.i0; i <= square.i0 + square.columns; ++i) {
        error = std::max(error, std::abs(drawn.at(i, j) - field.at(i, j)));
      }
    }
    EXPECT_LE(error, 0.02F * static_cast<float>(4 << level));
    for (const auto& [dx, dz] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
      if (!lod.tree().has(level - 1, 2 * x + dx, 2 * z + dz)) continue;
      error = std::max(error, lod.chunks().error(level - 1, 2 * x + dx, 2 * z + dz));
    }
    EXPECT_EQ(lod.chunks().error(level, x, z), error);
  });
}

// The samples of a side, from west to east or north to south.
std::vector<glm::ivec2> side_of(const PatchGrid::Patch& square, Side side) {
  const bool along_x = side == kNorth || side == kSouth;
  std::vector<glm::ivec2> samples;
  for (int k = 0; k <= (along_x ? square.columns : square.rows); ++k) {
    const glm::ivec2 off(side == kEast ? square.columns
                         : along_x     ? k
                                       : 0,
                         side == kSouth ? square.rows
                         : !along_x     ? k
                                        : 0);
    samples.push_back(glm::ivec2(square.i0, square.j0) + off);
  }
  return samples;
}

TEST(Floors, AreAsLowAsTheLowestSideOnTheirLine) {
  const Heightfield field = hilly(150, 77, 3, 3);
  const Chunked lod(field, {4, 0.1}, silent());
  const GroundGrid grid = grid_of(field);
  const chunked::Floors floors(grid, lod.tree(), lod.chunks());
  // By direction, level and sample: the lowest surface of the chunks with a side there, or the ground.
  std::map<std::tuple<bool, int, int, int>, float> lowest;
  for_chunks(lod, 1, [&](int level, int x, int z) {
    const SurfaceRaster drawn = surface_of(lod, field, level, x, z);
    for (const Side side : {kNorth, kEast, kSouth, kWest}) {
      for (const glm::ivec2 at : side_of(lod.tree().grid(level).patch(x, z), side)) {
        float& low =
            lowest.try_emplace({side % 2 == 0, level, at.x, at.y}, field.at(at.x, at.y)).first->second;
        low = std::min(low, drawn.at(at.x, at.y));
      }
    }
  });
  std::size_t under_samples = 0;
  for_chunks(lod, 0, [&](int level, int x, int z) {
    for (const Side side : {kNorth, kEast, kSouth, kWest}) {
      float expected = std::numeric_limits<float>::max(), sampled = expected;
      for (const glm::ivec2 at : side_of(lod.tree().grid(level).patch(x, z), side)) {
        sampled = std::min(sampled, field.at(at.x, at.y));
        for (int coarser = level; coarser < lod.tree().levels(); ++coarser) {
          const auto known = lowest.find({side % 2 == 0, coarser, at.x, at.y});
          if (known != lowest.end()) expected = std::min(expected, known->second);
        }
      }
      expected = std::min(expected, sampled);
      EXPECT_EQ(floors.at(level, x, z, side), expected);
      under_samples += expected < sampled ? 1 : 0;
    }
  });
  EXPECT_GT(under_samples, 50U);
}

// Vertices arrive at the surface of the coarser chunk, whatever its triangles are.
TEST(MorphingChunks, LeadToTheCoarserSurface) {
  const Heightfield field = hilly(150, 77, 3, 3);
  const Chunked lod(field, {4, 0.1, true, true}, silent());
  const GroundGrid grid = grid_of(field);
  const chunked::Floors floors(grid, lod.tree(), lod.chunks());
  std::size_t moving = 0;
  for_chunks(lod, 1, [&](int level, int x, int z) {
    const bool coarsest = level + 1 == lod.tree().levels();
    const SurfaceRaster still = surface_of(lod, field, level, x, z),
                        moved = surface_of(lod, field, level, x, z, 1),
                        coarser = coarsest ? still : surface_of(lod, field, level + 1, x / 2, z / 2);
    const IndexRange range = lod.chunks().part(level, x, z, kSurface);
    for (std::uint32_t k = range.first_index; k < range.first_index + range.index_count; ++k) {
      const std::uint32_t sample = lod.chunks().sample(lod.chunks().indices()[k]);
      const int i = static_cast<int>(sample) % field.width, j = static_cast<int>(sample) / field.width;
      ASSERT_NEAR(moved.at(i, j), coarser.at(i, j), 1e-5);
      moving += moved.at(i, j) != field.at(i, j) ? 1 : 0;
    }
    float error = 0;
    const PatchGrid::Patch square = lod.tree().grid(level).patch(x, z);
    for (int j = square.j0; j <= square.j0 + square.rows; ++j) {
      for (int i = square.i0; i <= square.i0 + square.columns; ++i) {
        error = std::max(error, std::abs(moved.at(i, j) - field.at(i, j)));
      }
    }
    EXPECT_NEAR(lod.chunks().morphed_error(level, x, z), error, 1e-5);
    for (const Side side : {kNorth, kEast, kSouth, kWest}) {
      for (const glm::ivec2 at : side_of(square, side)) {
        EXPECT_LE(floors.at(level, x, z, side), std::min(still.at(at.x, at.y), moved.at(at.x, at.y)));
      }
    }
  });
  EXPECT_GT(moving, 1000U);
}

// RMS, pixels.
double popping_of(const Heightfield& field, bool morph) {
  Chunked lod = make(field, {4, 0.02, true, morph}, 4);
  Distribution pops;
  SurfaceRaster before(field.width, field.depth), after = before;
  std::size_t changes = 0;
  const std::vector<View> path = views(camera_path("fly"), field);
  before.draw(lod.update(path[0]));
  for (std::size_t k = 1; k < 60; ++k) {
    const Frame& frame = lod.update(path[k]);
    after.draw(frame);
    changes += frame.stats.changes;
    popping(before, after, SeenSamples(field, path[k]), &pops);
    std::swap(before, after);
  }
  EXPECT_GT(changes, 100U);
  return pops.rms();
}

// What is left: the triangles of a chunk are not those of the coarser one, and level 0 does not morph.
TEST(MorphingChunks, PopLess) {
  const Heightfield field = hilly(257, 257, 0.5F, 1, 5, 5);
  EXPECT_LT(popping_of(field, true), 0.8 * popping_of(field, false));
}

TEST(Chunked, DrawsTheSkirtsThatFaceTheEye) {
  const Heightfield field = flat(17, 17, 7);
  Chunked lod = make(field, {8}, 0.05);
  View view = from_above(field);
  EXPECT_EQ(lod.update(view).stats.triangles, 2U);  // the eye is over the chunk
  view.eye.z = -10;
  EXPECT_EQ(lod.update(view).stats.triangles, 4U);
  view.eye.x = 30;
  EXPECT_EQ(lod.update(view).stats.triangles, 6U);
}

// Often enough that chunks move, and that their array is packed.
TEST_P(ChunkedBothWays, DrawsAndUploadsAfterManyEditsAsIfBuiltAnew) {
  Heightfield field = hilly(100, 90, 0.3F);
  Chunked lod = make(field, {4, 0.02, true, GetParam()}, 0.2);
  View view = from_above(field);
  view.eye = {50, 30, -10};
  lod.update(view);
  std::vector<std::uint32_t> uploaded;
  std::vector<ChunkVertex> vertices;
  std::size_t largest = 0;
  std::mt19937 random(5);
  for (int k = 0; k < 60; ++k) {
    const glm::ivec2 low(random() % 80, random() % 70), high = low + glm::ivec2(random() % 20, random() % 20);
    std::uniform_real_distribution<float> noise(0, k % 20 == 0 ? 0.0F : static_cast<float>(k % 9));
    for (int j = low.y; j <= high.y; ++j) {
      for (int i = low.x; i <= high.x; ++i) field.at(i, j) += noise(random);
    }
    lod.edited({low, high});
    if (k % 3 == 0) continue;  // several edits in a frame
    const Frame& frame = lod.update(view);
    uploaded.resize(frame.indices.size());
    vertices.resize(frame.chunk_vertices.size());
    for (const DirtyRange& range : frame.uploads) {
      if (range.target == DirtyRange::Target::kIndices) {
        ASSERT_LE(range.first + range.count, frame.indices.size());
        std::copy_n(frame.indices.begin() + range.first, range.count, uploaded.begin() + range.first);
      } else if (range.target == DirtyRange::Target::kChunkVertices) {
        ASSERT_LE(range.first + range.count, frame.chunk_vertices.size());
        std::copy_n(frame.chunk_vertices.begin() + range.first, range.count, vertices.begin() + range.first);
      }
    }
    largest = std::max(largest, frame.indices.size());
    Chunked fresh = make(field, {4, 0.02, true, GetParam()}, 0.2);
    ASSERT_EQ(TriangleSet(frame), TriangleSet(fresh.update(view))) << k;
    if (k > 40) {
      for (const Batch& batch : frame.batches) {
        for (std::uint32_t i = batch.first_index; i < batch.first_index + batch.index_count; ++i) {
          const std::uint32_t vertex = frame.indices[i];
          ASSERT_EQ(uploaded[i], vertex) << k;
          if (vertex < 2 * field.heights.size()) continue;
          const std::size_t v = vertex - 2 * field.heights.size();
          ASSERT_EQ(vertices[v].sample, frame.chunk_vertices[v].sample);
          ASSERT_EQ(vertices[v].coarser, frame.chunk_vertices[v].coarser);
        }
      }
    }
  }
  EXPECT_LT(lod.update(view).indices.size(), largest);
}

TEST_P(ChunkedBothWays, UploadsOnceAndCountsChanges) {
  const Heightfield field = hilly(300, 200, 0.1F);
  Chunked lod = make(field, {8, 0.008, true, GetParam()}, 2);
  const std::vector<View> all = views(camera_path("fly"), field);
  const Frame& first = lod.update(all[0]);
  EXPECT_EQ(first.stats.bytes_uploaded,
            4 * (first.indices.size() + field.heights.size()) + 8 * first.chunk_vertices.size());
  EXPECT_EQ(first.chunk_vertices.empty(), !GetParam());
  EXPECT_GT(first.stats.changes, 0U);
  EXPECT_EQ(lod.update(all[0]).stats.changes, 0U);
  const Frame& later = lod.update(all[100]);
  EXPECT_GT(later.stats.changes, 0U);
  EXPECT_EQ(later.stats.bytes_uploaded, 0U);
}

TEST_P(ChunkedBothWays, TakesNoHeapBytesAFrame) {
  const Heightfield field = hilly(300, 257, 1);
  Chunked lod = make(field, {8, 0.008, true, GetParam()}, 1);
  const std::vector<View> all = views(camera_path("fly"), field);
  for (const View& view : all) lod.update(view);
  const std::int64_t live = HeapCounter::live();
  HeapCounter::reset_peak();
  for (const View& view : all) lod.update(view);
  EXPECT_EQ(HeapCounter::peak(), live);
}

TEST(Chunked, RefusesChunksOfOtherSizes) {
  const Heightfield field = flat(9, 9);
  const LodType& type = lod("chunked");
  Parameters parameters(type.parameters);
  for (const std::int64_t wrong : {1, 5, 48, 1024}) {
    EXPECT_THROW(
        {
          parameters.set("chunk", wrong);
          (void)type.build(field, parameters, silent());
        },
        Error)
        << wrong;
  }
}

}  // namespace
}  // namespace terrabench::test
