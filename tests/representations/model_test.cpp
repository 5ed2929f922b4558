// Models as text: those of the paper, and every kind of bad input.
#include "representations/procedural_mesh/model.h"

#include <fmt/format.h>

#include "tests/representations/growing_models.h"

namespace terrabench::growing {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(Models, OfThePaperAreSmallAndWellFormedOnTheWay) {
  const std::vector<std::string> names = model_names();
  EXPECT_GE(names.size(), 11U);
  for (const std::string& name : names) {
    const Model model = parse_model(model_text(name), name);
    EXPECT_LT(model.bytes, 8192U) << name;
    EXPECT_FALSE(model.title.empty()) << name;
    const bool closed = name != "fractal_plane";
    std::uint32_t checked = 0;  // the growing steps of a tree are many: one in ten
    const auto check = [&](const GrownMesh& mesh, std::uint32_t subdivisions) {
      if (checked++ % 10 == 0 || subdivisions > 0) {
        EXPECT_EQ(faults(mesh.mesh, closed), "") << name;
      }
    };
    const GrownMesh mesh = expand(model, {.after_step = check});
    EXPECT_EQ(faults(mesh.mesh, closed), "") << name;
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

const std::string kGrow = "[[step]]\ngrow = 1\n";

std::string rule(const std::string& rest) { return kHead + kRule + rest; }
std::string sections(const std::string& one) { return rule("sections = [{ " + one + " }]\n" + kGrow); }
std::string faces(const std::string& list) {
  return rule("corners = 4\nvertices = [[0, 0, 1], [0, 0.1, 1]]\nfaces = " + list + "\n");
}
std::string base(const std::string& list) {
  return "[base]\nvertices = [[0,0,0],[1,0,0],[1,1,0],[0,1,0],[2,0,0],[2,1,1],[-1,0,0],[0,-1,0]]\nfaces = " +
         list + "\n";
}

TEST(Models, BadInputIsRefusedWithLineAndColumn) {
  const std::string a = "[symbols]\na = []\n", all = "[[step]]\ngrow = \"all\"\n";
  std::string sum = "1";
  for (int k = 0; k < 2000; ++k) sum += "+1";
  const std::string three = "corners = 3\nvertices = [[0, 0, 1]]\nfaces = [[0,1,3],[1,2,3],[2,0,3]]\n";
  const struct {
    std::string text, place, what;
  } refused[] = {
      {"", "", "'base' is missing"},
      {"[bsae]", "", "'base' is missing; is it meant by 'bsae' in line 1?"},
      {"[base", "m:1", ""},
      {std::string(2 << 20, ' '), "", "at most"},
      {"seed = -1\n" + kHead, "m:1:8", ""},
      {"[base]\nshape = \"ball\"\n", "m:2:9", "'ball'"},
      {"[base]\nshape = \"cube\"\nsize = [1, 0, 1]\n", "m:1:", "above 0"},
      {kHead + "creases = [[0, 6, 1]]\n", "m:7:12", "no face has an edge from 0 to 6"},
      {kHead + "[[step]]\n", "m:7:", "either grow or subdivide"},
      {kHead + "[[step]]\ngrow = \"al\"\n", "m:8:8", ""},
      {kHead + "[[rule]]\nsymbol = \"z\"\n" + kExtrude, "m:8:10", "unknown symbol 'z'"},
      {rule(""), "m:7:", "a rule without a template"},
      {rule("faces = [[0, 1, 2]]\n"), "m:7:", "'corners' is missing"},
      {rule(kExtrude + "cap = \"zz\"\n"), "m:10:8", "unknown symbol 'zz'"},
      {rule(kExtrude + "cap = \"b\"\n"), "m:10:", "'b' has 1 parameters, got 0"},
      {rule(kExtrude + "wehn = 1\n"), "m:10:", "'wehn'"},
      {sections("move = 1, scale = 0.5, radius = 2"), "m:9:", "both 'scale' and 'radius'"},
      // While it grows or is subdivided.
      {sections("move = \"1/(px - px)\""), "m:9:23: the value is not a finite number", "'a' grows in step 1"},
      {rule(kExtrude + "cap = \"b(log(px - px - 1))\"\n" + kGrow), "m:10:10", ""},
      {rule("when = \"0/0\"\n" + kExtrude + kGrow), "m:9:9", ""},
      {"[constants]\nc = \"1/0\"\n" + kHead, "m:2:5", ""},
      {kHead + "[[step]]\nsubdivide = 1\ndisplace = { amount = \"1/0\" }\n", "m:9:24", "not a finite number"},
      {rule("probability = -0.5\n" + kExtrude + kGrow), "m:9:1", "a probability is negative"},
      {rule("probability = \"0.5 - step - 1\"\n" + kExtrude + kGrow), "m:9:1", "a probability is negative"},
      {sections("move = 1, scale = 0"), "m:7:", "degenerate face"},
      {sections("move = 0"), "m:7:", "degenerate face"},
      {rule(three + kGrow), "m:7:", "another number of corners"},
      // Names, and limits.
      {"[symbols]\nsize = []\n[base]\nshape = \"cube\"\n", "m:2:", "already in use"},
      {"[symbols]\na = [\"b\"]\nb = []\n[base]\nshape = \"cube\"\n", "m:1:", "has the name of a symbol"},
      {rule(kExtrude + "cap = \"a\"\n" + all + "[limits]\nsteps = 100\n"), "m",
       "still grows after 100 steps"},
      {"[limits]\nfaces = 50000\n" + a + "[base]\nshape = \"cube\"\nsymbol = \"a\"\n" + kRule +
           "sections = [{ move = 1, sides = \"a\" }]\ncap = \"a\"\n" + all,
       "m", "beyond 50000 faces"},
      {"[limits]\nfaces = 4096\nsteps = 1000000\n" + a +
           "[base]\nshape = \"plane\"\ncells = 64\nsymbol = \"a\"\n" + kRule +
           "corners = 4\nfaces = [[0,1,2,3]]\nsymbols = \"a\"\n" + all,
       "m", "with those that it replaces"},
      {"[base]\nshape = \"cube\"\n[[step]]\nsubdivide = 14\n", "m:3:", "more than 10000000"},
      {"[limits]\nfaces = 10\n[base]\nshape = \"plane\"\ncells = 9\n", "m:3:", "more than 10"},
      {"[limits]\nfaces = 1000\n[base]\nshape = \"sphere\"\ncells = 256\n",
       "m:3:", "393216 faces, more than 1000"},
      {"[symbols]\na = [\"p\"]\n[base]\nshape = \"plane\"\ncells = 1024\nsymbol = \"a(" + sum + ")\"\n", "m",
       "too long for so many faces"},
      // Templates and bases that are not well formed.
      {faces("[[0,1,4],[1,2,4],[2,3,4]]"), "m:11:9", "does not fit its face"},
      {faces("[[0,4,1],[1,2,4],[2,3,5],[3,0,5]]"), "m:11:9", "in the same direction"},
      {faces("[[0,1,4],[1,2,4],[2,3,4],[3,0,4]]"), "m:11:9", "vertex 5 belongs to no face"},
      {faces("[[0,1,4],[1,2,4],[2,3,4],[3,0,5]]"), "m:11:9", "has one face only"},
      {faces("[[0,1,2],[0,2,3]]"), "m:11:9", "joins two corners of the base"},
      {faces("[[0,1,4,4],[1,2,4],[2,3,4],[3,0,4]]"), "m:11:9", "vertex 4 twice"},
      {faces("[[0,1,9]]"), "m:11:9", "vertex 9 of 6"},
      {faces("[[0,1]]"), "m:11:9", "2 corners"},
      {base("[[0,1,2],[0,1,3]]"), "m:1:", "the edge from vertex 0 to 1"},
      {base("[[0,1,9]]"), "m:1:", "vertex 9 of 8"},
      {base("[[0,1,1]]"), "m:1:", "vertex 1 twice"},
      {base("[[0,1]]"), "m:1:", "2 corners"},
      {base("[[0,1,4]]"), "m:1:", "has no area"},
      {base("[[0,1,2]]"), "m:1:", "belongs to no face"},
      {base("[[0,1,3],[0,6,7],[2,4,5]]"), "m:1:", "joins two fans"},
      {base("[]"), "m:1:", "no face"}};
  for (const auto& [text, place, what] : refused) {
    EXPECT_THAT(error_of(text), AllOf(StartsWith(place), HasSubstr(what))) << text;
  }
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

}  // namespace
}  // namespace terrabench::growing
