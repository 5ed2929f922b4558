#include "experiments/drill/ground.h"

namespace terrabench::drill {

TerrainSource open_ground(std::string_view name, std::uint64_t seed) {
  constexpr int kPaperSize = 400;
  if (name == "noise-ridges") return source_of(name, whole_metres(noise_ridges(kPaperSize, seed)));
  if (name == "noise-hills") return source_of(name, whole_metres(noise_hills(kPaperSize, seed)));
  if (name == kMainGround) {
    return source_of(name, resample(*open_terrain("jacksboro").heights, kPaperSize, kPaperSize));
  }
  return open_heights(name, seed);
}

std::vector<std::string> grounds(const RunOptions& options) {
  const std::string main(kMainGround);
  if (options.profile == Profile::kQuick) return terrabench::grounds(options, {main});
  return terrabench::grounds(options, {main, "jacksboro", "noise-ridges", "noise-hills"});
}

}  // namespace terrabench::drill
