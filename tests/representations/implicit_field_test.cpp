// The field of the implicit surface against integrals that know nothing of prefix sums.
#include <random>

#include "terrain/error.h"
#include "tests/representations/implicit_ground.h"

namespace terrabench::test {
namespace {

// Whether the voxel at these numbers is solid, by the rule for what lies outside: sides and floor continue.
bool solid_at(const LayeredStack& stack, int i, int level, int j) {
  const ColumnGrid& grid = stack.grid();
  if (level >= grid.levels) return false;
  const ColumnRuns runs = stack.column(std::clamp(i, 0, grid.width - 1), std::clamp(j, 0, grid.depth - 1));
  for (std::size_t r = 0; r < runs.count; ++r) {
    if (std::max(level, 0) < runs.tops[r]) return runs.materials[r] != Material::kAir;
  }
  return false;
}

// The share of solid voxel halves in a cube, as the field. All in halves of voxels, so that it is exact.
float cube_by_counting(const LayeredStack& stack, glm::ivec3 centre, int radius) {
  const auto voxel = [](int half) { return half >= 0 ? half / 2 : -((1 - half) / 2); };
  std::int64_t sum = 0, all = 0;
  for (int z = centre.z - radius; z < centre.z + radius; ++z) {
    for (int y = centre.y - radius; y < centre.y + radius; ++y) {
      for (int x = centre.x - radius; x < centre.x + radius; ++x, ++all) {
        sum += solid_at(stack, voxel(x), voxel(y), voxel(z)) ? 1 : -1;
      }
    }
  }
  return static_cast<float>(static_cast<double>(sum) / static_cast<double>(all));
}

// The mean over the midpoints of boxes of 1/parts m that lie in the sphere. Voxels are 1 m, and their faces
// lie between boxes if the centre is at a multiple of 1/parts.
double sphere_by_counting(const LayeredStack& stack, glm::dvec3 centre, double radius, int parts) {
  std::int64_t sum = 0, all = 0;
  const int n = static_cast<int>(std::ceil(radius * parts));
  const glm::dvec3 from = centre - glm::dvec3(stack.bounds().low);
  for (int z = -n; z < n; ++z) {
    for (int y = -n; y < n; ++y) {
      for (int x = -n; x < n; ++x) {
        const glm::dvec3 offset = (glm::dvec3(x, y, z) + 0.5) / static_cast<double>(parts);
        if (offset.x * offset.x + offset.y * offset.y + offset.z * offset.z > radius * radius) continue;
        const glm::dvec3 at = from + offset;
        ++all;
        sum += solid_at(stack, static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)),
                        static_cast<int>(std::floor(at.z)))
                   ? 1
                   : -1;
      }
    }
  }
  return static_cast<double>(sum) / static_cast<double>(all);
}

TEST(ImplicitField, CubeIsTheCountedShareExactly) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    const TerrainSource source = random_cells(seed, 9, 13, 7, 2, 20 + 20 * seed);
    for (const int radius : {1, 3, 4, 9, 40}) {  // halves of a voxel
      const auto built = implicit(source, {.resolution = 13, .radius = radius / 2.0});
      const glm::vec3 low = built->bounds().low;
      std::mt19937 random(seed);
      for (int round = 0; round < 60; ++round) {
        const glm::ivec3 at{static_cast<int>(random() % 26) - 4, static_cast<int>(random() % 34) - 4,
                            static_cast<int>(random() % 22) - 4};
        ASSERT_EQ(built->field().at(low + 0.5F * glm::vec3(at)), cube_by_counting(built->stack(), at, radius))
            << at.x << ' ' << at.y << ' ' << at.z << ", radius " << radius;
      }
    }
  }
}

TEST(ImplicitField, CubeBetweenHalvesIsContinuous) {  // rounded to 1/256 of a column
  const auto built = implicit(random_cells(3, 9, 13, 7, 1, 50), {.resolution = 13, .radius = 2});
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(0, 1);
  const glm::vec3 low = built->bounds().low;
  for (int round = 0; round < 300; ++round) {
    // Trilinear between the corners of an eighth of a voxel is exact: no border of a voxel lies inside.
    const glm::vec3 t{unit(random), unit(random), unit(random)};
    const glm::ivec3 at{static_cast<int>(random() % 9), static_cast<int>(random() % 13),
                        static_cast<int>(random() % 7)};
    double expected = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::ivec3 to{corner & 1, corner >> 1 & 1, corner >> 2};
      double weight = 1;
      for (int axis = 0; axis < 3; ++axis) weight *= to[axis] == 1 ? t[axis] : 1 - t[axis];
      expected += weight * cube_by_counting(built->stack(), 2 * (at + to), 4);
    }
    EXPECT_NEAR(built->field().at(low + glm::vec3(at) + t), expected, 3 * 0.5 / 256);
  }
}

