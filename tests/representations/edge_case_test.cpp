// Terrains at the limits, and impossible input.
#include "representations/column_grid.h"
#include "representations/layered_stack/layered_stack.h"
#include "tests/representations/ground.h"
#include "tests/terrain/errors.h"

namespace terrabench::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

ExitCode code_of(const std::function<void()>& action) {
  const Failure failure = failure_of(action);
  EXPECT_TRUE(failure.code == ExitCode::kInterrupted || !failure.advice.empty());
  return failure.code;
}

class Any : public testing::TestWithParam<std::string_view> {};
INSTANTIATE_TEST_SUITE_P(Types, Any, testing::ValuesIn(types()),
                         [](const auto& at) { return std::string(at.param); });

// Types that return the source's own samples, of any size and number: volumes with materials, and heights
// without loss. Drills refuse heights beyond 10⁹ m, and a tree of heightmaps has no ground in a single row.
bool returns_samples(const Traits& traits) {
  return traits.materials || (traits.lossless && !traits.overhangs);
}

class Sampled : public testing::TestWithParam<std::string_view> {};
INSTANTIATE_TEST_SUITE_P(Types, Sampled, testing::ValuesIn(types(returns_samples)),
                         [](const auto& at) { return std::string(at.param); });

TEST_P(Sampled, TakesFieldsOfOneSampleOrOneRow) {
  for (const auto& [width, depth] : {std::pair{1, 1}, {1, 17}, {40, 1}, {2, 2}}) {
    const auto n = static_cast<std::size_t>(width * depth);
    const auto built = build(GetParam(), from_heights(width, depth, std::vector<float>(n, 3), 2, 2));
    const std::vector<float> x{static_cast<float>(width - 1) * 2}, z{static_cast<float>(depth - 1) * 2};
    const SpanSink sink = spans_of(*built, {x, z});
    ASSERT_EQ(sink.column(0).size(), 1U);
    EXPECT_EQ(sink.column(0)[0].top, 3);
    EXPECT_LE(sink.column(0)[0].bottom, 1);
    EXPECT_TRUE(check_edges(built->mesh({})).watertight());
    reloaded(GetParam(), *built);
  }
}

TEST_P(Any, TakesAllSolid) {
  const TerrainSource rock =
      from_predicate({{0, 0, 0}, {9, 9, 9}}, [](float, float, float) { return Material::kBedrock; });
  const auto built = build(GetParam(), rock, 9);
  const Lattice lattice(built->bounds(), 9, 9);
  const SpanSink sink = spans_of(*built, lattice.columns());
  for (std::size_t c = 0; c < sink.columns(); ++c) {
    ASSERT_EQ(sink.column(c).size(), 1U);
    EXPECT_EQ(sink.column(c)[0], (Span{0, 9, Material::kBedrock}));
  }
  EXPECT_TRUE(check_edges(built->mesh({})).watertight());
}

TEST_P(Any, TakesAllAir) {
  const TerrainSource air =
      from_predicate({{0, 0, 0}, {9, 9, 9}}, [](float, float, float) { return Material::kAir; });
  const auto built = build(GetParam(), air, 9);
  EXPECT_TRUE(spans_of(*built, Lattice(built->bounds(), 9, 9).columns()).all().empty());
  EXPECT_TRUE(
      spans_of(*reloaded(GetParam(), *built), Lattice(built->bounds(), 9, 9).columns()).all().empty());
}

TEST_P(Sampled, TakesLongThinSolids) {
  const auto rock = [](float, float, float) { return Material::kBedrock; };
  for (const glm::vec3 size : {glm::vec3{1, 1, 200}, glm::vec3{200, 1, 1}, glm::vec3{1, 200, 1}}) {
    const auto built = build(GetParam(), from_predicate({glm::vec3(0), size}, rock), 200);
    EXPECT_EQ(built->bounds().high, size);
    EXPECT_EQ(spans_of(*built, Lattice(built->bounds(), 3, 3).columns()).all().size(), 9U);
  }
}

TEST_P(Any, AnswersNothingOutsideAndForNonsense) {
  const auto built = build(GetParam(), random_boxes(2, 10, 40, 1), 10);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> x{-1, 11, 5, nan, kInfinity, 5, 5, 5},
      y{5, 5, 5, 5, 5, nan, kInfinity, -kInfinity}, z{5, 5, -0.01F, 5, 5, 5, 5, 5};
  std::vector<Material> out(x.size(), Material{7});
  built->materials({x, y, z}, out);
  EXPECT_EQ(out, std::vector<Material>(x.size(), Material::kAir));
  for (std::size_t c = 0; c < 5; ++c) EXPECT_TRUE(spans_of(*built, {x, z}).column(c).empty()) << c;
}

