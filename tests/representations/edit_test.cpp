// Edits, against a model that is too simple to be wrong: one byte per voxel.
#include "representations/column_grid.h"
#include "representations/layered_stack/layered_stack.h"
#include "terrain/error.h"
#include "tests/representations/ground.h"

namespace terrabench::test {
namespace {

// Types that return single cells as they were set; an editable surface that rounds them has tests of its own.
class Edited : public testing::TestWithParam<std::string_view> {};
INSTANTIATE_TEST_SUITE_P(Types, Edited,
                         testing::ValuesIn(types([](const Traits& t) { return t.editable && t.materials; })),
                         [](const auto& at) { return std::string(at.param); });

TEST_P(Edited, ManyRandomStrokesEqualTheModel) {
  constexpr int kWidth = 21, kLevels = 26, kDepth = 18;
  const TerrainSource source = random_cells(7, kWidth, kLevels, kDepth, 2, 40);
  const auto built = build(GetParam(), source, kLevels);
  const Bounds bounds = built->bounds();
  std::vector<std::uint8_t> model(kWidth * kLevels * kDepth);
  const auto voxel = [&](int i, int level, int j) -> std::uint8_t& {
    return model[static_cast<std::size_t>((j * kWidth + i) * kLevels + level)];
  };
  std::vector<float> x, y, z;
  for (int j = 0; j < kDepth; ++j) {
    for (int i = 0; i < kWidth; ++i) {
      for (int level = 0; level < kLevels; ++level) {
        x.push_back(bounds.low.x + static_cast<float>(i) + 0.5F);
        y.push_back(bounds.low.y + static_cast<float>(level) + 0.5F);
        z.push_back(bounds.low.z + static_cast<float>(j) + 0.5F);
      }
    }
  }
  std::vector<Material> got(model.size());
  built->materials({x, y, z}, got);
  for (std::size_t v = 0; v < model.size(); ++v) model[v] = static_cast<std::uint8_t>(got[v]);

  std::mt19937 random(11);
  std::uniform_real_distribution<float> unit(-0.1F, 1.1F);
  for (int round = 0; round < 60; ++round) {
    std::vector<float> stroke_x, stroke_z;
    std::vector<Span> strokes;
    for (unsigned s = 0; s < 1 + random() % 100; ++s) {  // 3000 strokes in all
      const float a = bounds.low.y + unit(random) * kLevels, b = bounds.low.y + unit(random) * kLevels;
      if (a == b) continue;
      stroke_x.push_back(bounds.low.x + unit(random) * kWidth);
      stroke_z.push_back(bounds.low.z + unit(random) * kDepth);
      strokes.push_back({std::min(a, b), std::max(a, b), static_cast<Material>(random() % 4)});
      const float i = stroke_x.back() - bounds.low.x, j = stroke_z.back() - bounds.low.z;
      if (i < 0 || i > kWidth || j < 0 || j > kDepth) continue;
      for (int level = 0; level < kLevels; ++level) {
        const float centre = bounds.low.y + static_cast<float>(level) + 0.5F;
        if (centre < strokes.back().bottom || centre >= strokes.back().top) continue;
        voxel(std::min(static_cast<int>(i), kWidth - 1), level, std::min(static_cast<int>(j), kDepth - 1)) =
            static_cast<std::uint8_t>(strokes.back().material);
      }
    }
    built->edit({stroke_x, stroke_z}, strokes);
    built->materials({x, y, z}, got);
    for (std::size_t v = 0; v < model.size(); ++v)
      ASSERT_EQ(static_cast<std::uint8_t>(got[v]), model[v]) << "round " << round;
  }
  const auto copy = reloaded(GetParam(), *built);
  copy->materials({x, y, z}, got);
  for (std::size_t v = 0; v < model.size(); ++v) ASSERT_EQ(static_cast<std::uint8_t>(got[v]), model[v]);
}

TEST_P(Edited, StrokesThatCannotBeChangeNothing) {
  const auto built = build(GetParam(), random_boxes(1, 10, 20, 1), 10);
  const std::vector<std::byte> before = saved(*built);
  const std::vector<float> x{1, 2}, z{1, 2};
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const Span& wrong : {Span{5, 5, Material::kAir}, Span{6, 5, Material::kBedrock},
                            Span{nan, 5, Material::kAir}, Span{1, nan, Material::kAir}}) {
    const std::vector<Span> strokes{{0, 10, Material::kBedrock}, wrong};
    EXPECT_THROW(built->edit({x, z}, strokes), Error);
  }
  EXPECT_THROW(built->edit({x, z}, std::vector<Span>{{0, 10, Material::kBedrock}}), Error);
  built->edit({std::vector<float>{nan, -100}, std::vector<float>{1, 1}},
              std::vector<Span>{{0, 10, Material::kBedrock}, {0, 10, Material::kBedrock}});
  EXPECT_EQ(saved(*built), before);
}

TEST_P(Edited, InfiniteSpansReachTheBounds) {
  const auto built = build(GetParam(), random_boxes(1, 10, 20, 1), 10);
  const float infinity = std::numeric_limits<float>::infinity();
  const std::vector<float> x{3.5F}, z{4.5F};
  built->edit({x, z}, std::vector<Span>{{-infinity, infinity, Material{9}}});
  const SpanSink sink = spans_of(*built, {x, z});
  ASSERT_EQ(sink.column(0).size(), 1U);
  EXPECT_EQ(sink.column(0)[0], (Span{0, 10, Material{9}}));
}

TEST(Edit, UndoneEditsLeaveTheStackAsItWas) {  // canonical runs: the same content is the same bytes
  Progress progress;
  const TerrainSource source = caves();
  const Parameters parameters = with(representation("layered_stack"), 40);
  const auto stack = LayeredStack::build_stack(source, parameters, progress);
  const auto untouched = LayeredStack::build_stack(source, parameters, progress);
  const Lattice lattice(stack->bounds(), 40, 40);
  const SpanSink before = spans_of(*stack, lattice.columns());
  stack->edit(lattice.columns(), std::vector<Span>(1600, Span{0.2F, 0.9F, Material{3}}));
  EXPECT_FALSE(*stack == *untouched);
  stack->edit(lattice.columns(), std::vector<Span>(1600, Span{0, 1, Material::kAir}));
  for (std::size_t c = 0; c < before.columns(); ++c) {
    const std::vector<float> x(before.column(c).size(), lattice.x[c]),
        z(before.column(c).size(), lattice.z[c]);
    stack->edit({x, z}, before.column(c));
  }
  EXPECT_TRUE(*stack == *untouched);
  EXPECT_EQ(stack->memory().total(), untouched->memory().total());
}

// One edit at a time changes a tile in its block, several at once write it anew. From many runs to one per
// column, so that the tile's starts become narrower on the way.
TEST(Edit, OneByOneGivesTheSameStacksAsAllAtOnce) {
  constexpr int kSide = 16, kLevels = 600;
  Progress progress;
  const TerrainSource source = random_cells(3, kSide, kLevels, kSide, 2, 50);
  const auto built = [&] {
    return LayeredStack::build_stack(source, with(representation("layered_stack"), kLevels), progress);
  };
  const auto one_by_one = built(), at_once = built();
  const Bounds bounds = at_once->bounds();
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<float> x, z;
  std::vector<Span> strokes;
  for (int s = 0; s < 8000; ++s) {
    const float a = unit(random) * kLevels, b = unit(random) * (s < 4000 ? 8 : kLevels);
    x.push_back(bounds.low.x + unit(random) * kSide);
    z.push_back(bounds.low.z + unit(random) * kSide);
    strokes.push_back({bounds.low.y + a, bounds.low.y + a + 1 + b, static_cast<Material>(random() % 3)});
    one_by_one->edit({std::span(&x.back(), 1), std::span(&z.back(), 1)}, std::span(&strokes.back(), 1));
  }
  EXPECT_GT(at_once->runs(), 65535U);
  at_once->edit({x, z}, strokes);
  EXPECT_LT(at_once->runs(), 65535U);
  EXPECT_TRUE(*one_by_one == *at_once);
  EXPECT_EQ(one_by_one->memory().total(), at_once->memory().total());
}

// Full leaves become parts of larger nodes once there were as many edits as leaves; until then they stay.
TEST(Edit, ManyEditsOfOpenVdbVoxelsGiveTheirLeavesBack) {
  constexpr int kSide = 64;
  const auto cells = [](unsigned percent) {
    return build("voxel", random_cells(5, kSide, kSide, kSide, 1, percent), kSide);
  };
  const auto built = cells(50);
  const Bounds bounds = built->bounds();
  const Lattice lattice(bounds, kSide, kSide);
  const std::vector<Span> all(lattice.x.size(), {bounds.low.y, bounds.high.y, Material{1}});
  built->edit(lattice.columns(), all);
  EXPECT_EQ(built->memory().total(), cells(100)->memory().total()) << "one solid box";
}

}  // namespace
}  // namespace terrabench::test
