// The experiments that measure the grounded heightmap tree: their grounds, their events, and that what they
// count can be other than 0.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "experiments/experiment.h"
#include "experiments/ght/site.h"
#include "representations/ght/invariants.h"
#include "terrain/error.h"
#include "terrain/events/event_file.h"
#include "terrain/source.h"

namespace terrabench::ght {
namespace {

using events::Event;
using events::Kind;

constexpr int kSize = 32;

Site site_of(int side = kEventsAlong * kSize, int size = kSize) { return make_site(side, size, 1); }

TEST(GhtSite, IsTheGroundThatAnEventFileNames) {
  const Site site = site_of();
  const TerrainSource source =
      events::open_script("terrain = \"diamond-square\"\nseed = 1\nsize = 129\n", "test.toml");
  ASSERT_TRUE(source.heights);
  EXPECT_EQ(checksum(site.ground), checksum(*source.heights));
}

TEST(GhtSite, RepeatsItselfAroundTheSameEvents) {
  const Site one = site_of(), many = site_of(512);
  EXPECT_EQ(many.corner, glm::dvec2(2 * one.extent()));
  EXPECT_EQ(many.middle, many.corner + one.middle);
  for (int j = 0; j <= 128; ++j) {
    for (int i = 0; i <= 128; ++i) {
      ASSERT_EQ(many.ground.at(256 + i, 256 + j), one.ground.at(i % 128, j % 128)) << i << ' ' << j;
    }
  }
  for (int k = 0; k < events::kKinds; ++k) {
    const auto kind = static_cast<Kind>(k);
    Ght small = plain_tree(one.ground), large = plain_tree(many.ground);
    small.apply(single_event(one, kind));
    large.apply(single_event(many, kind));
    EXPECT_EQ(events::kind(single_event(many, kind)), kind);
    EXPECT_EQ(large.model().tree.nodes().size(), small.model().tree.nodes().size());
  }
}

TEST(GhtSite, FinerSamplesTakeTheSameEvents) {
  for (const int size : {64, 128}) {
    const Site site = site_of(kEventsAlong * size, size);
    EXPECT_DOUBLE_EQ(site.size, site_of().size);
    for (int k = 0; k < events::kKinds; ++k) {
      if (is_carving(static_cast<Kind>(k))) continue;  // finer mountains are rougher about a mouth
      Ght tree = plain_tree(site.ground);
      EXPECT_NO_THROW(tree.apply(single_event(site, static_cast<Kind>(k)))) << size << ' ' << k;
    }
  }
}

TEST(GhtSite, SequenceOverlapsAndHasAllKinds) {
  const Site site = site_of();
  const std::vector<Event> all = overlapping_events(site);
  ASSERT_EQ(all.size(), 12U);
  std::set<Kind> kinds;
  Ght tree = plain_tree(site.ground);
  for (const Event& event : all) {
    tree.apply(event);
    kinds.insert(events::kind(event));
  }
  EXPECT_EQ(kinds.size(), static_cast<std::size_t>(events::kKinds));
  std::size_t overlaps = 0;
  for (std::size_t a = 0; a < all.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) overlaps += events::plan_box(all[a]).meets(events::plan_box(all[b]));
  }
  EXPECT_GT(overlaps, 10U);
  EXPECT_EQ(two_tunnels(site).size(), 2U);
}

TEST(GhtSite, IsTheNextWhoseMountainsHaveAPlaceForAllEvents) {
  EXPECT_EQ(event_site(128, 32, 1).seed, 1U);
  for (const std::uint64_t seed : {0U, 2U}) {
    const Site site = event_site(128, 32, seed);
    EXPECT_GT(site.seed, seed) << "these mountains have no place for one of the events";
    EXPECT_EQ(overlapping_events(site).size(), kPlannedEvents);
    EXPECT_EQ(two_tunnels(site).size(), 2U);
    for (int k = 0; k < events::kKinds; ++k) {
      Ght tree = plain_tree(site.ground);
      EXPECT_NO_THROW(tree.apply(single_event(site, static_cast<Kind>(k))));
    }
  }
}

TEST(GhtSite, RainRepeatsAndStaysOnTheTerrain) {
  const Site site = site_of();
  Ght first = plain_tree(site.ground), second = plain_tree(site.ground);
  Rain a(site.ground, 3), b(site.ground, 3), other(site.ground, 4);
  EXPECT_NE(events::to_text(std::array{other.next(first)}), events::to_text(std::array{Rain(a).next(first)}));
  for (int k = 0; k < 300; ++k) {
    const Event event = a.next(first);
    const glm::dvec3 radii = std::get<events::RadialErosion>(event).radii;
    EXPECT_GE(radii.x, 1.5 * site.ground.cell_x);
    EXPECT_LT(radii.x, 4 * site.ground.cell_x);
    EXPECT_EQ(radii, glm::dvec3(radii.x, radii.x / 3, radii.x));
    EXPECT_EQ(events::to_text(std::array{event}), events::to_text(std::array{b.next(second)}));
    ASSERT_NO_THROW(first.apply(event));
    second.apply(event);
  }
  EXPECT_EQ(first.model().tree.nodes().size(), 301U);
}

// What is counted must be seen when it is there.
TEST(GhtBreaks, AreSeen) {
  const Site site = site_of();
  Ght tree = plain_tree(site.ground);
  tree.apply(single_event(site, Kind::kNormalFault));
  const Model whole = tree.model();
  const Breaks none = count_breaks(whole);
  EXPECT_EQ(none.dangling + none.voids_seen, 0U);

  Model hollow = whole;
  FaceId some = kNone;
  hollow.surface.each_face([&](FaceId f) { some = f; });
  ASSERT_NE(some, kNone);
  hollow.tree.set_void(hollow.surface.face(some)[0]);
  EXPECT_GT(count_breaks(hollow).voids_seen, 0U);

  Model dangling = whole;
  CellId link = 0;
  while (dangling.tree.kind(link) != CellKind::kLink) ++link;
  GroundedHeightmap spare;
  spare.columns = spare.rows = 2;
  spare.parent = 0;
  const CellId nowhere = dangling.tree.nodes()[dangling.tree.append(spare)].cell(0, 0);
  dangling.tree.set_link(link, nowhere);
  EXPECT_EQ(count_breaks(dangling).dangling, 1U);
}

// Each experiment at its quick profile's first case: what it records is there and sound.
class Measured : public testing::Test {
 protected:
  double metric(std::string_view name) const {
    const Metric* const found = record_.find(name);
    if (found == nullptr) {
      ADD_FAILURE() << "no " << name;
      return 0;
    }
    return found->samples.front();
  }
  void run(std::string_view id, std::string_view name) {
    const std::vector<Case> all = experiment(id).cases(options_);
    const auto at = std::find_if(all.begin(), all.end(), [&](const Case& c) { return c.name == name; });
    ASSERT_NE(at, all.end()) << name;
    Case unnamed = *at;
    unnamed.name = "a label";  // parameters alone say what is measured
    record_ = {};
    Recorder recorder(record_, {});
    experiment(id).measure(unnamed, options_, recorder, progress_);
  }

