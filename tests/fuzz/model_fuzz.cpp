// Models of mesh growing: any text is read or refused with an Error, and what was read is expanded or refused
// with an Error, within small limits.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "representations/procedural_mesh/model.h"
#include "terrain/error.h"
#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace terrabench;
  using namespace terrabench::growing;
  try {
    Model model = parse_model(fuzz_text(data, size), "fuzz");
    const Limits limits{.faces = 2000, .steps = 30};
    if (model.base.faces() > limits.faces) return 0;
    model.limits = limits;
    for (Step& step : model.steps) step.growth.limits = limits;
    model.steps.resize(std::min<std::size_t>(model.steps.size(), 8));
    const GrownMesh mesh = expand(model);
    if (mesh.mesh.faces() > limits.faces || mesh.mesh.faces() == 0) std::abort();
    for (const std::uint32_t corner : mesh.mesh.corners) {
      if (corner >= mesh.mesh.positions.size()) std::abort();
    }
  } catch (const Error&) {
  }
  return 0;
}

FuzzSeeds fuzz_seeds() {
  FuzzSeeds seeds;
  for (const std::string& name : terrabench::growing::model_names()) {
    const std::string_view text = terrabench::growing::model_text(name);
    seeds.emplace_back(text.begin(), text.end());
  }
  constexpr std::string_view kSmall = R"toml(seed = 1
[constants]
c = [1, 2, 3]
d = "2*3"
[symbols]
a = ["p", "q"]
b = []
[base]
shape = "cube"
cells = [1, 2, 1]
top = "side == 4 ? a(1, 2) : b"
crease = 1
[[rule]]
symbol = "a"
when = "p < 4 && random() >= 0"
probability = "0.9"
let = { r = "random(0.5, 1)*c[p % 3]" }
base = { u = 0, v = 1 }
sections = [{ move = [0, 0, "r"], turn = [1, "q", 0], tropism = -5, scale = 0.8, crease = 2, u = 0, v = "side/sides" }]
cap = "a(p + 1, d/q)"
[[rule]]
symbol = "b"
when = "size > 0.1 || area > 1"
corners = 4
vertices = [{ mix = [0.25, 0.25, 0.25, 0.25], move = [0, 0, 0.1] }]
faces = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
symbols = "none"
texture = [[0, 0], [0, 1], [1, 1], [1, 0], [0.5, 0.5]]
creases = [[0, 1, 2]]
[[step]]
grow = 2
only = ["a"]
[[step]]
name = "x"
subdivide = 1
place = "linear"
bound = 0.5
displace = [{ along = [0, 1, 0], unit = "metre", amount = "0.1*noise(x, y, z)" }, { along = "tangent", amount = 0.1 }]
[[step]]
grow = "all"
)toml";
  seeds.emplace_back(kSmall.begin(), kSmall.end());
  return seeds;
}
