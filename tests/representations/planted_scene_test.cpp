#include "representations/procedural_mesh/lazy/planted_scene.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <regex>

#include "terrain/error.h"

namespace terrabench::growing {
namespace {

const std::array kForkLevels{DetailLevel{}, DetailLevel{.leave_out = {"ridges"}},
                             DetailLevel{.leave_out = {"ridges"}, .fewer_subdivisions = 2},
                             DetailLevel{.leave_out = {"ridges", "smooth"}}};
const std::array kCactusLevels{DetailLevel{}, DetailLevel{.leave_out = {"spikes"}},
                               DetailLevel{.leave_out = {"spikes", "ribs"}}};

DetailModel fork() {
  return make_detail_model(model_text("fork_ridges_random"), "fork_ridges_random", kForkLevels);
}
DetailModel cactus() { return make_detail_model(model_text("cactus"), "cactus", kCactusLevels); }

float flat(float, float) { return 0; }

PlantedScene planted(std::uint64_t count) {
  return {{fork(), cactus()}, scatter({.count = count, .shares = {1, 1}}, flat)};
}

void expect_equal(const GrownMesh& a, const GrownMesh& b) {
  EXPECT_TRUE(a.mesh.positions == b.mesh.positions && a.mesh.texture == b.mesh.texture);
  EXPECT_EQ(a.mesh.corners, b.mesh.corners);
  EXPECT_EQ(a.mesh.first_corner, b.mesh.first_corner);
  EXPECT_EQ(a.mesh.symbols, b.mesh.symbols);
}

// The text of the model with the seed in place of its own, run through the plain expansion.
TEST(PlantedScene, ExpandsAnInstanceAsTheEagerExpansionDoesBitForBit) {
  const PlantedScene scene = planted(6);
  for (std::size_t i = 0; i < 6; ++i) {
    const Instance& instance = scene.instances()[i];
    const std::string_view name = instance.model == 0 ? "fork_ridges_random" : "cactus";
    Model model = parse_model(model_text(name), std::string(name));
    model.system.seed = instance.seed;
    expect_equal(scene.mesh(i, 0), expand(model));
    expect_equal(scene.mesh(i, 1), expand(model, {.leave_out = {instance.model == 0 ? "ridges" : "spikes"}}));
  }
}

TEST(PlantedScene, EstimatesTheFacesAndABoxOfEveryExpansion) {
  const PlantedScene scene = planted(24);
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < 24; ++i) {
    for (std::size_t l = 0; l < scene.levels(i); ++l) {
      const GrownMesh mesh = scene.mesh(i, l);
      EXPECT_EQ(mesh.mesh.faces(), scene.faces(i, l)) << i << " " << l;
      EXPECT_EQ(beyond(box_of(mesh.mesh.positions), scene.local_box(i)), 0) << i << " " << l;
      if (l == 0) total += mesh.mesh.faces();
      const Bounds& box = scene.box(i);
      for (const glm::vec3& p : mesh.mesh.positions) {
        const glm::vec3 at(to_world(scene.instances()[i]) * glm::vec4(p, 1));
        for (int k = 0; k < 3; ++k) ASSERT_TRUE(at[k] >= box.low[k] && at[k] <= box.high[k]);
      }
    }
  }
  EXPECT_EQ(scene.total_faces(), total);
  EXPECT_NE(scene.instances()[0].seed, scene.instances()[1].seed);
}

// A model that is written with these constants must agree.
TEST(PlantedScene, ALevelWithOtherConstantsIsTheModelWithThem) {
  const std::string text(model_text("branch_aspen"));
  const std::array levels{DetailLevel{}, DetailLevel{.constants = {{"Leaves", 6}, {"LeafScale", 0.5}}}};
  const DetailModel model = make_detail_model(text, "branch_aspen", levels);
  const std::string changed =
      std::regex_replace(std::regex_replace(text, std::regex("\nLeaves = "), "\nLeaves = 6 # "),
                         std::regex("\nLeafScale = "), "\nLeafScale = 0.5 # ");
  const GrownMesh mesh = expand_seed(model.levels[1], 5);
  expect_equal(mesh, expand_seed(parse_model(changed, "changed"), 5));
  EXPECT_LT(mesh.mesh.faces(), expand_seed(model.levels[0], 5).mesh.faces());
}

TEST(PlantedScene, IsTheSameForEveryNumberOfThreads) {
  const PlantedScene many = planted(20);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  tbb::task_arena(1).execute([&] {
    const PlantedScene one = planted(20);
    EXPECT_EQ(one.total_faces(), many.total_faces());
    for (std::size_t i = 0; i < 20; ++i) {
      EXPECT_EQ(one.box(i).low, many.box(i).low);
      EXPECT_EQ(one.box(i).high, many.box(i).high);
      EXPECT_EQ(one.instances()[i].seed, many.instances()[i].seed);
    }
  });
}

TEST(PlantedScene, LevelsGetCoarserWithDistance) {
  const PlantedScene scene({fork()}, scatter({.count = 1, .side = 1, .shares = {1}}, flat));
  View view;
  view.height = 600;
  view.far = 1e6F;
  std::size_t last = 0;
  std::vector<bool> seen(4);
  for (float distance = 0; distance < 5000; distance = distance * 1.1F + 0.5F) {
    view.eye = {0, 2, distance};
    view.target = {0, 2, distance - 1};
    const std::size_t level = scene.choose_levels(view, {})[0];
    EXPECT_GE(level, last) << distance;
    last = level;
    seen[level] = true;
    EXPECT_EQ(scene.choose_levels(view, {.spacing = 0})[0], 0);
  }
  EXPECT_EQ(seen, std::vector<bool>(4, true));
  // Behind the eye, a coarser level is enough.
  view.eye = {0, 2, 60};
  view.target = {0, 2, 59};
  const int ahead = scene.choose_levels(view, {})[0];
  view.target = {0, 2, 61};
  EXPECT_GT(scene.choose_levels(view, {})[0], ahead);
}

TEST(PlantedScene, TheCoarsestLevelThatHasEnoughFacesIsChosen) {
  const std::array<std::uint32_t, 3> faces{1000, 100, 10};
  const std::tuple<double, double, std::size_t> known[] = {{10, 1, 2},
                                                           {10.5, 1, 1},
                                                           {101, 1, 0},
                                                           {5000, 1, 0},
                                                           {400, 2, 1},
                                                           {std::numeric_limits<double>::infinity(), 1, 0},
                                                           {std::numeric_limits<double>::quiet_NaN(), 1, 0}};
  for (const auto& [disc, spacing, level] : known)
    EXPECT_EQ(coarsest_level(faces, disc, spacing), level) << disc;
}

TEST(PlantedScene, RefusesWhatItCannotPlant) {
  const auto refused = [](std::uint64_t count, std::vector<double> shares, float side = 100) {
    EXPECT_THROW(scatter({.count = count, .side = side, .shares = std::move(shares)}, flat), Error);
  };
  refused(1'000'000'000, {1});  // before it allocates: this takes no time
  refused(UINT64_MAX, {1});
  refused(1, {-1, 1});
  refused(1, {});
  refused(1, {1}, std::numeric_limits<float>::quiet_NaN());
  EXPECT_TRUE(scatter({.count = 0, .shares = {1}}, flat).empty());
  const PlantedScene empty({fork()}, {});
  EXPECT_EQ(empty.total_faces(), 0U);
  EXPECT_TRUE(empty.choose_levels({}, {}).empty());
  for (const Instance& wrong : {Instance{.model = 1}, {.scale = 0}, {.position = glm::vec3(NAN)}}) {
    EXPECT_THROW(PlantedScene({fork()}, {wrong}), Error);
  }
}

TEST(PlantedScene, RefusesLevelsThatTheModelDoesNotHave) {
  const std::string cactus(model_text("cactus")), prism = "\n[base]\nshape = \"prism\"\n";
  const auto make = [](const std::string& text, const DetailLevel& level) {
    make_detail_model(text, "m", std::array{level});
  };
  EXPECT_THROW(make(cactus, {.leave_out = {"needles"}}), Error);
  EXPECT_THROW(make(cactus, {.fewer_subdivisions = 1}), Error);  // its last step grows
  EXPECT_THROW(make_detail_model(cactus, "m", {}), Error);
  const DetailLevel three{.constants = {{"Leaves", 3}}};
  EXPECT_NO_THROW(make("[constants]\na = 1\nLeaves = 8 # of a twig" + prism, three));
  EXPECT_NO_THROW(make("constants = { a = 2, Leaves = 8.5, b = 3 }" + prism, three));
  for (const std::string& text :
       {cactus, "[constants]\nLeaves = \"2*4\"" + prism, "[constants]\nLeaves = [8, 9]" + prism}) {
    EXPECT_THROW(make(text, three), Error) << text;
  }
  EXPECT_THROW(make("[constants]\nLeaves = 8" + prism, {.constants = {{"Leaves", NAN}}}), Error);
  // From coarse to fine.
  const std::array wrong{kForkLevels[1], kForkLevels[0]};
  const std::string name = "fork_ridges_random";
  EXPECT_THROW(PlantedScene({make_detail_model(model_text(name), name, wrong)}, {Instance{}}), Error);
}

}  // namespace
}  // namespace terrabench::growing
