#include "experiments/drill/cutting_planes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "experiments/figures/maps.h"

namespace terrabench::drill {
namespace {

constexpr double kTurn = 0.42, kRise = 0.85;  // radians: west of south, and above the horizon
constexpr double kRelief = 0.36;              // drawn height of the relief, of the block's side
constexpr double kBase = 5;                   // samples of rock below the lowest ground
constexpr Rgb kRock{150, 142, 132}, kPlane{214, 40, 40}, kCut{150, 0, 0};

// East, up, south. Towards the eye, and the directions of the image's axes.
const glm::dvec3 kToEye{-std::sin(kTurn) * std::cos(kRise), std::sin(kRise),
                        std::cos(kTurn) * std::cos(kRise)};
const glm::dvec3 kRight{std::cos(kTurn), 0, std::sin(kTurn)};
const glm::dvec3 kUp = glm::cross(kToEye, kRight);

Rgb mixed(const Rgb& a, const Rgb& b, double share_of_b) {
  Rgb mix;
  for (std::size_t c = 0; c < 3; ++c) {
    mix[c] = static_cast<std::uint8_t>(std::lround(a[c] + (b[c] - a[c]) * share_of_b));
  }
  return mix;
}

}  // namespace

CuttingPlanes::CuttingPlanes(const Heightfield& ground, std::uint32_t pixel, int w)
    : w_(w), half_(w + kMargin) {
  const int i = static_cast<int>(pixel) % ground.width, j = static_cast<int>(pixel) / ground.width;
  block_ = crop(ground, i - half_, j - half_, 2 * half_ + 1, 2 * half_ + 1);
  const HeightRange range = height_range(block_);
  const double relief = std::max(static_cast<double>(range.highest) - range.lowest, 1e-6);
  metres_ = relief / (kRelief * 2 * half_);
  low_ = range.lowest - kBase * metres_;
  top_ = (range.highest - low_) / metres_ + 2;
}

double CuttingPlanes::ground(double east, double south) const {
  const double x = std::clamp(east + half_, 0.0, 2.0 * half_),
               z = std::clamp(south + half_, 0.0, 2.0 * half_);
  const int i = std::min(static_cast<int>(x), 2 * half_ - 1),
            j = std::min(static_cast<int>(z), 2 * half_ - 1);
  const double dx = x - i, dz = z - j;
  const double height = (block_.at(i, j) * (1 - dx) + block_.at(i + 1, j) * dx) * (1 - dz) +
                        (block_.at(i, j + 1) * (1 - dx) + block_.at(i + 1, j + 1) * dx) * dz;
  return (height - low_) / metres_;
}

bool CuttingPlanes::inside(const glm::dvec3& p) const {
  return std::abs(p.x) <= half_ && std::abs(p.z) <= half_ && p.y >= 0 && p.y <= ground(p.x, p.z);
}

double CuttingPlanes::per_pixel(int width, int height) const {
  const double across = 2 * half_ * (std::abs(kRight.x) + std::abs(kRight.z));
  const double high = 2 * half_ * (std::abs(kUp.x) + std::abs(kUp.z)) + top_ * kUp.y;
  return 1.02 * std::max(across / width, high / height);
}

glm::dvec3 CuttingPlanes::origin(double x, double y, int width, int height) const {
  const double scale = per_pixel(width, height);
  const glm::dvec3 middle{0, top_ / 2, 0};
  return middle + kRight * ((x - width / 2.0) * scale) - kUp * ((y - height / 2.0) * scale);
}

// The colour of the block where a ray met it: ground, with the lines in which the planes cut it, or a side.
Rgb CuttingPlanes::surface(const glm::dvec3& p) const {
  if (p.y < ground(p.x, p.z) - 0.5) return kRock;
  const double east = ground(p.x + 0.5, p.z) - ground(p.x - 0.5, p.z),
               south = ground(p.x, p.z + 0.5) - ground(p.x, p.z - 0.5);
  const double light =
      std::max(0.0, (east + south + std::numbers::sqrt2) /
                        (2 * std::sqrt(1 + east * east + south * south)));  // from the north-west
  const double lowest = kBase, highest = top_ - 2;
  const Rgb ground_colour =
      figures::lit(figures::elevation_colour((p.y - lowest) / (highest - lowest)), light);
  const double r = std::hypot(p.x, p.z);
  if (r > w_) return ground_colour;
  constexpr double kStep = 2 * std::numbers::pi / kPlanes;
  const double angle = std::atan2(p.z, p.x), off = angle - kStep * std::round(angle / kStep);
  return std::abs(r * std::sin(off)) < 0.14 ? kCut : ground_colour;
}

std::vector<CuttingPlanes::Crossing> CuttingPlanes::crossings(const glm::dvec3& from, double end) const {
  std::vector<Crossing> found;
  for (int m = 0; m < kPlanes; ++m) {
    const double angle = 2 * std::numbers::pi * m / kPlanes, along_x = std::cos(angle),
                 along_z = std::sin(angle);
    const double speed = along_x * kToEye.z - along_z * kToEye.x;
    if (std::abs(speed) < 1e-9) continue;
    const double t = (along_x * from.z - along_z * from.x) / speed;  // p = from - t · kToEye
    const glm::dvec3 p = from - kToEye * t;
    const double r = p.x * along_x + p.z * along_z;
    if (t >= end || r < 0 || r > w_ || p.y > top_ || p.y < ground(p.x, p.z)) continue;
    found.push_back({t, r > w_ - 0.25 || p.y > top_ - 0.25});
  }
  std::ranges::sort(found, {}, &Crossing::along);
  return found;
}

Rgb CuttingPlanes::colour(const glm::dvec3& from) const {
  constexpr double kStep = 0.2, kFar = 200;
  std::optional<double> hit;
  for (double t = -kFar; t < kFar && !hit; t += kStep) {
    if (!inside(from - kToEye * t)) continue;
    double outside = t - kStep, within = t;
    for (int i = 0; i < 12; ++i) {
      const double middle = (outside + within) / 2;
      (inside(from - kToEye * middle) ? within : outside) = middle;
    }
    hit = within;
  }
  Rgb seen = hit ? surface(from - kToEye * *hit) : Rgb{255, 255, 255};
  const std::vector<Crossing> planes = crossings(from, hit.value_or(kFar));
  for (auto plane = planes.rbegin(); plane != planes.rend(); ++plane) {
    seen = mixed(seen, kPlane, plane->edge ? 0.9 : 0.22);
  }
  return seen;
}

Image CuttingPlanes::draw(int width, int height) const {
  constexpr int kOver = 2;  // samples per pixel along each axis
  Image image(width, height, {255, 255, 255});
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      std::array<int, 3> sum{};
      for (int s = 0; s < kOver * kOver; ++s) {
        const Rgb one =
            colour(origin(x + (s % kOver + 0.5) / kOver, y + (s / kOver + 0.5) / kOver, width, height));
        for (std::size_t c = 0; c < 3; ++c) sum[c] += one[c];
      }
      Rgb mean;
      for (std::size_t c = 0; c < 3; ++c) mean[c] = static_cast<std::uint8_t>(sum[c] / (kOver * kOver));
      image.set(x, y, mean);
    }
  });
  return image;
}

}  // namespace terrabench::drill
