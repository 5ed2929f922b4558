// Rays on the implicit surface: against its field, sampled densely along them, and against its mesh.
#include "representations/implicit/field_rays.h"

#include <random>

#include "tests/representations/implicit_ground.h"
#include "tests/representations/rays.h"

namespace terrabench::test {
namespace {

struct Case {
  std::string_view name;
  TerrainSource source;
  ImplicitOptions options;
};

TerrainSource hills(int width, int depth, float cell_x, float cell_z) {
  std::vector<float> heights;
  for (int j = 0; j < depth; ++j) {
    for (int i = 0; i < width; ++i) {
      const auto x = static_cast<float>(i), z = static_cast<float>(j);
      heights.push_back(10 + 4 * std::sin(0.4F * x) * std::cos(0.3F * z) + std::sin(1.1F * (x + z)));
    }
  }
  return from_heights(width, depth, heights, cell_x, cell_z);
}

std::vector<Case> cases() {
  return {{"hills", hills(40, 31, 1, 1), {}},
          {"hills, cells no whole number", hills(30, 41, 1.5F, 1), {.cell = 1.7}},
          {"hills, sphere", hills(40, 31, 1, 1), {.kernel = "sphere"}},
          {"hills, surface nets", hills(33, 33, 2, 2), {.extractor = "surface_nets"}},
          {"caves", caves(), {.resolution = 40}},
          {"caves, sphere", caves(), {.resolution = 32, .kernel = "sphere"}},
          {"caves, wide kernel", caves(), {.resolution = 40, .radius = 0.12}},
          {"boxes", random_boxes(7, 24, 90, 3), {.resolution = 24}},
          {"boxes, narrow kernel", random_boxes(8, 24, 90, 3), {.resolution = 24, .radius = 1.6}}};
}

glm::vec3 at(const Ray& ray, double t) {
  return glm::vec3(glm::dvec3(ray.origin) + t * glm::dvec3(ray.direction));
}

// Where the ray's line is in the box.
bool in_box(const Bounds& box, const Ray& ray, double& begin, double& end) {
  begin = ray.near;
  end = ray.far;
  for (int axis = 0; axis < 3; ++axis) {
    const double o = ray.origin[axis], d = ray.direction[axis];
    const double a = (box.low[axis] - o) / d, b = (box.high[axis] - o) / d;
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  return begin < end;
}

// A field of rounded positions can flip more than once where a ray grazes it.
bool both_signs(const StackField& field, const Ray& ray, double begin, double end) {
  bool solid = false, air = false;
  for (int k = 0; k <= 64; ++k) {
    (field.at(at(ray, begin + (end - begin) * k / 64)) > 0 ? solid : air) = true;
  }
  return solid && air;
}

// Each hit within the box is a change of the field's sign within a 1024th of a cell, and no change that
// lasts for a quarter of a cell comes before it, as samples 50 times per cell see it.
TEST(FieldRays, HitIsTheFirstChangeOfSign) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const auto built = implicit(c.source, c.options);
    const StackField& field = built->field();
    const Bounds box = built->bounds();
    const std::vector<Ray> rays = random_rays(box, 41, 3000);
    const std::vector<float> distances = cast(*built, rays);
    std::size_t changes = 0, walls = 0;
    for (std::size_t r = 0; r < rays.size(); ++r) {
      const Ray& ray = rays[r];
      double begin, end;
      if (!in_box(box, ray, begin, end)) {
        EXPECT_EQ(distances[r], kNoHit) << r;
        continue;
      }
      const double cell = double{built->cell()} / glm::length(glm::dvec3(ray.direction));
      const double rounding = 1e-6 * std::max(1.0, end), hit = distances[r];
      const bool enters_solid = begin > ray.near && field.at(at(ray, begin)) > 0;
      const bool starts_solid = begin <= ray.near && field.at(at(ray, begin)) > 0;
      double first = enters_solid ? begin : kNoHit, since = kNoHit;  // of a change that lasts
      for (double t = begin; t <= end && first == kNoHit; t += cell / 50) {
        if ((field.at(at(ray, t)) > 0) == starts_solid) {
          since = kNoHit;
        } else {
          since = std::min(since, t);
          if (t - since > cell / 4) first = since;
        }
      }
      EXPECT_LE(hit, first + cell / 50 + rounding) << r;
      if (hit > begin + rounding && hit < end - rounding) {
        ++changes;
        EXPECT_TRUE(both_signs(field, ray, hit - cell / 1024 - rounding, hit + rounding)) << r;
      } else if (std::isfinite(hit)) {
        ++walls;
        EXPECT_TRUE(enters_solid || starts_solid || hit <= begin + rounding) << r;
      }
    }
    EXPECT_GT(changes, 200U);
    EXPECT_GT(walls, 50U);
  }
}

// Short level rays within one cell in plan, at any height: if the field's sign differs between their ends,
// they hit. A height that the caster wrongly takes for free of the surface would show here.
TEST(FieldRays, ChangesWithinACellAreFoundAtEveryHeight) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const auto built = implicit(c.source, c.options);
    const FieldLattice& lattice = built->lattice();
    std::mt19937 random(3);
    std::uniform_real_distribution<float> in(0, 1);
    std::vector<Ray> rays;
    while (rays.size() < 20000) {
      const int i = static_cast<int>(in(random) * static_cast<float>(lattice.cells.x)),
                j = static_cast<int>(in(random) * static_cast<float>(lattice.cells.z));
      const glm::vec3 low{lattice.position(0, i), lattice.low.y, lattice.position(2, j)},
          high{lattice.position(0, i + 1), lattice.high.y, lattice.position(2, j + 1)};
      const float height = in(random);
      const glm::vec3 begin = glm::mix(low, high, glm::vec3(in(random), height, in(random))),
                      end = glm::mix(low, high, glm::vec3(in(random), height, in(random)));
      if (begin != end) rays.push_back({.origin = begin, .direction = end - begin, .near = 0, .far = 1});
    }
    const std::vector<float> distances = cast(*built, rays);
    std::size_t changes = 0;
    for (std::size_t r = 0; r < rays.size(); ++r) {
      const StackField& field = built->field();
      if ((field.at(at(rays[r], 0)) > 0) == (field.at(at(rays[r], 1)) > 0)) continue;
      ++changes;
      EXPECT_TRUE(std::isfinite(distances[r])) << r;
    }
    EXPECT_GT(changes, 40U);
  }
}

