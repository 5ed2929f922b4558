#include "experiments/hybrid/stage_relations.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "terrain/sources/noise/program.h"

namespace terrabench::hybrid {
namespace {

using noise::Stage;

Pixels sampled(const noise::Graph& graph, noise::Node root, float extent, int side, Progress& progress) {
  const noise::Program program(graph, root);
  const float step = extent / static_cast<float>(side);
  Pixels pixels{side, std::vector<float>(static_cast<std::size_t>(side) * static_cast<std::size_t>(side))};
  progress.begin("slice", side);
  tbb::parallel_for(0, side, [&](int row) {
    program.slice({step / 2, (static_cast<float>(row) + 0.5F) * step, step, step, extent / 2, side, 1},
                  std::span(pixels.values).subspan(static_cast<std::size_t>(row) * side, side));
    progress.advance();
  });
  return pixels;
}

// What a stage is compared with.
struct Stages {
  const noise::CaveOptions& terrain;
  int side;
  Recorder& recorder;
  Progress& progress;

  Pixels of(Stage stage) const { return slice_of(stage, terrain, side, progress); }
  float step() const { return terrain.extent / static_cast<float>(side); }  // metres
};

// The largest difference of two values in one row, or in one column.
double spread(const Pixels& pixels, bool along_rows) {
  float largest = 0;
  for (int a = 0; a < pixels.side; ++a) {
    const auto value = [&](int b) { return along_rows ? pixels.at(b, a) : pixels.at(a, b); };
    float least = value(0), most = least;
    for (int b = 1; b < pixels.side; ++b) {
      least = std::min(least, value(b));
      most = std::max(most, value(b));
    }
    largest = std::max(largest, most - least);
  }
  return largest;
}

double share_differing(const Pixels& a, const Pixels& b) {
  double differing = 0;
  for (std::size_t k = 0; k < a.values.size(); ++k) differing += a.values[k] != b.values[k];
  return differing / static_cast<double>(a.values.size());
}

// From the line that falls from 1 at the lower border to 0 at the upper one.
void measure_gradient(const Pixels& now, const Stages& stages) {
  double off = 0;
  for (int row = 0; row < now.side; ++row) {
    for (int i = 0; i < now.side; ++i)
      off = std::max(off, std::abs(now.at(i, row) - (1 - (row + 0.5) / now.side)));
  }
  stages.recorder.add("row_spread", "", spread(now, true));
  stages.recorder.add("off_the_line", "", off);
}

// The values of `source` on both sides of the threshold that makes it `clamped`.
struct Threshold {
  float highest_of_zero = -1, lowest_of_one = 2;
};
Threshold threshold_of(const Pixels& clamped, const Pixels& source, bool ones_above) {
  Threshold found;
  for (std::size_t k = 0; k < clamped.values.size(); ++k) {
    if ((clamped.values[k] > 0.5F) == ones_above) {
      found.lowest_of_one = std::min(found.lowest_of_one, source.values[k]);
    } else {
      found.highest_of_zero = std::max(found.highest_of_zero, source.values[k]);
    }
  }
  return found;
}

// The mean square of f(x + h) - 2 f(x) + f(x - h) along rows. For white noise it does not depend on h, for
// smooth noise of one octave it grows with the fourth power, and for a fractal with a power in between.
double bend(const Pixels& now, int h) {
  double sum = 0, count = 0;
  for (int row = 0; row < now.side; ++row) {
    for (int i = h; i + h < now.side; ++i, ++count) {
      const double second = double{now.at(i + h, row)} - 2 * double{now.at(i, row)} + now.at(i - h, row);
      sum += second * second;
    }
  }
  return sum / count;
}

void measure_fbm(const Pixels& now, const Stages& stages) {
  const int metre = now.side / static_cast<int>(stages.terrain.extent);
  stages.recorder.add("column_spread", "", spread(now, false));
  stages.recorder.add("bend_4m", "", bend(now, 4 * metre));
  stages.recorder.add("bend_8m", "", bend(now, 8 * metre));
  float step = 0;
  for (int i = 0; i < now.side; ++i) step = std::max(step, std::abs(now.at(i, 1) - now.at(i, 0)));
  stages.recorder.add("lowest_row_step", "", step);
}

// One row of the fractal, the one at y = 0, which lies half a pixel below figure 5's lowest row.
void measure_flat_fbm(const Pixels& now, const Stages& stages) {
  const Pixels fbm = stages.of(Stage::kFbm);
  float off = 0;
  for (int i = 0; i < now.side; ++i) off = std::max(off, std::abs(now.at(i, 0) - fbm.at(i, 0)));
  stages.recorder.add("column_spread", "", spread(now, false));
  stages.recorder.add("off_lowest_row", "", off);
}

// The heights of the columns against the straight line over the values of figure 6 that fits them best.
void measure_hills(const Pixels& now, const Stages& stages) {
  const Pixels noise = stages.of(Stage::kFlatFbm);
  const int n = now.side;
  std::vector<double> heights;  // pixels
  double mean_noise = 0, mean_height = 0;
  for (int i = 0; i < n; ++i) {
    double height = 0;
    for (int row = 0; row < n; ++row) height += now.at(i, row) > 0.5F;
    heights.push_back(height);
    mean_noise += double{noise.at(i, 0)} / n;
    mean_height += height / n;
  }
  double products = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    const double from_mean = noise.at(i, 0) - mean_noise;
    products += from_mean * (heights[static_cast<std::size_t>(i)] - mean_height);
    squares += from_mean * from_mean;
  }
  double off = 0;
  for (int i = 0; i < n; ++i) {
    const double line = mean_height + products / squares * (noise.at(i, 0) - mean_noise);
    off = std::max(off, std::abs(heights[static_cast<std::size_t>(i)] - line));
  }
  const auto [least, most] = std::minmax_element(heights.begin(), heights.end());
  stages.recorder.add("heights_off_the_noise", "pixels", off);
  stages.recorder.add("relief", "pixels", *most - *least);
}

// The offsets along x by which the root of a stage moves its samples.
noise::Node shift_of(const noise::CaveGraph& graph) {
  return graph.graph.modules()[graph.root.index].inputs[1];
}

// The stage `before` sampled at x + shift instead of x.
Pixels moved(Stage before, const Pixels& shift, const Stages& stages) {
  const noise::CaveGraph graph = noise::graph_for(before, stages.terrain);
  const noise::Program program(graph.graph, graph.root);
  Pixels result{shift.side, std::vector<float>(shift.values.size())};
  const auto side = static_cast<std::size_t>(shift.side);
  const std::vector<float> z(side, stages.terrain.extent / 2);
  tbb::parallel_for(std::size_t{0}, side, [&](std::size_t row) {
    std::vector<float> x, y(side, (static_cast<float>(row) + 0.5F) * stages.step());
    for (std::size_t i = 0; i < side; ++i)
      x.push_back((static_cast<float>(i) + 0.5F) * stages.step() + shift.values[row * side + i]);
    program.points(x, y, z, std::span(result.values).subspan(row * side, side));
  });
  return result;
}

// Of the pixels that changed, the share that lies farther along x than `reach` pixels from every edge of what
// was before; tips of caves that are narrower than a pixel have no edge in the picture. Pixels whose samples
// come from outside the picture do not count.
double share_far_from_edges(const Pixels& before, const Pixels& now, const Pixels& shift, float step,
                            int reach) {
  double changed = 0, far = 0;
  for (int row = 0; row < now.side; ++row) {
    for (int i = 0; i < now.side; ++i) {
      const double from = i + 0.5 + shift.at(i, row) / step;
      if (now.at(i, row) == before.at(i, row) || from < 0 || from >= now.side) continue;
      bool near = false;
      for (int k = std::max(i - reach, 0); k <= std::min(i + reach, now.side - 1) && !near; ++k)
        near = before.at(k, row) != before.at(i, row);
      ++changed;
      far += !near;
    }
  }
  return far / std::max(changed, 1.0);
}

void measure_shift(Stage stage, Stage before, const Pixels& now, const Stages& stages) {
  const noise::CaveGraph graph = noise::graph_for(stage, stages.terrain);
  const Pixels shift =
      sampled(graph.graph, shift_of(graph), stages.terrain.extent, now.side, stages.progress);
  const Pixels source = stages.of(before);
  float largest = 0;
  for (const float each : shift.values) largest = std::max(largest, std::abs(each));
  stages.recorder.add("share_moved", "", share_differing(now, source));
  stages.recorder.add("share_off_the_shift", "", share_differing(now, moved(before, shift, stages)));
  const int reach = static_cast<int>(std::ceil(largest / stages.step()));  // pixels
  stages.recorder.add("share_far_from_edges", "",
                      share_far_from_edges(source, now, shift, stages.step(), reach));
}

// The mean second difference at the maxima and at the minima of rows: crests are sharp, valleys are round.
void measure_crests(const Pixels& now, const Stages& stages) {
  double sums[2] = {}, counts[2] = {};
  for (int row = 0; row < now.side; ++row) {
    for (int i = 1; i + 1 < now.side; ++i) {
      const double left = double{now.at(i, row)} - now.at(i - 1, row),
                   right = double{now.at(i, row)} - now.at(i + 1, row);
      if (left * right <= 0) continue;
      const int minimum = left < 0 ? 1 : 0;
      sums[minimum] += std::abs(left + right);
      ++counts[minimum];
    }
  }
  stages.recorder.add("sharpness_of_maxima", "", sums[0] / std::max(counts[0], 1.0));
  stages.recorder.add("sharpness_of_minima", "", sums[1] / std::max(counts[1], 1.0));
}

void measure_product(const Pixels& now, const Stages& stages) {
  const Pixels ground = stages.of(Stage::kXYPerturbed);
  Pixels product = stages.of(Stage::kPerturbedRidged);
  for (std::size_t k = 0; k < product.values.size(); ++k) product.values[k] *= ground.values[k];
  stages.recorder.add("share_off_product", "", share_differing(now, product));
}

// How much of the caves in figure 12's ground is left in its lower and in its upper half.
void measure_attenuation(const Pixels& now, const Stages& stages) {
  const Pixels ground = stages.of(Stage::kXYPerturbed), unweakened = stages.of(Stage::kMultiplied);
  double caves[2] = {}, left[2] = {}, added = 0;
  for (int row = 0; row < now.side; ++row) {
    const int upper = row < now.side / 4 ? 0 : 1;  // the gradient's ground fills the lower half of the slice
    for (int i = 0; i < now.side; ++i) {
      const bool cave = ground.at(i, row) != unweakened.at(i, row);
      const bool stays = ground.at(i, row) != now.at(i, row);
      caves[upper] += cave;
      left[upper] += cave && stays;
      added += stays && !cave;
    }
  }
  stages.recorder.add("caves_left_low", "", left[0] / std::max(caves[0], 1.0));
  stages.recorder.add("caves_left_high", "", left[1] / std::max(caves[1], 1.0));
  stages.recorder.add("caves_added", "pixels", added);
}

}  // namespace

