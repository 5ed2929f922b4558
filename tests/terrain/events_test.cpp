// What each event does to grounds simple enough to work out by hand, and which events are refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/terrain/errors.h"
#include "tests/terrain/events_ground.h"

namespace terrabench::events {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr double kNear = 1e-5;  // heights are floats

void expect_column(const Evaluation& e, double x, double z, const std::vector<Stretch>& expected) {
  const std::vector<Stretch> solid = column(e, x, z);
  ASSERT_EQ(solid.size(), expected.size()) << "at " << x << ", " << z;
  for (std::size_t i = 0; i < solid.size(); ++i) {
    EXPECT_NEAR(solid[i].top, expected[i].top, kNear) << "at " << x << ", " << z;
    if (i + 1 < solid.size()) {
      EXPECT_NEAR(solid[i].bottom, expected[i].bottom, kNear) << "at " << x << ", " << z;
    } else {
      EXPECT_EQ(solid[i].bottom, -HUGE_VAL);
    }
  }
}

TEST(Events, LinearErosionIsARoofUpsideDown) {
  const LinearErosion trench{{20, 32}, {44, 32}, 3, 45};  // W = 3
  const Evaluation e = after(flat(), {trench});
  EXPECT_NEAR(height(e, 32, 32), 17, kNear);
  EXPECT_NEAR(height(e, 32, 33), 18, kNear);
  EXPECT_NEAR(height(e, 32, 31), 18, kNear);
  EXPECT_NEAR(height(e, 20, 32), 17, kNear);      // the bottom edge ends here,
  EXPECT_NEAR(height(e, 18.5, 32), 18.5, kNear);  // and the end plane rises
  EXPECT_NEAR(height(e, 45, 32.5), 18, kNear);
  EXPECT_NEAR(height(e, 45, 34), 19, kNear);
  EXPECT_NEAR(height(e, 32, 35), 20, kNear);
  EXPECT_NEAR(height(e, 48, 32), 20, kNear);
  // The relief stays on the planes.
  EXPECT_NEAR(height(after(rising_east(), {trench}), 32, 33), 20 + 8 - 2, kNear);
}

TEST(Events, LinearErosionFollowsItsLine) {
  // 3-4-5: 5 m along, at 2.5 m across the drop is half the depth.
  const Evaluation e = after(flat(), {LinearErosion{{20, 20}, {32, 36}, 5, 45}});
  EXPECT_NEAR(height(e, 26, 28), 15, kNear);
  EXPECT_NEAR(height(e, 26 + 2, 28 - 1.5), 17.5, kNear);
  EXPECT_NEAR(height(e, 26 - 4, 28 + 3), 20, kNear);
}

TEST(Events, RadialErosionTakesTheGroundAboveHalfAnEllipsoid) {
  const Evaluation e = after(flat(), {RadialErosion{{32, 20, 32}, {8, 4, 6}}});
  EXPECT_NEAR(height(e, 32, 32), 16, kNear);
  EXPECT_NEAR(height(e, 36.8, 32), 16.8, kNear);  // 0.6 of the radius
  EXPECT_NEAR(height(e, 32, 36.8), 17.6, kNear);  // 0.8 of the radius
  EXPECT_NEAR(height(e, 32, 38.5), 20, kNear);
  EXPECT_NEAR(height(e, 41, 32), 20, kNear);
  // Ground under the ellipsoid stays, ground above its centre goes.
  EXPECT_NEAR(height(after(flat(), {RadialErosion{{32, 25, 32}, {8, 4, 6}}}), 32, 32), 20, kNear);
  EXPECT_NEAR(height(after(flat(), {RadialErosion{{32, 12, 32}, {8, 4, 6}}}), 36.8, 32), 8.8, kNear);
}

TEST(Events, NormalFaultParts) {
  const DipFault fault{false, {16, 32}, {48, 32}, 8, 2, 45};  // offset 2; left is north
  const Evaluation e = after(flat(), {fault});
  EXPECT_NEAR(height(e, 32, 31), 21, kNear);  // the upper lip
  EXPECT_NEAR(height(e, 32, 33), 19, kNear);  // the lower one
  EXPECT_NEAR(height(e, 32, 32), 20, kNear);  // the scarp between
  EXPECT_NEAR(height(e, 32, 31.5), 20.5, kNear);
  EXPECT_NEAR(height(e, 32, 27.5), 20.5, kNear);  // d' = 4.5 was d = 4
  EXPECT_NEAR(height(e, 32, 36.5), 19.5, kNear);
  EXPECT_NEAR(height(e, 32, 24), 20, kNear);
  EXPECT_NEAR(height(e, 32, 40), 20, kNear);
  EXPECT_NEAR(height(e, 15.9, 31), 20, kNear);  // past the end, a cliff from
  EXPECT_NEAR(height(e, 16.1, 31), 21, kNear);
  // The relief moves with the blocks: at d = 4 it was 22.
  EXPECT_NEAR(height(after(rising_north(), {fault}), 32, 27.5), 22.5, kNear);
  EXPECT_NEAR(height(after(rising_north(), {fault}), 32, 36.5), 17.5, kNear);
}

TEST(Events, InverseFaultHangsOver) {
  const Evaluation e = after(flat(), {DipFault{true, {16, 32}, {48, 32}, 8, 4, 45}});  // offset 4
  expect_column(e, 32, 32, {{20, 21.6}, {0, 18.4}});
  expect_column(e, 32, 31, {{19, 21.4}, {0, 18.2}});
  expect_column(e, 32, 33, {{21, 21.8}, {0, 18.6}});
  EXPECT_NEAR(height(e, 32, 29), 21, kNear);
  EXPECT_NEAR(height(e, 32, 35), 19, kNear);
  EXPECT_NEAR(height(e, 32, 24), 20, kNear);
  EXPECT_NEAR(height(e, 48.1, 32), 20, kNear);
}

TEST(Events, InverseFaultOnGroundSteeperThanItsScarpFolds) {
  const Heightfield rising_south = ground_of([](double, double z) { return 20 + 2 * (z - 32); });
  const Evaluation e = after(rising_south, {DipFault{true, {16, 32}, {48, 32}, 8, 4, 60}});
  // offset 4/√3; at d' = 0 each block's ground was d = (o/2)/(1 + o/16) away.
  const double half = 2 / std::sqrt(3.0), d = half / (1 + half / 8);
  const double left = 20 - 2 * d + 2 * (1 - d / 8), right = 20 + 2 * d - 2 * (1 - d / 8);
  ASSERT_GT(right, 20);
  expect_column(e, 32, 32, {{20, right}, {0, left}});  // the scarp, at 20, faces down into the right block
}

TEST(Events, LateralFaultSlidesBlocksApart) {
  const Evaluation e = after(rising_east(), {LateralFault{{16, 32}, {48, 32}, 8, 4}});
  EXPECT_NEAR(height(e, 32, 28), 20 + 0.25 * 31, kNear);  // left goes forwards by half of 2
  EXPECT_NEAR(height(e, 32, 36), 20 + 0.25 * 33, kNear);
  EXPECT_NEAR(height(e, 32, 31.999), 20 + 0.25 * 30, 1e-3);
  EXPECT_NEAR(height(e, 32, 24), 20 + 0.25 * 32, kNear);
  EXPECT_NEAR(height(e, 15, 31), 20 + 0.25 * 15, kNear);
  EXPECT_NEAR(height(e, 16, 32), 20 + 0.25 * 14, kNear);  // from beyond the end
}

TEST(Events, TunnelRunsThroughTheRidge) {
  Carving tunnel = square_tunnel({20, 15, 32}, {44, 15, 32});
  const Evaluation e = after(ridge(), {tunnel});
  expect_column(e, 32, 32, {{17, 30}, {0, 13}});
  expect_column(e, 32, 33.9, {{17, 30}, {0, 13}});
  EXPECT_NEAR(height(e, 32, 34.1), 30, kNear);
  EXPECT_NEAR(height(e, 32, 29.9), 30, kNear);
  EXPECT_NEAR(height(e, 47, 32), 13, kNear);  // the mouth: ground 16, under the roof
  EXPECT_NEAR(height(e, 47, 35), 16, kNear);
  EXPECT_NEAR(height(e, 17, 32), 13, kNear);
  EXPECT_NEAR(height(e, 52, 32), 10, kNear);
  // Narrower towards the end, rising one in twelve.
  tunnel.scale_to = 0.5;
  tunnel.to.y = 17;
  expect_column(after(ridge(), {tunnel}), 32, 32, {{17.5, 30}, {0, 14.5}});
  EXPECT_NEAR(height(after(ridge(), {tunnel}), 32, 33.6), 30, kNear);
}

TEST(Events, TunnelOfAnotherSectionShowsIt) {
  Carving tunnel = square_tunnel({20, 15, 32}, {44, 15, 32});
  tunnel.section = {{-2, -2}, {2, -2}, {0, 2}};
  expect_column(after(ridge(), {tunnel}), 32, 33, {{15, 30}, {0, 13}});
  // a is to the right: south when walking east. A section that leans right.
  tunnel.section = {{0, -2}, {2, -2}, {2, 2}};
  expect_column(after(ridge(), {tunnel}), 32, 33.5, {{16, 30}, {0, 13}});
  EXPECT_NEAR(height(after(ridge(), {tunnel}), 32, 31), 30, kNear);
  // Not convex: two openings over one another.
  tunnel.section = {{-2, -2}, {2, -2}, {-1, 0}, {2, 2}, {-2, 2}};
  expect_column(after(ridge(), {tunnel}), 32, 32.5, {{17, 30}, {14, 16}, {0, 13}});
}

TEST(Events, CaveEndsInside) {
  Carving cave = square_tunnel({20, 15, 32}, {32, 15, 32});
  cave.cave = true;
  const Evaluation e = after(ridge(), {cave});
  expect_column(e, 31.9, 32, {{17, 30}, {0, 13}});
  EXPECT_NEAR(height(e, 32.1, 32), 30, kNear);
  EXPECT_NEAR(height(e, 17, 32), 13, kNear);
  EXPECT_NEAR(height(e, 47, 32), 16, kNear);
}

TEST(Events, WallsBulgeSmoothlyAndNotAtTheCorners) {
  Carving tunnel = square_tunnel({20, 15, 32}, {44, 15, 32});
  tunnel.roughness = 0.25;
  tunnel.seed = 3;
  double most = 0, steepest = 0, before = tunnel.bulge(1, 0, 0.5);
  for (double u = -4; u < 30; u += 0.01) {
    for (const double across : {0.0, 0.1, 0.5, 1.0}) {
      const double bulge = tunnel.bulge(2, u, across);
      most = std::max(most, std::abs(bulge));
      if (across == 0 || across == 1) {
        EXPECT_EQ(bulge, 0);
      }
    }
    if (u >= 0) {
      const double bulge = tunnel.bulge(1, u, 0.5);
      steepest = std::max(steepest, std::abs(bulge - before) / 0.01);
      before = bulge;
    }
  }
  EXPECT_LE(most, 0.25);
  EXPECT_GT(most, 0.1);
  EXPECT_LT(steepest, 0.5);
  const Evaluation e = after(ridge(), {tunnel});
  // The roof is side 2, from (2, 2) to (-2, 2): a = 0 is half-way.
  for (const double x : {24.0, 30.0, 37.5}) {
    expect_column(e, x, 32,
                  {{17 + tunnel.bulge(2, x - 20, 0.5), 30}, {0, 13 - tunnel.bulge(0, x - 20, 0.5)}});
  }
  Carving other = tunnel;
  other.seed = 4;
  EXPECT_NE(tunnel.bulge(2, 3.3, 0.5), other.bulge(2, 3.3, 0.5));
}

TEST(Events, OneComesAfterAnother) {
  const LinearErosion trench{{20, 32}, {44, 32}, 3, 45};
  const DipFault fault{false, {16, 32}, {48, 32}, 8, 2, 45};
  // The trench's bottom is torn apart into two lips.
  EXPECT_NEAR(height(after(flat(), {trench, fault}), 32, 31), 18, kNear);
  EXPECT_NEAR(height(after(flat(), {trench, fault}), 32, 32), 17, kNear);
  // The trench is cut into the scarp: at d = 1 it takes 2 of 21 m.
  EXPECT_NEAR(height(after(flat(), {fault, trench}), 32, 31), 19, kNear);
  // A bowl takes the overhang's upper part.
  const DipFault inverse{true, {16, 32}, {48, 32}, 8, 4, 45};
  expect_column(after(flat(), {inverse, RadialErosion{{32, 25, 32}, {4, 4, 4}}}), 32, 32,
                {{20, 21}, {0, 18.4}});
  expect_column(after(flat(), {inverse, RadialErosion{{32, 23, 32}, {4, 4, 4}}}), 32, 32, {{0, 18.4}});
  expect_column(after(flat(), {inverse, RadialErosion{{32, 20, 32}, {4, 4, 4}}}), 32, 32, {{0, 16}});
}

TEST(Events, CarvingsStayWhereTheyAre) {
  const Evaluation e =
      after(ridge(), {square_tunnel({20, 15, 32}, {44, 15, 32}), LinearErosion{{30, 32}, {34, 32}, 4, 45}});
  expect_column(e, 32, 32, {{17, 26}, {0, 13}});
}

TEST(Events, NorthIsLeftOfEast) {
  const Line line({0, 0}, {3, 0});
  EXPECT_EQ(line.left, glm::dvec2(0, -1));
  const Line slant({1, 2}, {4, 6});
  const glm::dvec2 local = slant.local({5, 4});
  EXPECT_NEAR(local.x, (4 * 3 + 2 * 4) / 5.0, 1e-12);
  EXPECT_NEAR(local.y, (4 * 4 - 2 * 3) / 5.0, 1e-12);
  EXPECT_NEAR(glm::distance(slant.plan(local), glm::dvec2(5, 4)), 0, 1e-12);
}

TEST(Events, OutlinesHoldAllThatChanges) {
  const std::vector<Event> events = {
      LinearErosion{{20, 22}, {32, 38}, 5, 45}, RadialErosion{{32, 20, 32}, {8, 4, 6}},
      DipFault{false, {20, 20}, {32, 36}, 8, 2, 45}, DipFault{true, {20, 20}, {32, 36}, 8, 4, 45},
      LateralFault{{20, 20}, {32, 36}, 8, 4}};
  const Heightfield ground = rising_east();
  for (const Event& event : events) {
    const Evaluation e = after(ground, {event});
    const std::array<glm::dvec2, 4> corners = outline(event);
    double area = 0;
    for (std::size_t c = 0; c < 4; ++c) {
      const glm::dvec2 a = corners[c], b = corners[(c + 1) % 4];
      area += (a.x * b.y - a.y * b.x) / 2;
    }
    EXPECT_LT(area, 0) << "counter-clockwise from above, where z runs down";
    int inside = 0, changed = 0;
    for (double z = 0.25; z < 64; ++z) {
      for (double x = 0.25; x < 64; ++x) {
        bool in = true;
        for (std::size_t c = 0; c < 4; ++c) {
          const glm::dvec2 a = corners[c], b = corners[(c + 1) % 4];
          in &= (b.x - a.x) * (z - a.y) - (b.y - a.y) * (x - a.x) <= 0;
        }
        const bool moved = std::abs(height(e, x, z) - (20 + 0.25 * x)) > kNear || column(e, x, z).size() > 1;
        EXPECT_TRUE(in || !moved) << name(kind(event)) << " at " << x << ", " << z;
        inside += in;
        changed += moved;
        EXPECT_TRUE(!in || plan_box(event).contains({x, z}));
      }
    }
    EXPECT_GT(changed, inside / 2) << name(kind(event));
  }
}

TEST(Events, BoundsHoldAllGround) {
  const std::vector<Event> events = {
      LinearErosion{{20, 32}, {44, 32}, 3, 45}, DipFault{true, {16, 32}, {48, 32}, 8, 4, 45},
      RadialErosion{{32, 12, 32}, {8, 4, 6}}, DipFault{false, {16, 30}, {48, 34}, 9, 2, 45}};
  const Evaluation e = after(flat(), events);
  double lowest = HUGE_VAL, highest = -HUGE_VAL;
  for (double z = 0; z <= 64; z += 0.5) {
    for (double x = 0; x <= 64; x += 0.5) {
      const std::vector<Stretch> solid = column(e, x, z);
      highest = std::fmax(highest, solid.front().top);
      lowest = std::fmin(lowest, solid.back().top);
    }
  }
  EXPECT_LT(lowest, 9);
  EXPECT_GE(lowest - 1, e.bounds().low.y);
  EXPECT_LE(highest, e.bounds().high.y);
  EXPECT_GT(e.bounds().low.y, 0);
  EXPECT_LT(e.bounds().high.y, 24);
}

TEST(Events, ASolidSaysTheSame) {
  const auto sculpture =
      std::make_shared<const Sculpture>(Sculpture{ridge(), {square_tunnel({20, 15, 32}, {44, 15, 32})}});
  const Solid solid = evaluate(sculpture);
  std::vector<Material> column(8);
  solid.column({32, 32, 1, 4}, column);  // 1, 5, 9, 13, 17, 21, 25, 29
  constexpr Material kIn = Material::kBedrock, kOut = Material::kAir;
  EXPECT_THAT(column,
              testing::ElementsAre(kIn, kIn, kIn, kIn, kIn, kIn, kIn, kIn));  // both ends belong to it
  solid.column({32, 32, 14, 2.5}, column);                                    // 14, 16.5, 19, …, 29, 31.5
  EXPECT_THAT(column, testing::ElementsAre(kOut, kOut, kIn, kIn, kIn, kIn, kIn, kOut));
  EXPECT_EQ(solid.checksum.size(), 32U);
  auto other = *sculpture;
  std::get<Carving>(other.events[0]).to.y = 16;
  EXPECT_NE(evaluate(std::make_shared<const Sculpture>(other)).checksum, solid.checksum);
}

Failure refusal(const Event& event) {
  return failure_of([&] { validate(event, {64, 64}, 3); });
}

TEST(Events, ImpossibleValuesAreRefusedByField) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = HUGE_VAL;
  const auto tunnel = [](std::vector<glm::dvec2> section) {
    Carving carving = square_tunnel({20, 15, 32}, {44, 15, 32});
    carving.section = std::move(section);
    return carving;
  };
  Carving rough = square_tunnel({20, 15, 32}, {44, 15, 32}), shrunk = rough, upright = rough;
  rough.roughness = 0.3;
  shrunk.scale_to = 0;
  upright.to = {20, 40, 32};
  const std::pair<Event, const char*> cases[] = {
      {LinearErosion{{20, 32}, {20, 32}, 3, 45}, "'from' and 'to'"},
      {LinearErosion{{nan, 32}, {20, 32}, 3, 45}, "'from'"},
      {LinearErosion{{20, 32}, {30, inf}, 3, 45}, "'to'"},
      {LinearErosion{{20, 32}, {30, 32}, 0, 45}, "'depth'"},
      {LinearErosion{{20, 32}, {30, 32}, nan, 45}, "'depth'"},
      {LinearErosion{{20, 32}, {30, 32}, 3, 90}, "'slope'"},
      {LinearErosion{{20, 32}, {30, 32}, 3, nan}, "'slope'"},
      {LinearErosion{{2, 32}, {30, 32}, 3, 45}, "outside the terrain"},
      {LinearErosion{{20, 32}, {30, 99}, 3, 45}, "outside the terrain"},
      {RadialErosion{{32, 20, 32}, {8, 0, 6}}, "'radii'"},
      {RadialErosion{{32, 20, 32}, {8, 3, -6}}, "'radii'"},
      {RadialErosion{{32, nan, 32}, {8, 3, 6}}, "'centre'"},
      {RadialErosion{{4, 20, 32}, {8, 3, 6}}, "outside the terrain"},
      {DipFault{false, {16, 32}, {16, 32}, 8, 2, 45}, "'from' and 'to'"},
      {DipFault{true, {16, 32}, {48, 32}, 0, 2, 45}, "'extent'"},
      {DipFault{true, {16, 32}, {48, 32}, 8, -2, 45}, "'throw'"},
      {DipFault{true, {16, 32}, {48, 32}, 8, 2, 0}, "'dip'"},
      {DipFault{true, {16, 32}, {48, 32}, 8, 16, 45}, "leaves no ground of the blocks"},
      {LateralFault{{16, 32}, {48, 32}, 8, 0}, "'slip'"},
      {LateralFault{{16, 32}, {48, 32}, 80, 4}, "outside the terrain"},
      {LateralFault{{1, 32}, {48, 32}, 8, 4}, "outside the terrain"},
      {tunnel({{-2, -2}, {2, 2}}), "'section' must have 3 to 64 points, got 2"},
      {tunnel({{-2, -2}, {2, 2}, {2, -2}, {-2, 2}}), "crosses itself"},
      {tunnel({{-2, -2}, {2, -2}, {0, -2}, {0, 2}}), "crosses itself"},
      {tunnel({{-2, -2}, {-2, 2}, {2, 2}, {2, -2}}), "clockwise"},
      {tunnel({{-2, -2}, {-2, -2}, {2, 2}, {2, -2}}), "two equal points"},
      {tunnel({{-2, -2}, {2, nan}, {2, 2}}), "'section'"},
      {tunnel({{-2, -2}, {0, -2}, {2, -2}}), "crosses itself"},
      {tunnel(std::vector<glm::dvec2>(100)), "'section' must have 3 to 64 points, got 100"},
      {tunnel({{-40, -2}, {2, -2}, {2, 2}}), "outside the terrain"},
      {rough, "'roughness'"},
      {shrunk, "'scale_to'"},
      {upright, "'from' and 'to'"},
  };
  for (const auto& [event, what] : cases) {
    const Failure failure = refusal(event);
    EXPECT_EQ(failure.code, ExitCode::kBadInput);
    EXPECT_THAT(failure.what, AllOf(HasSubstr("event 3 ("), HasSubstr(name(kind(event))), HasSubstr(what)));
    EXPECT_FALSE(failure.advice.empty());
  }
}