TEST(ImplicitField, SphereIsTheCountedShare) {
  for (const double radius : {0.7, 1.5, 2.0, 4.3}) {
    const auto built = implicit(random_cells(5, 12, 12, 12, 1, 45),
                                {.resolution = 12, .kernel = "sphere", .radius = radius});
    std::mt19937 random(2);
    double largest = 0;
    for (int round = 0; round < 15; ++round) {
      // At eighths of a column, where nothing is rounded.
      const glm::dvec3 at =
          glm::dvec3(built->bounds().low) + glm::dvec3(random() % 100, random() % 100, random() % 100) / 8.0;
      const double expected = sphere_by_counting(built->stack(), at, radius, radius < 2 ? 64 : 16);
      const double got = built->field().at(glm::vec3(at));
      EXPECT_NEAR(got, expected, 0.003) << radius;
      largest = std::max(largest, std::abs(expected));
    }
    EXPECT_GT(largest, 0.05);
  }
}

class EveryKernel : public testing::TestWithParam<std::string_view> {};
INSTANTIATE_TEST_SUITE_P(Kernels, EveryKernel, testing::ValuesIn(kKernelNames),
                         [](const auto& at) { return std::string(at.param); });

// Supports that are full, empty or half full by construction, at a size of voxel that no float holds exactly.
TEST_P(EveryKernel, IsExactlyOneMinusOneAndNought) {
  constexpr int kSide = 24, kMiddle = 12;
  constexpr float kVoxel = 0.3F;
  const Bounds bounds{{-7.1F, 100.3F, 3}, glm::vec3{-7.1F, 100.3F, 3} + glm::vec3(kVoxel * kSide)};
  using Rule = bool (*)(int, int, int);
  const Rule halves[] = {
      [](int x, int, int) { return x < kMiddle; },
      [](int x, int, int) { return x >= kMiddle; },
      [](int, int y, int) { return y < kMiddle; },
      [](int, int y, int) { return y >= kMiddle; },
      [](int, int, int z) { return z < kMiddle; },
      [](int x, int y, int z) { return ((x < kMiddle) ^ (y < kMiddle) ^ (z < kMiddle)) != 0; },  // octants
      [](int x, int y, int z) { return (x / 3 + y / 3 + z / 3) % 2 == 0; },                      // blocks
  };
  for (const double radius : {0.3, 0.45, 0.6, 0.9, 1.0, 1.2345, 2.1}) {
    for (const Rule rule : halves) {
      const auto cell = [&](float at, float low) {
        return static_cast<int>(std::floor((at - low) / kVoxel));
      };
      const TerrainSource source = from_predicate(bounds, [&](float x, float y, float z) {
        return rule(cell(x, bounds.low.x), cell(y, bounds.low.y), cell(z, bounds.low.z)) ? Material::kBedrock
                                                                                         : Material::kAir;
      });
      const auto built = implicit(source, {.resolution = kSide, .kernel = GetParam(), .radius = radius});
      const float y = built->stack().grid().edge_y(kMiddle), x = built->stack().grid().edge_x(kMiddle),
                  z = built->stack().grid().edge_z(kMiddle);
      EXPECT_EQ(built->field().at({x, y, z}), 0.0F) << radius;
    }
    const auto rock = [](float, float y, float) { return y < 104 ? Material::kBedrock : Material::kAir; };
    const auto built =
        implicit(from_predicate(bounds, rock), {.resolution = kSide, .kernel = GetParam(), .radius = radius});
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(-2, 9);
    for (int round = 0; round < 200; ++round) {
      const glm::vec3 at = bounds.low + glm::vec3{unit(random), unit(random), unit(random)};
      const float top = built->stack().grid().edge_y(built->stack().column(0, 0).tops[0]);
      const float margin = static_cast<float>(radius) + 0.01F;
      if (at.y < top - margin) {
        EXPECT_EQ(built->field().at(at), 1.0F);
      } else if (at.y > top + margin) {
        EXPECT_EQ(built->field().at(at), -1.0F);
      } else {
        EXPECT_LE(std::abs(built->field().at(at)), 1.0F);
      }
    }
  }
}

TEST_P(EveryKernel, PlanesEqualLinesToTheBit) {
  const auto built = implicit(random_boxes(4, 30, 40, 2), {.resolution = 30, .kernel = GetParam()});
  std::mt19937 random(6);
  for (const float spacing : {1.0F, 0.37F, 2.6F}) {
    std::vector<float> xs, ys;
    for (int n = -3; n < 14; ++n) xs.push_back(4 + spacing * static_cast<float>(n));
    for (int n = -3; n < 20; ++n) ys.push_back(6 + spacing * static_cast<float>(n));
    const auto planes = built->field().planes(xs, ys);
    std::vector<float> plane(xs.size() * ys.size()), line(ys.size());
    double z = -9;
    for (int round = 0; round < 30; ++round, z += 0.25 * static_cast<double>(random() % 9)) {
      planes->sample(z, plane);
      for (std::size_t i = 0; i < xs.size(); ++i) {
        built->field().line(xs[i], z, ys, line);
        for (std::size_t k = 0; k < ys.size(); ++k) ASSERT_EQ(plane[i * ys.size() + k], line[k]);
      }
    }
  }
}

