// Unusual and invalid ground, views and knobs: every method in the registry refuses what is invalid, draws
// everything else correctly, and is unchanged after a refusal.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "lod/lod.h"
#include "lod/meters/cracks.h"
#include "tests/lod/drawing.h"
#include "tests/lod/variants.h"
#include "tests/terrain/errors.h"

namespace terrabench::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kLargest = std::numeric_limits<float>::max();

// The number of corners outside the ground's extent or its range of heights.
std::size_t outside(const std::vector<glm::vec3>& corners, const Heightfield& field) {
  const HeightRange range = height_range(field);
  return static_cast<std::size_t>(std::count_if(corners.begin(), corners.end(), [&](const glm::vec3& p) {
    return !(p.x >= 0 && p.x <= field.extent_x() && p.z >= 0 && p.z <= field.extent_z() &&
             p.y >= range.lowest && p.y <= range.highest);
  }));
}

template <class Call>
bool refused(const Call& call) {
  const Failure failure = failure_of(call);
  return failure.code == ExitCode::kUsage && !failure.advice.empty();
}

// An ordinary view across the ground, which the tests modify.
View across(const Heightfield& field) {
  View view;
  view.eye = {0.4F * field.extent_x(), 30, 0.7F * field.extent_z()};
  view.target = {0.5F * field.extent_x(), 0, 0.2F * field.extent_z()};
  view.far = 10 * (field.extent_x() + field.extent_z());
  return view;
}

struct Change {
  const char* what;
  std::function<void(View&)> apply;
};

const std::vector<Change>& legal() {
  static const std::vector<Change> kChanges = {
      {"under the ground", [](View& v) { v.eye.y = -5; }},
      {"far under the ground", [](View& v) { v.eye.y = -1e6F; }},
      {"on the ground's corner",
       [](View& v) {
         v.eye = {0, 1.8F, 0}, v.target = {1, 1.8F, 1};
       }},
      {"outside, looking in",
       [](View& v) {
         v.eye = {-500, 50, -700};
       }},
      {"outside, looking away",
       [](View& v) {
         v.eye = {-500, 50, 0}, v.target = {-900, 50, 0};
       }},
      {"a million metres off",
       [](View& v) {
         v.eye = {1e6F, 1e5F, -1e6F}, v.far = 1e7F;
       }},
      {"as good as infinitely far",
       [](View& v) {
         v.eye = {1e30F, 1e30F, -1e30F}, v.far = kLargest;
       }},
      {"where floats end", [](View& v) { v.eye = glm::vec3(-kLargest), v.target = glm::vec3(kLargest); }},
      {"so far that a pixel's worth of metres is no float",
       [](View& v) {
         v.eye = {-2.5e38F, 0, 0}, v.target = {0, 0, 0}, v.far = kLargest;
         v.width = v.height = 1;
       }},
      {"above, looking down", [](View& v) { v.eye.y = 1e4F, v.target = v.eye - glm::vec3(0.1F, 9, 0); }},
      {"looking up", [](View& v) { v.target = v.eye + glm::vec3(0.1F, 9, 0); }},
      {"upside down",
       [](View& v) {
         v.up = {0, -1, 0};
       }},
      {"one pixel", [](View& v) { v.width = v.height = 1; }},
      {"a line of pixels", [](View& v) { v.width = 100000, v.height = 1; }},
      {"through a pinhole", [](View& v) { v.vertical_fov = 1e-6F; }},
      {"nearly everything in view", [](View& v) { v.vertical_fov = 3.14159F; }},
      {"from nearly nothing to nearly infinity", [](View& v) { v.near = 1e-6F, v.far = 1e30F; }},
      {"a slice", [](View& v) { v.near = 100, v.far = 101; }},
  };
  return kChanges;
}

const std::vector<Change>& illegal() {
  static const std::vector<Change> kChanges = {
      {"an eye that is no number", [](View& v) { v.eye.x = kNan; }},
      {"an eye at infinity", [](View& v) { v.eye.y = kInfinity; }},
      {"an eye at minus infinity", [](View& v) { v.eye = glm::vec3(-kInfinity); }},
      {"a target that is no number", [](View& v) { v.target.z = kNan; }},
      {"a target at infinity", [](View& v) { v.target.x = kInfinity; }},
      {"looking nowhere", [](View& v) { v.target = v.eye; }},
      {"no way up", [](View& v) { v.up = glm::vec3(0); }},
      {"up along the sight", [](View& v) { v.target = v.eye - v.up; }},
      {"up that is no number", [](View& v) { v.up.x = kNan; }},
      {"no field of view", [](View& v) { v.vertical_fov = 0; }},
      {"a field of view below none", [](View& v) { v.vertical_fov = -1; }},
      {"half of all directions", [](View& v) { v.vertical_fov = std::numbers::pi_v<float>; }},
      {"a field of view that is no number", [](View& v) { v.vertical_fov = kNan; }},
      {"no columns", [](View& v) { v.width = 0; }},
      {"fewer rows than none", [](View& v) { v.height = -600; }},
      {"near at the eye", [](View& v) { v.near = 0; }},
      {"near that is no number", [](View& v) { v.near = kNan; }},
      {"far before near", [](View& v) { v.far = 0.5F * v.near; }},
      {"far at infinity", [](View& v) { v.far = kInfinity; }},
  };
  return kChanges;
}