TEST(Events, CarvingsMustSuitTheGround) {
  const auto refusal = [](Heightfield ground, const Carving& carving) {
    return failure_of([&] { after(std::move(ground), {carving}); }).what;
  };
  EXPECT_THAT(refusal(ridge(), square_tunnel({10, 15, 32}, {44, 15, 32})), HasSubstr("starts in the air"));
  EXPECT_THAT(refusal(ridge(), square_tunnel({17, 15, 32}, {44, 15, 32})), HasSubstr("starts in the air"));
  EXPECT_THAT(refusal(ridge(), square_tunnel({20, 15, 32}, {50, 15, 32})), HasSubstr("ends in the air"));
  EXPECT_THAT(refusal(flat(), square_tunnel({20, 10, 32}, {44, 10, 32})), HasSubstr("does not come out"));
  EXPECT_THAT(refusal(flat(), square_tunnel({20, 17, 32}, {44, 10, 32})), HasSubstr("beyond 'to'"));
  const Heightfield valley =
      ground_of([](double x, double) { return 30 - 30 * std::exp(-(x - 32) * (x - 32) / 16); });
  EXPECT_THAT(refusal(valley, square_tunnel({12, 15, 32}, {52, 15, 32})), HasSubstr("leaves the ground"));
  // The ground before counts: here the tunnel's start has just been cut away.
  EXPECT_THAT(
      failure_of([] {
        after(ridge(), {LinearErosion{{20, 30}, {20, 34}, 8, 45}, square_tunnel({20, 15, 32}, {44, 15, 32})});
      }).what,
      AllOf(HasSubstr("event 2 (tunnel)"), HasSubstr("starts in the air")));
}

