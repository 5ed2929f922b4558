// Event files: any text is read or refused with an Error; what was read is equal after writing and reading,
// and its events are evaluated or refused with an Error.
#include <cstdlib>

#include "terrain/error.h"
#include "terrain/events/evaluate.h"
#include "terrain/events/event_file.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace terrabench;
using namespace terrabench::events;

void evaluate_columns(const Script& script) {
  Heightfield ground{33, 33, 2, 2, std::vector<float>(33 * 33, 20), {}};
  for (int i = 0; i < 33; ++i) ground.at(16, i) = 40;
  const Evaluation after(std::make_shared<const Sculpture>(Sculpture{std::move(ground), script.events}));
  std::vector<Stretch> solid;
  for (double x = 0; x <= 64; x += 8) {
    after.column({x, x / 2}, solid);
    if (solid.empty() || solid.front().top > after.bounds().high.y) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const Script script = parse_script(fuzz_text(data, size), "fuzz");
    const std::string text = to_text(script);
    if (to_text(parse_script(text, "copy")) != text) std::abort();
    evaluate_columns(script);
  } catch (const Error&) {
  }
  return 0;
}

FuzzSeeds fuzz_seeds() {
  constexpr std::string_view kSeeds[] = {
      R"(terrain = "t"
seed = 1
size = 65
[[event]]
kind = "linear-erosion"
from = [10, 20.5]
to = [30, 40]
depth = 3
slope = 40
[[event]]
kind = "radial-erosion"
centre = [30, 20, 30]
radii = [8, 2e0, 6]
[[event]]
kind = "normal-fault"
from = [20, 20]
to = [40, 30]
extent = 9
throw = 2
dip = 60
)",
      R"(terrain = "t"
[[event]]
kind = "inverse-fault"
from = [20, 20]
to = [40, 30]
extent = 9
throw = 2
[[event]]
kind = "lateral-fault"
from = [20, 20]
to = [40, 30]
extent = 9
slip = 3
)",
      R"(terrain = "t"
[[event]]
kind = "tunnel"
from = [31.5, 30, 20]
to = [32.5, 30, 20]
section = [[-1, 0], [1, 0], [0, 1]]
scale_to = 0.9
roughness = 0.01
seed = 7
[[event]]
kind = "cave"
from = [31.5, 30, 40]
to = [32.5, 30, 41]
section = [[-1, 0], [1, 0], [0, 1]]
)",
      "\"t\u00e9\" = 1\n",  // beyond ASCII: toml++ 3.3.0 alone has undefined behaviour for some of them
      "t\u00e9 = 1\n",     "terrain = \u03c4\n",
      "seed = 1\u00a1\n",  "terrain = \"\"\"\\\n \u00e9\"\"\" # \u03c4\nsize = 65\n"};
  return seeds_of(kSeeds);
}
