// Procedural meshes as terrain, against what is known of their shapes.
#include "representations/procedural_mesh/procedural_mesh.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include "representations/procedural_mesh/model.h"
#include "representations/procedural_mesh/model_terrain.h"
#include "terrain/error.h"
#include "tests/representations/ground.h"
#include "tests/terrain/errors.h"
#include "tests/terrain/ground.h"

namespace terrabench::test {
namespace {

using testing::HasSubstr;

const std::string kCube = "[base]\nshape = \"cube\"\nsize = [2, 3, 4]\n";

// Refined linearly and moved onto the unit sphere at every level.
std::string sphere(int levels) {
  const std::string length = "sqrt(x*x + y*y + z*z)";
  return fmt::format(
      "[base]\nshape = \"sphere\"\nradius = 1\ncells = 2\n[[step]]\nsubdivide = {0}\nplace = \"linear\"\n"
      "displace = [{{ along = [1, 0, 0], unit = \"metre\", amount = \"x/{1} - x\" }}, "
      "{{ along = [0, 1, 0], unit = \"metre\", amount = \"y/{1} - y\" }}, "
      "{{ along = [0, 0, 1], unit = \"metre\", amount = \"z/{1} - z\" }}]\n",
      levels, length);
}

TerrainSource flat_ground(int side) {
  return from_heights(side, side, std::vector<float>(static_cast<std::size_t>(side * side), 7));
}

ProceduralMesh model_of(const std::string& text, int leave_out = 0) {
  MeshDescription description;
  description.model.assign(text.begin(), text.end());
  description.leave_out = leave_out;
  return ProceduralMesh(std::move(description), "test");
}

std::vector<Span> column(const Representation& built, float x, float z) {
  const SpanSink sink = spans_of(built, {{&x, 1}, {&z, 1}});
  return {sink.column(0).begin(), sink.column(0).end()};
}

TEST(ProceduralMesh, OfACubeIsExactEverywhereOnItsEdgesToo) {
  const ProceduralMesh cube = model_of(kCube);
  const std::vector<Span> full{{-1.5F, 1.5F, Material::kBedrock}};
  for (const float x : {-1.0F, -0.999F, -0.5F, 0.0F, 0.3F, 1.0F}) {
    for (const float z : {-2.0F, -1.0F, 0.0F, 0.6F, 1.999F, 2.0F}) {
      EXPECT_EQ(column(cube, x, z), full) << x << " " << z;
    }
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(-3, 3);
  for (int n = 0; n < 10000; ++n) {
    const float x = unit(random), z = unit(random);
    const bool inside = std::abs(x) <= 1 && std::abs(z) <= 2;
    ASSERT_EQ(column(cube, x, z), inside ? full : std::vector<Span>{}) << x << " " << z;
  }
  EXPECT_EQ(cube.bounds().low, glm::vec3(-1, -1.5F, -2));
  EXPECT_EQ(cube.mesh({}).triangles(), 12U);
  EXPECT_NEAR(volume(cube.mesh({})), 24, 1e-5);
}

TEST(ProceduralMesh, OfASphereConvergesToTheSphere) {
  double before = 0;
  for (int levels = 2; levels <= 5; ++levels) {
    const ProceduralMesh built = model_of(sphere(levels));
    double largest = 0;
    std::mt19937 random(2);
    std::uniform_real_distribution<float> unit(-0.8F, 0.8F);
    for (int n = 0; n < 4000; ++n) {
      const float x = unit(random), z = unit(random);
      if (x * x + z * z > 0.64F) continue;
      const std::vector<Span> spans = column(built, x, z);
      ASSERT_EQ(spans.size(), 1U);
      const double y = std::sqrt(1.0 - double{x} * x - double{z} * z);
      largest = std::max({largest, std::abs(spans[0].top - y), std::abs(spans[0].bottom + y)});
    }
    if (levels > 2) {
      EXPECT_GT(before / largest, 3.2) << levels;
      EXPECT_LT(before / largest, 4.8) << levels;
    }
    before = largest;
  }
  EXPECT_LT(before, 1e-3);
}

// Every crossing by the signs of three areas, in long doubles; false close to an edge.
bool brute_force(const TriangleColumns& mesh, float x, float z,
                 std::vector<std::pair<double, int>>& crossings) {
  using Point = glm::vec<3, long double>;
  const auto area = [](const Point& u, const Point& v) { return u.z * v.x - u.x * v.z; };
  crossings.clear();
  for (const Triangle& t : mesh.triangles()) {
    const Point at(x, 0, z), a = Point(mesh.positions()[t.x]) - at, b = Point(mesh.positions()[t.y]) - at,
                             c = Point(mesh.positions()[t.z]) - at;
    const long double whole = area(b - a, c - a), of_a = area(b, c), of_b = area(c, a), of_c = area(a, b);
    const int signs = (of_a > 0) + (of_b > 0) + (of_c > 0);
    if (signs != 0 && signs != 3) continue;
    if (std::min({std::abs(of_a), std::abs(of_b), std::abs(of_c)}) <= 1e-9L * std::abs(whole)) return false;
    const auto y = static_cast<double>((of_a * a.y + of_b * b.y + of_c * c.y) / (of_a + of_b + of_c));
    crossings.emplace_back(y, whole > 0 ? -1 : 1);
  }
  std::sort(crossings.begin(), crossings.end());
  return true;
}

class NamedModels : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Models, NamedModels,
                         testing::Values("fractal_plane", "fractal_sphere", "forking_trunk", "chair",
                                         "cactus_smooth"),
                         [](const auto& at) { return std::string(at.param); });

TEST_P(NamedModels, CrossAsEveryTriangleTriedDoes) {
  const ProceduralMesh built = model_of(std::string(growing::model_text(GetParam())), 2);
  const Bounds bounds = built.bounds();
  const Cloud cloud(bounds, 200, 5);
  const bool open = std::string_view(GetParam()) == "fractal_plane";
  std::vector<Crossing> got;
  std::vector<std::pair<double, int>> expected;
  int compared = 0, several = 0;
  for (std::size_t c = 0; c < cloud.x.size(); ++c) {
    built.columns().crossings(cloud.x[c], cloud.z[c], got);
    if (!brute_force(built.columns(), cloud.x[c], cloud.z[c], expected)) continue;
    ASSERT_EQ(got.size(), expected.size());
    double length = 0, depth = open && !got.empty() ? 1 : 0, bottom = bounds.low.y;
    for (std::size_t k = 0; k < got.size(); ++k) {
      const auto [y, weight] = expected[k];
      EXPECT_NEAR(got[k].y, y, 1e-5 * (1 + std::abs(got[k].y)));
      EXPECT_EQ(got[k].weight, weight);
      if (depth <= 0 && depth + weight > 0) bottom = y;
      if (depth > 0 && depth + weight <= 0) length += y - bottom;
      depth += weight;
    }
    EXPECT_EQ(depth, 0);
    double solid = 0;
    for (const Span& span : column(built, cloud.x[c], cloud.z[c])) solid += double{span.top} - span.bottom;
    EXPECT_NEAR(solid, length, 1e-4 * (1 + length));
    ++compared;
    several += got.size() > 2;
  }
  EXPECT_GT(compared, 190);
  if (std::string_view(GetParam()) == "chair") {
    EXPECT_GT(several, 10) << "the seat over the legs";
  }
}

TEST_P(NamedModels, AreWatertightAndAnswerAlikeInAllWays) {
  const std::string text(growing::model_text(GetParam()));
  const ProceduralMesh built = model_of(text, 1);
  EXPECT_TRUE(check_edges(built.mesh({})).watertight());
  const Cloud cloud(built.bounds(), 2000, 7);
  std::vector<Material> points(cloud.x.size());
  built.materials(cloud.points(), points);
  const MeshColumns solid{std::make_shared<const ProceduralMesh>(model_of(text, 1))};
  for (std::size_t p = 0; p < points.size(); ++p) {
    Material alone{7};
    solid({cloud.x[p], cloud.z[p], cloud.y[p], 1}, {&alone, 1});
    ASSERT_EQ(alone, points[p]);
  }
  ByteSink bytes;
  built.save(bytes);
  EXPECT_LT(bytes.bytes().size(), text.size() + 64);
  const auto copy = reloaded("procedural_mesh", built);
  EXPECT_TRUE(same_spans(spans_of(*copy, {cloud.x, cloud.z}), spans_of(built, {cloud.x, cloud.z})));
  const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
  const ProceduralMesh alone = model_of(text, 1);
  EXPECT_TRUE(same_spans(spans_of(alone, {cloud.x, cloud.z}), spans_of(built, {cloud.x, cloud.z})));
  EXPECT_EQ(alone.mesh({}).indices, built.mesh({}).indices);
}

TEST(ProceduralMesh, ReturnsHeightsToTheBitAtAnyNumberOfLevels) {
  for (const auto& [width, depth] : {std::pair{2, 2}, {5, 9}, {33, 17}, {70, 41}, {3, 130}}) {
    const Heightfield field = random_ground(width, depth, 3, -50, 900);
    const TerrainSource source = from_heights(width, depth, field.heights, 29.7F, 31.3F);
    for (const std::int64_t levels : {0, 1, 4, 16}) {
      Progress progress;
      const RepresentationType& type = representation("procedural_mesh");
      const auto built = type.build(source, Parameters(type.parameters, {{"levels", levels}}), progress);
      for (int j = 0; j < depth; ++j) {
        for (int i = 0; i < width; ++i) {
          const std::vector<Span> spans =
              column(*built, static_cast<float>(i) * 29.7F, static_cast<float>(j) * 31.3F);
          ASSERT_EQ(spans.size(), 1U) << i << " " << j;
          ASSERT_EQ(spans[0].top, field.at(i, j)) << i << " " << j;
        }
      }
    }
  }
}

TEST(ProceduralMesh, LeavesOutLateLevels) {
  const TerrainSource source = from_heights(65, 65, random_ground(65, 65, 1, 0, 100).heights);
  const RepresentationType& type = representation("procedural_mesh");
  Progress progress;
  const auto full = type.build(source, Parameters(type.parameters), progress);
  for (const std::int64_t out : {1, 2, 4}) {
    const auto coarse = type.build(source, Parameters(type.parameters, {{"leave_out", out}}), progress);
    const auto& mesh = dynamic_cast<const ProceduralMesh&>(*coarse);
    const std::size_t side = std::size_t{64} >> static_cast<unsigned>(out);
    EXPECT_EQ(mesh.columns().triangles().size(), 2 * side * side);
    for (std::size_t k = 0; k <= side; ++k) {  // the vertices that are left lie where they did
      const auto x = static_cast<float>(k << static_cast<unsigned>(out));
      EXPECT_EQ(column(*coarse, x, x), column(*full, x, x));
    }
    const float cell = static_cast<float>(std::int64_t{1} << out) * 1.01F;
    EXPECT_LE(full->mesh({cell}).triangles(), coarse->mesh({}).triangles() * 4);
    EXPECT_LT(full->mesh({cell}).triangles(), full->mesh({}).triangles());
  }
}

TEST(ProceduralMesh, ClosesAroundHolesThatTouchAtCorners) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    std::vector<float> heights =
        with_holes(random_ground(23, 31, seed, 0, 10), seed + 1, 0.02 * seed).heights;
    heights[0] = 1;
    const auto built = build("procedural_mesh", from_heights(23, 31, heights, 3, 2));
    EXPECT_TRUE(check_edges(built->mesh({})).watertight()) << seed;
    const Lattice lattice(built->bounds(), 22 * 12, 30 * 12);
    double sum = 0;
    const SpanSink sink = spans_of(*built, lattice.columns());
    for (const Span& span : sink.all()) sum += static_cast<double>(span.top) - span.bottom;
    const double expected = sum * 22 * 3 * 30 * 2 / static_cast<double>(lattice.x.size());
    EXPECT_NEAR(volume(built->mesh({})), expected, 2e-3 * expected) << seed;
  }
}

