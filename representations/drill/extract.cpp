#include "representations/drill/extract.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>

#include "representations/drill/cross_sections.h"
#include "terrain/error.h"
#include "terrain/hydrology/channels.h"
#include "terrain/memory.h"

namespace terrabench {
namespace {

constexpr std::size_t kDrillsPerTask = 1024;

std::vector<HoleRun> find_holes(const Heightfield& field) {
  std::vector<HoleRun> holes;
  bool inside = false;
  for (std::size_t i = 0; i < field.heights.size(); ++i) {
    const bool hole = Heightfield::is_no_data(field.heights[i]);
    if (hole && !inside) holes.push_back({static_cast<std::uint32_t>(i), 0});
    if (hole) ++holes.back().count;
    inside = hole;
  }
  return holes;
}

// Lowers every channel pixel to the lowest one upstream of it.
std::vector<float> monotone_elevations(const Heightfield& field, const FlowNetwork& network,
                                       std::uint32_t tau) {
  std::vector<float> elevation = field.heights;
  for (const std::uint32_t pixel : channel_pixels(network, tau)) {  // upstream first
    if (!network.flows(pixel)) continue;
    float& below = elevation[network.receiver(pixel)];
    below = std::min(below, elevation[pixel]);
  }
  return elevation;
}

void shape_drills(const CrossSections& sections, const DrillOptions& options, Drills& drills,
                  Progress* progress) {
  const std::size_t count = drills.count();
  if (progress != nullptr) progress->begin("drill shapes", (count + kDrillsPerTask - 1) / kDrillsPerTask);
  drills.slope.resize(count);
  drills.curvature.resize(count);
  tbb::parallel_for(std::size_t{0}, (count + kDrillsPerTask - 1) / kDrillsPerTask, [&](std::size_t step) {
    std::vector<float> joined(static_cast<std::size_t>(sections.w()));
    for (std::size_t i = step * kDrillsPerTask; i < std::min(count, (step + 1) * kDrillsPerTask); ++i) {
      sections.join(drills.pixel[i], joined);
      const float centre = drills.elevation[i];
      FittedProfile profile = fit_profile(joined, centre, options.fit);
      // A drill that sees no ground around it digs its own pixel only: the plateau is one sample away.
      if (!profile.determined) {
        (options.fit == DrillFit::kVertex ? profile.curvature : profile.slope) = drills.plateau - centre;
      }
      drills.slope[i] = profile.slope;
      drills.curvature[i] = profile.curvature;
    }
    if (progress != nullptr) progress->advance();
  });
}

void require(bool good, std::string_view what, std::int64_t given, std::string_view advice) {
  if (!good) throw usage_error(fmt::format("{}, got {}", what, given), "drill", advice);
}

}  // namespace

void check_options(const DrillOptions& options, int width, int depth) {
  constexpr int kMost = Drills::kMaxInfluence;
  const int most_w = std::min(kMost, std::max(width, depth));
  require(options.tau >= 1, "tau must be at least 1", options.tau, "at 1 every pixel is a channel");
  require(options.w >= 1 && options.w <= most_w, fmt::format("w must be between 1 and {} samples", most_w),
          options.w, "a cross-section is no longer than the terrain");
  require(CrossSections::reaches(width, options.w), "w is too long for so wide a terrain", options.w,
          "choose a smaller w, or turn the terrain so that its longer side runs south");
  require(options.k >= 0 && options.k <= kMost, fmt::format("k must be between 0 and {} samples", kMost),
          options.k, "a window is 2k + 1 samples wide");
}

Drills extract_drills(const Heightfield& field, const FlowNetwork& network, const DrillOptions& options,
                      Progress* progress) {
  check_options(options, field.width, field.depth);
  assert(network.width == field.width && network.depth == field.depth);
  std::vector<float> lowered;
  if (options.monotone_profiles) lowered = monotone_elevations(field, network, options.tau);
  const std::vector<float>& elevation = options.monotone_profiles ? lowered : field.heights;

  Drills drills;
  drills.width = field.width;
  drills.depth = field.depth;
  drills.cell_x = field.cell_x;
  drills.cell_z = field.cell_z;
  const HeightRange range = height_range(field);
  drills.plateau = range.no_data == field.heights.size() ? 0 : range.highest;
  drills.w = options.w;
  drills.k = options.k;
  drills.holes = find_holes(field);
  const auto is_channel = [&](std::uint32_t flow) { return flow >= options.tau; };
  drills.pixel.reserve(static_cast<std::size_t>(
      std::count_if(network.accumulation.begin(), network.accumulation.end(), is_channel)));
  drills.direction.reserve(drills.pixel.capacity());
  drills.elevation.reserve(drills.pixel.capacity());
  for (std::size_t i = 0; i < network.size(); ++i) {
    if (!is_channel(network.accumulation[i])) continue;
    drills.pixel.push_back(static_cast<std::uint32_t>(i));
    drills.direction.push_back(network.direction[i]);
    drills.elevation.push_back(elevation[i]);
  }
  drills.interpolated = options.interpolate_untouched;
  if (drills.count() == 0) return drills;
  require_memory(CrossSections::bytes(field, options.w), "cross-sections");
  shape_drills(CrossSections(field, options.w), options, drills, progress);
  if (options.adaptive_k) choose_influence(field, drills, progress);
  return drills;
}

}  // namespace terrabench
