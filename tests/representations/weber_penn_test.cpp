// The tree model of Weber and Penn (1995) as rules that all species share: what its parameters mean, counted
// and measured on the grown meshes.
#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/representations/growing_models.h"

namespace terrabench::growing {
namespace {

const std::string kNoSplits = "SegSplits = [0, 0, 0, 0]";

std::string text_of(std::string_view name) { return std::string(model_text(name)); }

std::string with(std::string text, const std::string& old, const std::string& now) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return at == std::string::npos ? text : text.replace(at, old.size(), now);
}

// The wood alone, before it is smoothed; the faces that would bear leaves keep their symbol.
GrownMesh wood(const Model& model) { return expand(model, {.leave_out = {"leaves", "smooth"}}); }

std::size_t count_of(const Model& model, const GrownMesh& mesh, std::string_view symbol) {
  std::size_t count = 0;
  for (const std::uint32_t each : mesh.mesh.symbols) count += model.system.symbols[each].name == symbol;
  return count;
}

std::size_t triangles(const FaceMesh& mesh) {
  std::size_t count = 0;
  for (std::size_t f = 0; f < mesh.faces(); ++f)
    count += mesh.first_corner[f + 1] - mesh.first_corner[f] == 3;
  return count;
}

// Every split is a tent with two triangles. A stem of 5 segments has 4 places for splits; the counts of a
// path from base to tip differ by the random start of the sum, the number of tips does not.
TEST(WeberPenn, StemsSplitAsOftenAsTheParameterSays) {
  for (const auto& [splits, tips] :
       {std::pair{"0", 1U}, {"0.25", 2U}, {"0.5", 4U}, {"1", 16U}, {"1.5", 36U}}) {
    const std::string text = with(with(with(text_of("branch_aspen"), "Levels = 3", "Levels = 2"), kNoSplits,
                                       fmt::format("SegSplits = [0, {}, 0, 0]", splits)),
                                  "SplitAngle = [0, 0, 0, 0]", "SplitAngle = [0, 30, 30, 0]");
    const GrownMesh mesh = wood(parse_model(text, "splits"));
    EXPECT_EQ(triangles(mesh.mesh), 2 * (tips - 1)) << splits;
    EXPECT_EQ(faults(mesh.mesh), "") << splits;
  }
}

TEST(WeberPenn, TheTrunkSplitsAtItsBase) {
  const std::string text =
      with(with(with(text_of("bush_tupelo"), "Levels = 3", "Levels = 1"), "sides = 12", "sides = 4"),
           "BaseSplits = 0", "BaseSplits = 2");
  const Model model = parse_model(text, "base splits");
  const GrownMesh mesh = wood(model);
  EXPECT_EQ(triangles(mesh.mesh), 4U);
  EXPECT_EQ(count_of(model, mesh, "leaf"), 3 * 50U);
  EXPECT_EQ(faults(mesh.mesh), "");
}

TEST(WeberPenn, TrunkBearsItsBranchesAboveTheBase) {
  const Model model = parse_model(with(text_of("bush_tupelo"), "Levels = 3", "Levels = 1"), "trunk");
  EXPECT_EQ(count_of(model, wood(model), "leaf"), 50U);
}

TEST(WeberPenn, LeavesPerTwigGrowTowardsTheTipOfTheBranch) {
  const Model model = parse_model(model_text("branch_aspen"), "branch_aspen");
  const double share = 0.45 / 0.6, extent = 0.5 + 0.5 * (1 - share) / 0.3;
  const int twigs = static_cast<int>(std::lround(30 * (0.2 + 0.8 * extent)));
  std::size_t leaves = 0;
  for (int i = 1; i <= twigs; ++i) leaves += std::lround(25 * (0.5 + 0.5 * i / twigs));
  EXPECT_EQ(count_of(model, wood(model), "leaf"), leaves);
}

TEST(WeberPenn, TheFootOfTheTrunkHasFlareAndLobes) {
  const GrownMesh mesh = wood(parse_model(model_text("bush_tupelo"), "bush_tupelo"));
  const double n = 63;  // 50 branches above a fifth of the trunk
  for (int i = 0; i < 10; ++i) {
    const double z = (i + 1) / n, flare = 1 + (std::pow(100, std::max(1 - 8 * z, 0.0)) - 1) / 100;
    const double radius = 4 * 0.015 * (1 - 0.9 * z) * flare;
    glm::vec3 middle(0);
    const auto at = [&](int corner) { return mesh.mesh.positions[24 + 12 * i + corner]; };
    for (int corner = 0; corner < 12; ++corner) middle += at(corner) / 12.0F;
    for (int corner = 0; corner < 12; ++corner) {
      const double lobe = 1 + 0.1 * std::sin(M_PI_2 * corner);
      EXPECT_NEAR(glm::distance(at(corner), middle), radius * lobe, 1e-5) << i << " " << corner;
    }
  }
}

// AttractionUp turns twigs upwards, and downwards if it is negative.
TEST(WeberPenn, AttractionTurnsTwigsUpAndDown) {
  const auto height = [](const char* attraction) {
    const GrownMesh mesh =
        wood(parse_model(with(text_of("branch_aspen"), "AttractionUp = 0.5", attraction), "attraction"));
    double sum = 0;
    for (const glm::vec3& p : mesh.mesh.positions) sum += p.y;
    return sum / static_cast<double>(mesh.mesh.positions.size());
  };
  const double up = height("AttractionUp = 1"), none = height("AttractionUp = 0");
  EXPECT_GT(up, none + 0.05);
  EXPECT_GT(none, height("AttractionUp = -2") + 0.05);
}

}  // namespace
}  // namespace terrabench::growing
