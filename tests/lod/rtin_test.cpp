// The published rule against a recursion of its own, exact errors against every sample, nested spheres, and
// what the knob bounds.
#include "lod/rtin/rtin.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "lod/meters/cracks.h"
#include "lod/meters/screen_error.h"
#include "lod/plan_triangle.h"
#include "tests/lod/drawing.h"
#include "tests/lod/variants.h"

namespace terrabench::test {
namespace {

using rtin::Triangle;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// The published rule on a square of 2ᵏ + 1 samples: the errors of one depth after the other, deepest first,
// each as the triangles of that depth are met on a descent from the two roots; then the mesh by another
// descent.
class Published {
 public:
  explicit Published(const Heightfield& field) : field_(field), errors_(field.heights.size(), 0.0F) {
    int depth = 0;
    for (int cells = field.width - 1; cells > 1; cells /= 2) depth += 2;
    while (depth-- > 0) {
      roots([&](const Triangle& t) { measure(t, depth); });
    }
  }

  float error(glm::ivec2 at) const { return errors_[place(at)]; }
  Triangles mesh(float most) const {
    Triangles all;
    roots([&](const Triangle& t) { add(t, most, all); });
    return all;
  }

 private:
  template <class Use>
  void roots(const Use& use) const {
    const int m = field_.width - 1;
    use(Triangle{{0, 0}, {m, m}, {m, 0}});
    use(Triangle{{m, m}, {0, 0}, {0, m}});
  }
  std::size_t place(glm::ivec2 at) const { return static_cast<std::size_t>(at.y) * field_.width + at.x; }
  float height(glm::ivec2 at) const { return field_.heights[place(at)]; }
  static bool smallest(const Triangle& t) { return std::abs(t.a.x - t.c.x) + std::abs(t.a.y - t.c.y) == 1; }

  void measure(const Triangle& t, int depth) {
    const glm::ivec2 m = (t.a + t.b) / 2;
    if (depth > 0) {
      measure({t.c, t.a, m}, depth - 1);
      measure({t.b, t.c, m}, depth - 1);
      return;
    }
    float& error = errors_[place(m)];
    const double between = (static_cast<double>(height(t.a)) + height(t.b)) / 2;
    error = std::max(error, static_cast<float>(std::abs(between - height(m))));
    if (smallest({t.c, t.a, m})) return;
    error = std::max({error, errors_[place((t.a + t.c) / 2)], errors_[place((t.b + t.c) / 2)]});
  }
  void add(const Triangle& t, float most, Triangles& all) const {
    const glm::ivec2 m = (t.a + t.b) / 2;
    if (!smallest(t) && error(m) > most) {
      add({t.c, t.a, m}, most, all);
      add({t.b, t.c, m}, most, all);
    } else {
      all.push_back({static_cast<std::uint32_t>(place(t.a)), static_cast<std::uint32_t>(place(t.b)),
                     static_cast<std::uint32_t>(place(t.c))});
    }
  }