TEST_P(Any, RefusesHeightsWithoutSubstance) {
  const float none = Heightfield::kNoData;
  EXPECT_EQ(code_of([&] {
              build(GetParam(), from_heights(2, 2, {none, none, none, none}));
            }),
            ExitCode::kBadInput);
  EXPECT_EQ(code_of([&] {
              build(GetParam(), from_heights(2, 2, {1, 2, kInfinity, 4}));
            }),
            ExitCode::kBadInput);
  EXPECT_EQ(code_of([&] { build(GetParam(), from_heights(2, 2, {1, 2, 3})); }), ExitCode::kBadInput);
  EXPECT_EQ(code_of([&] { build(GetParam(), from_heights(0, 0, {})); }), ExitCode::kBadInput);
  EXPECT_EQ(code_of([&] { build(GetParam(), from_heights(1, 1, {1}, 0, 1)); }), ExitCode::kBadInput);
  EXPECT_EQ(code_of([&] { build(GetParam(), from_heights(1, 1, {1}, none, 1)); }), ExitCode::kBadInput);
}

TEST_P(Any, RefusesSolidsWithoutVolume) {
  const auto rock = [](float, float, float) { return Material::kBedrock; };
  for (const Bounds& bounds :
       {Bounds{{0, 0, 0}, {1, 0, 1}}, Bounds{{0, 0, 0}, {1, 1, kInfinity}}, Bounds{{0, 1, 0}, {1, 0, 1}},
        Bounds{{0, 0, 0}, {1, std::numeric_limits<float>::quiet_NaN(), 1}}}) {
    EXPECT_EQ(code_of([&] { build(GetParam(), from_predicate(bounds, rock), 4); }), ExitCode::kBadInput);
  }
}

TEST_P(Sampled, SurvivesHeightsOfAnyMagnitude) {
  for (const float scale : {1e-30F, 1e-6F, 1.0F, 1e7F, 1e28F}) {
    const auto built = build(GetParam(), from_heights(2, 2, {scale, -scale, 0, scale / 3}));
    const std::vector<float> at{0};
    const SpanSink sink = spans_of(*built, {at, at});
    ASSERT_EQ(sink.column(0).size(), 1U);
    const float step = 2 * std::max(scale, 1.0F) / 254;  // of the coarsest structure
    EXPECT_NEAR(sink.column(0)[0].top, scale, step) << scale;
  }
}

TEST_P(Any, StopsWhenInterrupted) {
  Progress::interrupt();
  EXPECT_EQ(code_of([&] { build(GetParam(), caves(), 40); }), ExitCode::kInterrupted);
  Progress::clear_interrupt();
}

TEST(Limits, StepsThatDoNotFit16BitsAreRefused) {
  const TerrainSource tall = from_heights(2, 1, {0, 3000}), solid = caves();
  EXPECT_EQ(code_of([&] { build("layered_stack", tall, 0, 0.01); }), ExitCode::kUsage);
  EXPECT_EQ(code_of([&] { build("layered_stack", solid, 10, 1e-6); }), ExitCode::kUsage);
  EXPECT_NO_THROW(build("layered_stack", from_heights(2, 1, {0, 1e9F}), 0, 1e6));
  EXPECT_EQ(code_of([&] { with(representation("layered_stack"), -1); }), ExitCode::kUsage);
  EXPECT_EQ(code_of([&] { with(representation("layered_stack"), 70000); }), ExitCode::kUsage);
  EXPECT_EQ(code_of([&] { with(representation("layered_stack"), 1, std::nan("")); }), ExitCode::kUsage);
}

TEST(Limits, AGridThatDoesNotFitTheMemoryIsRefused) {
  EXPECT_EQ(code_of([] { build("dense_voxel", caves(), 60000); }), ExitCode::kEnvironment);
}

TEST(Limits, TheTallestColumnKeepsAllItsLevels) {
  const auto rock = [](float, float y, float) {
    return static_cast<int>(y) % 2 == 0 ? Material::kBedrock : Material::kAir;
  };
  const TerrainSource source = from_predicate({{0, 0, 0}, {1, 65535, 1}}, rock);
  const auto built = build("layered_stack", source, 65535);
  const std::vector<float> at{0.5F};
  EXPECT_EQ(spans_of(*built, {at, at}).all().size(), 32768U);
  const auto copy = reloaded("layered_stack", *built);
  EXPECT_EQ(copy->memory().total(), built->memory().total());
}

TEST(Registry, NamesTypesAndSuggestsTheNearest) {
  EXPECT_EQ(representation("voxel").name, "voxel");
  const Failure failure = failure_of([] { representation("layered_stak"); });
  EXPECT_NE((failure.what + failure.advice).find("layered_stack"), std::string::npos);
  for (const RepresentationType& type : representations()) {
    EXPECT_FALSE(type.summary.empty());
    EXPECT_FALSE(type.paper.empty());
    EXPECT_TRUE(Parameters(type.parameters).has("resolution"));
  }
}

TEST(Runs, EndWhereTheMaterialChanges) {
  std::mt19937 random(1);
  for (int round = 0; round < 300; ++round) {
    std::vector<Material> column(1 + random() % 70, Material{3});
    const std::size_t begin = random() % column.size(), end = begin + 1 + random() % (column.size() - begin);
    if (end < column.size()) column[end] = Material{static_cast<std::uint8_t>(random() % 2 == 0 ? 0 : 255)};
    EXPECT_EQ(run_end(column, begin), end);
  }
}

}  // namespace
}  // namespace terrabench::test
