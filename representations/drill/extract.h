// Drills from a terrain (Stuetzle & Franklin 2012, §2.1 and §2.2): one for every channel pixel, its shape the
// quadratic fitted to the union of the cross-sections around it. O(pixels + drills · w).
//
// To follow one drill: FlowNetwork (terrain/hydrology/flow.h); extract_drills() in extract.cpp;
// shape_drills() above it, which joins the cross-sections (cross_sections.h) and fits a profile
// (fit_profile(), profile_fit.h); then back to ground by regenerate.h. What can wait: the options of §4.1,
// holes, the codec (drill_codec.h).
#pragma once

#include <cstdint>

#include "representations/drill/drills.h"
#include "representations/drill/profile_fit.h"
#include "terrain/heightfield.h"
#include "terrain/hydrology/flow.h"
#include "terrain/progress.h"

namespace terrabench {

struct DrillOptions {
  std::uint32_t tau = 25;  // least flow of a channel, pixels
  int w = 10;              // length of a cross-section, samples
  int k = 10;              // influence, samples
  DrillFit fit = DrillFit::kMonotone;
  // §4.1: elevations never rise downstream. With monotone shapes no pit can be left (pits.h).
  bool monotone_profiles = false;
  bool adaptive_k = false;             // §4.1: a k per drill, up to `k`: choose_influence()
  bool interpolate_untouched = false;  // §4.1: see regenerate.h
};

// Throws usage_error: τ < 1, w < 1 or larger than the terrain, w or k above 255, k < 0.
void check_options(const DrillOptions&, int width, int depth);

// Drills for all pixels whose flow is at least τ; none when no flow is. `network` is route_flow(field);
// heights are below 10⁹ m. Parallel over drills, the same on every machine. Throws what check_options()
// throws, and environment_error when the cross-sections do not fit the memory.
Drills extract_drills(const Heightfield& field, const FlowNetwork& network, const DrillOptions& options,
                      Progress* progress = nullptr);

// §4.1: "every operator will store its own value for k".
// Chooses from about ten influences between 2 and drills.k: the terrain is regenerated with each for all
// drills, and every drill takes the one with the least squared error in the drill's largest window. Sets
// drills.influence. Costs one regeneration and O(pixels) per influence; holds 12 bytes per pixel.
// Deterministic.
void choose_influence(const Heightfield& field, Drills& drills, Progress* progress = nullptr);

}  // namespace terrabench
