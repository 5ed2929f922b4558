// The four methods of table 2 over one ground, and how their frames are timed.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "experiments/experiment.h"
#include "experiments/mrbsp/ground.h"

namespace terrabench::mrbsp {

enum Method : std::size_t { kBrute, kLod, kVis, kBoth, kMethods };
inline constexpr std::array<std::string_view, kMethods> kMethodNames{"brute", "lod", "vis", "both"};

// Level of detail with the rules as printed.
struct Methods {
  std::vector<Mrbsp> lods;  // by Method

  Methods(const Heightfield&, const visibility::ChangeTable&, Progress&);
  void tune(double size);  // of level of detail; the others draw the finest triangles
};

// The visible sets of a ground.
visibility::ChangeTable sets_over(const Heightfield&, const visibility::Options&, Progress&);
// The numbers of cells along the longer side that are tried where the paper leaves the number open.
inline constexpr std::array kCells{4, 8, 16, 32, 64};
// Those sets, of all numbers of cells, with which visibility alone draws the share of brute force that is
// closest to the paper's, 38.1 %.
visibility::ChangeTable fitted_sets(const Heightfield&, visibility::Options, const std::vector<View>&,
                                    Progress&);
// The size at which level of detail alone draws the paper's share of brute force, 41.6 %.
double fitted_size(Methods&, const std::vector<View>&);

// `count` views, evenly spaced; at most all of them.
std::vector<View> some_of(const std::vector<View>& views, std::size_t count);

// Of one method, with the choice of triangles and the drawing.
struct FrameTimes {
  // Of each round the median over all views, seconds. A round is a sample: it repeats the same frames, whose
  // times differ from each other by what they show.
  std::vector<double> rounds;
  // Of all views, each in its fastest round: other work of the machine only ever makes a frame slower, so
  // this is the least disturbed time.
  double least = 0;
  double choosing_share = 0;  // of all frames' time
};
// Draws every view with every method, kSamples times. Methods alternate at every view, so that a slow period
// of the machine affects all alike; every second round reverses their order, so that none always follows the
// same other one and inherits its caches. Every round has new renderers, made in another order: all frames of
// one can take a third longer than those of another that draws the same.
std::vector<FrameTimes> time_frames(std::vector<Mrbsp>& lods, const Heightfield&, const std::vector<View>&,
                                    const RunOptions&, Progress&);

}  // namespace terrabench::mrbsp
