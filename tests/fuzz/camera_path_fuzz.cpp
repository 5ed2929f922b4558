// Camera paths: any text either throws Error or gives a path whose views pass check_view().
#include <string_view>

#include "lod/camera/camera_path.h"
#include "terrain/error.h"
#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace terrabench;
  Heightfield ground;
  ground.width = 3;
  ground.depth = 2;
  ground.heights = {1, 2, 3, 4, 5, 6};
  try {
    views(parse_camera_path(fuzz_text(data, size), "fuzz", "fuzz"), ground);
  } catch (const Error&) {
  }
  return 0;
}

FuzzSeeds fuzz_seeds() {
  constexpr std::string_view kHead = R"(field_of_view = 60
screen = [800, 600]
frames_per_second = 25
origin = [0.5, 0.25]
near = 0.1
)";
  constexpr std::string_view kPaths[] = {
      "kind = \"walk\"\nunit = \"m\"\nspeed = 2\nkeyframe = [{at = [0, 1]}, {at = [1e1, -2.5], speed = 3}, "
      "{at = [4, 4]}]\n",
      "kind = \"fly\"\nunit = \"extent\"\nkeyframe = [{at = [0, 0], height = 0.1, speed = 1, look_at = [1, "
      "1]},"
      " {at = [1, 0], height = 9, speed = 1, look_at = [2, 2]}]\n",
      "kind = \"turn\"\nspeed = 90\nkeyframe = [{at = [0, 0], heading = 0, pitch = -10}, {heading = 180}]\n",
      "k\u00efnd = 1\n",
      "kind = \u03c4\n",  // beyond ASCII: toml++ 3.3.0 alone has undefined behaviour here
      "'kind' = \"\"\"\\\n \u00e9\"\"\" # \u03c4\n"};
  FuzzSeeds seeds;
  for (const std::string_view path : kPaths) {
    std::vector<std::uint8_t> seed(kHead.begin(), kHead.end());
    seed.insert(seed.end(), path.begin(), path.end());
    seeds.push_back(seed);
  }
  return seeds;
}
