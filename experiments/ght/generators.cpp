// §2.3 of "ght": what each generator of base terrain must do, counted sample by sample.
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "experiments/cases.h"
#include "terrain/sources/fractal/diamond_square.h"
#include "terrain/sources/fractal/faults.h"
#include "terrain/sources/fractal/hills.h"
#include "terrain/sources/fractal/limits.h"

namespace terrabench::ght {
namespace {

using namespace fractal;

std::size_t differences(const Heightfield& a, const Heightfield& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.heights.size(); ++i) count += a.heights[i] != b.heights[i];
  return count;
}

// Whether the same seed gives the same terrain on one thread, and another seed another one.
template <class Make>
void record_seeds(std::string_view name, const Make& make, std::uint64_t seed, Recorder& recorder) {
  const Heightfield field = make(seed);
  recorder.terrain(name, checksum(field));
  {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    recorder.add("repeat_differences", "", differences(field, make(seed)));
  }
  recorder.add(
      "other_seed_share", "",
      static_cast<double>(differences(field, make(seed + 1))) / static_cast<double>(field.heights.size()));
}

// Counts samples of opposite borders that differ, corners that are not as set, and displacements beyond the
// range of their level. Also records the ratio of the mean displacements of successive levels.
void measure_diamond_square(int side, int, std::uint64_t seed, Recorder& recorder) {
  DiamondSquareOptions options{.seed = seed, .side = side, .corner = 100};
  const Heightfield field = diamond_square(options);
  const int last = side - 1, levels = levels_of_side(side);
  std::size_t open = 0, corners = 0, beyond = 0;
  for (int i = 0; i <= last; ++i) {
    open += field.at(0, i) != field.at(last, i);
    open += field.at(i, 0) != field.at(i, last);
  }
  for (const int x : {0, last}) {
    for (const int z : {0, last}) corners += field.at(x, z) != options.corner;
  }
  double ratio = 0, before = 0;
  int ratios = 0;
  for (int level = 0; level < levels; ++level) {
    const int half = last >> (level + 1);
    const double range = level_range(options.amplitude, options.hurst, level);
    double sum = 0;
    for (int z = half; z < last; z += 2 * half) {
      for (int x = half; x < last; x += 2 * half) {
        const double mean =
            0.25 * (static_cast<double>(field.at(x - half, z - half)) + field.at(x + half, z - half) +
                    field.at(x - half, z + half) + field.at(x + half, z + half));
        const double moved = std::abs(field.at(x, z) - mean);
        beyond += moved > range + 1e-3;  // a millimetre for the rounding of heights
        sum += moved / std::pow(4.0, level);
      }
    }
    constexpr int kManyPoints = 4;  // the first level of 256 points or more
    if (level > kManyPoints) {
      ratio += sum / before;
      ++ratios;
    }
    before = sum;
  }
  recorder.add("open_border_samples", "", open);
  recorder.add("corner_differences", "", corners);
  recorder.add("beyond_range", "", beyond);
  if (ratios > 0) recorder.add("range_ratio", "", ratio / ratios / std::exp2(-options.hurst));
  record_seeds(
      "diamond-square", [&](std::uint64_t s) { return diamond_square({.seed = s, .side = side}); }, seed,
      recorder);
}

// Compares the terrain before and after each fault: counts samples that did not rise by the step on the one
// side or sink by it on the other. On the sphere, counts samples that differ across the date line or at a
// pole.
void measure_faults(int side, int steps, std::uint64_t seed, Recorder& recorder) {
  FaultOptions options{.seed = seed, .width = side, .depth = side, .faults = 0, .step = 1};
  Heightfield before = fault_terrain(options);
  const auto raised =
      std::count_if(before.heights.begin(), before.heights.end(), [](float h) { return h != 0; });
  recorder.add("not_flat_at_first", "", raised);
  options.faults = steps;
  const std::vector<FaultLine> lines = fault_lines(options);
  std::size_t wrong = 0, up = 0;
  for (int k = 0; k < steps; ++k) {
    options.faults = k + 1;
    const Heightfield after = fault_terrain(options);
    for (int j = 0; j < side; ++j) {
      for (int i = 0; i < side; ++i) {
        const bool rises = lines[static_cast<std::size_t>(k)].rises(i, j);
        wrong += after.at(i, j) - before.at(i, j) != (rises ? 1.0F : -1.0F);
        up += rises;
      }
    }
    before = after;
  }
  recorder.add("wrong_samples", "", wrong);
  recorder.add("rising_share", "", static_cast<double>(up) / (static_cast<double>(side) * side * steps));

  const Heightfield planet =
      planet_faults({.seed = seed, .width = 2 * side - 1, .depth = side, .faults = steps});
  std::size_t seam = 0;
  for (int j = 0; j < side; ++j) seam += planet.at(0, j) != planet.at(planet.width - 1, j);
  for (int i = 0; i < planet.width; ++i) {
    seam += planet.at(i, 0) != planet.at(0, 0);
    seam += planet.at(i, side - 1) != planet.at(0, side - 1);
  }
  recorder.add("planet_seam_samples", "", seam);
  record_seeds(
      "faults",
      [&](std::uint64_t s) {
        return fault_terrain({.seed = s, .width = side, .depth = side, .faults = steps});
      },
      seed, recorder);
}

// The largest deviation from r² − d², cut off at zero, for one hill and for the sum of all, as a share of the
// highest point. Also counts samples outside the single hill that are not zero.
void measure_hills(int side, int steps, std::uint64_t seed, Recorder& recorder) {
  HillOptions options{.seed = seed, .width = side, .depth = side, .cell = 1, .hills = steps};
  options.least_radius = static_cast<float>(side) / 32;
  options.most_radius = static_cast<float>(side) / 6;
  const std::vector<Hill> hills = draw_hills(options);
  const auto height = [](const Hill& hill, int i, int j) {
    const double dx = i - static_cast<double>(hill.x), dz = j - static_cast<double>(hill.z);
    return static_cast<double>(hill.radius) * hill.radius - dx * dx - dz * dz;
  };
  const Hill single{static_cast<float>(side / 2), static_cast<float>(side / 2), options.most_radius};
  const Heightfield one = raise_hills(options, {single}), all = hill_terrain(options);
  double one_off = 0, all_off = 0, highest = 0;
  std::size_t outside = 0;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const double alone = height(single, i, j);
      if (alone <= 0) {
        outside += one.at(i, j) != 0;
      } else {
        one_off = std::max(one_off, std::abs(one.at(i, j) - alone));
      }
      double sum = 0;
      for (const Hill& hill : hills) sum += std::max(0.0, height(hill, i, j));
      all_off = std::max(all_off, std::abs(all.at(i, j) - sum));
      highest = std::max(highest, sum);
    }
  }
  recorder.add("one_hill_deviation", "", one_off / (static_cast<double>(single.radius) * single.radius));
  recorder.add("sum_deviation", "", all_off / highest);
  recorder.add("raised_outside", "", outside);
  record_seeds(
      "hills",
      [&](std::uint64_t s) {
        HillOptions other = options;
        other.seed = s;
        return hill_terrain(other);
      },
      seed, recorder);
}

