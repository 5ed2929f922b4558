// No line of sight passes through the cracks between the chunks of chunked LOD, which its skirts cover.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "lod/chunked/chunked.h"
#include "lod/chunked/paged_chunked.h"
#include "lod/meters/bare_pixels.h"
#include "lod/meters/projector.h"
#include "tests/lod/drawing.h"
#include "tests/lod/settle.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench::test {
namespace {

// What a ray from the eye meets first, as the GPU draws it: back faces are not seen.
enum class Met { kNothing, kSurface, kSkirt, kBelow };

struct Ground {
  const Heightfield& field;
  std::vector<glm::vec3> corners;

  // By distance from the eye in lengths of the direction; nothing if the triangle is not met.
  static std::optional<double> distance(const glm::vec3* t, const glm::dvec3& eye, const glm::dvec3& along) {
    const glm::dvec3 a(t[0]), u = glm::dvec3(t[1]) - a, v = glm::dvec3(t[2]) - a, off = eye - a;
    const glm::dvec3 n = glm::cross(u, v);
    const double facing = -glm::dot(along, n);
    if (facing == 0) return std::nullopt;
    const double at = glm::dot(off, n) / facing;
    const glm::dvec3 p = off + at * along;
    const double squared = glm::dot(n, n), b = glm::dot(glm::cross(p, v), n),
                 c = glm::dot(glm::cross(u, p), n);
    const double slack = 1e-9 * squared;
    if (at <= 0 || b < -slack || c < -slack || b + c > squared + slack) return std::nullopt;
    return at;
  }

  Met first(const glm::dvec3& eye, const glm::dvec3& along) const {
    double nearest = std::numeric_limits<double>::infinity();
    Met met = Met::kNothing;
    for (std::size_t k = 0; k < corners.size(); k += 3) {
      const std::optional<double> at = distance(&corners[k], eye, along);
      if (!at || *at >= nearest) continue;
      const glm::vec3* const t = &corners[k];
      const glm::dvec3 n = glm::cross(glm::dvec3(t[1] - t[0]), glm::dvec3(t[2] - t[0]));
      const bool front = glm::dot(n, along) < 0, skirt = n.y == 0;
      if (skirt && !front) continue;
      nearest = *at;
      met = skirt ? Met::kSkirt : front ? Met::kSurface : Met::kBelow;
    }
    return met == Met::kNothing && leaves_below(eye, along) ? Met::kBelow : met;
  }

  // Whether the ray leaves the ground's extent well below its border. The eye is over the extent.
  bool leaves_below(const glm::dvec3& eye, const glm::dvec3& along) const {
    const auto until = [](double from, double step, double end) {
      return step > 0   ? (end - from) / step
             : step < 0 ? -from / step
                        : std::numeric_limits<double>::infinity();
    };
    const glm::dvec3 out = eye + along * std::min(until(eye.x, along.x, field.extent_x()),
                                                  until(eye.z, along.z, field.extent_z()));
    const auto on_ground = [](double at, float extent) {
      return std::clamp(static_cast<float>(at), 0.0F, extent);
    };
    return out.y + 40 < field.sample(on_ground(out.x, field.extent_x()), on_ground(out.z, field.extent_z()));
  }
};

struct Sights {
  std::array<std::size_t, 4> met{};  // pixels, by Met
  std::size_t bare = 0;              // pixels
};

// At the centres of all pixels of small screens; cracks are many pixels wide.
Sights meet(const Heightfield& field, Lod& lod) {
  lod.tune(80);
  Sights counts;
  for (const glm::vec2 to : {glm::vec2{1, 0.2F}, {-0.6F, 1}, {-0.5F, -0.8F}, {0.9F, -0.7F}}) {
    View view;
    view.eye = {0.5F * field.extent_x(), 60, 0.5F * field.extent_z()};
    view.target = view.eye + glm::vec3(to.x, -0.5F, to.y);
    view.width = 96;
    view.height = 72;
    const Ground ground{field, corners_of(lod.update(view))};
    const Projector project(view);
    counts.bare += find_bare_pixels(lod.update(view), field, view).bare;
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        ++counts.met[static_cast<std::size_t>(ground.first(view.eye, project.direction(x + 0.5, y + 0.5)))];
      }
    }
  }
  return counts;
}

Sights meet(const Heightfield& field, bool skirts, bool morph) {
  Chunked lod(field, {8, 1, skirts, morph}, silent());
  return meet(field, lod);
}

class Skirts : public ::testing::TestWithParam<bool> {};  // morph
INSTANTIATE_TEST_SUITE_P(Morph, Skirts, ::testing::Bool());

TEST_P(Skirts, CoverEveryCrack) {
  const Heightfield field = hilly(150, 131, 12, 3);
  const auto of = [](const Sights& sights, Met met) { return sights.met[static_cast<std::size_t>(met)]; };
  const Sights covered = meet(field, true, GetParam()), open = meet(field, false, GetParam());
  EXPECT_EQ(of(covered, Met::kBelow), 0U);
  EXPECT_GT(of(covered, Met::kSkirt), 50U);
  EXPECT_EQ(covered.bare, 0U);
  EXPECT_EQ(of(open, Met::kSkirt), 0U);
  EXPECT_GT(of(open, Met::kBelow), 20U);
  EXPECT_GT(open.bare, 0U);
}

// All four of a chunk are drawn, those on the ground's border too, so bare pixels say nothing.
TEST(Skirts, OfChunksOnDiskCoverEveryCrack) {
  const Heightfield field = hilly(150, 131, 12, 3);
  const TemporaryFolder folder;
  chunked::ChunkFile::build(*heights_in_memory(field), {8, 512, 1}, folder / "chunks", silent());
  PagedChunked lod(folder / "chunks", std::size_t{1} << 26);
  lod.tune(80);
  View all = from_above(field);
  all.eye.y = 60;
  settle(lod, all);
  const std::uint64_t late = lod.late_frames();
  const Sights sights = meet(field, lod);
  EXPECT_EQ(lod.late_frames(), late);
  EXPECT_EQ(sights.met[static_cast<std::size_t>(Met::kBelow)], 0U);
  EXPECT_GT(sights.met[static_cast<std::size_t>(Met::kSkirt)], 50U);
}

}  // namespace
}  // namespace terrabench::test
