// Event files: any text is read or refused with an Error; what was read is equal after writing and reading,
// and its events are evaluated or refused with an Error.
#include <cstdlib>

#include "terrain/error.h"
#include "terrain/events/evaluate.h"
#include "terrain/events/event_file.h"
#include "terrain/events/scripts.h"
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
  std::vector<std::string_view> seeds = {
      "\"t\u00e9\" = 1\n",  // beyond ASCII: toml++ 3.3.0 alone has undefined behaviour for some of them
      "t\u00e9 = 1\n", "terrain = \u03c4\n", "seed = 1\u00a1\n",
      "terrain = \"\"\"\\\n \u00e9\"\"\" # \u03c4\nsize = 65\n"};
  for (const char* const name : {"canyon", "cave", "inverse-fault", "lateral-fault", "linear-erosion",
                                 "normal-fault", "radial-erosion", "tunnel"})
    seeds.push_back(script_text(name));
  return seeds_of(seeds);
}
