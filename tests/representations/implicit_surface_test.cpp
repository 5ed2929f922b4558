// The surfaces of both extractors: closed, where the field says, the same in chunks and after edits.
#include <gmock/gmock.h>

#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "representations/implicit/cell_cases.h"
#include "terrain/sources/noise/cave_terrain.h"
#include "tests/representations/implicit_ground.h"
#include "tests/terrain/errors.h"

namespace terrabench::test {
namespace {

class EveryExtractor : public testing::TestWithParam<std::string_view> {
 protected:
  Extractor extractor() const {
    return GetParam() == "marching_cubes" ? Extractor::kMarchingCubes : Extractor::kSurfaceNets;
  }
};
INSTANTIATE_TEST_SUITE_P(Extractors, EveryExtractor, testing::ValuesIn(kExtractorNames),
                         [](const auto& at) { return std::string(at.param); });

const Bounds kBox{{-1, -1, -1}, {1, 1, 1}};

TEST(CellCases, SeparateSolidCornersAndPassEachCrossedEdgeOnce) {
  for (int solid = 0; solid < 256; ++solid) {
    const CellCase& cell = cell_cases()[static_cast<std::size_t>(solid)];
    int crossed = 0;
    for (int edge = 0; edge < 12; ++edge) {
      const int axis = edge / 4, b = axis == 0 ? 1 : 0, c = axis == 2 ? 1 : 2;
      const int low = (edge & 1) << b | (edge >> 1 & 1) << c, high = low | 1 << axis;
      const bool crosses = ((solid >> low ^ solid >> high) & 1) != 0;
      EXPECT_EQ(cell.loop_of[static_cast<std::size_t>(edge)] != kNoLoop, crosses) << solid << ' ' << edge;
      crossed += crosses ? 1 : 0;
    }
    EXPECT_EQ(cell.triangles, crossed - 2 * cell.loops) << solid;
  }
  EXPECT_EQ(cell_cases()[0b10000001].loops, 2);  // opposite corners
  EXPECT_EQ(cell_cases()[0b01111110].loops, 2);
  EXPECT_EQ(cell_cases()[0b01101001].loops, 4);  // every second corner
  EXPECT_EQ(cell_cases()[0b10010110].loops, 4);
  EXPECT_EQ(cell_cases()[0b00001001].loops, 2);  // across one face
}

// Every case of a cell occurs next to every other, with zeros among them.
TEST_P(EveryExtractor, ClosesNoise) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    const FunctionField noise([seed](glm::vec3 p) {
      unsigned hash = seed;
      for (int axis = 0; axis < 3; ++axis) {
        hash = (hash ^ static_cast<unsigned>(std::lround((p[axis] + 9) * 32))) * 2654435761U;
        hash ^= hash >> 15;
      }
      return static_cast<float>(static_cast<int>(hash % 9) - 4 - static_cast<int>(seed) / 2);
    });
    const TriangleMesh mesh = closed_surface(noise, FieldLattice(kBox, 1.0F / 16), extractor());
    const EdgeReport edges = check_edges(mesh);
    EXPECT_GT(mesh.triangles(), 20000U);
    EXPECT_EQ(edges.open, 0U);
    if (extractor() == Extractor::kMarchingCubes) {
      EXPECT_EQ(edges.non_manifold, 0U);
      EXPECT_EQ(edges.misoriented, 0U);
    }
    for (std::size_t v = 0; v < mesh.normals.size(); ++v) {
      ASSERT_NEAR(glm::length(mesh.normals[v]), 1, 1e-5);
      for (int axis = 0; axis < 3; ++axis) ASSERT_LE(std::abs(mesh.positions[v][axis]), 1);
    }
  }
}

