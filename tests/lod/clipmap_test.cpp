// The windows hold what the ground holds wherever the eye went, cover the ground once, and meet without a
// gap.
#include "lod/clipmap/clipmap.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <random>
#include <string>

#include "terrain/error.h"
#include "terrain/memory.h"

namespace terrabench {
namespace {

Heightfield rough(int width, int depth) {
  Heightfield field;
  field.width = width;
  field.depth = depth;
  field.cell_x = 2.0F;
  field.cell_z = 3.0F;
  std::mt19937 random(7);
  for (int k = 0; k < width * depth; ++k)
    field.heights.push_back(static_cast<float>(random() % 1000) * 0.01F);
  return field;
}

// An eye low enough for every level, and a view that holds everything because it is nearly flat and far off.
View everything(const Heightfield& field, float x, float z, float above) {
  View view;
  view.eye = {x, 10 + above, z};
  view.target = {x, 0, z};
  view.up = {0, 0, -1};
  view.vertical_fov = 3.14F;
  view.width = view.height = 100;
  view.near = 0.01F;
  view.far = 100 * (field.extent_x() + field.extent_z());
  return view;
}

struct Soup {
  double area = 0;
  std::size_t flipped = 0;
  // Directed edges by the bits of their ends; what is left after opposite ones cancel.
  std::map<std::array<std::array<std::uint32_t, 3>, 2>, int> open;
};

std::array<std::uint32_t, 3> bits(const glm::vec3& p) {
  return {std::bit_cast<std::uint32_t>(p.x + 0.0F), std::bit_cast<std::uint32_t>(p.y + 0.0F),
          std::bit_cast<std::uint32_t>(p.z + 0.0F)};
}

Soup collect(const Frame& frame) {
  Soup soup;
  triangles(frame, [&](std::span<const glm::vec3> corners) {
    for (std::size_t k = 0; k < corners.size(); k += 3) {
      const glm::dvec3 p = corners[k], q = corners[k + 1], r = corners[k + 2];
      const double area = 0.5 * ((q.z - p.z) * (r.x - p.x) - (q.x - p.x) * (r.z - p.z));
      if (area == 0) continue;  // beyond the border
      soup.flipped += area < 0;
      soup.area += area;
      for (int e = 0; e < 3; ++e) {
        const auto a = bits(corners[k + e]), b = bits(corners[k + (e + 1) % 3]);
        if (const auto other = soup.open.find({b, a}); other != soup.open.end()) {
          if (--other->second == 0) soup.open.erase(other);
        } else {
          ++soup.open[{a, b}];
        }
      }
    }
  });
  return soup;
}

bool on_border(const Heightfield& field, const std::array<std::uint32_t, 3>& point) {
  const float x = std::bit_cast<float>(point[0]), z = std::bit_cast<float>(point[2]);
  return x == 0 || z == 0 || x == field.extent_x() || z == field.extent_z();
}

std::string point(const std::array<std::uint32_t, 3>& p) {
  return fmt::format("({}, {}, {})", std::bit_cast<float>(p[0]), std::bit_cast<float>(p[1]),
                     std::bit_cast<float>(p[2]));
}

void expect_closed(const Heightfield& field, const Frame& frame) {
  const Soup soup = collect(frame);
  EXPECT_EQ(soup.flipped, 0U);
  EXPECT_NEAR(soup.area, static_cast<double>(field.extent_x()) * field.extent_z(), 1e-6 * soup.area);
  for (const auto& [edge, times] : soup.open) {
    EXPECT_EQ(times, 1);
    EXPECT_TRUE(on_border(field, edge[0]) && on_border(field, edge[1]))
        << "from " << point(edge[0]) << " to " << point(edge[1]);
  }
}

TEST(ClipmapWindow, CoversItsCellsOnceWithoutOddVerticesAtTheBorder) {
  for (const int m : {2, 3, 4, 7, 16}) {
    const clipmap::Window window = clipmap::make_window(m);
    const auto twice_area = [&](const clipmap::Block& block) {
      int sum = 0;
      for (std::uint32_t k = block.first_index; k < block.first_index + block.index_count; k += 3) {
        std::array<int, 3> a, b;
        for (int c = 0; c < 3; ++c) {
          a[c] = static_cast<int>(window.indices[k + c]) % window.side;
          b[c] = static_cast<int>(window.indices[k + c]) / window.side;
          EXPECT_TRUE((a[c] != 0 && a[c] != window.n - 1) || b[c] % 2 == 0);
          EXPECT_TRUE((b[c] != 0 && b[c] != window.n - 1) || a[c] % 2 == 0);
        }
        const int area = (b[1] - b[0]) * (a[2] - a[0]) - (a[1] - a[0]) * (b[2] - b[0]);
        EXPECT_GT(area, 0);
        sum += area;
      }
      return sum;
    };
    int whole = 0;
    for (const auto& block : window.ring) whole += twice_area(block);
    for (const auto& block : window.middle) whole += twice_area(block);
    EXPECT_EQ(whole, 2 * (window.n - 1) * (window.n - 1));
    for (const auto& trim : window.trims) {
      EXPECT_EQ(twice_area(trim), 2 * (4 * m * m - (2 * m - 1) * (2 * m - 1)));
    }
  }
}

TEST(Clipmap, MeetsWithoutGapsWhereverTheEyeIs) {
  std::mt19937 random(3);
  for (const auto& [width, depth] : {std::pair{257, 257}, {300, 141}, {403, 344}, {2, 2}, {3, 100}}) {
    const Heightfield field = rough(width, depth);
    Clipmap lod(heights_in_memory(field), 31);
    for (int k = 0; k < 20; ++k) {
      const float x = field.extent_x() * (static_cast<float>(random() % 1400) / 1000 - 0.2F);
      const float z = field.extent_z() * (static_cast<float>(random() % 1400) / 1000 - 0.2F);
      expect_closed(field, lod.update(everything(field, x, z, 1 + static_cast<float>(random() % 60))));
      if (HasFatalFailure()) return;
    }
  }
}

TEST(Clipmap, HoldsTheGroundsHeightsAfterAnyWalk) {
  const Heightfield field = rough(500, 400);
  Clipmap lod(heights_in_memory(field), 63);
  std::mt19937 random(11);
  float x = 500, z = 600;
  for (int k = 0; k < 200; ++k) {
    const auto step = [&] { return static_cast<float>(random() % 61) - 30; };
    x = k % 50 == 49 ? static_cast<float>(random() % 1000) : x + step();
    z += step();
    const Frame& frame = lod.update(everything(field, x, z, 1));
    for (int l = 0; l < lod.levels(); ++l) {
      const ClipLevel& level = frame.levels[l];
      for (int b = level.corner.y; b < level.corner.y + lod.window(); ++b) {
        for (int a = level.corner.x; a < level.corner.x + lod.window(); ++a) {
          const int i = std::clamp(a * level.spacing, 0, field.width - 1);
          const int j = std::clamp(b * level.spacing, 0, field.depth - 1);
          const int mask = level.side - 1;
          ASSERT_EQ(level.heights[(b & mask) * level.side + (a & mask)], field.at(i, j)) << k << ' ' << l;
        }
      }
    }
  }
}

TEST(Clipmap, UploadsTheLShapedStripsOnly) {
  const Heightfield field = rough(1025, 1025);
  Clipmap lod(heights_in_memory(field), 127);
  const auto at = [&](int i, int j) {
    return everything(field, static_cast<float>(i) * field.cell_x, static_cast<float>(j) * field.cell_z, 1);
  };
  const std::size_t n = static_cast<std::size_t>(lod.window());
  const std::size_t all = lod.update(at(512, 512)).stats.bytes_uploaded;
  EXPECT_GT(all, 4 * n * n * static_cast<std::size_t>(lod.levels()));
  EXPECT_EQ(lod.update(at(512, 512)).stats.bytes_uploaded, 0U);
  EXPECT_EQ(lod.update(at(513, 513)).stats.bytes_uploaded, 0U);         // windows go in steps of two samples
  EXPECT_EQ(lod.update(at(514, 512)).stats.bytes_uploaded, 4 * 2 * n);  // the finest level alone
  EXPECT_EQ(
      lod.update(at(516, 514)).stats.bytes_uploaded,  // L: two columns, two rows; the next level: columns
      4 * (2 * n + 2 * (n - 2)) + 4 * 2 * n);
}

TEST(Clipmap, StepsBackWhenTheEyeRises) {
  const Heightfield field = rough(1025, 1025);
  Clipmap lod(heights_in_memory(field), 63);
  const auto finest = [&](float above) {
    const Frame& frame = lod.update(everything(field, 1000, 1000, above));
    std::uint16_t least = 99;
    for (const Batch& batch : frame.batches) least = std::min(least, batch.level);
    return least;
  };
  EXPECT_EQ(finest(1), 0);
  EXPECT_EQ(finest(0.5F * 63 * 3), 1);
  EXPECT_EQ(finest(1.0e6F), lod.levels() - 1);
  EXPECT_EQ(finest(1), 0);
}

TEST(Clipmap, CullsBlocksBehindTheEye) {
  const Heightfield field = rough(1025, 1025);
  Clipmap lod(heights_in_memory(field), 127);
  View view;
  view.eye = {1000, 20, 1500};
  view.target = {1000, 20, 0};
  const std::size_t ahead = lod.update(view).stats.triangles;
  const std::size_t around = lod.update(everything(field, 1000, 1500, 10)).stats.triangles;
  EXPECT_GT(ahead, 0U);
  EXPECT_LT(ahead, around / 2);
}

TEST(Clipmap, CountsItsHeapBytes) {
  const Heightfield field = rough(600, 600);
  const HeapScope heap;
  auto lod = std::make_unique<Clipmap>(heights_in_memory(field), 63);
  lod->update(everything(field, 300, 300, 1));
  EXPECT_EQ(heap.held(), static_cast<std::int64_t>(lod->memory().total()));
  lod->tune(127);
  lod->update(everything(field, 400, 300, 1));
  EXPECT_EQ(heap.held(), static_cast<std::int64_t>(lod->memory().total()));
}

TEST(Clipmap, TakesFarEyesAndTinyScreens) {
  const Heightfield field = rough(100, 100);
  Clipmap lod(heights_in_memory(field), 15);
  View view;
  view.width = view.height = 1;
  for (const glm::vec3 eye :
       {glm::vec3(0, -1000, 0), glm::vec3(1e30F, 5, 1e30F), glm::vec3(-1e9F, 1e20F, 50)}) {
    view.eye = eye;
    view.target = {0, 1, 0};
    EXPECT_NO_THROW(lod.update(view));
  }
  view.eye.x = NAN;
  EXPECT_THROW(lod.update(view), Error);
}

}  // namespace
}  // namespace terrabench
