#include "terrain/sources/fractal/hills.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "terrain/error.h"
#include "terrain/sources/fractal/counter_random.h"
#include "terrain/sources/fractal/limits.h"

namespace terrabench::fractal {
namespace {

constexpr char kWhere[] = "hill technique";
constexpr int kMostHills = 10'000'000;
constexpr int kBand = 32;             // rows that one task raises
constexpr std::size_t kBatch = 8192;  // hills sorted at a time, which bounds the memory of the lists

void check_field(const HillOptions& options) {
  check_side(options.width, "width", kWhere);
  check_side(options.depth, "depth", kWhere);
  check_between(options.cell, 1e-6, kLargestMetres, "cell", kWhere);
  check_between(options.scale, -kLargestMetres, kLargestMetres, "scale", kWhere);
  check_memory(options.width, options.depth, kWhere);
}

// Samples first … last of a line of `count`, `cell` apart, that lie within `radius` of `centre`, rounded
// outwards.
struct Reach {
  int first, last;
};
Reach reach(float centre, float radius, float cell, int count) {
  const auto limit = static_cast<float>(count);
  return {static_cast<int>(std::clamp(std::floor((centre - radius) / cell), 0.0F, limit)),
          static_cast<int>(std::clamp(std::ceil((centre + radius) / cell), -1.0F, limit - 1))};
}

void raise_row(const HillOptions& options, const Hill& hill, int j, float* row) {
  const float dz = static_cast<float>(j) * options.cell - hill.z;
  const float top = hill.radius * hill.radius - dz * dz;
  if (!(top > 0)) return;
  const Reach columns = reach(hill.x, hill.radius, options.cell, options.width);
  for (int i = columns.first; i <= columns.last; ++i) {
    const float dx = static_cast<float>(i) * options.cell - hill.x;
    const float height = top - dx * dx;
    row[i] += options.scale * (height > 0 ? height : 0.0F);
  }
}

// Which hills of a batch touch each band of rows, in the order of their numbers.
struct Bands {
  Bands(const HillOptions& options, std::span<const Hill> hills)
      : begin(static_cast<std::size_t>((options.depth + kBand - 1) / kBand) + 1) {
    const auto visit = [&](auto&& each) {
      for (std::size_t h = 0; h < hills.size(); ++h) {
        const Reach rows = reach(hills[h].z, hills[h].radius, options.cell, options.depth);
        if (rows.first > rows.last) continue;
        for (int band = rows.first / kBand; band <= rows.last / kBand; ++band)
          each(static_cast<std::size_t>(band), h);
      }
    };
    visit([&](std::size_t band, std::size_t) { ++begin[band + 1]; });
    for (std::size_t band = 1; band < begin.size(); ++band) begin[band] += begin[band - 1];
    list.resize(begin.back());
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    visit([&](std::size_t band, std::size_t h) { list[next[band]++] = static_cast<std::uint32_t>(h); });
  }
  std::vector<std::size_t> begin;
  std::vector<std::uint32_t> list;
};

}  // namespace

std::vector<Hill> draw_hills(const HillOptions& options) {
  check_field(options);
  check_between(options.hills, 0, kMostHills, "hills", kWhere);
  // Squares of radii and distances are heights.
  constexpr double kLeast = 1e-6, kMost = 1e9;
  check_between(options.least_radius, kLeast, kMost, "least_radius", kWhere);
  check_between(options.most_radius, kLeast, kMost, "most_radius", kWhere);
  if (options.least_radius > options.most_radius) {
    throw usage_error(fmt::format("most_radius must be at least least_radius, {} m, got {} m",
                                  options.least_radius, options.most_radius),
                      kWhere, "give least_radius at most as large as most_radius");
  }
  std::vector<Hill> hills;
  hills.reserve(static_cast<std::size_t>(options.hills));
  const double east = static_cast<double>(options.width - 1) * options.cell;
  const double south = static_cast<double>(options.depth - 1) * options.cell;
  for (int k = 0; k < options.hills; ++k) {
    const CounterRandom random(options.seed, kHills, static_cast<std::uint64_t>(k));
    const double r = options.least_radius +
                     (static_cast<double>(options.most_radius) - options.least_radius) * random.share(0);
    hills.push_back({static_cast<float>(-r + (east + 2 * r) * random.share(1)),
                     static_cast<float>(-r + (south + 2 * r) * random.share(2)), static_cast<float>(r)});
  }
  return hills;
}

Heightfield hill_terrain(const HillOptions& options) { return raise_hills(options, draw_hills(options)); }

Heightfield raise_hills(const HillOptions& options, const std::vector<Hill>& hills) {
  check_field(options);
  Heightfield field = Heightfield::zeros(options.width, options.depth, options.cell, options.cell);
  for (std::size_t first = 0; first < hills.size(); first += kBatch) {
    const auto batch = std::span(hills).subspan(first, std::min(kBatch, hills.size() - first));
    const Bands bands(options, batch);
    tbb::parallel_for(std::size_t{0}, bands.begin.size() - 1, [&](std::size_t band) {
      const int top = static_cast<int>(band) * kBand, end = std::min(top + kBand, options.depth);
      for (std::size_t at = bands.begin[band]; at < bands.begin[band + 1]; ++at) {
        const Hill& hill = batch[bands.list[at]];
        const Reach rows = reach(hill.z, hill.radius, options.cell, options.depth);
        for (int j = std::max(top, rows.first); j <= std::min(end - 1, rows.last); ++j) {
          raise_row(options, hill, j, &field.at(0, j));
        }
      }
    });
  }
  return field;
}

}  // namespace terrabench::fractal
