// Growing steps: frames, attachment, averages, choice of rules, and that meshes stay well formed.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <random>

#include "representations/procedural_mesh/growing/grow.h"
#include "tests/representations/growing_models.h"

namespace terrabench::growing {
namespace {

TEST(Growing, FrameOfAFaceIsAtItsCentreAlongItsNormalAndFirstEdge) {
  const std::vector<glm::vec3> positions{{1, 2, 3}, {1, 2, 7}, {5, 2, 7}, {5, 2, 3}};
  const std::uint32_t corners[] = {0, 1, 2, 3};
  const FaceShape shape = face_shape(corners, positions);
  EXPECT_EQ(shape.frame.origin, glm::dvec3(3, 2, 5));
  EXPECT_EQ(shape.frame.z, glm::dvec3(0, 1, 0));
  EXPECT_EQ(shape.frame.x, glm::dvec3(0, 0, 1));
  EXPECT_EQ(shape.frame.y, glm::dvec3(1, 0, 0));
  EXPECT_EQ(shape.area, 16);
  EXPECT_FLOAT_EQ(static_cast<float>(shape.size), std::sqrt(32.0F));
  EXPECT_EQ(shape.frame.to_local(shape.frame.to_world({1, 2, 3})), glm::dvec3(1, 2, 3));
}

// A cube on a cube: every coordinate is known.
TEST(Growing, ATemplateIsAlignedWithItsFace) {
  const GrownMesh mesh =
      grown(kSymbols + kCubeBase +
            "[[rule]]\nsymbol = \"a\"\ncorners = 4\n"
            "vertices = [[-0.25, -0.5, 2], [0.5, -0.5, 2], [0.5, 0.5, 2], [-0.5, 0.5, 2]]\n"
            "faces = [[4,5,6,7],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7]]\n"
            "symbols = [\"b(1)\",\"none\",\"none\",\"none\",\"none\"]\n[[step]]\ngrow = 1\n");
  ASSERT_EQ(mesh.mesh.faces(), 10U);
  ASSERT_EQ(mesh.mesh.positions.size(), 12U);
  EXPECT_EQ(faults(mesh.mesh), "");
  // The top's first edge runs along z, so local x is z and local y is x.
  EXPECT_EQ(mesh.mesh.positions[8], glm::vec3(-0.5F, 2.5F, -0.25F));
  EXPECT_EQ(mesh.mesh.positions[9], glm::vec3(-0.5F, 2.5F, 0.5F));
  EXPECT_EQ(mesh.mesh.positions[10], glm::vec3(0.5F, 2.5F, 0.5F));
  EXPECT_EQ(std::count(mesh.mesh.symbols.begin(), mesh.mesh.symbols.end(), 2U), 1);
}

TEST(Growing, TropismBendsTowardsTheWorldsUpAndStopsThere) {
  for (const auto& [degrees, expected] : {std::pair{30, 0.5}, {400, 1.0}, {-30, -0.5}, {0, 0.0}}) {
    const GrownMesh mesh =
        grown(fmt::format("[symbols]\na = []\nb = []\n[base]\nshape = \"cube\"\n"
                          "sides_symbol = \"side == 2 ? a : none\"\n[[rule]]\nsymbol = \"a\"\n"
                          "sections = [{{ tropism = {}, move = 2 }}]\ncap = \"b\"\n"
                          "[[rule]]\nsymbol = \"b\"\nwhen = \"0\"\nsections = [{{ move = 1 }}]\n"
                          "[[step]]\ngrow = 1\n",
                          degrees));
    ASSERT_EQ(mesh.states.size(), 1U);
    EXPECT_NEAR(mesh.states[0].shape.frame.z.y, expected, 1e-6) << degrees;
    EXPECT_NEAR(mesh.states[0].shape.frame.origin.y, 2 * expected, 1e-6) << degrees;
  }
}

TEST(Growing, StretchMayDifferFromCornerToCorner) {
  const GrownMesh mesh = grown(kSymbols + kCubeBase +
                               "[[rule]]\nsymbol = \"a\"\nsections = [{ move = 2, radius = 1, stretch = [\"1 "
                               "+ side\", \"1 + 2*side\"] },\n"
                               "{ move = 1 }]\ncap = \"b(0)\"\n[[step]]\ngrow = 1\n");
  ASSERT_EQ(mesh.mesh.positions.size(), 16U);
  const double side = std::sqrt(0.5);
  for (int i = 0; i < 4; ++i) {
    const glm::vec3 stretched = mesh.mesh.positions[8 + i], after = mesh.mesh.positions[12 + i];
    // The cube's top has its first edge along z or x; the second section is not stretched.
    const double x = side * (1 + i), y = side * (1 + 2 * i);
    EXPECT_NEAR(std::hypot(stretched.x, stretched.z), std::hypot(x, y), 1e-5) << i;
    EXPECT_NEAR(std::hypot(after.x, after.z), 1, 1e-5) << i;
  }
}

TEST(Growing, RulesAreTakenWithTheirProbabilities) {
  const GrownMesh mesh = grown(
      "seed = 3\n[symbols]\na = []\nb = []\nc = []\n[base]\nshape = \"plane\"\ncells = 64\nsymbol = \"a\"\n"
      "[[rule]]\nsymbol = \"a\"\nprobability = 0.2\nsections = [{ move = 0.1 }]\ncap = \"b\"\n"
      "[[rule]]\nsymbol = \"a\"\nprobability = 0.5\nsections = [{ move = 0.1 }]\ncap = \"c\"\n[[step]]\ngrow "
      "= 1\n");
  const auto share = [&](std::uint32_t symbol) {
    return static_cast<double>(std::count(mesh.mesh.symbols.begin(), mesh.mesh.symbols.end(), symbol)) / 4096;
  };
  EXPECT_NEAR(share(2), 0.2, 0.032);  // 5 standard deviations
  EXPECT_NEAR(share(3), 0.5, 0.040);
  EXPECT_EQ(mesh.states.size(), static_cast<std::size_t>(std::lround(4096 * share(1))));
  EXPECT_EQ(faults(mesh.mesh, false), "");
}

TEST(Growing, TheFacesOfOneParentKeepItsSymbolThroughASubdivision) {
  const GrownMesh mesh = grown(
      "[symbols]\nb = [\"p\"]\n[base]\nshape = \"cube\"\ntop = \"b(7)\"\n[[rule]]\nsymbol = \"b\"\n"
      "when = \"p == 7\"\nsections = [{ move = 0.1 }]\n[[step]]\nsubdivide = 1\n[[step]]\ngrow = 1\n");
  EXPECT_EQ(mesh.mesh.faces(), 24 - 4 + 4 * 5U);
  EXPECT_EQ(faults(mesh.mesh), "");
}

bool same(const GrownMesh& a, const GrownMesh& b) {
  return a.mesh.positions == b.mesh.positions && a.mesh.texture == b.mesh.texture &&
         a.mesh.corners == b.mesh.corners && a.mesh.first_corner == b.mesh.first_corner &&
         a.mesh.symbols == b.mesh.symbols && a.parameters == b.parameters;
}

TEST(Growing, IsTheSameForEveryNumberOfThreadsAndStepByStepAndDependsOnTheSeed) {
  for (const char* const name : {"branch_aspen", "bush_tupelo", "cactus", "fractal_plane"}) {
    Model model = parse_model(model_text(name), name);
    const GrownMesh many = expand(model);
    std::size_t steps = 0;
    EXPECT_TRUE(same(expand(model, {.after_step = [&](const GrownMesh&, auto) { ++steps; }}), many)) << name;
    EXPECT_GT(steps, model.steps.size() + 1) << name;
    {
      const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
      EXPECT_TRUE(same(expand(model), many)) << name;
    }
    EXPECT_TRUE(same(expand(model), many)) << name;
    model.system.seed += 1;
    EXPECT_FALSE(same(expand(model), many)) << name;
  }
}

// Random but valid rules: extrusions, tents and pyramids, on every kind of base.
std::string random_rules(std::mt19937& random) {
  const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const auto number = [&](int low, int high) { return (low + pick(high - low)) / 100.0; };
  constexpr const char* kSymbol[] = {"a", "b", "c", "none"};
  const auto symbol = [&] { return kSymbol[pick(4)]; };
  constexpr const char* kBases[] = {"\"cube\"", "\"sphere\"\ncells = 2", "\"prism\"\nsides = 5",
                                    "\"plane\"\ncells = 2"};
  std::string text = fmt::format(
      "seed = {}\n[limits]\nfaces = 20000\n[symbols]\na = []\nb = []\nc = []\n[base]\nshape = {}\n",
      pick(1000), kBases[pick(4)]);
  text += fmt::format("symbol = \"sides_are_four ? {} : none\"\n", symbol());
  text.replace(text.find("sides_are_four"), 14, "side % 2 == 0");
  for (int r = 0; r < 3; ++r) {
    const int kind = pick(3);
    text +=
        fmt::format("[[rule]]\nsymbol = \"{}\"\nwhen = \"{}\"\n", kSymbol[r], kind == 0 ? "1" : "sides == 4");
    if (pick(2) == 0) text += fmt::format("probability = {}\n", number(30, 100));
    if (kind == 0) {
      text += "sections = [";
      for (int s = pick(3); s >= 0; --s) {
        text += fmt::format(
            "{{ move = \"random({}, 1)*size\", turn = [{}, {}, {}], scale = {}, tropism = {}, u = {}, v = "
            "\"step\", sides = \"{}\" }},",
            number(20, 60), pick(40) - 20, pick(40) - 20, pick(60) - 30, number(50, 110), pick(20) - 10,
            number(0, 100), symbol());
      }
      text += fmt::format("]\ncap = \"{}\"\n", symbol());
    } else if (kind == 1) {
      text += fmt::format(
          "corners = 4\nvertices = [{{ mix = [0.5, 0, 0, 0.5], move = [0, 0, \"{0}*size\"] }}, {{ mix = [0, "
          "0.5, 0.5, 0], move = [0, 0, \"{0}*size\"] }}]\nfaces = [[0, 1, 5, 4], [1, 2, 5], [4, 5, 2, 3], "
          "[3, 0, 4]]\nsymbols = [\"{1}\", \"{2}\", \"{1}\", \"none\"]\n",
          number(10, 80), symbol(), symbol());
    } else {
      text += fmt::format(
          "corners = 4\nvertices = [[\"random(-0.2, 0.2)*size\", 0, \"{}*size\"]]\nfaces = [[0, 1, 4], [1, "
          "2, "
          "4], [2, 3, 4], [3, 0, 4]]\nsymbols = \"{}\"\n",
          number(10, 100), symbol());
    }
  }
  for (int s = 1 + pick(2); s >= 0; --s)
    text += pick(3) == 0 ? "[[step]]\nsubdivide = 1\n" : "[[step]]\ngrow = 2\n";
  return text;
}

TEST(Growing, AThousandRandomRuleSystemsStayWellFormedAtEveryStep) {
  std::mt19937 random(12);
  std::size_t grew = 0, refused = 0;
  for (int i = 0; i < 1000; ++i) {
    const std::string text = random_rules(random);
    const Model model = parse_model(text, "random");
    const bool closed = text.find("plane") == std::string::npos;
    try {
      const GrownMesh mesh = expand(model, {.after_step = [&](const GrownMesh& m, auto) {
                                      ASSERT_EQ(faults(m.mesh, closed), "") << text;
                                    }});
      grew += mesh.mesh.faces() > model.base.faces() + 4;
    } catch (const Error& e) {
      EXPECT_THAT(e.what(), testing::AnyOf(testing::HasSubstr("20000"), testing::HasSubstr("degenerate")))
          << text;
      ++refused;
    }
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(grew, 600U);
  EXPECT_LT(refused, 100U);
}

}  // namespace
}  // namespace terrabench::growing
