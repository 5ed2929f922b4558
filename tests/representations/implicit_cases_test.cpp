// The implicit surface of terrains at the limits, impossible parameters and damaged files.
#include "terrain/error.h"
#include "tests/representations/implicit_ground.h"

namespace terrabench::test {
namespace {

TEST(ImplicitCases, FlatGroundStaysWhereItIs) {
  for (const std::string_view kernel : kKernelNames) {
    for (const std::string_view extractor : kExtractorNames) {
      const auto built = implicit(from_heights(40, 37, std::vector<float>(1480, 12), 2, 2),
                                  {.kernel = kernel, .extractor = extractor, .cell = 0.5});
      const TriangleMesh mesh = built->mesh({});
      EXPECT_TRUE(check_edges(mesh).watertight());
      const Bounds box = bounds_of(mesh);
      EXPECT_EQ(box.low, built->bounds().low);
      EXPECT_EQ(box.high, built->bounds().high);
      EXPECT_EQ(box.high.y, 12);
      EXPECT_NEAR(volume(mesh), 80.0 * 74 * 2, 80.0 * 74 * 2 * 0.05);  // edges of walls are cut off by nets
      for (const TriangleMesh& surface : {built->chunk({0, 0}, 0), built->chunk({1, 1}, 2)}) {
        ASSERT_GT(surface.positions.size(), 0U);
        for (std::size_t v = 0; v < surface.positions.size(); ++v) {
          EXPECT_EQ(surface.positions[v].y, 12);
          EXPECT_EQ(surface.normals[v], glm::vec3(0, 1, 0)) << v;
        }
      }
    }
  }
}

TEST(ImplicitCases, GroundWithoutOverhangsHasOneSpanPerColumn) {
  std::vector<float> heights;
  for (int c = 0; c < 900; ++c) {
    heights.push_back(50 + 10 * std::sin(0.3F * static_cast<float>(c % 30)) *
                               std::cos(0.2F * static_cast<float>(c / 30)));
  }
  const auto built = implicit(from_heights(30, 30, heights, 4, 5), {});
  const Lattice lattice(built->bounds(), 41, 43);
  const SpanSink sink = spans_of(*built, lattice.columns());
  for (std::size_t c = 0; c < sink.columns(); ++c) {
    ASSERT_EQ(sink.column(c).size(), 1U);
    EXPECT_EQ(sink.column(c)[0].bottom, built->bounds().low.y);
    EXPECT_GT(sink.column(c)[0].top, 38);
    EXPECT_LT(sink.column(c)[0].top, 62);
  }
  EXPECT_EQ(euler_characteristic(built->mesh({})), 2);
}

TEST(ImplicitCases, AllAirAndThinCrumbsHaveNoSurface) {
  const Bounds bounds{{0, 0, 0}, {40, 40, 40}};
  const auto air = implicit(from_predicate(bounds, [](float, float, float) { return Material::kAir; }),
                            {.resolution = 40});
  EXPECT_TRUE(air->mesh({}).indices.empty());
  EXPECT_TRUE(air->chunk({1, 1}, 3).indices.empty());
  const auto crumb = implicit(from_predicate(bounds,
                                             [](float x, float y, float z) {
                                               return x > 20 && x < 21 && y > 20 && y < 21 && z > 20 && z < 21
                                                          ? Material::kBedrock
                                                          : Material::kAir;
                                             }),
                              {.resolution = 40});
  EXPECT_TRUE(crumb->mesh({}).indices.empty());
}

TEST(ImplicitCases, OneCellIsABlock) {
  for (const std::string_view extractor : kExtractorNames) {
    for (const std::string_view kernel : kKernelNames) {
      const auto rock = [](float, float, float) { return Material::kBedrock; };
      for (const glm::ivec3 n : {glm::ivec3{1, 1, 1}, {1, 50, 1}, {50, 1, 1}, {1, 1, 50}}) {
        const auto built =
            implicit(from_predicate({{0, 0, 0}, glm::vec3(n)}, rock),
                     {.resolution = std::max({n.x, n.y, n.z}), .kernel = kernel, .extractor = extractor});
        const TriangleMesh mesh = built->mesh({});
        EXPECT_EQ(check_edges(mesh).open, 0U);
        EXPECT_TRUE(check_edges(mesh).watertight());
        EXPECT_EQ(euler_characteristic(mesh), 2);
        if (extractor == "marching_cubes") {
          EXPECT_NEAR(volume(mesh), n.x * n.y * n.z, 1e-4);
        }
        reloaded("implicit", *built);
      }
    }
  }
}

TEST(ImplicitCases, ParametersSurviveTheFile) {
  const auto built = implicit(
      random_boxes(2, 30, 30, 2),
      {.resolution = 30, .kernel = "sphere", .extractor = "surface_nets", .radius = 1.7, .cell = 0.8});
  const auto copy = reloaded("implicit", *built);
  const auto& loaded = dynamic_cast<const ImplicitSurface&>(*copy);
  EXPECT_EQ(loaded.field().radius(), 1.7);
  EXPECT_EQ(loaded.field().kernel(), Kernel::kSphere);
  EXPECT_TRUE(same_mesh(built->mesh({}), loaded.mesh({})));
  EXPECT_TRUE(same_mesh(built->chunk({0, 1}, 2), loaded.chunk({0, 1}, 2)));
}

TEST(ImplicitCases, DamagedParametersAreRefused) {
  const auto built = implicit(random_boxes(2, 10, 30, 2), {.resolution = 10});
  const std::vector<std::byte> good = saved(*built);
  const std::size_t radius = good.size() - 14, cell = good.size() - 6;
  const auto refused = [&](std::size_t at, auto value) {
    std::vector<std::byte> bad = good;
    std::memcpy(bad.data() + at, &value, sizeof value);
    ByteSource in(bad, "memory");
    try {
      representation("implicit").load(in);
    } catch (const Error& error) {
      return error.code() == ExitCode::kBadInput;
    }
    return false;
  };
  EXPECT_FALSE(refused(radius, 3.0));
  EXPECT_FALSE(refused(cell, 2.0F));
  for (const double wrong : {0.0, -1.0, 1e300, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_TRUE(refused(radius, wrong)) << wrong;
  }
  for (const float wrong : {0.0F, -1.0F, 1e-30F, std::nanf(""), std::numeric_limits<float>::infinity()}) {
    EXPECT_TRUE(refused(cell, wrong)) << wrong;
  }
  EXPECT_TRUE(refused(good.size() - 2, std::uint8_t{2}));
  EXPECT_TRUE(refused(good.size() - 1, std::uint8_t{2}));
}

TEST(ImplicitCases, ImpossibleRequestsAreRefused) {
  const TerrainSource source = random_boxes(2, 40, 30, 2);
  EXPECT_THROW(implicit(source, {.resolution = 40, .cell = 1e-4}), Error);
  EXPECT_THROW(implicit(source, {.resolution = 40, .radius = -1}), Error);
  EXPECT_THROW(implicit(source, {.resolution = 40, .kernel = "pyramid"}), Error);
  EXPECT_THROW(implicit(source, {.resolution = 40, .extractor = "marching_squares"}), Error);
  const auto built = implicit(source, {.resolution = 40});
  for (const glm::ivec2 at : {glm::ivec2{-1, 0}, {0, -1}, {2, 0}, {0, 2}}) {
    EXPECT_THROW(built->chunk(at, 0), Error);
  }
  EXPECT_THROW(built->chunk({0, 0}, -1), Error);
  EXPECT_THROW(built->chunk({0, 0}, 6), Error);
  EXPECT_NO_THROW(built->chunk({1, 1}, 5));
}

TEST(ImplicitCases, StrokesThatCannotBeChangeNothing) {
  const auto built = implicit(random_boxes(1, 40, 20, 1), {.resolution = 40});
  const std::vector<float> x{1, 2}, z{1, 2};
  EXPECT_THROW(built->edit({x, z}, std::vector<Span>{{0, 10, Material::kAir}, {6, 5, Material::kAir}}),
               Error);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  built->edit({std::vector<float>{nan, -100}, std::vector<float>{1, 1}},
              std::vector<Span>{{0, 10, Material::kBedrock}, {0, 10, Material::kBedrock}});
  for (int c = 0; c < 4; ++c) EXPECT_EQ(built->version({c % 2, c / 2}), 0U);
}

}  // namespace
}  // namespace terrabench::test