TEST_P(EveryKernel, HeightsBoundTheField) {
  const auto built = implicit(caves(), {.resolution = 40, .kernel = GetParam()});
  const auto [solid, air] = built->field().heights({0.3, 0.4}, {0.6, 0.5});
  EXPECT_LT(solid, air);
  for (float x = 0.3F; x <= 0.6F; x += 0.05F) {
    for (float z = 0.4F; z <= 0.5F; z += 0.05F) {
      for (float y = -0.2F; y < 1.2F; y += 0.01F) {
        const float value = built->field().at({x, y, z});
        if (y < solid) {
          EXPECT_EQ(value, 1);
        }
        if (y >= air) {
          EXPECT_EQ(value, -1);
        }
      }
    }
  }
}

TEST(ImplicitField, FarBelowOnlyTheLowestLevelCounts) {
  const auto built = implicit(random_cells(1, 8, 8, 8, 1, 50), {.resolution = 8, .radius = 300});
  const glm::vec3 low = built->bounds().low;
  EXPECT_EQ(built->field().at(low + glm::vec3(0, -300, 0)), built->field().at(low + glm::vec3(0, -400, 0)));
  EXPECT_NE(built->field().at(low + glm::vec3(0, -290, 0)), built->field().at(low + glm::vec3(0, -400, 0)));
}

// The farthest that the field half-way between two neighbours along an axis is from the mean of theirs.
double from_linear(const StackField& field, std::span<const float> xs, std::span<const float> zs, int axis) {
  double worst = 0;
  for (std::size_t j = 0; j + 1 < zs.size(); ++j) {
    for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
      for (const float y : {4.0F, 9.0F, 11.5F, 14.0F}) {
        const glm::vec3 one{xs[i], y, zs[j]};
        const glm::vec3 other = axis == 0 ? glm::vec3{xs[i + 1], y, zs[j]} : glm::vec3{xs[i], y, zs[j + 1]};
        const double middle = field.at((one + other) / 2.0F);
        worst = std::max(worst, std::abs(middle - (field.at(one) + field.at(other)) / 2));
      }
    }
  }
  return worst;
}

// Not across a border of columns, nor with a radius that ends within one. Columns of 1 m × 2 m.
TEST(ImplicitField, IsLinearBetweenPositionsAsItSays) {
  std::mt19937 random(5);
  std::vector<float> heights;
  for (int k = 0; k < 20 * 20; ++k) heights.push_back(2 + static_cast<float>(random() % 1000) / 50);
  const auto built = implicit(from_heights(20, 20, heights, 1, 2), {});
  const LayeredStack& stack = built->stack();
  const ColumnGrid& grid = stack.grid();
  const auto positions = [](double origin, double first, double apart) {
    std::vector<float> all;
    for (int k = 0; k < 8; ++k) all.push_back(static_cast<float>(origin + first + apart * k));
    return all;
  };
  struct Row {
    double radius, first_x, apart_x, first_z, apart_z;
    bool along_x, along_z;
  };
  for (const Row& row : {Row{2, 3, 1, 4, 2, true, true}, Row{4, 3, 0.5, 4, 1, true, true},
                         Row{2, 3.5, 1, 4, 2, false, true}, Row{2, 3, 1, 5, 2, true, false},
                         Row{2, 3, 0.75, 4, 2, false, true}, Row{2, 3, 1, 4, 1.5, true, false},
                         Row{1, 3, 1, 4, 2, true, false}, Row{1.5, 3, 1, 4, 2, false, false}}) {
    SCOPED_TRACE(testing::Message() << row.radius << ' ' << row.first_x << ' ' << row.apart_x << ' '
                                    << row.first_z << ' ' << row.apart_z);
    const StackField field(stack, Kernel::kCube, row.radius);
    const std::vector<float> xs = positions(grid.origin_x, row.first_x, row.apart_x),
                             zs = positions(grid.origin_z, row.first_z, row.apart_z);
    EXPECT_EQ(field.linear_between(xs, zs), row.along_x && row.along_z);
    for (const int axis : {0, 1}) {
      const double off = from_linear(field, xs, zs, axis);
      if (axis == 0 ? row.along_x : row.along_z) {
        EXPECT_LT(off, 1e-6) << axis;
      } else {
        EXPECT_GT(off, 1e-3) << axis;
      }
    }
  }
  const std::vector<float> borders = positions(grid.origin_x, 2, 2);
  EXPECT_FALSE(StackField(stack, Kernel::kSphere, 2).linear_between(borders, borders));
}

TEST(ImplicitField, RadiiWithoutAnExactVolumeAreRefused) {
  const TerrainSource source = random_boxes(1, 10, 10, 1);
  EXPECT_THROW(implicit(source, {.resolution = 10, .radius = 1e9}), Error);
  EXPECT_THROW(implicit(source, {.resolution = 10, .kernel = "sphere", .radius = 17}), Error);
  EXPECT_NO_THROW(implicit(source, {.resolution = 10, .kernel = "sphere", .radius = 16}));
  EXPECT_NO_THROW(implicit(source, {.resolution = 10, .radius = 1000}));
}

}  // namespace
}  // namespace terrabench::test
