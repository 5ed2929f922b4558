// The drill paper's statements about regeneration, for each fit: equation 1 never raises a pixel and does
// not depend on the order of drills; shapes that fall outward, pits and steps at the edges of windows are
// measured.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "experiments/drill/edges.h"
#include "experiments/drill/factorial.h"
#include "experiments/drill/ground.h"
#include "experiments/experiment.h"
#include "representations/drill/extract.h"
#include "representations/drill/pits.h"
#include "representations/drill/regenerate.h"
#include "terrain/hydrology/channels.h"
#include "terrain/hydrology/flow.h"
#include "terrain/metrics/elevation_error.h"

namespace terrabench::drill {
namespace {

// Equation 1 as printed: one drill after another, in the given order.
Heightfield drill_one_by_one(const Drills& drills, const std::vector<std::uint32_t>& order) {
  Heightfield terrain;
  terrain.width = drills.width;
  terrain.depth = drills.depth;
  terrain.heights.assign(drills.pixels(), drills.plateau);
  for (const HoleRun& hole : drills.holes) {
    std::fill_n(terrain.heights.begin() + hole.first, hole.count, Heightfield::kNoData);
  }
  for (const std::uint32_t drill : order) {
    const int x = static_cast<int>(drills.pixel[drill]) % drills.width;
    const int z = static_cast<int>(drills.pixel[drill]) / drills.width;
    const int k = drills.influence_of(drill);
    for (int j = std::max(0, z - k); j <= std::min(drills.depth - 1, z + k); ++j) {
      for (int i = std::max(0, x - k); i <= std::min(drills.width - 1, x + k); ++i) {
        const auto squared = static_cast<float>((i - x) * (i - x) + (j - z) * (j - z));
        const float r = std::sqrt(squared);
        const float shape = drills.elevation[drill] + r * (drills.slope[drill] + drills.curvature[drill] * r);
        float& height = terrain.at(i, j);
        height = shape < height ? shape : height;
      }
    }
  }
  return terrain;
}

std::size_t differences(const Heightfield& a, const Heightfield& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.heights.size(); ++i) {
    const bool holes = std::isnan(a.heights[i]) && std::isnan(b.heights[i]);
    count += !holes && a.heights[i] != b.heights[i];
  }
  return count;
}

void record_orders(const Drills& drills, const Heightfield& regenerated, std::uint64_t seed,
                   Recorder& recorder, Progress& progress) {
  std::vector<std::uint32_t> order(drills.count());
  std::iota(order.begin(), order.end(), 0U);
  std::mt19937_64 random(seed);
  std::size_t differing = 0;
  progress.begin("drilling in other orders", 3);
  for (int i = 0; i < 3; ++i) {
    // As listed, backwards, shuffled.
    if (i == 1) std::reverse(order.begin(), order.end());
    if (i == 2) std::shuffle(order.begin(), order.end(), random);
    differing += differences(drill_one_by_one(drills, order), regenerated);
    progress.advance();
  }
  recorder.add("order_differences", "", differing);
}

// The first `count` drills.
Drills first_drills(Drills drills, std::size_t count) {
  drills.pixel.resize(count);
  drills.direction.resize(count);
  drills.elevation.resize(count);
  drills.slope.resize(count);
  drills.curvature.resize(count);
  if (!drills.influence.empty()) drills.influence.resize(count);
  return drills;
}

// Pixels that are higher after more drills than after fewer.
void record_rises(const Drills& drills, Recorder& recorder) {
  std::size_t rises = 0;
  Heightfield before = regenerate(first_drills(drills, 0));
  for (int eighth = 1; eighth <= 8; ++eighth) {
    Heightfield after = regenerate(first_drills(drills, drills.count() * eighth / 8));
    for (std::size_t i = 0; i < after.heights.size(); ++i) rises += after.heights[i] > before.heights[i];
    before = std::move(after);
  }
  recorder.add("rises", "", rises);
}

void record_channels(const Drills& drills, const Heightfield& ground, const Heightfield& regenerated,
                     Recorder& recorder) {
  std::size_t kept = 0, above = 0, over_plateau = 0;
  for (const std::uint32_t pixel : drills.pixel) {
    kept += regenerated.heights[pixel] == ground.heights[pixel];
    above += regenerated.heights[pixel] > ground.heights[pixel];
  }
  for (const float height : regenerated.heights) over_plateau += height > drills.plateau;
  recorder.add("channel_pixels", "", drills.count());
  recorder.add("channel_pixels_kept", "", kept);
  recorder.add("channel_pixels_above", "", above);
  recorder.add("pixels_above_plateau", "", over_plateau);
}

void record_pits(std::string_view of, const Heightfield& terrain, Recorder& recorder) {
  const Pits pits = count_pits(terrain);
  recorder.add(std::string("pits_") + std::string(of), "", pits.count);
  recorder.add(std::string("pit_pixels_") + std::string(of), "", pits.pixels);
}

void record_edges(const Drills& drills, const Heightfield& ground, Recorder& recorder) {
  const Steps own = steps(ground);
  const EdgeSteps edges = edge_steps(drills);
  recorder.add("ground_largest_step", "m", own.largest);
  recorder.add("ground_mean_step", "m", own.mean);
  recorder.add("pairs_across_edges", "", static_cast<double>(edges.across.pairs));
  recorder.add("edge_largest_step", "m", edges.across.largest);
  recorder.add("edge_mean_step", "m", edges.across.mean);
  recorder.add("inside_largest_step", "m", edges.inside.largest);
  recorder.add("inside_mean_step", "m", edges.inside.mean);
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(at.terrain, options.seed));
  const Heightfield& ground = *source.heights;
  const FlowNetwork network = route_flow(ground, &progress);
  DrillOptions extract = options_for({.k = 20}, variant_of(at.parameters));
  const Drills drills = extract_drills(ground, network, extract, &progress);
  const Heightfield regenerated = regenerate(drills);
  record_orders(drills, regenerated, options.seed, recorder, progress);
  record_rises(drills, recorder);
  record_channels(drills, ground, regenerated, recorder);

  std::size_t falling = 0, rising = 0;
  for (std::size_t i = 0; i < drills.count(); ++i) {
    const bool falls = drills.slope[i] < 0 || drills.curvature[i] < 0;
    falling += falls;
    rising += !falls && drills.slope[i] + drills.curvature[i] > 0;  // neither falls nor is flat
  }
  recorder.add("shapes_that_fall", "", falling);
  add_share(recorder, "shapes_that_rise_share",
            static_cast<double>(rising) / static_cast<double>(drills.count()));
  record_pits("original", ground, recorder);
  record_pits("regenerated", regenerated, recorder);
  // §4.1: channels that never rise downstream.
  extract.monotone_profiles = true;
  const Heightfield legal = regenerate(extract_drills(ground, network, extract, &progress));
  record_pits("monotone_profiles", legal, recorder);
  record_edges(drills, ground, recorder);
  add_share(recorder, "rmse_normalised", elevation_error(ground, regenerated).normalised());
  add_share(recorder, "rmse_monotone_profiles", elevation_error(ground, legal).normalised());
}

}  // namespace

extern const Experiment kPromises{"drill.promises", "§2.3 and §4: order of drills, pits, edges", fit_specs(),
                                  fit_cases, measure};

}  // namespace terrabench::drill
