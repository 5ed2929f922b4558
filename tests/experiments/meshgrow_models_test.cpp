// The models of "meshgrow" as triangles, the fork of a trunk, and the levels that leave out steps.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "experiments/experiment.h"
#include "experiments/meshgrow/fork.h"
#include "experiments/meshgrow/models.h"
#include "terrain/error.h"

namespace terrabench::meshgrow {
namespace {

growing::Model model(const std::string& name) {
  return growing::parse_model(growing::model_text(name), name);
}

TEST(Fork, SharedVerticesGetTheMeanOfBothBranches) {
  const Fork fork = find_fork(model("fork_ridges"), "branch");
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
  const std::vector<StemSection> sections = sections_along(model("forking_trunk"), kStems);
  ASSERT_EQ(sections.size(), 12U);  // 3 of the trunk, then 5 and 4 of the branches
  for (const StemSection& section : sections) {
    EXPECT_NEAR(section.length, section.symbol == "trunk" ? 0.7 : 0.55, 1e-5);
    EXPECT_NEAR(section.end_v - section.v, section.length, 1e-5);
  }
  EXPECT_TRUE(sections_along(model("cactus"), std::span(kStems).last(1)).empty());
}

TEST(Fork, IsMissingWithoutBranches) { EXPECT_THROW(find_fork(model("cactus"), "none such"), Error); }

TEST(MeshgrowModelFigures, PolygonsKeepTheirEdgesAsWires) {
  FaceMesh faces;  // a kite, whose diagonal from corner 1 to 3 is the shorter one, and a triangle
  faces.positions = {{0, 0, 0}, {2, 0, 1}, {6, 0, 0}, {2, 0, -1}, {7, 0, -3}};
  faces.add_face({0, 1, 2, 3});
  faces.add_face({3, 2, 4});
  faces.symbols = {5, 6};
  const ModelMesh mesh = triangles_of(faces);
  EXPECT_EQ(mesh.mesh.indices, (std::vector<std::uint32_t>{1, 2, 3, 1, 3, 0, 3, 2, 4}));
  EXPECT_EQ(mesh.symbols, (std::vector<std::uint32_t>{5, 5, 6}));
  EXPECT_EQ(mesh.wires, (std::vector<std::uint8_t>{3, 6, 7}));  // not the edge from 3 to 1
  for (const glm::vec3& normal : mesh.mesh.normals) EXPECT_NEAR(glm::length(normal), 1, 1e-5F);
}

// Faces that meet at a sharp edge keep their own normals; a roof so flat that it counts as smooth does not.
TEST(MeshgrowModelFigures, OnlySharpEdgesHaveSeveralNormals) {
  const auto normals_of = [](float rise) {
    FaceMesh ridge;  // two quadrilaterals that meet at an edge
    ridge.positions = {{-1, 0, 0}, {-1, 0, 1}, {0, rise, 1}, {0, rise, 0}, {1, 0, 1}, {1, 0, 0}};
    ridge.texture.assign(6, glm::vec2(0));
    ridge.add_face({0, 1, 2, 3});
    ridge.add_face({3, 2, 4, 5});
    const ModelMesh mesh = triangles_of(ridge);
    EXPECT_EQ(mesh.texture.size(), mesh.mesh.positions.size());
    return mesh.mesh.normals;
  };
  const std::vector<glm::vec3> flat = normals_of(0.2F), sharp = normals_of(2);
  EXPECT_EQ(flat.size(), 6U);
  // Each quadrilateral has a right angle at the ridge, whether one of its triangles lies there or both.
  for (const int v : {2, 3}) EXPECT_NEAR(flat[v].y, 1, 1e-6F);
  EXPECT_NEAR(flat[0].y, 1 / std::sqrt(1.04F), 1e-6F);
  ASSERT_EQ(sharp.size(), 8U);
  for (const glm::vec3& normal : sharp) EXPECT_NEAR(normal.y, 1 / std::sqrt(5.0F), 1e-6F);
}

TEST(MeshgrowModelFigures, EveryLevelLeavesOutStepsOfAPaintedModel) {
  for (const Case& test_case : experiment("meshgrow.lod").cases({})) {
    const std::string name = test_case.parameters.text("model");
    EXPECT_EQ(painted(name).model, name);
    const std::string left_out = test_case.parameters.text("left_out");
    EXPECT_EQ(left_out.empty(), test_case.name.ends_with("/full")) << test_case.name;
  }
  EXPECT_THROW(painted("palm"), Error);
}

TEST(MeshgrowLevels, ErrorsAreThoseOfTheModelsWithoutTheNoiseOfTheirPictures) {
  const Experiment& levels = experiment("meshgrow.lod");
  const auto errors = [&](std::string_view left_out, std::int64_t samples) {
    Case at{"small", {levels.parameters, {{"height", std::int64_t{96}}, {"samples", samples}}}};
    at.parameters.set("left_out", std::string(left_out));
    Record record;
    Recorder recorder(record, "unused");
    Progress progress;
    levels.measure(at, {}, recorder, progress);
    return std::array{record.find("near_error")->samples[0], record.find("far_error")->samples[0]};
  };
  EXPECT_EQ(errors("", 2), (std::array{0.0, 0.0}));
  const auto noisy = errors("spikes,ribs,smooth", 2), clean = errors("spikes,ribs,smooth", 64);
  EXPECT_GT(clean[0], 10);
  EXPECT_NEAR(noisy[0], clean[0], 0.05 * clean[0]);
  EXPECT_NEAR(noisy[1], clean[1], 0.2 * clean[1]);
}

}  // namespace
}  // namespace terrabench::meshgrow
