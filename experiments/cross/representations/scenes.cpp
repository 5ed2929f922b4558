#include "experiments/cross/representations/scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/cross/files/temporary_folder.h"
#include "experiments/ght/site.h"
#include "experiments/ground.h"
#include "terrain/events/event_file.h"
#include "terrain/files.h"
#include "terrain/sources/fractal/diamond_square.h"

namespace terrabench::cross {
namespace {

// The sequence of all kinds of event of the GHT paper's complex terrain, as ght.complex applies it.
TerrainSource sequence(std::uint64_t seed) {
  constexpr int kSide = 128;
  const ght::Site site = ght::make_site(kSide, kSide / ght::kEventsAlong, seed);
  return events::open_script(
      events::to_text(events::Script{"diamond-square", seed, kSide + 1, ght::overlapping_events(site), {}}),
      "sequence");
}

// The middle of maine: types are built many times, and the whole tile has ten times the samples of the other
// DEMs.
TerrainSource middle_of(const TerrainSource& source) {
  constexpr int kSide = 513;
  const Heightfield& all = *source.heights;
  const int i0 = (all.width - kSide) / 2, j0 = (all.depth - kSide) / 2;
  TerrainSource part = source_of(source.name, crop(all, i0, j0, kSide, kSide));
  part.notes = source.notes;
  part.notes.push_back(fmt::format("the middle {0} × {0} of {1} × {2} samples", kSide, all.width, all.depth));
  return part;
}

TerrainSource open(const SceneOptions& options) {
  if (options.terrain == "sequence") return sequence(options.seed);
  if (options.terrain == "fractal") {
    return source_of("fractal", fractal::diamond_square({.seed = options.seed, .side = options.size}));
  }
  TerrainSource source = open_terrain(options.terrain, options.seed);
  if (options.terrain == "maine") source = middle_of(source);
  return source;
}

}  // namespace

Parameters Scene::parameters(const RepresentationType& type, std::int64_t columns) const {
  Parameters parameters(type.parameters);
  const bool sculpted = source.events && parameters.has("events");
  if (columns == 0 && source.solid && !sculpted) columns = options.resolution;
  if (columns > 0 && parameters.has("resolution")) {
    parameters.set("resolution", columns + (sculpted ? 1 : 0));
  }
  return parameters;
}

std::unique_ptr<Representation> Scene::build(const RepresentationType& type, Progress& progress) const {
  return type.build(source, parameters(type), progress);
}

double relief_of(const Scene& scene) {
  if (scene.source.heights) {
    const HeightRange range = height_range(*scene.source.heights);
    return static_cast<double>(range.highest) - range.lowest;
  }
  float lowest = HUGE_VALF, highest = -HUGE_VALF;
  for (std::size_t c = 0; c < scene.lines.parts.lines(); ++c) {
    const auto line = scene.lines.parts.line(c);
    if (line.empty()) continue;
    lowest = std::min(lowest, line.back().top);
    highest = std::max(highest, line.back().top);
  }
  return static_cast<double>(highest) - lowest;
}

double own_bytes(const Scene& scene) {
  if (!scene.source.heights) return static_cast<double>(scene.heightmap_bytes);
  const Heightfield& field = *scene.source.heights;
  const bool whole = std::ranges::all_of(field.heights, [](float h) {
    return Heightfield::is_no_data(h) || (h == std::round(h) && std::abs(h) < 32768);
  });
  return static_cast<double>(field.heights.size()) * (whole ? 2 : 4);
}

std::vector<std::string> compared_scenes(const RunOptions& options) {
  if (options.profile == Profile::kQuick) return grounds(options, {"jacksboro", "caves", "canyon"});
  return grounds(options, {"jacksboro", "helens", "maine", "fractal", "caves", "canyon", "sequence"});
}

std::int64_t solid_resolution(std::string_view terrain, bool paper_profile) {
  if (paper_profile) return 256;
  return terrain == "caves" ? 64 : 128;
}

bool is_solid(const std::string& terrain) {
  constexpr std::array<std::string_view, 4> kSolids{"caves", "canyon", "sequence", "two-tunnels"};
  if (std::ranges::find(kSolids, terrain) != kSolids.end()) return true;
  // Only parsed: cases are planned before processes are forked, and evaluating a script starts threads.
  return terrain.ends_with(events::kExtension) &&
         !events::parse_script(read_file(terrain, events::kMostBytes), terrain).events.empty();
}

const Scene& scene(const SceneOptions& options, Progress& progress) {
  static std::unique_ptr<Scene> kept;
  if (kept && kept->options == options) return *kept;
  kept.reset();
  auto made = std::make_unique<Scene>();
  made->options = options;
  made->source = open(options);
  made->lines = ground_lines(made->source, options.lines);
  if (made->source.solid) made->random = random_lines(made->source, options.lines, options.seed);
  const glm::vec3 size = made->source.bounds().size();
  made->cell = made->source.heights
                   ? std::max(made->source.heights->cell_x, made->source.heights->cell_z)
                   : std::max({size.x, size.y, size.z}) / static_cast<float>(options.resolution);
  const RepresentationType& heightmap = representation("heightmap");
  made->heightmap_bytes = made->build(heightmap, progress)->memory().total();
  kept = std::move(made);
  return *kept;
}

}  // namespace terrabench::cross