TEST(ProceduralMesh, StandsOnGroundAndIsUnitedWithIt) {
  const auto built =
      build("procedural_mesh", model_on_ground(sphere(3), "ball", flat_ground(21), ModelPlace{10, 8, 2}));
  EXPECT_EQ(column(*built, 2, 3), (std::vector<Span>{{6, 7, Material::kBedrock}}));
  const std::vector<Span> beside = column(*built, 11, 8);
  ASSERT_EQ(beside.size(), 2U);
  EXPECT_EQ(beside[0], (Span{6, 7, Material::kBedrock}));
  // Its foot, a fiftieth of its height, lies in the ground.
  EXPECT_NEAR(beside[1].bottom, 9 - std::sqrt(3), 0.08 + 0.03);
  EXPECT_NEAR(beside[1].top, 9 + std::sqrt(3), 0.08 + 0.03);
  const std::vector<Span> foot = column(*built, 10, 8);
  ASSERT_EQ(foot.size(), 1U) << "the ball touches the ground";
  EXPECT_GT(foot[0].top, 11 - 0.08);
  EXPECT_LT(foot[0].top, 11);
}

TEST(ProceduralMesh, LeavesNoGapUnderAFootOnASlope) {
  std::vector<float> heights;
  for (int j = 0; j < 21; ++j) {
    for (int i = 0; i < 21; ++i) heights.push_back(static_cast<float>(i + 2 * j));
  }
  const auto built = build(
      "procedural_mesh", model_on_ground(kCube, "box", from_heights(21, 21, heights), ModelPlace{10, 8, 1}));
  for (const float x : {9.0F, 9.7F, 11.0F}) {
    for (const float z : {6.0F, 7.1F, 10.0F}) EXPECT_EQ(column(*built, x, z).size(), 1U) << x << " " << z;
  }
  EXPECT_NEAR(column(*built, 9.1F, 6.1F)[0].top, 21 + 3, 1e-4);        // the lowest corner stands at 9 + 12 m
  EXPECT_NEAR(column(*built, 10.9F, 9.9F)[0].top, 10.9 + 19.8, 1e-4);  // the hillside covers it there
}

