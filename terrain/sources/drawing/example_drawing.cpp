// In place of an art program: the strokes that the paper names, one after the other.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "terrain/error.h"
#include "terrain/sources/drawing/drawing.h"
#include "terrain/sources/noise/program.h"

namespace terrabench {
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
