// The representation as a whole, and parameters for a budget.
#include "representations/drill/drill_terrain.h"

#include "representations/drill/choose_parameters.h"
#include "representations/drill/drill_codec.h"
#include "representations/drill/extract.h"
#include "representations/drill/quantum.h"
#include "representations/drill/regenerate.h"
#include "tests/representations/drill_ground.h"
#include "tests/representations/ground.h"
#include "tests/terrain/errors.h"

namespace terrabench::test {
namespace {

std::unique_ptr<Representation> drilled(const Heightfield& field,
                                        const std::vector<std::pair<std::string_view, Value>>& values) {
  Parameters parameters(DrillTerrain::parameters());
  for (const auto& [name, value] : values) parameters.set(name, value);
  Progress progress;
  return DrillTerrain::build(source_of("hills", field), parameters, progress);
}

double rmse(const Heightfield& a, const Heightfield& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.heights.size(); ++i) {
    sum += std::pow(static_cast<double>(a.heights[i]) - b.heights[i], 2);
  }
  return std::sqrt(sum / static_cast<double>(a.heights.size()));
}

TEST(DrillTerrain, AnswersWithTheRegeneratedHeights) {
  const Heightfield field = hills(50, 40, 2, false, 2);
  const auto built = drilled(field, {{"tau", std::int64_t{10}}, {"k", std::int64_t{8}}});
  const Heightfield expected = regenerate(dynamic_cast<const DrillTerrain&>(*built).drills());
  SpanSink sink;
  for (int j = 0; j < field.depth; ++j) {
    for (int i = 0; i < field.width; ++i) {
      const float x = static_cast<float>(i) * field.cell_x, z = static_cast<float>(j) * field.cell_z;
      sink.clear();
      built->spans({std::span(&x, 1), std::span(&z, 1)}, sink);
      if (std::isnan(expected.at(i, j))) {
        EXPECT_TRUE(sink.column(0).empty());
      } else {
        ASSERT_EQ(sink.column(0).size(), 1U);
        EXPECT_EQ(sink.column(0)[0].top, expected.at(i, j));
        EXPECT_EQ(sink.column(0)[0].bottom, built->bounds().low.y);
      }
    }
  }
}

TEST(DrillTerrain, MeshIsWatertightEvenWhereShapesDigThroughTheFloor) {
  const Heightfield field = hills(60, 50, 7, false, 1);
  for (const char* const fit : {"monotone", "printed", "vertex"}) {
    const auto built =
        drilled(field, {{"fit", std::string(fit)}, {"k", std::int64_t{30}}, {"w", std::int64_t{4}}});
    const TriangleMesh mesh = built->mesh({});
    EXPECT_TRUE(check_edges(mesh).watertight());
    EXPECT_GT(volume(mesh), 0);
    for (const glm::vec3& p : mesh.positions) {
      ASSERT_GE(p.y, built->bounds().low.y);
      ASSERT_LE(p.y, built->bounds().high.y);
    }
  }
}

TEST(DrillTerrain, LoadsWhatItSavedAndCountsEveryByte) {
  const Heightfield field = hills(70, 60, 3, false, 1);
  reloaded("drill", *drilled(field, {}))->mesh({});  // thread pools and tables are made once
  const HeapScope scope;
  for (const bool all : {false, true}) {
    auto built =
        drilled(field, {{"adaptive_k", all}, {"interpolate_untouched", all}, {"monotone_profiles", all}});
    EXPECT_EQ(static_cast<std::int64_t>(built->memory().total()), scope.held());
    auto copy = reloaded("drill", *built);
    EXPECT_TRUE(dynamic_cast<DrillTerrain&>(*copy).drills() == dynamic_cast<DrillTerrain&>(*built).drills());
    const Lattice lattice(built->bounds(), 50, 50);
    EXPECT_TRUE(same_spans(spans_of(*copy, lattice.columns()), spans_of(*built, lattice.columns())));
    built.reset();
    EXPECT_EQ(static_cast<std::int64_t>(copy->memory().total()),
              scope.held() -
                  static_cast<std::int64_t>(heap_bytes(lattice.x.data()) + heap_bytes(lattice.z.data())));
  }
  EXPECT_EQ(scope.held(), 0);
}

TEST(DrillTerrain, WithoutChannelsIsAPlateau) {
  const Heightfield field = hills(30, 30, 1);
  const auto built = drilled(field, {{"tau", std::int64_t{100000}}});
  const float x = 50, z = 60;
  const SpanSink sink = spans_of(*built, {std::span(&x, 1), std::span(&z, 1)});
  EXPECT_EQ(sink.column(0)[0].top, height_range(field).highest);
}

TEST(DrillTerrain, OfFlatsSingleSamplesAndRows) {
  for (const Heightfield& field :
       {Heightfield{1, 1, 10, 10, {7}, {}}, Heightfield{40, 1, 10, 10, std::vector<float>(40, 3), {}},
        Heightfield{20, 20, 10, 10, std::vector<float>(400, -5), {}}}) {
    const auto built = drilled(field, {{"w", std::int64_t{1}}, {"tau", std::int64_t{1}}});
    const float at = 0;
    const SpanSink sink = spans_of(*built, {std::span(&at, 1), std::span(&at, 1)});
    ASSERT_EQ(sink.column(0).size(), 1U);
    EXPECT_EQ(sink.column(0)[0].top, field.heights[0]);
    reloaded("drill", *built);
  }
}

TEST(DrillTerrain, RefusesWhatItCannotUse) {
  const Heightfield field = hills(20, 20, 1);
  for (const auto& [name, value] :
       std::vector<std::pair<std::string_view, Value>>{{"tau", std::int64_t{0}},
                                                       {"tau", std::int64_t{-7}},
                                                       {"w", std::int64_t{0}},
                                                       {"w", std::int64_t{21}},
                                                       {"w", std::int64_t{100000}},
                                                       {"k", std::int64_t{-2}},
                                                       {"k", std::int64_t{256}},
                                                       {"quantum", -1.0},
                                                       {"max_rmse", -1.0}}) {
    EXPECT_EQ(failure_of([&] { drilled(field, {{name, value}}); }).code, ExitCode::kUsage) << name;
  }
  EXPECT_EQ(failure_of([&] {
              drilled(field, {{"budget_bytes", std::int64_t{500}}, {"max_rmse", 3.0}});
            }).code,
            ExitCode::kUsage);
  Heightfield far = field;
  far.heights[7] = 1e12F;
  EXPECT_EQ(failure_of([&] { drilled(far, {}); }).code, ExitCode::kBadInput);
  far.heights.assign(far.heights.size(), Heightfield::kNoData);
  EXPECT_EQ(failure_of([&] { drilled(far, {}); }).code, ExitCode::kBadInput);
}

TEST(Budget, IsKeptWhereItCanBe) {
  const Heightfield field = hills(96, 80, 4);
  const FlowNetwork network = route_flow(field);
  const auto check = [&](const DrillBudget& budget) {
    const DrillChoice choice = choose_parameters(field, network, budget, {});
    Drills drills = extract_drills(field, network, choice.options);
    quantise(drills, choice.quantum);
    ByteSink bytes;
    encode_drills(drills, bytes);
    EXPECT_EQ(bytes.bytes().size(), choice.bytes);
    EXPECT_NEAR(rmse(regenerate(drills), field), choice.rmse, 1e-9);
    return choice;
  };
  double before = std::numeric_limits<double>::infinity();
  for (const std::size_t bytes : {500U, 1000U, 3000U}) {
    const DrillChoice choice = check({bytes, 0});
    EXPECT_TRUE(choice.within_budget);
    EXPECT_LE(choice.bytes, bytes);
    EXPECT_LE(choice.rmse, before);
    before = choice.rmse;
  }
  const DrillChoice near = check({0, before * 2});
  EXPECT_TRUE(near.within_budget);
  EXPECT_LE(near.rmse, before * 2);
  EXPECT_LE(near.bytes, 3000U);
  EXPECT_FALSE(check({0, 1e-6}).within_budget);
  EXPECT_FALSE(check({1, 0}).within_budget);
}

TEST(Budget, ThatCannotBeKeptIsRefused) {
  const Heightfield field = hills(48, 40, 4);
  for (const auto& [name, value] : std::vector<std::pair<std::string_view, Value>>{
           {"budget_bytes", std::int64_t{1}}, {"max_rmse", 1e-6}}) {
    const Failure failure = failure_of([&] { drilled(field, {{name, value}}); });
    EXPECT_EQ(failure.code, ExitCode::kUsage) << name;
    EXPECT_NE(failure.what.find("the nearest take"), std::string::npos) << failure.what;
  }
}

TEST(Budget, OfTheSmallestTerrains) {
  for (const int size : {1, 2, 3}) {
    Heightfield field{size, size, 10, 10, std::vector<float>(static_cast<std::size_t>(size * size), 3), {}};
    field.heights[0] = 1;
    const DrillChoice choice = choose_parameters(field, route_flow(field), {1000, 0}, {});
    EXPECT_TRUE(choice.within_budget);
    EXPECT_LE(choice.options.w, size);
    EXPECT_EQ(choice.options.tau, 6U);  // the first candidate: no flow reaches any
  }
}

TEST(Budget, ReachesTheRepresentation) {
  const Heightfield field = hills(96, 80, 4);
  ByteSink small, large;
  drilled(field, {{"budget_bytes", std::int64_t{800}}})->save(small);
  drilled(field, {{"max_rmse", 12.0}})->save(large);
  EXPECT_LT(small.bytes().size(), 800U + 80);  // and the header
  EXPECT_GT(large.bytes().size(), small.bytes().size());
}

}  // namespace
}  // namespace terrabench::test