class BadInput : public ::testing::TestWithParam<Variant> {
 protected:
  std::unique_ptr<Lod> build(const Heightfield& field) { return test::build(GetParam(), field, silent_); }
  const LodType& type_ = lod(GetParam().method);
  Progress silent_;
};

TEST_P(BadInput, GroundWithoutTrianglesOrWithHolesIsRefused) {
  for (const auto& [width, depth] : {std::pair{1, 1}, {1, 9}, {9, 1}}) {
    EXPECT_TRUE(refused([&, w = width, d = depth] { build(flat(w, d)); })) << width << " × " << depth;
  }
  Heightfield field = hilly(40, 30);
  field.at(39, 29) = Heightfield::kNoData;
  EXPECT_TRUE(refused([&] { build(field); }));
  EXPECT_TRUE(refused([&] { build(flat(40, 30, Heightfield::kNoData)); }));
  EXPECT_NO_THROW(build(fill_no_data(field))->update(across(field)));
}

TEST_P(BadInput, GroundOfAnySizeIsDrawnOnce) {
  for (const auto& [width, depth] : {std::pair{2, 2},
                                     {2, 9},
                                     {9, 2},
                                     {3, 3},
                                     {5, 4},
                                     {17, 33},
                                     {100, 37},
                                     {129, 129},
                                     {130, 127},
                                     {3, 700},
                                     {403, 344}}) {
    Heightfield field = hilly(width, depth, 0.4F);
    field.cell_x = 2;
    field.cell_z = 3;
    const std::vector<glm::vec3> corners = corners_of(build(field)->update(from_above(field)));
    EXPECT_EQ(outside(corners, field), 0U) << width << " × " << depth;
    EXPECT_DOUBLE_EQ(plan_area(corners), plan_area(field)) << width << " × " << depth;
  }
}

TEST_P(BadInput, LegalViewsOfAnyKindAreDrawnWithoutCracks) {
  const Heightfield field = hilly(150, 121, 0.4F);
  const std::unique_ptr<Lod> lod = build(field);
  const bool promises_no_cracks =
      type_.traits.conforming &&
      fmt::format("{}={}", GetParam().parameter, GetParam().value) != type_.unstitched;
  for (const double knob : {type_.knob.finest, type_.knob.fallback, type_.knob.coarsest}) {
    lod->tune(knob);
    for (const Change& change : legal()) {
      SCOPED_TRACE(fmt::format("{}, {} {}", change.what, type_.knob.name, knob));
      View view = across(field);
      change.apply(view);
      const Frame& frame = lod->update(view);
      EXPECT_EQ(outside(corners_of(frame), field), 0U);
      EXPECT_TRUE(!promises_no_cracks || find_cracks(frame, field.width, field.depth, view).tight());
    }
  }
}

TEST_P(BadInput, IllegalViewsAreRefusedAndForgotten) {
  const Heightfield field = hilly(150, 121, 0.4F);
  const std::unique_ptr<Lod> tried = build(field), spared = build(field);
  for (std::size_t k = 0; k < illegal().size(); ++k) {
    SCOPED_TRACE(illegal()[k].what);
    View view = across(field);
    view.eye.x += static_cast<float>(k);
    View bad = view;
    illegal()[k].apply(bad);
    EXPECT_TRUE(refused([&] { tried->update(bad); }));
    EXPECT_EQ(corners_of(tried->update(view)), corners_of(spared->update(view)));
  }
}

TEST_P(BadInput, TheKnobTakesItsRangeAlone) {
  const Heightfield field = hilly(150, 121, 0.4F);
  const Knob& knob = type_.knob;
  const std::unique_ptr<Lod> lod = build(field);
  const auto drawn_with = [&](double value) {
    lod->tune(value);
    return lod->update(across(field)).stats.triangles;
  };
  const std::size_t finest = drawn_with(knob.finest), fallback = drawn_with(knob.fallback),
                    coarsest = drawn_with(knob.coarsest);
  EXPECT_GE(finest, fallback);
  EXPECT_GE(fallback, coarsest);
  const double sign = knob.finest < knob.coarsest ? 1 : -1;
  for (const double beyond : {1.0, 1e10, 1e300, double{kInfinity}}) {
    EXPECT_EQ(drawn_with(knob.finest - sign * beyond), finest) << beyond;
    EXPECT_EQ(drawn_with(knob.coarsest + sign * beyond), coarsest) << beyond;
  }
  EXPECT_TRUE(refused([&] { lod->tune(kNan); }));
  EXPECT_EQ(lod->update(across(field)).stats.triangles, coarsest);
}

TEST_P(BadInput, HeightsBeyondAnyMountainStayFinite) {
  Heightfield field = hilly(60, 60);
  field.at(20, 20) = 1e30F;
  field.at(21, 20) = -1e30F;
  const std::unique_ptr<Lod> lod = build(field);
  EXPECT_EQ(outside(corners_of(lod->update(across(field))), field), 0U);
  EXPECT_EQ(outside(corners_of(lod->update(from_above(field))), field), 0U);
}

INSTANTIATE_TEST_SUITE_P(EachMethod, BadInput, ::testing::ValuesIn(variants()), name_of);

}  // namespace
}  // namespace terrabench::test