Pixels slice_of(Stage stage, const noise::CaveOptions& terrain, int side, Progress& progress) {
  const noise::CaveGraph graph = noise::graph_for(stage, terrain);
  return sampled(graph.graph, graph.root, terrain.extent, side, progress);
}

void compare_stages(Stage stage, const Pixels& now, const noise::CaveOptions& terrain, Recorder& recorder,
                    Progress& progress) {
  const Stages stages{terrain, now.side, recorder, progress};
  switch (stage) {
    case Stage::kGradient:
      return measure_gradient(now, stages);
    case Stage::kClampedGradient: {
      const Threshold found = threshold_of(now, stages.of(Stage::kGradient), true);
      recorder.add("highest_gradient_of_air", "", found.highest_of_zero);
      recorder.add("lowest_gradient_of_ground", "", found.lowest_of_one);
      return;
    }
    case Stage::kFbm:
      return measure_fbm(now, stages);
    case Stage::kFlatFbm:
      return measure_flat_fbm(now, stages);
    case Stage::kYPerturbed:
      return measure_hills(now, stages);
    case Stage::kXYPerturbed:
      return measure_shift(stage, Stage::kYPerturbed, now, stages);
    case Stage::kRidged:
      return measure_crests(now, stages);
    case Stage::kClampedRidged: {  // 0 is a cave, where the noise is high
      const Threshold found = threshold_of(now, stages.of(Stage::kRidged), false);
      recorder.add("highest_noise_outside", "", found.highest_of_zero);
      recorder.add("lowest_noise_inside", "", found.lowest_of_one);
      return;
    }
    case Stage::kPerturbedRidged:
      return measure_shift(stage, Stage::kClampedRidged, now, stages);
    case Stage::kMultiplied:
      return measure_product(now, stages);
    case Stage::kAttenuated:
      return measure_attenuation(now, stages);
  }
}

}  // namespace terrabench::hybrid