struct Generator {
  std::string_view name;
  void (*measure)(int side, int steps, std::uint64_t seed, Recorder&);
};
constexpr std::array kGeneratorTable{
    Generator{"diamond-square", measure_diamond_square},
    Generator{"fault-formation", measure_faults},
    Generator{"hill", measure_hills},
};
constexpr std::array kNames = names_of(kGeneratorTable);
const std::array kSpecs{
    choice("generator", kNames, "the generator that is measured"),
    ParameterSpec{"side", std::int64_t{129}, "samples", "2^n + 1 along each side", 9, 4097},
    ParameterSpec{"steps", std::int64_t{100}, "", "number of faults or hills", 1, 10000},
};

std::vector<Case> cases(const RunOptions& options) {
  return cases_by("generator", kSpecs,
                  {{"side", std::int64_t{options.profile == Profile::kPaper ? 513 : 129}}});
}

void measure(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress&) {
  const int side = test_case.integer("side");
  const int steps = test_case.integer("steps");
  kGeneratorTable[test_case.parameters.choice("generator")].measure(side, steps, options.seed, recorder);
}

}  // namespace

extern const Experiment kGenerators{"ght.generators", "§2.3: properties of the base-terrain generators",
                                    kSpecs, cases, measure};

}  // namespace terrabench::ght
