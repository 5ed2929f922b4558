#include "experiments/drill/ground.h"

#include "experiments/noise_ground.h"
#include "terrain/error.h"

namespace terrabench::drill {
namespace {

constexpr int kPaperSize = 400;

TerrainSource from_heights(std::string_view name, Heightfield heights) {
  TerrainSource source;
  source.name = name;
  source.checksum = checksum(heights);
  source.heights = std::move(heights);
  return source;
}

}  // namespace

TerrainSource open_ground(std::string_view name, std::uint64_t seed) {
  if (name == "noise-ridges") return from_heights(name, whole_metres(noise_ridges(kPaperSize, seed)));
  if (name == "noise-hills") return from_heights(name, whole_metres(noise_hills(kPaperSize, seed)));
  if (name == "jacksboro-400") {
    return from_heights(name, resample(*open_terrain("jacksboro").heights, kPaperSize, kPaperSize));
  }
  TerrainSource source = open_terrain(name, seed);
  if (!source.heights) {
    throw usage_error("drills need a height field, not a solid", name, "name a terrain of heights");
  }
  return source;
}

std::vector<std::string> grounds(const RunOptions& options) {
  if (!options.terrains.empty()) return options.terrains;
  std::vector<std::string> names{std::string(kMainGround)};
  if (options.profile == Profile::kPaper) {
    names.insert(names.end(), {"jacksboro", "noise-ridges", "noise-hills"});
  }
  return names;
}

std::vector<Case> ground_cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const std::string& ground : grounds(options)) cases.push_back({ground, {}, ground});
  return cases;
}

}  // namespace terrabench::drill
