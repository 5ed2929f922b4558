// The models of "meshgrow" as triangles, and the levels that leave out steps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <string>

#include "experiments/experiment.h"
#include "experiments/meshgrow/models.h"
#include "terrain/error.h"

namespace terrabench::meshgrow {
namespace {

TEST(MeshgrowModelFigures, PolygonsKeepTheirEdgesAsWires) {
  FaceMesh faces;  // a kite, whose diagonal from corner 1 to 3 is the shorter one, and a triangle
  faces.positions = {{0, 0, 0}, {2, 0, 1}, {6, 0, 0}, {2, 0, -1}, {7, 0, -3}};
  faces.first_corner = {0, 4, 7};
  faces.corners = {0, 1, 2, 3, 3, 2, 4};
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
    ridge.first_corner = {0, 4, 8};
    ridge.corners = {0, 1, 2, 3, 3, 2, 4, 5};
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

TEST(MeshgrowModelFigures, LeavingOutTheSpikesRemovesThemAlone) {
  const growing::Model model = growing::parse_model(growing::model_text("cactus"), "cactus");
  const auto symbols = [&](const growing::ExpandOptions& options) {
    std::multiset<std::string> names;
    for (const std::uint32_t symbol : triangles_of(growing::expand(model, options).mesh).symbols) {
      names.insert(model.system.symbols[symbol].name);
    }
    return names;
  };
  growing::ExpandOptions without;
  without.leave_out = {"spikes"};
  EXPECT_GT(symbols({}).count("spike"), 1000U);
  EXPECT_EQ(symbols(without).count("spike"), 0U);
  EXPECT_GT(symbols(without).count("skin"), 1000U);
}

TEST(MeshgrowModelFigures, EveryLevelLeavesOutStepsOfAPaintedModel) {
  for (const Case& at : experiment("meshgrow.lod").cases({})) {
    const std::string name = at.parameters.text("model");
    EXPECT_EQ(painted(name).model, name);
    const std::string left_out = at.parameters.text("left_out");
    EXPECT_EQ(left_out.empty(), at.name.ends_with("/full")) << at.name;
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
