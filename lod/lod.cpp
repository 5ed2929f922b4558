#include "lod/lod.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "terrain/error.h"

namespace terrabench {

double setting(const Knob& knob, double value) {
  if (std::isnan(value)) {
    throw usage_error(fmt::format("{} must be a number, got NaN", knob.name), knob.name,
                      fmt::format("choose {} to {} {}", knob.finest, knob.coarsest, knob.unit));
  }
  const auto [low, high] = std::minmax(knob.finest, knob.coarsest);
  const double within = std::clamp(value, low, high);
  return knob.whole ? std::round(within) : within;
}

void check_ground(const Heightfield& ground) {
  if (ground.width < 2 || ground.depth < 2) {
    throw usage_error(
        fmt::format("ground must have at least 2 × 2 samples, got {} × {}", ground.width, ground.depth), "",
        "choose a larger field");
  }
  if (height_range(ground).no_data > 0) {
    throw usage_error("ground must not have no-data samples", "", "fill them first (fill_no_data)");
  }
}

void check_edit(const SampleRect& rect, int width, int depth) {
  const auto inside = [](int low, int high, int samples) {
    return low >= 0 && low <= high && high < samples;
  };
  if (inside(rect.low.x, rect.high.x, width) && inside(rect.low.y, rect.high.y, depth)) return;
  throw usage_error(fmt::format("samples ({}, {}) to ({}, {}) are not on the ground of {} × {}", rect.low.x,
                                rect.low.y, rect.high.x, rect.high.y, width, depth),
                    "edit", "choose a rectangle of the ground's samples");
}

void append_heights(const GroundGrid& grid, const SampleRect& rect, std::vector<DirtyRange>& ranges) {
  for (int j = rect.low.y; j <= rect.high.y; ++j) {
    ranges.push_back({.target = DirtyRange::Target::kHeights,
                      .first = static_cast<std::uint32_t>(j) * static_cast<std::uint32_t>(grid.width) +
                               static_cast<std::uint32_t>(rect.low.x),
                      .count = static_cast<std::uint32_t>(rect.high.x - rect.low.x + 1)});
  }
}

GroundGrid grid_of(const Heightfield& field) {
  return {field.width, field.depth, field.cell_x, field.cell_z, field.heights};
}

}  // namespace terrabench
