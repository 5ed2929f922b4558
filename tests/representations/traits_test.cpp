// What a type's line in the registry says that it can do, it can do.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "representations/layered_stack/thermal_erosion.h"
#include "representations/ray_cast.h"
#include "terrain/error.h"
#include "terrain/progress.h"
#include "tests/representations/ground.h"

namespace terrabench::test {
namespace {

class Traits : public testing::TestWithParam<std::string_view> {
 protected:
  Traits() {
    std::vector<float> heights(17 * 17, 0.0F);
    heights[144] = 20;  // a spike, which slides
    built_ = type_.build(from_heights(17, 17, heights), Parameters(type_.parameters), progress_);
  }

  Progress progress_;
  const RepresentationType& type_ = representation(GetParam());
  std::unique_ptr<Representation> built_;
};

TEST_P(Traits, SayWhetherRaysNeedAMesh) { EXPECT_EQ(built_->ray_caster() != nullptr, type_.traits.rays); }

TEST_P(Traits, SayWhetherItErodes) {
  if (type_.traits.erodes) {
    EXPECT_GT(built_->erode_to(40, progress_).columns, 0U);
  } else {
    EXPECT_THROW(built_->erode_to(40, progress_), Error);
  }
}

TEST_P(Traits, SayWhetherItTakesEdits) {
  const float x = 8, z = 8;
  const Span air{1, 30, Material::kAir};
  if (type_.traits.editable) {
    EXPECT_NO_THROW(built_->edit({{&x, 1}, {&z, 1}}, {&air, 1}));
  } else {
    EXPECT_THROW(built_->edit({{&x, 1}, {&z, 1}}, {&air, 1}), Error);
  }
}

std::vector<std::string_view> names() {
  std::vector<std::string_view> all;
  for (const RepresentationType& type : representations()) all.push_back(type.name);
  return all;
}
INSTANTIATE_TEST_SUITE_P(EachType, Traits, testing::ValuesIn(names()),
                         [](const auto& at) { return std::string(at.param); });

TEST(Registry, RefusesANameThatIsTaken) {
  const RepresentationType again = representations()[0];
  EXPECT_THROW(add_representation(again), Error);
}

TEST(Registry, RefusesAFileKnobOfAParameterThatTheTypeLacks) {
  constexpr std::array kKnobs{FileKnob{"no_such_parameter", 0.1, 1}};
  RepresentationType lacking = representations()[0];
  lacking.name = "lacking";
  lacking.file_knobs = kKnobs;
  const std::size_t before = representations().size();
  try {
    add_representation(lacking);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kUsage);
    EXPECT_NE(std::string(error.what()).find("no_such_parameter"), std::string::npos);
  }
  EXPECT_EQ(representations().size(), before);
}

}  // namespace
}  // namespace terrabench::test
