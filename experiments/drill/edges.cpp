#include "experiments/drill/edges.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace terrabench::drill {
namespace {

// Calls visit(a, b) for all pairs of neighbours with data.
template <class Visit>
void each_pair(const Heightfield& field, const Visit& visit) {
  const auto width = static_cast<std::size_t>(field.width);
  const auto pair = [&](std::size_t a, std::size_t b) {
    if (!Heightfield::is_no_data(field.heights[a]) && !Heightfield::is_no_data(field.heights[b])) visit(a, b);
  };
  for (std::size_t at = 0; at < field.heights.size(); ++at) {
    if ((at + 1) % width != 0) pair(at, at + 1);
    if (at + width < field.heights.size()) pair(at, at + width);
  }
}

void add(const Heightfield& field, std::size_t a, std::size_t b, Steps& to) {
  const double step = std::abs(static_cast<double>(field.heights[a]) - field.heights[b]);
  to.largest = std::max(to.largest, step);
  to.mean += step;  // the sum, until all pairs are met
  ++to.pairs;
}

void finish(Steps& steps) {
  if (steps.pairs > 0) steps.mean /= static_cast<double>(steps.pairs);
}

}  // namespace

std::vector<std::uint32_t> as_listed(const Drills& drills) {
  std::vector<std::uint32_t> order(drills.count());
  std::iota(order.begin(), order.end(), 0U);
  return order;
}

Drilled drill_one_by_one(const Drills& drills, std::span<const std::uint32_t> order) {
  Drilled drilled{Heightfield::zeros(drills.width, drills.depth, drills.cell_x, drills.cell_z),
                  std::vector(drills.pixels(), Drilled::kPlateau)};
  std::vector<float>& heights = drilled.terrain.heights;
  std::fill(heights.begin(), heights.end(), drills.plateau);
  for (const std::uint32_t drill : order) {
    const int x = static_cast<int>(drills.pixel[drill]) % drills.width;
    const int z = static_cast<int>(drills.pixel[drill]) / drills.width;
    const int k = drills.influence_of(drill);
    for (int j = std::max(0, z - k); j <= std::min(drills.depth - 1, z + k); ++j) {
      for (int i = std::max(0, x - k); i <= std::min(drills.width - 1, x + k); ++i) {
        const float r = std::sqrt(static_cast<float>((i - x) * (i - x) + (j - z) * (j - z)));
        const float height =
            drills.elevation[drill] + r * (drills.slope[drill] + drills.curvature[drill] * r);
        const auto at = static_cast<std::size_t>(j) * static_cast<std::size_t>(drills.width) +
                        static_cast<std::size_t>(i);
        if (height >= heights[at]) continue;
        heights[at] = height;
        drilled.by[at] = drill;
      }
    }
  }
  for (const HoleRun& hole : drills.holes) {
    std::fill_n(heights.begin() + hole.first, hole.count, Heightfield::kNoData);
  }
  return drilled;
}

Steps steps(const Heightfield& field) {
  Steps all;
  each_pair(field, [&](std::size_t a, std::size_t b) { add(field, a, b, all); });
  finish(all);
  return all;
}

EdgeSteps edge_steps(const Drills& drills, const Drilled& drilled) {
  // Whether the window of the drill that shaped one sample leaves out the other.
  const auto leaves_out = [&](std::size_t one, std::size_t other) {
    const std::uint32_t drill = drilled.by[one];
    if (drill == Drilled::kPlateau) return false;
    const auto width = static_cast<std::size_t>(drills.width);
    const auto apart = [](std::size_t a, std::size_t b) { return a > b ? a - b : b - a; };
    const std::size_t centre = drills.pixel[drill], away = std::max(apart(other % width, centre % width),
                                                                    apart(other / width, centre / width));
    return away > static_cast<std::size_t>(drills.influence_of(drill));
  };
  EdgeSteps edges;
  each_pair(drilled.terrain, [&](std::size_t a, std::size_t b) {
    add(drilled.terrain, a, b, leaves_out(a, b) || leaves_out(b, a) ? edges.across : edges.inside);
  });
  finish(edges.across);
  finish(edges.inside);
  return edges;
}

}  // namespace terrabench::drill
