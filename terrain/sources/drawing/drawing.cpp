#include "terrain/sources/drawing/drawing.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <utility>
#include <vector>

#include "terrain/error.h"
#include "terrain/memory.h"
#include "terrain/parameters.h"
#include "terrain/sources/noise/program.h"

namespace terrabench {
namespace {

void check(const GreyImage& picture, const DrawingOptions& options) {
  const auto within = [](float value, float lowest, float highest, std::string_view name,
                         std::string_view advice) {
    if (!(value >= lowest && value <= highest)) {
      throw usage_error("a drawing's adjustment is out of range", name, advice);
    }
  };
  if (picture.width < 1 || picture.height < 1) {
    throw usage_error("the drawing has no pixels", "picture", "give a picture of at least one pixel");
  }
  within(options.cell, 1e-3F, 1e6F, "cell", "choose 0.001 to 1e6 m");
  within(options.sea_level, 0, 0.999F, "sea_level", "choose 0 to 0.999");
  within(options.peak, 0, 1e6F, "peak", "choose 0 to 1e6 m");
  within(options.seabed, 0, 1, "seabed", "choose 0 to 1");
  within(options.mountains, 0, 1, "mountains", "choose 0 to 1");
  if (options.smoothing < 0 || options.smoothing > 1000) {
    throw usage_error("the number of smoothing passes is out of range", "smoothing", "choose 0 to 1000");
  }
}

float height_of(std::uint16_t grey, const DrawingOptions& options) {
  const float g = static_cast<float>(grey) / 65535, s = options.sea_level;
  return g >= s ? options.peak * ((g - s) / (1 - s)) : -options.seabed * options.peak * ((s - g) / s);
}

// The share by which each pass moves a sample: 1 for hills, 0 for mountains. It depends on the drawn height,
// so that smoothing cannot turn one into the other.
float softness(float height, const DrawingOptions& options) {
  const float foot = 0.75F * options.mountains * options.peak, top = options.mountains * options.peak;
  if (height >= top) return 0;
  return height <= foot ? 1 : (top - height) / (top - foot);
}

void smooth(Heightfield& field, const std::vector<float>& soft, std::vector<float>& next) {
  const int width = field.width, depth = field.depth;
  tbb::parallel_for(0, depth, [&](int j) {
    const int above = std::max(j - 1, 0), below = std::min(j + 1, depth - 1);
    const auto column = [&](int i) {
      return 0.25F * field.at(i, above) + 0.5F * field.at(i, j) + 0.25F * field.at(i, below);
    };
    for (int i = 0; i < width; ++i) {
      const std::size_t at = static_cast<std::size_t>(j) * width + i;
      const float mean =
          0.25F * column(std::max(i - 1, 0)) + 0.5F * column(i) + 0.25F * column(std::min(i + 1, width - 1));
      next[at] = field.heights[at] + soft[at] * (mean - field.heights[at]);
    }
  });
  field.heights.swap(next);
}

}  // namespace

Heightfield land_from_drawing(const GreyImage& picture, const DrawingOptions& options) {
  check(picture, options);
  const std::size_t fields = options.smoothing == 0 ? 1 : 3;
  require_memory(fields * sizeof(float) * picture.width * static_cast<std::size_t>(picture.height),
                 "land from a drawing", "give a smaller picture");
  Heightfield field = Heightfield::zeros(picture.width, picture.height, options.cell, options.cell);
  for (std::size_t k = 0; k < field.heights.size(); ++k) {
    field.heights[k] = height_of(picture.values[k], options);
  }
  if (options.smoothing == 0) return field;
  std::vector<float> soft(field.heights.size()), next(field.heights.size());
  for (std::size_t k = 0; k < soft.size(); ++k) soft[k] = softness(field.heights[k], options);
  for (int pass = 0; pass < options.smoothing; ++pass) smooth(field, soft, next);
  return field;
}

namespace {

// land_from_drawing() checks the ranges.
const std::array kSpecs{
    ParameterSpec{"cell", 30.0, "m", "side of a pixel"},
    ParameterSpec{"sea_level", 0.3, "", "intensity at the shore"},
    ParameterSpec{"peak", 1000.0, "m", "height of white"},
    ParameterSpec{"seabed", 0.1, "", "depth of black, as a share of the peak"},
    ParameterSpec{"smoothing", std::int64_t{2}, "passes", "of diffusion", 0, 1000},
    ParameterSpec{"mountains", 0.6, "", "height that is never smoothed, as a share of the peak"},
};

}  // namespace

NamedDrawing parse_drawing(std::string_view text) {
  NamedFile named = parse_named_file(text, kSpecs);
  const Parameters& given = named.options;
  const auto number = [&](std::string_view name) { return static_cast<float>(given.number(name)); };
  return {std::move(named.file),
          {.cell = number("cell"),
           .sea_level = number("sea_level"),
           .peak = number("peak"),
           .seabed = number("seabed"),
           .smoothing = static_cast<int>(given.integer("smoothing")),
           .mountains = number("mountains")}};
}

// In place of an art program: the strokes that the paper names, one after the other.
namespace {

// Distances as shares of the picture's side.
constexpr float kRidgeWidth = 0.09F, kRiverWidth = 0.012F, kShore = 0.05F;
constexpr glm::vec2 kLake{0.70F, 0.30F};
constexpr float kLakeRadius = 0.08F;

float distance_to(glm::vec2 at, glm::vec2 a, glm::vec2 b) {
  const glm::vec2 along = b - a;
  const float t = std::clamp(glm::dot(at - a, along) / glm::dot(along, along), 0.0F, 1.0F);
  return glm::length(at - a - t * along);
}

// Two ranges across the land.
float distance_to_ridges(glm::vec2 at) {
  static constexpr std::array<std::array<glm::vec2, 4>, 2> kRidges = {
      {{{{0.05F, 0.20F}, {0.22F, 0.34F}, {0.34F, 0.30F}, {0.47F, 0.46F}}},
       {{{0.50F, 0.90F}, {0.64F, 0.74F}, {0.80F, 0.72F}, {0.96F, 0.58F}}}}};
  float nearest = 2;
  for (const auto& ridge : kRidges) {
    for (std::size_t k = 0; k + 1 < ridge.size(); ++k) {
      nearest = std::min(nearest, distance_to(at, ridge[k], ridge[k + 1]));
    }
  }
  return nearest;
}

// From the lake to the western border.
float distance_to_river(glm::vec2 at) {
  const float bed = 0.58F + 0.06F * std::sin(11 * at.x) + 0.03F * std::sin(27 * at.x + 1);
  const float joined = kLake.y + (bed - kLake.y) * std::clamp((kLake.x - at.x) / 0.2F, 0.0F, 1.0F);
  return at.x > kLake.x ? 2 : std::abs(at.y - joined);
}

// 1 at the middle of a stroke, 0 at its rim and beyond.
float stroke(float distance, float width) { return std::clamp(1 - distance / width, 0.0F, 1.0F); }

}  // namespace

Image example_drawing(int side, std::uint64_t seed) {
  if (side < 1 || side > 16384) {
    throw usage_error("the drawing's side is out of range", "side", "choose 1 to 16384 pixels");
  }
  noise::Graph graph;
  const auto per_pixel = [&](float cycles) { return cycles / static_cast<float>(side); };
  const noise::Program clouds(graph, graph.fbm({.seed = seed, .frequency = per_pixel(4), .octaves = 6}));
  const noise::Program rocks(graph, graph.fbm({.seed = seed + 1, .frequency = per_pixel(24), .octaves = 4}));
  Image picture(side, side, {});
  const auto length = static_cast<std::size_t>(side);
  std::vector<float> x(length), y(length, 0.0F), z(length), row(length), rock(length);
  for (int i = 0; i < side; ++i) x[static_cast<std::size_t>(i)] = static_cast<float>(i);
  for (int j = 0; j < side; ++j) {
    std::fill(z.begin(), z.end(), static_cast<float>(j));
    clouds.points(x, y, z, row);
    rocks.points(x, y, z, rock);
    for (int i = 0; i < side; ++i) {
      const float cloud = row[static_cast<std::size_t>(i)];
      const glm::vec2 at = (glm::vec2(i, j) + 0.5F) / static_cast<float>(side);
      const float ridge = stroke(distance_to_ridges(at), kRidgeWidth);
      const float crag = rock[static_cast<std::size_t>(i)];
      float grey = std::clamp(0.45F + 0.3F * cloud, 0.2F, 0.65F) + ridge * (0.45F + 0.5F * crag);
      const float lake = glm::length(at - kLake) - kLakeRadius * (1 + 0.5F * cloud);
      const float water = std::min(lake, distance_to_river(at) - kRiverWidth);
      grey *= std::clamp(water / kShore, 0.0F, 1.0F);
      const auto value = static_cast<std::uint8_t>(std::lround(255 * std::clamp(grey, 0.0F, 1.0F)));
      picture.set(i, j, {value, value, value});
    }
  }
  return picture;
}

}  // namespace terrabench
