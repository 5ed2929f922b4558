// A structure's memory() is what operator new gave it.
#include "representations/layered_stack/layered_stack.h"
#include "tests/representations/ground.h"

namespace terrabench::test {
namespace {

class Counted : public testing::TestWithParam<std::string_view> {};
INSTANTIATE_TEST_SUITE_P(Types, Counted, testing::ValuesIn(types()),
                         [](const auto& at) { return std::string(at.param); });

TEST_P(Counted, AfterBuildEditLoadAndDestruction) {
  const TerrainSource source = random_boxes(21, 60, 40, 3),
                      ground = from_heights(40, 30, std::vector<float>(1200, 7.0F));
  build(GetParam(), source, 2)->mesh({});  // thread pools and tables are made once
  const HeapScope scope;
  for (const TerrainSource* from : {&source, &ground}) {
    auto built = build(GetParam(), *from, 60);
    EXPECT_EQ(static_cast<std::int64_t>(built->memory().total()), scope.held());
    if (representation(GetParam()).traits.editable) {
      const Bounds bounds = built->bounds();
      std::mt19937 random(3);
      std::uniform_real_distribution<float> unit(0, 1);
      for (int s = 0; s < 2000; ++s) {
        const float a = unit(random), b = unit(random), x = bounds.low.x + unit(random) * bounds.size().x,
                    z = bounds.low.z + unit(random) * bounds.size().z;
        const Span span = {bounds.low.y + std::min(a, b) * bounds.size().y,
                           bounds.low.y + (std::max(a, b) + 0.01F) * bounds.size().y,
                           static_cast<Material>(random() % 5)};
        built->edit({std::span(&x, 1), std::span(&z, 1)}, std::span(&span, 1));
      }
    }
    EXPECT_EQ(static_cast<std::int64_t>(built->memory().total()), scope.held());
    auto copy = reloaded(GetParam(), *built);
    built.reset();
    EXPECT_EQ(static_cast<std::int64_t>(copy->memory().total()), scope.held());
    copy.reset();
    EXPECT_EQ(scope.held(), 0);
  }
}

TEST(StackMemory, CaveTerrainTakesLessThanThePapers24BytesAColumn) {
  for (const int n : {128, 256, 512}) {
    build("layered_stack", caves(), 2);
    const HeapScope scope;
    const auto built = build("layered_stack", caves(), n);
    const auto& stack = dynamic_cast<const LayeredStack&>(*built);
    const double columns = static_cast<double>(n) * n, bytes = static_cast<double>(scope.held()) / columns;
    const double runs = static_cast<double>(stack.runs()) / columns;
    EXPECT_GT(runs, 3);  // or it would be no cave terrain
    EXPECT_LT(runs, 7);
    EXPECT_LT(bytes, 24);
    EXPECT_LT(bytes, 2 + 3 * runs + 0.4);  // the layout and next to nothing else
    RecordProperty("bytes_per_column_" + std::to_string(n), std::to_string(bytes));
  }
}

TEST(DenseMemory, IsAByteAVoxel) {
  EXPECT_EQ(build("dense_voxel", caves(), 64)->memory().payload, 64U * 64 * 64);
}

}  // namespace
}  // namespace terrabench::test