  const Heightfield& field_;
  std::vector<float> errors_;
};

std::vector<Heightfield> squares() {
  std::vector<Heightfield> all{flat(17, 17, 3), random_ground(3, 3, 2, -9, 9),
                               random_ground(33, 33, 3, 0, 500)};
  for (const int side : {5, 65, 257}) all.push_back(hilly(side, side, 0.5F, 7, 10, 10));
  all.push_back(rounded(waves(129, 129, 40)));
  return all;
}

Triangles mesh_for_all_views(const Heightfield& field, bool exact, double metres) {
  Rtin lod(field, {.exact = exact, .metres = metres}, silent());
  const Frame& frame = lod.update(from_above(field));
  Triangles all;
  for (std::size_t k = 0; k < frame.indices.size(); k += 3)
    all.push_back({frame.indices[k], frame.indices[k + 1], frame.indices[k + 2]});
  return all;
}

// Of all samples under the triangle from its plane, metres.
double largest_error(const Heightfield& field, const std::array<std::uint32_t, 3>& vertices) {
  std::array<Corner, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const int x = static_cast<int>(vertices[k]) % field.width,
              z = static_cast<int>(vertices[k]) / field.width;
    corners[k] = {x, z, field.at(x, z)};
  }
  double largest = 0;
  for_samples_on(corners.data(), field.width, field.depth, [&](int x, int z, float y) {
    largest = std::max(largest, std::abs(static_cast<double>(y) - field.at(x, z)));
  });
  return largest;
}
double largest_error(const Heightfield& field, const Triangles& mesh) {
  double largest = 0;
  for (const auto& triangle : mesh) largest = std::max(largest, largest_error(field, triangle));
  return largest;
}

TEST(Rtin, PublishedErrorsAndMeshesEqualTheRecursion) {
  for (const Heightfield& field : squares()) {
    SCOPED_TRACE(field.width);
    const Published published(field);
    const rtin::NestedErrors errors(grid_of(field), false, silent());
    for (int z = 0; z < field.depth; ++z) {
      for (int x = 0; x < field.width; ++x) ASSERT_EQ(errors.at({x, z}).error, published.error({x, z}));
    }
    for (const double metres : {1e-3, 0.05, 1.0, 5.0, 60.0, 1e5}) {
      Triangles ours = mesh_for_all_views(field, false, metres),
                theirs = published.mesh(static_cast<float>(metres));
      std::ranges::sort(ours);
      std::ranges::sort(theirs);
      ASSERT_EQ(ours, theirs) << metres;
    }
  }
}

TEST(Rtin, ExactErrorsBoundTheMeshAndPublishedOnesDoNot) {
  for (const auto& [width, depth] : {std::pair{129, 129}, {100, 37}, {34, 65}}) {
    const Heightfield field = hilly(width, depth, 0.5F);
    for (const double metres : {1.0, 3.0}) {
      SCOPED_TRACE(metres);
      const Triangles exact = mesh_for_all_views(field, true, metres),
                      published = mesh_for_all_views(field, false, metres);
      const double largest = largest_error(field, exact);
      EXPECT_LE(largest, metres * (1 + 1e-5));
      EXPECT_GT(largest, 0.7 * metres);
      EXPECT_GT(largest_error(field, published), metres * 1.01);
      EXPECT_GT(exact.size(), published.size());
      EXPECT_LT(exact.size(), 2U * (width - 1) * (depth - 1));
    }
  }
}

// All triangles that are split in the finest mesh, by depth.
std::vector<std::vector<Triangle>> split_triangles(const rtin::Lattice& lattice) {
  std::vector<std::vector<Triangle>> by_depth;
  const auto choose = [&](const Triangle& t, std::size_t& depth) {
    if (!t.splits()) return rtin::Next::kSkip;
    by_depth.resize(std::max(by_depth.size(), depth + 1));
    by_depth[depth++].push_back(t);
    return rtin::Next::kSplit;
  };
  descend(lattice, std::size_t{0}, choose, [](const Triangle&) {});
  return by_depth;
}

constexpr std::pair<int, int> kSizes[] = {{2, 2},   {3, 2},   {2, 9},    {5, 4},    {33, 33},
                                          {34, 65}, {19, 27}, {100, 37}, {129, 65}, {3, 130}};

TEST(NestedErrors, AreTheLargestUnderATriangleOrUnderThoseThatDependOnItsSplit) {
  for (const auto& [width, depth] : kSizes) {
    SCOPED_TRACE(fmt::format("{} × {}", width, depth));
    const Heightfield field = hilly(width, depth, 3, 4, 2, 3);
    const rtin::NestedErrors errors(grid_of(field), true, silent());
    const rtin::Lattice& lattice = errors.lattice();
    const glm::ivec2 size = lattice.size();
    std::vector<double> expected(static_cast<std::size_t>(size.x) * size.y);
    const auto at = [&](glm::ivec2 p) -> double& {
      return expected[static_cast<std::size_t>(p.y) * size.x + p.x];
    };
    const auto by_depth = split_triangles(lattice);
    for (auto level = by_depth.rbegin(); level != by_depth.rend(); ++level) {
      for (const Triangle& t : *level) {
        double& error = at(t.middle());
        error = std::max(
            error, largest_error(field, {lattice.vertex(t.a), lattice.vertex(t.b), lattice.vertex(t.c)}));
        const auto [left, right] = t.halves();
        if (left.splits()) error = std::max({error, at(left.middle()), at(right.middle())});
      }
      for (const Triangle& t : *level) {
        ASSERT_NEAR(errors.at(t.middle()).error, at(t.middle()), 1e-5) << t.middle().x << ' ' << t.middle().y;
      }
    }
  }
}

TEST(NestedErrors, HaveSpheresThatHoldTheSamplesUnderTheirTrianglesAndNest) {
  for (const auto& [width, depth] : kSizes) {
    for (const bool exact : {true, false}) {
      SCOPED_TRACE(fmt::format("{} × {}, exact {}", width, depth, exact));
      const Heightfield field = hilly(width, depth, 9, 4, 2, 3);
      const rtin::NestedErrors errors(grid_of(field), exact, silent());
      for (const std::vector<Triangle>& level : split_triangles(errors.lattice())) {
        for (const Triangle& t : level) {
          const glm::dvec3 centre = errors.position(t.middle());
          const double radius = errors.at(t.middle()).radius;
          std::array<Corner, 3> corners;
          for (std::size_t k = 0; k < 3; ++k) {
            const glm::ivec2 p = errors.lattice().sample(std::array{t.a, t.b, t.c}[k]);
            corners[k] = {p.x, p.y, field.at(p.x, p.y)};
          }
          for_samples_on(corners.data(), width, depth, [&](int x, int z, float) {
            ASSERT_LE(glm::distance(centre, errors.position({x, z})), radius * (1 + 1e-6));
          });
          const auto [left, right] = t.halves();
          if (!left.splits()) continue;
          for (const glm::ivec2 child : {left.middle(), right.middle()}) {
            EXPECT_LE(errors.at(child).error, errors.at(t.middle()).error);
            EXPECT_LE(glm::distance(centre, errors.position(child)) + errors.at(child).radius, radius);
          }
        }
      }
    }
  }
}

bool equal(const rtin::NestedErrors& one, const rtin::NestedErrors& other) {
  const glm::ivec2 size = one.lattice().size();
  for (int z = 0; z < size.y; ++z) {
    for (int x = 0; x < size.x; ++x) {
      const rtin::Nested &a = one.at({x, z}), &b = other.at({x, z});
      if (a.error != b.error || a.radius != b.radius) return false;
    }
  }
  return true;
}

TEST(NestedErrors, AreTheSameWithOneThread) {
  const Heightfield field = hilly(301, 140, 1);
  const rtin::NestedErrors many(grid_of(field), true, silent());
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_TRUE(equal(many, rtin::NestedErrors(grid_of(field), true, silent())));
}

TEST(NestedErrors, AfterAnEditAreThoseOfTheEditedGround) {
  std::mt19937 random(3);
  for (const auto& [width, depth] : {std::pair{129, 129}, {100, 37}, {70, 150}, {9, 2}}) {
    for (const bool exact : {true, false}) {
      Heightfield field = hilly(width, depth, 1);
      rtin::NestedErrors edited(grid_of(field), exact, silent());
      for (int k = 0; k < 12; ++k) {
        const glm::ivec2 low{random() % width, random() % depth};
        const glm::ivec2 high = glm::min(low + glm::ivec2(random() % 12), glm::ivec2(width - 1, depth - 1));
        for (int z = low.y; z <= high.y; ++z) {
          for (int x = low.x; x <= high.x; ++x) field.at(x, z) += k % 2 == 0 ? 7.0F : -6.5F;
        }
        edited.update(low, high);
        ASSERT_TRUE(equal(edited, rtin::NestedErrors(grid_of(field), exact, silent()))) << k;
      }
    }
  }
}

// From eyes anywhere, for any ground.
TEST(Rtin, BoundsTheErrorWithoutCracks) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> share(-0.2F, 1.2F), turn(-3.14F, 3.14F), height(-5, 60);
  for (const auto& [width, depth] : kSizes) {
    const Heightfield field = hilly(width, depth, 1, 1, 3, 2);
    Rtin lod(field, {}, silent());
    for (int k = 0; k < 25; ++k) {
      const double pixels = std::ldexp(0.5, k % 6);
      SCOPED_TRACE(fmt::format("{} × {}, view {}, {} px", width, depth, k, pixels));
      View view;
      view.eye = {share(random) * field.extent_x(), height(random), share(random) * field.extent_z()};
      const float heading = turn(random), pitch = 0.3F * turn(random);
      view.target = view.eye + glm::vec3(std::cos(heading), std::sin(pitch), std::sin(heading));
      view.width = 320;
      view.height = 240;
      view.far = 5000;
      lod.tune(pixels);
      const Frame& frame = lod.update(view);
      const CrackReport cracks = find_cracks(frame, width, depth, view);
      EXPECT_TRUE(cracks.tight()) << cracks.gaps << " gaps, " << cracks.bare_edges << " bare edges";
      EXPECT_EQ(cracks.t_junctions, 0U);
      const Deviation error =
          screen_error(SurfaceRaster(frame, width, depth), field, SeenSamples(field, view)).in_frustum;
      EXPECT_LE(error.largest, pixels * (1 + 1e-5));
      EXPECT_EQ(error.undrawn, 0U);
    }
  }
}