TEST(ProceduralMesh, CountsItsBytesForModelsToo) {
  model_of(kCube).mesh({});
  const HeapScope scope;
  auto built = std::make_unique<ProceduralMesh>(model_of(sphere(4)));
  EXPECT_EQ(static_cast<std::int64_t>(built->memory().total()), scope.held());
  EXPECT_LT(built->description_bytes(), 800U);
  EXPECT_GT(built->expanded_bytes(), 100'000U);
}

TEST(ProceduralMesh, OtherRepresentationsAreBuiltFromModels) {
  const TerrainSource source = model_source(sphere(4), "ball");
  for (const std::string_view name : types([](const Traits& t) { return t.materials; })) {
    double solid = 0;
    const auto built = build(name, source, 40);
    const SpanSink sink = spans_of(*built, Lattice(built->bounds(), 40, 40).columns());
    for (const Span& span : sink.all()) solid += (static_cast<double>(span.top) - span.bottom) / 400;
    EXPECT_NEAR(solid, 4 * std::numbers::pi / 3, 0.05) << name;
  }
  const auto heights = build("heightmap", source, 40);
  EXPECT_NEAR(column(*heights, 0, 0)[0].top, 1, 0.06);
}

template <class Action>
std::string what_of(const Action& action) {
  return failure_of(action).what;
}

TEST(ProceduralMesh, RefusesClosedMeshesThatAreTurnedInsideOut) {
  const std::string
      tetrahedron = "[base]\nvertices = [[0,0,0],[1,0,0],[0,1,0],[0,0,1]]\nfaces = ",
      inward = "[[0,1,2],[0,3,1],[1,3,2],[0,2,3]]\n", outward = "[[0,2,1],[0,1,3],[1,2,3],[0,3,2]]\n",
      plane =
          "[base]\nvertices = "
          "[[0,0,0],[9,0,0],[9,0,9],[0,0,9],[0,5,0],[1,5,0],[0,6,0],[0,5,1]]\nfaces = [[3,2,1,0]";
  for (const std::string& good : {tetrahedron + outward, tetrahedron + outward + "[[step]]\nsubdivide = 2\n",
                                  plane + ",[4,6,5],[4,5,7],[5,6,7],[4,7,6]]\n"}) {
    EXPECT_NO_THROW(model_of(good)) << good;
  }
  for (const std::string& bad : {tetrahedron + inward, tetrahedron + inward + "[[step]]\nsubdivide = 2\n",
                                 plane + ",[4,5,6],[4,7,5],[5,7,6],[4,6,7]]\n"}) {
    EXPECT_THAT(what_of([&] { model_of(bad); }), HasSubstr("inside out")) << bad;
  }
  EXPECT_THAT(what_of([&] {
                model_on_ground(tetrahedron + inward, "m", flat_ground(3), ModelPlace{1, 1, 0.5F});
              }),
              HasSubstr("inside out"));
}

TEST(ProceduralMesh, RefusesASingleRowOfSamples) {
  for (const char* const type : {"procedural_mesh", "ght"}) {
    for (const auto& [width, depth] : {std::pair{1, 5}, {5, 1}, {1, 1}}) {
      const TerrainSource row =
          from_heights(width, depth, std::vector<float>(static_cast<std::size_t>(width) * depth, 7));
      EXPECT_THAT(what_of([&] { build(type, row); }), HasSubstr("at least 2 × 2")) << type << width;
    }
    EXPECT_NO_THROW(build(type, from_heights(2, 2, {1, 2, 3, 4}))) << type;
  }
}

TEST(ProceduralMesh, RefusesWhatHasNoInsideOrPlace) {
  const auto text = [](const std::string& model) { return what_of([&] { model_of(model); }); };
  const auto place = [](const std::string& model, const TerrainSource& ground, std::optional<ModelPlace> at) {
    return what_of([&] { model_on_ground(model, "m", ground, at); });
  };
  EXPECT_THAT(text("[base]\nvertices = [[0,0,0],[1,0,0],[1,0,1],[0,0,1]]\nfaces = [[0,1,2,3]]\n"),
              HasSubstr("looks down"));
  EXPECT_NO_THROW(model_of("[base]\nshape = \"cube\"\nsize = [1e8, 1e8, 1e8]\n"));
  EXPECT_THAT(text("[base]\nshape = \"cube\"\nsize = [1e30, 1e30, 1e30]\n"), HasSubstr("farther than"));
  EXPECT_THAT(text("[limits]\nfaces = 100\n[base]\nshape = \"cube\"\n[[step]]\nsubdivide = 14\n"),
              HasSubstr("more than"));
  EXPECT_THAT(place(kCube, flat_ground(3), ModelPlace{50, 1, 1}), HasSubstr("no ground"));
  EXPECT_THAT(place(kCube, flat_ground(3), ModelPlace{1, 1, -1}), HasSubstr("scale"));
  EXPECT_THAT(place(kCube, caves(), std::nullopt), HasSubstr("solid"));
  EXPECT_THAT(what_of([] { model_source("[base", "m"); }), HasSubstr("m:1"));
}

}  // namespace
}  // namespace terrabench::test