TEST(Events, GroundWithHolesOrWithoutAreaIsRefused) {
  Heightfield holed = flat();
  holed.at(3, 4) = Heightfield::kNoData;
  EXPECT_THAT(failure_of([&] { after(holed, {}); }).what, HasSubstr("1 samples without a height"));
  EXPECT_THAT(failure_of([] { after({1, 2, 1, 1, {3, 4}, {}}, {}); }).what, HasSubstr("1×2"));
}

TEST(Events, InverseFaultsOverOneAnotherAreBounded) {
  const DipFault fault{true, {16, 32}, {48, 32}, 8, 4, 45};
  EXPECT_GT(column(after(flat(), std::vector<Event>(4, fault)), 32, 32).size(), 2U);
  EXPECT_THAT(failure_of([&] { after(flat(), std::vector<Event>(100, fault)); }).what,
              AllOf(HasSubstr("event 9 "), HasSubstr("more than 8 inverse faults")));
}

TEST(Events, ManyEventsAtOnePlaceDoNotNest) {
  EXPECT_NEAR(
      height(after(flat(), std::vector<Event>(20000, LinearErosion{{20, 32}, {44, 32}, 0.001, 45})), 32, 32),
      0, 1e-3);
}

}  // namespace
}  // namespace terrabench::events
