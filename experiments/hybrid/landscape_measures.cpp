#include "experiments/hybrid/landscape_measures.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "experiments/figures/measures.h"
#include "experiments/hybrid/pixels.h"

namespace terrabench::hybrid {
namespace {

// The direction in which a pixel's middle looks.
glm::dvec3 direction(const View& view, int x, int y) {
  const glm::dvec3 ahead = glm::normalize(glm::dvec3(view.target) - glm::dvec3(view.eye)),
                   right = glm::normalize(glm::cross(ahead, glm::dvec3(view.up))),
                   up = glm::cross(right, ahead);
  const double slope = std::tan(view.vertical_fov / 2.0);
  return glm::normalize(ahead + slope * (1 - 2 * (y + 0.5) / view.height) * up +
                        slope * view.width / view.height * (2 * (x + 0.5) / view.width - 1) * right);
}

bool shows_water(const Image& reflection, const Image& refraction, int x, int y) {
  return reflection.pixel(x, y) != refraction.pixel(x, y);
}

// The share of the reflection that fits a part of the water's pixels best, and the share that Schlick's
// approximation gives these.
class Share {
 public:
  void add(const Rgb& reflection, const Rgb& refraction, const Rgb& mixed, double schlick) {
    constexpr int kBrightest = 220;  // brighter light is compressed (display.glsl)
    if (std::max({std::ranges::max(reflection), std::ranges::max(refraction), std::ranges::max(mixed)}) >
        kBrightest)
      return;
    for (std::size_t c = 0; c < 3; ++c) {
      const double span = light_of(reflection[c]) - light_of(refraction[c]);
      products_ += span * (light_of(mixed[c]) - light_of(refraction[c]));
      expected_ += span * span * schlick;
      squares_ += span * span;
    }
  }
  double measured() const { return products_ / squares_; }
  double expected() const { return expected_ / squares_; }

 private:
  double products_ = 0, expected_ = 0, squares_ = 0;
};

}  // namespace

SlopeMap measure_slopes(const Texels& map, int du, int dv) {
  const int side = map.width;
  const auto at = [&](int x, int y, int channel) {
    return double{map.at((x + side) % side, (y + side) % side, channel)};
  };
  SlopeMap found;
  double difference = 0, size = 0;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double along_v = at(x, y + 1, du) - at(x, y - 1, du),
                   along_u = at(x + 1, y, dv) - at(x - 1, y, dv);
      difference += std::abs(along_v - along_u);
      size += 0.5 * (std::abs(along_v) + std::abs(along_u));
    }
  }
  found.curl = difference / size;
  for (const int channel : {du, dv}) {
    const Seam seam = measure_seam(map, channel);
    found.seam_step = std::max(found.seam_step, seam.at_seam);
    found.largest_step = std::max(found.largest_step, seam.elsewhere);
  }
  return found;
}

Seam measure_seam(const Texels& map, int channel) {
  Seam seam;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const bool last = x + 1 == map.width;
      const double step = std::abs(double{map.at(x, y, channel)} - map.at(last ? 0 : x + 1, y, channel));
      double& largest = last ? seam.at_seam : seam.elsewhere;
      largest = std::max(largest, step);
    }
  }
  return seam;
}

WaterMix measure_mix(const Image& reflection, const Image& refraction, const Image& mixed, const View& view) {
  int first = view.height, last = 0;  // rows with water
  double between = 0, water = 0;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      if (!shows_water(reflection, refraction, x, y)) continue;
      first = std::min(first, y);
      last = y;
      const Rgb a = reflection.pixel(x, y), b = refraction.pixel(x, y), m = mixed.pixel(x, y);
      bool inside = true;
      for (std::size_t c = 0; c < 3; ++c)  // a byte may be rounded the other way
        inside = inside && m[c] + 1 >= std::min(a[c], b[c]) && m[c] <= std::max(a[c], b[c]) + 1;
      between += inside;
      ++water;
    }
  }
  Share near, far;
  for (int y = first; y <= last; ++y) {
    Share& share = 2 * y > first + last ? near : far;
    for (int x = 0; x < view.width; ++x) {
      const double cosine = -direction(view, x, y).y;
      if (!shows_water(reflection, refraction, x, y)) continue;
      share.add(reflection.pixel(x, y), refraction.pixel(x, y), mixed.pixel(x, y),
                0.02 + 0.98 * std::pow(1 - cosine, 5));
    }
  }
  return {between / water, near.measured(), far.measured(), near.expected(), far.expected()};
}

double share_changed(const Image& a, const Image& b, const Image& reflection, const Image& refraction,
                     bool water) {
  double changed = 0, all = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      if (shows_water(reflection, refraction, x, y) != water) continue;
      changed += a.pixel(x, y) != b.pixel(x, y);
      ++all;
    }
  }
  return changed / all;
}

double cloud_match(const Image& image, const View& view, const Texels& noise, double turns) {
  constexpr int kEvery = 4;  // pixels
  figures::Correlation found;
  for (int y = 0; y < image.height / 2; y += kEvery) {
    for (int x = 0; x < image.width; x += kEvery) {
      const glm::dvec3 d = direction(view, x, y);
      const double azimuth = std::atan2(d.x, -d.z) / (2 * std::numbers::pi) + turns + 2,
                   zenith = std::acos(std::clamp(d.y, 0.0, 1.0)) / (0.5 * std::numbers::pi);
      found.add(image.pixel(x, y)[0], noise.at(static_cast<int>(azimuth * noise.width) % noise.width,
                                               static_cast<int>(zenith * (noise.height - 1))));
    }
  }
  return found.value();
}

}  // namespace terrabench::hybrid
