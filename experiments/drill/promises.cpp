// The drill paper's statements about regeneration, for each fit: equation 1 never raises a pixel and does
// not depend on the order of drills; shapes that fall outward, pits and steps at the edges of windows are
// measured.
#include <algorithm>
#include <cmath>
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

namespace terrabench::drill {
namespace {

std::size_t differences(const Heightfield& a, const Heightfield& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.heights.size(); ++i) {
    const bool holes = std::isnan(a.heights[i]) && std::isnan(b.heights[i]);
    count += !holes && a.heights[i] != b.heights[i];
  }
  return count;
}

// Returns the terrain drilled as listed.
Drilled record_orders(const Drills& drills, const Heightfield& regenerated, std::uint64_t seed,
                      Recorder& recorder, Progress& progress) {
  std::vector<std::uint32_t> order = as_listed(drills);
  std::mt19937_64 random(seed);
  std::size_t differing = 0;
  progress.begin("drilling in other orders", 3);
  const auto drilled_in_order = [&] {
    Drilled drilled = drill_one_by_one(drills, order);
    differing += differences(drilled.terrain, regenerated);
    progress.advance();
    return drilled;
  };
  Drilled listed = drilled_in_order();
  std::reverse(order.begin(), order.end());
  drilled_in_order();
  std::shuffle(order.begin(), order.end(), random);
  drilled_in_order();
  recorder.add("order_differences", "", differing);
  return listed;
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

void record_edges(const Drills& drills, const Drilled& drilled, const Heightfield& ground,
                  Recorder& recorder) {
  const EdgeSteps edges = edge_steps(drills, drilled);
  recorder.add("ground_largest_step", "m", steps(ground).largest);
  recorder.add("edge_largest_step", "m", edges.across.largest);
  recorder.add("edge_mean_step", "m", edges.across.mean);
  recorder.add("inside_largest_step", "m", edges.inside.largest);
  recorder.add("inside_mean_step", "m", edges.inside.mean);
}

void measure(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(test_case.terrain, options.seed));
  const Heightfield& ground = *source.heights;
  const FlowNetwork network = route_flow(ground, &progress);
  DrillOptions extract = options_for({.k = 20}, variant_of(test_case.parameters));
  const Drills drills = extract_drills(ground, network, extract, &progress);
  const Heightfield regenerated = regenerate(drills);
  const Drilled drilled = record_orders(drills, regenerated, options.seed, recorder, progress);
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
  recorder.add("pits_original", "", count_pits(ground));
  recorder.add("pits_regenerated", "", count_pits(regenerated));
  // §4.1: channels that never rise downstream.
  extract.monotone_profiles = true;
  recorder.add("pits_monotone_profiles", "",
               count_pits(regenerate(extract_drills(ground, network, extract, &progress))));
  record_edges(drills, drilled, ground, recorder);
}

}  // namespace

extern const Experiment kPromises{"drill.promises", "§2.3 and §4: order of drills, pits, edges",
                                  variant_specs(), fit_cases, measure};

}  // namespace terrabench::drill
