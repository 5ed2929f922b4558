// Growing one step at a time, the fork of a trunk, and the measurements of the models.
#include <gtest/gtest.h>

#include <array>

#include "experiments/meshgrow/growing_steps.h"
#include "results/store/store.h"
#include "terrain/error.h"
#include "tests/experiments/command_line.h"

namespace terrabench::meshgrow {
namespace {

using namespace growing;

Model model_of(const std::string& name) { return parse_model(model_text(name), name); }

TEST(GrowingSteps, GiveTheMeshOfTheExpansion) {
  for (const std::string name : {"forking_trunk", "cactus", "branch_aspen"}) {
    const Model model = model_of(name);
    std::size_t steps = 0, faces = 0;
    const GrownMesh stepwise =
        expand_in_steps(model, [&](const GrownMesh& before, const GrownMesh& after, int subdivisions) {
          if (subdivisions == 0) {
            EXPECT_GE(after.mesh.faces(), before.mesh.faces());
          }
          faces = after.mesh.faces();
          ++steps;
        });
    const GrownMesh whole = expand(model);
    EXPECT_EQ(stepwise.mesh.positions, whole.mesh.positions) << name;
    EXPECT_EQ(stepwise.mesh.corners, whole.mesh.corners) << name;
    EXPECT_EQ(faces, whole.mesh.faces());
    EXPECT_GT(steps, model.steps.size() + 1);  // growth to the end takes several steps
  }
}

TEST(Fork, SharedVerticesGetTheMeanOfBothBranches) {
  const Fork fork = find_fork(model_of("fork_ridges"), "branch");
  ASSERT_EQ(fork.faces.size(), 2U);
  ASSERT_EQ(fork.shared.size(), 2U);
  EXPECT_EQ(fork.shared[0].alone, (std::array{0.0, 0.5}));
  EXPECT_EQ(fork.shared[1].alone, (std::array{0.5, 1.0}));
  EXPECT_EQ(fork.shared[0].u, 0.25);
  EXPECT_EQ(fork.shared[1].u, 0.75);
  EXPECT_EQ(fork.others, 4);
  EXPECT_EQ(fork.others_changed, 0);
}

TEST(Fork, SectionsAreAsLongAsTheirRulesSay) {
  constexpr std::array<std::string_view, 2> kStems{"trunk", "branch"};
  const std::vector<StemSection> sections = sections_along(model_of("forking_trunk"), kStems);
  ASSERT_EQ(sections.size(), 12U);  // 3 of the trunk, then 5 and 4 of the branches
  for (const StemSection& section : sections) {
    EXPECT_NEAR(section.length, section.symbol == "trunk" ? 0.7 : 0.55, 1e-5);
    EXPECT_NEAR(section.end_v - section.v, section.length, 1e-5);
  }
  EXPECT_TRUE(sections_along(model_of("cactus"), std::span(kStems).last(1)).empty());
}

TEST(Fork, IsMissingWithoutBranches) { EXPECT_THROW(find_fork(model_of("cactus"), "none such"), Error); }

class MeshgrowModels : public CommandLine {};

// An open surface and a grown one; the check must find the vertex that the experiment puts into an edge.
TEST_F(MeshgrowModels, AreWellFormed) {
  const Outcome outcome = call("exec $T run meshgrow.models --out out --set runs=1");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  const Store store = Store::open(folder_ / "out");
  ASSERT_EQ(store.records().size(), 11U);
  for (const Record& record : store.records()) {
    const auto value = [&](std::string_view metric) {
      const Metric* const found = record.find(metric);
      return found != nullptr && found->samples.size() == 1 ? found->samples[0] : -1;
    };
    EXPECT_EQ(value("faults"), 0);
    EXPECT_EQ(value("differs_from_expansion"), 0);
    EXPECT_EQ(value("planted_not_found"), 0) << record.case_name;
    EXPECT_GT(value("t_vertices_planted"), 0);
    EXPECT_GT(value("meshes_checked"), 6);
    EXPECT_GT(value("model_bytes"), 100);
  }
}

}  // namespace
}  // namespace terrabench::meshgrow