TEST(Rtin, PublishedErrorsKeepNoBoundOnTheScreen) {
  const Heightfield field = hilly(202, 173, 0.7F, 1, 5, 5);
  std::array<double, 2> largest{};
  for (const bool exact : {false, true}) {
    Rtin lod(field, {.exact = exact}, silent());
    for (const View& view : path_over(field, 20)) {
      const SurfaceRaster drawn(lod.update(view), field.width, field.depth);
      largest[exact ? 1 : 0] = std::max(
          largest[exact ? 1 : 0], screen_error(drawn, field, SeenSamples(field, view)).in_frustum.largest);
    }
  }
  EXPECT_GT(largest[0], 1.05 * Rtin::knob().fallback);
  EXPECT_LE(largest[1], Rtin::knob().fallback);
}

TEST(Rtin, UploadsWhatDiffers) {
  const Heightfield field = hilly(202, 173, 0.7F, 1, 5, 5);
  Rtin lod(field, {}, silent());
  std::vector<std::uint32_t> held;
  std::size_t spared = 0;
  for (const View& view : path_over(field, 20)) {
    const Frame& frame = lod.update(view);
    held.resize(std::max(held.size(), frame.indices.size()));
    std::size_t sent = 0;
    for (const DirtyRange& range : frame.uploads) {
      if (range.target != DirtyRange::Target::kIndices) continue;
      std::copy_n(&frame.indices[range.first], range.count, &held[range.first]);
      sent += range.count;
    }
    spared += frame.indices.size() - sent;
    ASSERT_TRUE(std::equal(frame.indices.begin(), frame.indices.end(), held.begin()));
  }
  EXPECT_GT(spared, 0U);
}

}  // namespace
}  // namespace terrabench::test