TEST_P(EveryExtractor, BallsAndRingsHaveTheirShape) {
  const FunctionField ball([](glm::vec3 p) { return 0.8F - glm::length(p); });
  const FunctionField ring([](glm::vec3 p) {
    const float around = std::hypot(p.x, p.z) - 0.6F;
    return 0.25F - std::hypot(around, p.y);
  });
  const TriangleMesh round = closed_surface(ball, FieldLattice(kBox, 1.0F / 50), extractor());
  EXPECT_TRUE(check_edges(round).watertight());
  EXPECT_EQ(euler_characteristic(round), 2);
  EXPECT_NEAR(volume(round), 4.0 / 3 * std::numbers::pi * 0.512, 5e-3);
  for (std::size_t v = 0; v < round.positions.size(); ++v) {
    ASSERT_NEAR(glm::length(round.positions[v]), 0.8, 1e-3);
    ASSERT_GT(glm::dot(round.normals[v], glm::normalize(round.positions[v])), 0.999F);
  }
  const TriangleMesh torus = closed_surface(ring, FieldLattice(kBox, 1.0F / 50), extractor());
  EXPECT_TRUE(check_edges(torus).watertight());
  EXPECT_EQ(euler_characteristic(torus), 0);
  EXPECT_NEAR(volume(torus), 2 * std::numbers::pi * std::numbers::pi * 0.6 * 0.0625, 1e-2);
}

TEST_P(EveryExtractor, WallsAndFloorCloseTheTerrainAtItsBorder) {
  // Longer than a block along z, and no whole number of cells along y and z.
  const TerrainSource source =
      from_predicate({{2, 5, -1}, {42, 14.3F, 162.7F}}, [](float x, float y, float z) {
        return y < 9 + 2 * std::sin(x) + std::cos(0.2F * z) ? Material::kBedrock : Material::kAir;
      });
  for (const float cell : {0.0F, 1.7F, 5.0F, 1e9F}) {
    const auto built = implicit(source, {.resolution = 163, .extractor = GetParam(), .radius = 1.5});
    const TriangleMesh mesh = built->mesh({cell});
    EXPECT_TRUE(check_edges(mesh).watertight()) << cell;
    if (cell > 6) continue;
    const Bounds box = bounds_of(mesh);
    EXPECT_EQ(box.low, built->bounds().low);
    EXPECT_EQ(box.high.x, built->bounds().high.x);
    EXPECT_EQ(box.high.z, built->bounds().high.z);
    EXPECT_EQ(euler_characteristic(mesh), 2);
    // Waves are 6 m long: large cells lose much of them.
    const ColumnGrid& grid = built->stack().grid();
    double expected = 0;
    for (int c = 0; c < grid.width * grid.depth; ++c) {
      expected += built->stack().column(c % grid.width, c / grid.width).tops[0];
    }
    expected *= grid.step * grid.cell_x * grid.cell_z;
    EXPECT_NEAR(volume(mesh), expected, (cell < 1 ? 0.01 : 0.06) * expected) << cell;
  }
}

TEST_P(EveryExtractor, AnArchIsOneRing) {
  const TerrainSource arch = from_predicate({{0, 0, 0}, {48, 32, 24}}, [](float x, float y, float z) {
    const float r = std::hypot(x - 24, y - 4);
    const bool bow = r > 12 && r < 20 && std::abs(z - 12) < 5;
    return y < 4 || bow ? Material::kBedrock : Material::kAir;
  });
  for (const std::string_view kernel : kKernelNames) {
    const auto built = implicit(arch, {.resolution = 48, .kernel = kernel, .extractor = GetParam()});
    const TriangleMesh mesh = built->mesh({});
    EXPECT_TRUE(check_edges(mesh).watertight());
    EXPECT_EQ(euler_characteristic(mesh), 0) << kernel;
  }
}

TEST_P(EveryExtractor, RandomTerrainsAreClosedAtAnyDetail) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    for (const double radius : {0.4, 1.0, 3.0}) {
      const auto built = implicit(random_cells(seed, 37, 11, 40, 2, 30 + 20 * seed),
                                  {.resolution = 40, .extractor = GetParam(), .radius = radius});
      for (const float cell : {0.0F, 1.3F, 4.0F}) {
        const EdgeReport edges = check_edges(built->mesh({cell}));
        EXPECT_EQ(edges.open, 0U);
        if (extractor() == Extractor::kMarchingCubes) {
          EXPECT_TRUE(edges.watertight());
        }
      }
    }
  }
}

