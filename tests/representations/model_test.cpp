// Models as text: those of the paper, and every kind of bad input.
#include "representations/procedural_mesh/model.h"

#include <fmt/format.h>

#include "tests/representations/growing_models.h"

namespace terrabench::growing {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(Models, OfThePaperAreSmallAndWellFormedAtEveryStep) {
  const std::vector<std::string> names = model_names();
  EXPECT_GE(names.size(), 11U);
  for (const std::string& name : names) {
    const Model model = parse_model(model_text(name), name);
    EXPECT_LT(model.bytes, 8192U) << name;
    EXPECT_FALSE(model.title.empty()) << name;
    const bool closed = name != "fractal_plane";
    const GrownMesh mesh = expand(
        model, {.after_step = [&](const GrownMesh& m) { EXPECT_EQ(faults(m.mesh, closed), "") << name; }});
    EXPECT_GT(mesh.mesh.faces(), 1000U) << name;
  }
}

TEST(Models, CactusWithSpikesIsTheSmoothOneBeforeItsSpikes) {
  const GrownMesh smooth = expand(parse_model(model_text("cactus_smooth"), "smooth"));
  const Model cactus = parse_model(model_text("cactus"), "cactus");
  const GrownMesh without = expand(cactus, {.leave_out = {"spikes"}});
  EXPECT_EQ(without.mesh.positions, smooth.mesh.positions);
  EXPECT_EQ(without.mesh.corners, smooth.mesh.corners);
  const GrownMesh with = expand(cactus);
  EXPECT_GT(with.mesh.faces(), 2 * smooth.mesh.faces());
  // Spikes leave the vertices of the skin where they are.
  EXPECT_TRUE(
      std::equal(smooth.mesh.positions.begin(), smooth.mesh.positions.end(), with.mesh.positions.begin()));
}

TEST(Models, TwoSpeciesHaveFoliage) {
  for (const char* const name : {"branch_aspen", "bush_tupelo"}) {
    const Model model = parse_model(model_text(name), name);
    const GrownMesh tree = expand(model);
    std::size_t leaves = 0;
    for (const std::uint32_t symbol : tree.mesh.symbols)
      leaves += model.system.symbols[symbol].name == "green";
    EXPECT_GT(leaves, tree.mesh.faces() / 3) << name;
  }
}

const std::string kRule = "[[rule]]\nsymbol = \"a\"\n";
const std::string kExtrude = "sections = [{ move = 1 }]\n";
const std::string kHead = kSymbols + kCubeBase;  // 6 lines

TEST(Models, BadInputIsRefusedWithLineAndColumn) {
  const auto refused = [](const std::string& text) { return error_of(text); };
  EXPECT_THAT(refused(""), HasSubstr("'base' is missing"));
  EXPECT_THAT(refused("[bsae]"), HasSubstr("'base' is missing; is it meant by 'bsae' in line 1?"));
  EXPECT_THAT(refused("[base"), StartsWith("m:1"));
  EXPECT_THAT(refused(kHead + kRule), AllOf(StartsWith("m:7:"), HasSubstr("a rule without a template")));
  EXPECT_THAT(refused(kHead + kRule + "faces = [[0, 1, 2]]\n"), HasSubstr("a rule without base"));
  EXPECT_THAT(refused(kHead + "[[rule]]\nsymbol = \"z\"\n" + kExtrude),
              AllOf(StartsWith("m:8:10"), HasSubstr("unknown symbol 'z'")));
  EXPECT_THAT(refused(kHead + kRule + kExtrude + "cap = \"zz\"\n"),
              AllOf(StartsWith("m:10:8"), HasSubstr("unknown symbol 'zz'")));
  EXPECT_THAT(refused(kHead + kRule + kExtrude + "cap = \"b\"\n"), HasSubstr("'b' has 1 parameters, got 0"));
  EXPECT_THAT(refused(kHead + kRule + kExtrude + "wehn = 1\n"),
              AllOf(StartsWith("m:10:"), HasSubstr("'wehn'")));
  EXPECT_THAT(refused(kHead + "[[step]]\n"), HasSubstr("either grow or subdivide"));
  EXPECT_THAT(refused(kHead + "[[step]]\ngrow = \"al\"\n"), StartsWith("m:8:8"));
  EXPECT_THAT(refused("seed = -1\n" + kHead), StartsWith("m:1:8"));
  EXPECT_THAT(refused(std::string(2 << 20, ' ')), HasSubstr("at most"));
}

TEST(Models, NumbersThatAreNotFiniteAreRefusedWhereTheyAreWritten) {
  const std::string grow = "[[step]]\ngrow = 1\n";
  EXPECT_THAT(
      error_of(kHead + kRule + "sections = [{ move = \"1/(px - px)\" }]\n" + grow),
      AllOf(StartsWith("m:9:23: the value is not a finite number"), HasSubstr("'a' grows in step 1")));
  EXPECT_THAT(error_of(kHead + kRule + kExtrude + "cap = \"b(log(px - px - 1))\"\n" + grow),
              StartsWith("m:10:10"));
  EXPECT_THAT(error_of(kHead + kRule + "when = \"0/0\"\n" + kExtrude + grow), StartsWith("m:9:9"));
  EXPECT_THAT(error_of("[constants]\nc = \"1/0\"\n" + kHead), StartsWith("m:2:5"));
  EXPECT_THAT(error_of(kHead + "[[step]]\nsubdivide = 1\ndisplace = { amount = \"1/0\" }\n"),
              StartsWith("m:9:24: the value is not a finite number"));
}

TEST(Models, ContradictionsInARuleAreRefused) {
  const std::string grow = "[[step]]\ngrow = 1\n";
  EXPECT_THAT(error_of(kHead + kRule + "sections = [{ move = 1, scale = 0.5, radius = 2 }]\n" + grow),
              HasSubstr("both 'scale' and 'radius'"));
  for (const char* const value : {"-0.5", "\"0.5 - step - 1\""}) {
    EXPECT_THAT(error_of(kHead + kRule + "probability = " + value + "\n" + kExtrude + grow),
                AllOf(StartsWith("m:9:1"), HasSubstr("a probability is negative")));
  }
}

TEST(Models, TemplatesThatDoNotFitAreRefused) {
  const auto faces = [](const std::string& text) {
    return error_of(kHead + kRule + "corners = 4\nvertices = [[0, 0, 1], [0, 0.1, 1]]\nfaces = " + text +
                    "\n");
  };
  EXPECT_THAT(faces("[[0,1,4],[1,2,4],[2,3,4]]"), HasSubstr("does not fit its face"));
  EXPECT_THAT(faces("[[0,4,1],[1,2,4],[2,3,5],[3,0,5]]"), HasSubstr("used twice"));
  EXPECT_THAT(faces("[[0,1,4],[1,2,4],[2,3,4],[3,0,4]]"), HasSubstr("vertex 5 belongs to no face"));
  EXPECT_THAT(faces("[[0,1,4],[1,2,4],[2,3,4],[3,0,5]]"), HasSubstr("has one face only"));
  EXPECT_THAT(faces("[[0,1,2],[0,2,3]]"), HasSubstr("joins two corners of the base"));
  EXPECT_THAT(faces("[[0,1,4,4],[1,2,4],[2,3,4],[3,0,4]]"), HasSubstr("a corner twice"));
  EXPECT_THAT(faces("[[0,1,9]]"), HasSubstr("names vertex 9 of 6"));
  EXPECT_THAT(faces("[[0,1]]"), HasSubstr("fewer than 3"));
  const std::string three =
      "[[rule]]\nsymbol = \"a\"\ncorners = 3\nvertices = [[0, 0, 1]]\nfaces = [[0,1,3],[1,2,3],[2,0,3]]\n";
  EXPECT_THAT(error_of(kHead + three + "[[step]]\ngrow = 1\n"), HasSubstr("another number of corners"));
  EXPECT_THAT(error_of(kHead + kRule + "sections = [{ move = 1, scale = 0 }]\n[[step]]\ngrow = 1\n"),
              HasSubstr("degenerate face"));
  EXPECT_THAT(error_of(kHead + kRule + "sections = [{ move = 0 }]\n[[step]]\ngrow = 1\n"),
              HasSubstr("degenerate face"));
}

TEST(Models, GrowthWithoutEndStopsAtTheLimits) {
  EXPECT_THAT(
      error_of(kHead + kRule + kExtrude + "cap = \"a\"\n[[step]]\ngrow = \"all\"\n[limits]\nsteps = 100\n"),
      HasSubstr("still grows after 100 steps"));
  const std::string all = "[symbols]\na = []\n[base]\nshape = \"cube\"\nsymbol = \"a\"\n" + kRule +
                          "sections = [{ move = 1, sides = \"a\" }]\ncap = \"a\"\n";
  EXPECT_THAT(error_of("[limits]\nfaces = 50000\n" + all + "[[step]]\ngrow = \"all\"\n"),
              HasSubstr("beyond 50000 faces"));
  EXPECT_THAT(error_of("[base]\nshape = \"cube\"\n[[step]]\nsubdivide = 14\n"),
              HasSubstr("more than 10000000"));
  EXPECT_THAT(error_of("[limits]\nfaces = 10\n[base]\nshape = \"plane\"\ncells = 9\n"),
              HasSubstr("more than 10"));
}

TEST(Models, FacesThatAreReplacedDoNotPileUp) {
  const std::string swap = "corners = 4\nfaces = [[0,1,2,3]]\nsymbols = \"a\"\n";
  const std::string text = "[symbols]\na = []\n[base]\nshape = \"plane\"\ncells = 64\nsymbol = \"a\"\n" +
                           kRule + swap + "[[step]]\ngrow = 200\n";
  const GrownMesh mesh = expand(parse_model(text, "swap"));
  EXPECT_EQ(mesh.mesh.faces(), 4096U);
  EXPECT_EQ(mesh.states.size(), 4096U);
  EXPECT_LT(mesh.mesh.corners.capacity(), std::size_t{200} * 4096 * 4 / 4);
  // The first and the last face keep their places.
  const FaceMesh plane = expand(parse_model("[base]\nshape = \"plane\"\ncells = 64\n", "plane")).mesh;
  EXPECT_EQ(mesh.mesh.corners, plane.corners);
}

TEST(Models, GrowthThatOnlyReplacesItsFacesEnds) {
  const std::string swap = "corners = 4\nfaces = [[0,1,2,3]]\nsymbols = \"a\"\n";
  EXPECT_THAT(error_of("[limits]\nfaces = 4096\nsteps = 1000000\n[symbols]\na = []\n[base]\nshape = "
                       "\"plane\"\ncells = 64\nsymbol = \"a\"\n" +
                       kRule + swap + "[[step]]\ngrow = \"all\"\n"),
              HasSubstr("with those that it replaces"));
}

TEST(Models, TheLimitOfFacesIsExact) {
  const auto text = [](int most) {
    return fmt::format(
        "[limits]\nfaces = {}\n[symbols]\na = []\n[base]\nshape = \"plane\"\ncells = 4\n"
        "symbol = \"a\"\n[[rule]]\nsymbol = \"a\"\nwhen = \"px > 0.3 && pz > 0.3\"\n"
        "sections = [{{ move = 1 }}]\n[[step]]\ngrow = 1\n",
        most);
  };
  EXPECT_EQ(expand(parse_model(text(20), "exact")).mesh.faces(), 20U);
  EXPECT_THAT(error_of(text(19)), HasSubstr("beyond 19 faces"));
}

TEST(Models, CornersOfFacesAreLimited) {
  // A disc of two faces with very many corners each, for every face.
  std::string text = "[limits]\nfaces = 100000\n" +
                     std::string("[symbols]\na = []\nb = []\n[base]\nshape = ") +
                     "\"plane\"\ncells = 64\nsymbol = \"a\"\n[[rule]]\nsymbol = \"a\"\ncorners = 4\n";
  std::string vertices, around;
  for (int k = 0; k < 400; ++k) {
    vertices += fmt::format("[{}, {}, 0.1],", 0.001 * k, 0.001 * k * k);
    around += fmt::format("{},", 4 + k);
  }
  text += "vertices = [" + vertices + "]\nfaces = [[0, 1, " + around + "], [1, 2, 3, 0, ";
  for (int k = 399; k >= 0; --k) text += fmt::format("{}, ", 4 + k);
  text += "]]\n[[step]]\ngrow = 1\n";
  EXPECT_THAT(error_of(text), HasSubstr("corners of faces"));
}

TEST(Models, LongExpressionsForManyFacesAreRefused) {
  std::string sum = "1";
  for (int k = 0; k < 2000; ++k) sum += "+1";
  EXPECT_THAT(error_of("[symbols]\na = [\"p\"]\n[base]\nshape = \"plane\"\ncells = 1024\nsymbol = \"a(" +
                       sum + ")\"\n"),
              HasSubstr("too long for so many faces"));
  EXPECT_THAT(error_of("[limits]\nfaces = 1000\n[base]\nshape = \"sphere\"\ncells = 256\n"),
              HasSubstr("393216 faces, more than 1000"));
}

TEST(Models, NamesOfSymbolsAreNoVariables) {
  EXPECT_THAT(error_of("[symbols]\nsize = []\n[base]\nshape = \"cube\"\n"), HasSubstr("already in use"));
  EXPECT_THAT(error_of("[symbols]\na = [\"b\"]\nb = []\n[base]\nshape = \"cube\"\n"),
              HasSubstr("has the name of a symbol"));
}

TEST(Models, BaseMeshesMustBeWellFormed) {
  const auto base = [](const std::string& faces) {
    return error_of("[base]\nvertices = [[0,0,0],[1,0,0],[1,1,0],[0,1,0],[2,0,0],[2,1,1],[0,0,0]]\nfaces = " +
                    faces + "\n");
  };
  EXPECT_THAT(base("[[0,1,2],[0,1,3]]"), HasSubstr("the edge from 0 to 1"));
  EXPECT_THAT(base("[[0,1,9]]"), HasSubstr("names vertex 9 of 7"));
  EXPECT_THAT(base("[[0,1,1]]"), HasSubstr("a corner twice"));
  EXPECT_THAT(base("[[0,1]]"), HasSubstr("has 2 corners"));
  EXPECT_THAT(base("[[0,1,4]]"), HasSubstr("has no area"));
  EXPECT_THAT(base("[[0,1,2]]"), HasSubstr("belongs to no face"));
  EXPECT_THAT(base("[]"), HasSubstr("no face"));
  EXPECT_THAT(
      error_of("[base]\nvertices = [[0,0,0],[1,0,0],[0,1,0],[-1,0,0],[0,-1,0]]\nfaces = [[0,1,2],[0,3,4]]\n"),
      HasSubstr("joins two fans"));
  EXPECT_THAT(error_of("[base]\nshape = \"ball\"\n"), HasSubstr("unknown shape 'ball'"));
  EXPECT_THAT(error_of("[base]\nshape = \"cube\"\nsize = [1, 0, 1]\n"), HasSubstr("above 0"));
}

}  // namespace
}  // namespace terrabench::growing
