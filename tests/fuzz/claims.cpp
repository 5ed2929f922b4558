// Claims files: any text is read or refused with an Error.
#include "results/claims/claims.h"

#include <string_view>

#include "terrain/error.h"
#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    terrabench::parse_claims({reinterpret_cast<const char*>(data), size}, "fuzz");
  } catch (const terrabench::Error&) {
  }
  return 0;
}

std::vector<std::vector<std::uint8_t>> fuzz_seeds() {
  constexpr std::string_view kSeed = R"(paper = "p"
title = "t"
source = "s"
[[claim]]
id = "p.1"
where = "Table 1"
statement = "s"
class = "T"
reported = [1, 2.5]
profiles = ["paper"]
check = [{equal = ["e/c/m", 3]}, {order = [1, "e/c/m"]}, {within = ["e/c/m"], range = [0.5, 1]},
  {growth = ["e/c/m", "e/d/m"], range = [-1, 2]}, {figure = "p.F1"}]
[sets]
px = ["1", "2"]
on = [{name = "a", at = "b"}]
of = ["x", "y"]
out = {of = "on", with = ["at"], without = ["a"], except = []}
[[claim]]
each = ["on", "px"]
id = "p.{on}.{px}"
where = "{on.at}"
statement = ""
class = "E"
check = [{equal = ["e/{on}/{of}", 1]}, {each = ["of"], equal = ["e/{on.at}/{px}{of}", "e/c/m"]}]
[[claim]]
id = "p.2"
where = ""
statement = ""
class = "Q"
not_comparable = "later"
[[table]]
id = "p.t"
title = "t"
caption = "c"
experiment = "e"
rows_title = "r"
rows = [{label = "l", case = "c", a = 1, claim = "p.1"}]
columns = [{title = "A", unit = "B", reported = "a"}, {title = "S", speed_up = ["a", "m"]}, {title = "V", verdict = "claim"}]
[[plot]]
id = "p.p"
title = "t"
caption = "c"
x = {label = "x", log = true}
y = {label = "y", unit = "s"}
series = [{label = "l", values = [[1, 2]], slope = true}, {label = "m", experiment = "e", metric = "m", cases = [[1, "c"]]}]
)";
  // Beyond ASCII: in bare places toml++ 3.3.0 alone has undefined behaviour.
  constexpr std::string_view kBeyondAscii[] = {
      "pap\u00e9r = 1\n", "paper = \u03c4\n",
      "paper = \"\"\"\\\n \u00e9\"\"\"\ntitle = '\u03c4 \\'  # \u00b2\n"};
  std::vector<std::vector<std::uint8_t>> seeds = {{kSeed.begin(), kSeed.end()}};
  for (const std::string_view seed : kBeyondAscii) seeds.emplace_back(seed.begin(), seed.end());
  return seeds;
}
