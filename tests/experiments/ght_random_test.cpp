// The random events of ght.continuity: sane ones are possible, and each refusal gets its reason.
#include <gtest/gtest.h>

#include "experiments/ght/random_events.h"
#include "terrain/error.h"
#include "terrain/events/evaluate.h"

namespace terrabench::ght {
namespace {

using namespace events;

TEST(GhtRandomEvents, SaneOnesAreDefinedAndInsideTheTerrain) {
  const Site site = make_site(64, 16, 5);
  const Ght tree = plain_tree(site.ground);
  Dice dice(5);
  std::array<int, kKinds> seen{};
  for (int k = 0; k < 150; ++k) {
    const Event event = sane_event(dice, site, tree, {});
    ++seen[static_cast<std::size_t>(kind(event))];
    EXPECT_NO_THROW(Evaluation(std::make_shared<Sculpture>(Sculpture{site.ground, {event}})));
    const PlanBox box = source_box(event);
    EXPECT_GT(std::min(box.low.x, box.low.y), 2 * site.ground.cell_x);
    EXPECT_LT(std::max(box.high.x, box.high.y), site.extent() - 2 * site.ground.cell_x);
    EXPECT_FALSE(meets_fold(site, tree, event, {}));
  }
  for (int k = 0; k < kKinds; ++k) EXPECT_GT(seen[static_cast<std::size_t>(k)], 0) << event_names()[k];
}

Refusal reason(const Site& site, std::vector<Event> before, const Event& event) {
  Ght tree = plain_tree(site.ground);
  for (const Event& e : before) tree.apply(e);
  try {
    tree.apply(event);
  } catch (const Error& error) {
    return why_refused(site, event, before, error.what());
  }
  ADD_FAILURE() << "was not refused";
  return Refusal::kOther;
}

TEST(GhtRandomEvents, EachRefusalHasItsReason) {
  const Site site = make_site(64, 16, 5);
  const double cell = site.ground.cell_x, middle = site.extent() / 2;
  const auto at = [&](double x, double z) { return middle + cell * glm::dvec2(x, z); };
  const DipFault overhang{true, at(-8, 0), at(8, 0), 8 * cell, 2 * cell, 50};
  const LinearErosion across{at(0, -6), at(0, 6), 0.5 * cell, 40},
      beside{at(-8, 14), at(8, 14), 0.5 * cell, 40};
  EXPECT_EQ(reason(site, {overhang}, across), Refusal::kOverhang);
  EXPECT_EQ(reason(site, {}, LinearErosion{at(-30.5, 0), at(8, 0), 0.5 * cell, 40}), Refusal::kBorder);
  EXPECT_EQ(reason(site, {}, LinearErosion{at(-40, 0), at(8, 0), 0.5 * cell, 40}), Refusal::kImpossible);
  Carving high;
  high.from = {middle, 1e5, middle};
  high.to = {middle + 4 * cell, 1e5, middle};
  high.section = {{-cell, -cell}, {cell, -cell}, {cell, cell}, {-cell, cell}};
  EXPECT_EQ(reason(site, {}, high), Refusal::kImpossible);

  Ght tree = plain_tree(site.ground);
  tree.apply(overhang);
  EXPECT_TRUE(meets_fold(site, tree, across, std::array<Event, 1>{overhang}));
  EXPECT_FALSE(meets_fold(site, tree, beside, std::array<Event, 1>{overhang}));
  DipFault normal = overhang;
  normal.inverse = false;
  EXPECT_FALSE(meets_fold(site, tree, across, std::array<Event, 1>{normal}));
}

}  // namespace
}  // namespace terrabench::ght