// Ericson, Real-Time Collision Detection (2005), §5.1.5.
double distance_to(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 ab = b - a, ac = c - a, normal = glm::cross(ab, ac);
  const auto to_side = [&](const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 side = to - from;
    const double length = glm::dot(side, side);
    const double t = length > 0 ? std::clamp(glm::dot(p - from, side) / length, 0.0, 1.0) : 0;
    return glm::length(p - from - t * side);
  };
  const auto left_of = [&](const glm::dvec3& from, const glm::dvec3& to) {
    return glm::dot(glm::cross(to - from, p - from), normal) >= 0;
  };
  if (normal != glm::dvec3(0) && left_of(a, b) && left_of(b, c) && left_of(c, a)) {
    return std::abs(glm::dot(p - a, normal)) / glm::length(normal);
  }
  return std::min({to_side(a, b), to_side(b, c), to_side(c, a)});
}

double distance_to(const TriangleMesh& mesh, const glm::dvec3& p) {
  double nearest = 1e300;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const auto corner = [&](std::size_t k) { return glm::dvec3(mesh.positions[mesh.indices[t + k]]); };
    nearest = std::min(nearest, distance_to(p, corner(0), corner(1), corner(2)));
  }
  return nearest;
}

// A third of a cell, as the header says; along nearly every ray a cell.
TEST(FieldRays, HitsLieOnTheMeshWithinAThirdOfACell) {
  for (const Case& c : cases()) {
    for (const std::string_view extractor : kExtractorNames) {
      SCOPED_TRACE(testing::Message() << c.name << ", " << extractor);
      ImplicitOptions options = c.options;
      options.extractor = extractor;
      const auto built = implicit(c.source, options);
      const TriangleMesh mesh = built->mesh({});
      const std::vector<Ray> rays = random_rays(built->bounds(), 42, 400);
      const std::vector<float> distances = cast(*built, rays);
      double farthest = 0;
      std::size_t hits = 0, same = 0;
      for (std::size_t r = 0; r < rays.size(); ++r) {
        const double cell = double{built->cell()} / glm::length(glm::dvec3(rays[r].direction));
        const float through_mesh = brute_force(mesh, rays[r]);
        same += std::isfinite(through_mesh) == std::isfinite(distances[r]) &&
                (!std::isfinite(through_mesh) || std::abs(through_mesh - distances[r]) <= cell);
        if (!std::isfinite(distances[r])) continue;
        ++hits;
        farthest = std::max(farthest, distance_to(mesh, glm::dvec3(at(rays[r], distances[r]))));
      }
      EXPECT_GT(hits, 60U);
      EXPECT_LE(farthest, built->cell() / 3.0);
      EXPECT_GT(same, rays.size() * 97 / 100);
    }
  }
}