  RunOptions options_;
  Progress progress_;
  Record record_;
};

TEST_F(Measured, CountsAreThePapers) {
  run("ght.counts", "lateral-fault");
  EXPECT_EQ(metric("added_on_root"), 2);
  EXPECT_EQ(metric("added_on_block"), 2);
  EXPECT_EQ(metric("host_depth_on_block"), 1);
  EXPECT_NEAR(metric("largest_share_on_root"), 0.5, 0.01);
  run("ght.counts", "cave");
  EXPECT_EQ(metric("added_sides_3"), 5);
  EXPECT_EQ(metric("added_sides_12"), 14);
}

TEST_F(Measured, CellsAreThoseOfTheRules) {
  run("ght.cells", "hosts");
  EXPECT_EQ(metric("wrong_hosts"), 0);
  EXPECT_GT(metric("hosts_below_root"), metric("hosts_below_those"));
  run("ght.cells", "links");
  EXPECT_EQ(metric("wrong_heights"), 0);
  EXPECT_LT(metric("forgotten_heights"), metric("cells_over_links"));
  run("ght.cells", "interpolated");
  EXPECT_EQ(metric("wrong_interpolated"), 0);
  EXPECT_GT(metric("unlike_nearest"), 0.5 * metric("interpolated_cells"));
  run("ght.cells", "null-links");
  EXPECT_EQ(metric("mouth_without_null"), 0);
  EXPECT_EQ(metric("null_links"), metric("empty_cells"));
  run("ght.cells", "walls");
  EXPECT_GT(metric("near_correlation"), 0.8);
  EXPECT_LT(std::abs(metric("far_correlation")), 0.3);
}

TEST_F(Measured, OverhangsAreWhereTheyAre) {
  run("ght.overhang", "normal-fault");
  EXPECT_EQ(metric("overhang_columns"), 0);
  EXPECT_EQ(metric("lost_volume"), 0);
  for (const char* const name : {"inverse-fault", "tunnel", "cave"}) {
    run("ght.overhang", name);
    EXPECT_GT(metric("overhang_columns"), 100) << name;
    // Both are true to a cell, of which the hollow is a few high.
    EXPECT_NEAR(metric("lost_volume") / metric("evaluated_lost_volume"), 1, 0.15) << name;
  }
}

TEST_F(Measured, AllStructuresDoTheSameEdit) {
  for (int k = 0; k < events::kKinds; ++k) {
    const std::string name = "n=128/" + std::string(events::name(static_cast<Kind>(k)));
    run("ght.edits", name);
    EXPECT_GT(metric("columns"), 50) << name;
    EXPECT_GT(metric("ght_bytes"), 0) << name;
    // Of what is several cells deep, in the mean of the columns that change.
    EXPECT_LT(metric("stack_difference"), 0.2) << name;
    EXPECT_LT(metric("voxel_difference"), 0.2) << name;
    EXPECT_GT(metric("stack_whole_time"), metric("stack_time")) << name;
  }
}

TEST_F(Measured, SequenceIsRepeatedFromItsText) {
  run("ght.complex", "sequence");
  EXPECT_EQ(metric("events"), 12);
  EXPECT_EQ(metric("differs_from_text"), 0);
  EXPECT_LT(metric("text_bytes"), 2000);
  EXPECT_EQ(metric("heights") + metric("links") + metric("voids"), metric("cells"));
}

TEST(GhtCases, NameTheirEventsAndRefuseOthers) {
  RunOptions options;
  std::vector<Case> counts = experiment("ght.counts").cases(options);
  ASSERT_EQ(counts.size(), static_cast<std::size_t>(events::kKinds));
  for (std::size_t k = 0; k < counts.size(); ++k) {
    EXPECT_EQ(counts[k].name, events::name(static_cast<Kind>(k)));
    EXPECT_EQ(counts[k].parameters.choice("event"), k);
  }
  EXPECT_THROW(counts[0].parameters.set("event", std::string("landslide")), Error);
  const Experiment &edits = experiment("ght.edits"), &reach = experiment("ght.reach");
  EXPECT_EQ(edits.cases(options).size(), 4U * events::kKinds);
  EXPECT_EQ(reach.cases(options).back().name, "size=256");
  EXPECT_EQ(reach.cases(options).back().parameters.integer("n"), 1024);
  options.profile = Profile::kPaper;
  EXPECT_EQ(edits.cases(options).back().name, "n=4096/cave");
  EXPECT_EQ(edits.cases(options).back().parameters.text("event"), "cave");
}

}  // namespace
}  // namespace terrabench::ght