TEST(ImplicitSurface, SpansEndOnTheMesh) {
  const auto built = implicit(caves(), {.resolution = 40});
  const TriangleMesh mesh = built->mesh({});
  // Vertices of marching cubes on vertical edges are the ends of spans at lattice points.
  std::map<std::pair<float, float>, std::set<float>> ends;
  for (const glm::vec3 p : mesh.positions) ends[{p.x, p.z}].insert(p.y);
  std::size_t found = 0;
  for (int j = 1; j < built->lattice().cells.z; ++j) {
    for (int i = 1; i < built->lattice().cells.x; ++i) {
      const std::vector<float> x{built->lattice().position(0, i)}, z{built->lattice().position(2, j)};
      const SpanSink sink = spans_of(*built, {x, z});
      for (const Span& span : sink.all()) {
        EXPECT_EQ(ends[std::pair(x[0], z[0])].count(span.bottom), 1U);
        EXPECT_EQ(ends[std::pair(x[0], z[0])].count(span.top), 1U);
        found += span.bottom > built->bounds().low.y ? 2 : 1;
      }
    }
  }
  EXPECT_GT(found, 1000U);
}

TEST(ImplicitSurface, MaterialsFollowSpans) {
  for (const std::string_view kernel : kKernelNames) {
    const auto built = implicit(caves(), {.resolution = 30, .kernel = kernel, .cell = 0.021});
    Cloud cloud(built->bounds(), 3000, 5);
    for (std::size_t p = 0; p < cloud.x.size(); ++p) {  // every second line has five points
      if (p % 10 < 5) {
        cloud.x[p] = cloud.x[p - p % 10];
        cloud.z[p] = cloud.z[p - p % 10];
      }
      if (p % 7 == 0) cloud.y[p] = built->lattice().position(1, static_cast<int>(p % 48));
    }
    std::vector<Material> quick(cloud.x.size()), slow(cloud.x.size());
    built->materials(cloud.points(), quick);
    built->Representation::materials(cloud.points(), slow);
    EXPECT_EQ(quick, slow);
    EXPECT_GT(std::count(quick.begin(), quick.end(), Material::kBedrock), 300);
  }
}

TEST_P(EveryExtractor, NormalsFollowTheFieldsGradient) {
  const auto built = implicit(caves(), {.resolution = 64, .extractor = GetParam(), .radius = 0.05});
  const float step = built->lattice().cell;
  for (const int detail : {0, 1}) {
    const TriangleMesh mesh = built->chunk({1, 1}, detail);
    ASSERT_GT(mesh.positions.size(), 200U);
    double sum = 0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      glm::vec3 slope;
      for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 low = mesh.positions[v], high = low;
        low[axis] -= step;
        high[axis] += step;
        slope[axis] = built->field().at(high) - built->field().at(low);
      }
      sum += glm::dot(mesh.normals[v], -glm::normalize(slope));
    }
    EXPECT_GT(sum / static_cast<double>(mesh.positions.size()), 0.985) << detail;
  }
}

// 64,000³ cells: no machine holds a mesh of some 10¹⁰ vertices.
TEST(ImplicitSurface, AMeshThatNoMemoryHoldsIsRefusedBeforeItIsMade) {
  const RepresentationType& type = representation("implicit");
  Progress progress;
  const auto built =
      type.build(noise::cave_source({.seed = 1}),
                 Parameters(type.parameters, {{"resolution", std::int64_t{64}}, {"cell", 0.002}}), progress);
  const Failure failure = failure_of([&] { (void)built->mesh({}); });
  EXPECT_EQ(failure.code, ExitCode::kEnvironment);
  EXPECT_THAT(failure.advice, testing::HasSubstr("larger cells"));
}

}  // namespace
}  // namespace terrabench::test