// Bounds that the intervals of cells and the steps along a ray rest on.
TEST(FieldRays, TheFieldChangesNoFasterThanItsBounds) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const auto built = implicit(c.source, c.options);
    const StackField& field = built->field();
    const Bounds box = built->bounds();
    std::mt19937 random(9);
    std::uniform_real_distribution<float> unit(0, 1), small(-1, 1);
    double closest = 0;
    for (int k = 0; k < 20000; ++k) {
      const glm::vec3 p = box.low + glm::vec3(unit(random), unit(random), unit(random)) * box.size();
      glm::vec3 step = glm::vec3(small(random), small(random), small(random)) * built->cell();
      if (k % 4 != 0) step = {k % 4 == 1 ? step.x : 0, k % 4 == 2 ? step.y : 0, k % 4 == 3 ? step.z : 0};
      const double change = std::abs(field.at(p + step) - field.at(p));
      const double most = field.steepest(step) + field.jump();
      ASSERT_LE(change, most) << k;
      closest = std::max(closest, change / most);
    }
    EXPECT_GT(closest, 0.5);  // they are not idle
  }
}

// Samples from the array of tops are those from the stacks, also far outside the grid.
TEST(FieldRays, TopsChangeNoSample) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const auto built = implicit(c.source, c.options);
    const ColumnTops tops(built->stack());
    std::mt19937 random(10);
    std::uniform_real_distribution<float> unit(-0.5F, 1.5F);
    std::size_t between = 0;
    for (int k = 0; k < 20000; ++k) {
      const glm::vec3 p =
          built->bounds().low + glm::vec3(unit(random), unit(random), unit(random)) * built->bounds().size();
      const float expected = built->field().at(p);
      ASSERT_EQ(built->field().at(p, tops), expected) << k;
      between += expected > -1 && expected < 1;
    }
    EXPECT_GT(between, 500U);
  }
}

TEST(FieldRays, AKernelBelowACellHasNone) {
  const auto built = implicit(hills(20, 20, 1, 1), {.radius = 0.5});
  EXPECT_EQ(built->ray_caster(), nullptr);
}

TEST(FieldRays, FarAwayRaysEnd) {
  const auto built = implicit(hills(20, 20, 1, 1), {});
  const std::vector<Ray> rays = {{{10, 1e17F, 10}, {0, -1, 0}}, {{1e17F, 8, 10}, {-1, 0, 0}}};
  const std::vector<float> distances = cast(*built, rays);
  for (const float distance : distances) EXPECT_TRUE(distance == kNoHit || distance > 9e16F);
}

}  // namespace
}  // namespace terrabench::test
