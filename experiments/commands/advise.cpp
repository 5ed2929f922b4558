// advise: which method to take for a ground. It runs the experiments that answer the questions, and prints
// what the report says of the ground.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "experiments/commands/commands.h"
#include "experiments/processes.h"
#include "experiments/runner.h"
#include "results/report/advice.h"
#include "results/report/ground_name.h"
#include "results/report/report.h"
#include "results/store/store.h"
#include "terrain/source.h"
#include "terrain/sources/dem/dem.h"

namespace terrabench {
namespace {

// Draw the ground by each method, and where each errs on it.
constexpr std::array<std::string_view, 2> kPictures = {"overview.relief", "cross.error-maps"};

// Seconds that a case takes on a ground of kAdvisedSide² samples on two cores.
struct Cost {
  std::string_view experiment;
  double seconds;
};
constexpr std::array kCosts{
    // measured on a part of Maine, without other work
    Cost{"cross.representations", 3.1}, Cost{"cross.file-size", 2.9}, Cost{"cross.lod-equal-error", 0.9},
    Cost{"cross.lod-frames", 4.1},      Cost{"cross.lod-edit", 0.15}, Cost{"cross.error-maps", 12.6},
    Cost{"overview.relief", 2},
};

double seconds_of(const PlannedCase& planned, double samples) {
  const auto cost = std::ranges::find(kCosts, planned.experiment->id, &Cost::experiment);
  constexpr double kFixed = 0.3;  // the share that does not grow with the samples
  return (cost == kCosts.end() ? 5 : cost->seconds) *
         (kFixed + (1 - kFixed) * samples / (kAdvisedSide * kAdvisedSide));
}

struct Ground {
  std::string name;  // of what is measured: the terrain or a part of it
  std::string about, checksum;
  double samples = 0;
};

// The part of the DEM that is measured: its middle, or if less than half of that has heights or it is flat,
// the first of eight parts around it that is better, or the best if none is. Reads only these parts.
std::string part_of(const std::string& terrain, int side) {
  const DemHeader header = read_dem_header(terrain);
  const int width = std::min(side, header.width), depth = std::min(side, header.depth);
  std::string best;
  double most = -1;
  for (const int j : {1, 0, 2}) {
    for (const int i : {1, 0, 2}) {
      const bool middle = i == 1 && j == 1;
      const DemWindow window{i * (header.width - width) / 2, j * (header.depth - depth) / 2, width, depth,
                             middle};
      const std::string name = cropped(terrain, window);
      double share = 0;
      try {
        const Heightfield heights = read_dem(name).heights;
        const HeightRange range = height_range(heights);
        const auto samples = static_cast<double>(heights.heights.size());
        if (range.highest > range.lowest) share = 1 - static_cast<double>(range.no_data) / samples;
      } catch (const Error& error) {
        // Holds no height, or is damaged: another part may do. If none does, opening the first says why.
        if (error.code() != ExitCode::kBadInput) throw;
      }
      if (share > most) best = name;
      most = std::max(most, share);
      if (most >= 0.5) return best;
    }
  }
  return best;
}

bool is_too_large(const std::string& terrain, int side) {
  if (!names_dem_file(terrain) || !parse_dem(terrain).options.window.whole()) return false;
  const DemHeader header = read_dem_header(terrain);
  return static_cast<double>(header.width) * header.depth > static_cast<double>(side) * side;
}

Ground open_ground(const std::string& terrain, int side) {
  Ground ground;
  ground.name = is_too_large(terrain, side) ? part_of(terrain, side) : terrain;
  const TerrainSource source = open_terrain(ground.name);
  ground.checksum = source.checksum;
  const std::string label = ground_labels(std::array{ground.name})[0];
  ground.about = fmt::format("{}: {}", label, fmt::join(source.notes, "; "));
  ground.samples =
      source.heights ? static_cast<double>(source.heights->heights.size()) : kAdvisedSide * kAdvisedSide;
  return ground;
}

// In a process of its own, since reading starts threads, and run() forks.
Ground find_ground(const std::string& terrain, int side) {
  const std::string text = call_in_process([&] {
    const Ground ground = open_ground(terrain, side);
    return fmt::format("{}\n{}\n{}\n{}", ground.samples, ground.checksum, ground.about, ground.name);
  });
  Ground ground;
  std::istringstream lines(text);
  lines >> ground.samples >> ground.checksum >> std::ws;
  std::getline(lines, ground.about);
  std::getline(lines, ground.name);
  return ground;
}

std::filesystem::path default_folder(const std::string& terrain) {
  const std::string file = terrain_file(terrain);
  return "advice-" + (file.empty() ? terrain : std::filesystem::path(file).stem().string());
}

}  // namespace

ExitCode advise_command(const AdviseArguments& a, RunPlan plan) {
  if (std::ranges::find(ranking_layouts(), a.terrain, &RankingLayout::ground) != ranking_layouts().end()) {
    throw usage_error(fmt::format("'{}' is a reference ground: its answers are in README.md", a.terrain),
                      "advise", "name a file of yours");
  }
  if (!a.reference.empty()) (void)Store::open(a.reference);  // fails now rather than after the measurements
  const Ground ground = find_ground(a.terrain, a.side);
  plan.patterns = experiments_for(a.purpose);
  plan.patterns.insert(plan.patterns.end(), kPictures.begin(), kPictures.end());
  plan.options.terrains = {ground.name};
  plan.folder = a.folder.empty() ? default_folder(a.terrain) : a.folder;
  plan.resume = true;
  plan.terrain_checksum = ground.checksum;
  plan.seconds = [&](const PlannedCase& planned) { return seconds_of(planned, ground.samples); };
  const ExitCode code = run(plan);
  const WrittenReport report = write_report(plan.folder, a.reference, "quick", a.purpose);
  warn_of(report.faults);
  fmt::print(
      "{}\n\n{}\nsee {}\nwhat the methods are: terrabench list representations; terrabench list lods\n",
      ground.about, report.advice, report.page.string());
  return code;
}

}  // namespace terrabench
