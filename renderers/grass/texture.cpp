#include "renderers/grass/texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <random>

namespace terrabench {
namespace {

// The blade's middle at height y is at x = root + lean · (y ÷ height)², its half width there
// half · (1 − y ÷ height)^0.7; lengths are shares of the billboard.
struct Blade {
  float root, lean, height, half;
  glm::vec3 low, high;  // sRGB at root and tip

  bool covers(float x, float y) const {
    if (y >= height) return false;
    const float t = y / height;
    return std::abs(x - root - lean * t * t) < half * std::pow(1 - t, 0.7F);
  }
};

std::vector<Blade> grow_tuft(std::mt19937& random) {
  const auto between = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random() >> 8) / static_cast<float>(1 << 24);
  };
  constexpr int kBlades = 13;
  std::vector<Blade> tuft;
  for (int i = 0; i < kBlades; ++i) {
    Blade blade{};
    blade.root = 0.14F + 0.72F * (static_cast<float>(i) + between(0.1F, 0.9F)) / kBlades;
    blade.height = between(0.5F, 0.98F);
    // Outer blades lean outwards, and none leaves the billboard.
    const float lean = 0.6F * (blade.root - 0.5F) + between(-0.2F, 0.2F);
    blade.lean = std::clamp(blade.root + lean, 0.03F, 0.97F) - blade.root;
    blade.half = between(0.018F, 0.032F);
    const float dry = between(0, 1);
    blade.low = glm::mix(glm::vec3(38, 66, 18), glm::vec3(62, 78, 26), dry);
    blade.high = glm::mix(glm::vec3(96, 142, 48), glm::vec3(160, 164, 78), dry * dry);
    tuft.push_back(blade);
  }
  return tuft;
}

using Layer = std::vector<glm::vec4>;  // colour times opacity, 0 to 255, and opacity, 0 to 1

Layer paint(const std::vector<Blade>& tuft) {
  constexpr int kSamples = 2;  // along each axis of a texel
  Layer layer(static_cast<std::size_t>(kGrassTexels) * kGrassTexels, glm::vec4(0));
  for (int j = 0; j < kGrassTexels * kSamples; ++j) {
    const float y = (static_cast<float>(j) + 0.5F) / (kGrassTexels * kSamples);
    for (int i = 0; i < kGrassTexels * kSamples; ++i) {
      const float x = (static_cast<float>(i) + 0.5F) / (kGrassTexels * kSamples);
      // The last blade is in front.
      const auto front =
          std::find_if(tuft.rbegin(), tuft.rend(), [&](const Blade& b) { return b.covers(x, y); });
      if (front == tuft.rend()) continue;
      const glm::vec3 colour = glm::mix(front->low, front->high, y / front->height);
      layer[static_cast<std::size_t>(j / kSamples) * kGrassTexels + static_cast<std::size_t>(i / kSamples)] +=
          glm::vec4(colour, 1) / static_cast<float>(kSamples * kSamples);
    }
  }
  return layer;
}

Layer halve(const Layer& layer, int side) {
  const auto half = static_cast<std::size_t>(side / 2), whole = static_cast<std::size_t>(side);
  Layer smaller(half * half);
  for (std::size_t j = 0; j < half; ++j) {
    for (std::size_t i = 0; i < half; ++i) {
      const std::size_t at = 2 * j * whole + 2 * i;
      smaller[j * half + i] = 0.25F * (layer[at] + layer[at + 1] + layer[at + whole] + layer[at + whole + 1]);
    }
  }
  return smaller;
}

// The factor of the opacities for which the given share of texels is more than half opaque.
float keep_cover(const Layer& layer, double share) {
  std::vector<float> opacities;
  for (const glm::vec4& texel : layer) opacities.push_back(texel.a);
  const auto wanted = static_cast<std::size_t>(std::lround(share * static_cast<double>(layer.size())));
  const std::size_t place = std::min(wanted, layer.size() - 1);
  std::nth_element(opacities.begin(), opacities.begin() + static_cast<std::ptrdiff_t>(place), opacities.end(),
                   std::greater<>());
  return std::clamp(0.5F / std::max(opacities[place], 1e-3F), 1.0F, 8.0F);
}

double cover(const Layer& layer) {
  const auto opaque =
      std::count_if(layer.begin(), layer.end(), [](const glm::vec4& t) { return t.a > 0.5F; });
  return static_cast<double>(opaque) / static_cast<double>(layer.size());
}

void append(GrassTexels& level, const Layer& layer, float scale, const glm::vec3& empty) {
  for (const glm::vec4& texel : layer) {
    // Transparent texels have the layer's mean colour: linear filtering mixes it into the edges.
    const glm::vec3 colour = texel.a > 0 ? glm::vec3(texel) / texel.a : empty;
    for (int k = 0; k < 3; ++k) level.rgba.push_back(static_cast<std::uint8_t>(std::lround(colour[k])));
    level.rgba.push_back(static_cast<std::uint8_t>(std::lround(255 * std::min(scale * texel.a, 1.0F))));
  }
}

}  // namespace

std::vector<GrassTexels> paint_grass() {
  std::mt19937 random(2013);
  std::vector<GrassTexels> levels;
  for (int side = kGrassTexels; side >= 1; side /= 2) levels.push_back({side, {}});
  for (int number = 0; number < kGrassLayers; ++number) {
    Layer layer = paint(grow_tuft(random));
    glm::vec4 sum(0);
    for (const glm::vec4& texel : layer) sum += texel;
    const glm::vec3 mean = glm::vec3(sum) / sum.a;
    const double share = cover(layer);
    for (GrassTexels& level : levels) {
      if (level.side < kGrassTexels) layer = halve(layer, 2 * level.side);
      append(level, layer, level.side == kGrassTexels ? 1.0F : keep_cover(layer, share), mean);
    }
  }
  return levels;
}

}  // namespace terrabench
