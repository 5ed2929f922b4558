#include "representations/implicit/sphere_chords.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace terrabench {
namespace {

constexpr int kPhases = SphereChords::kPhases, kSteps = SphereChords::kSteps;

// The volumes over a column whose low corner lies x and z columns from the centre, times `scale` per m³.
// `chords` lines per column along x and z. Mirrored columns have equal volumes, bit for bit.
// O(chords² + steps)
void integrate(double x, double z, double cell_x, double cell_z, double radius, int chords, double scale,
               std::span<std::int32_t> out) {
  if (x < -0.5) x = -1 - x;
  if (z < -0.5) z = -1 - z;
  // Half chords by the first step that they do not pass.
  std::array<double, kSteps + 1> lengths{};
  std::array<int, kSteps + 1> counts{};
  int longer = 0;
  for (int b = 0; b < chords; ++b) {
    for (int a = 0; a < chords; ++a) {
      const double dx = (x + (a + 0.5) / chords) * cell_x, dz = (z + (b + 0.5) / chords) * cell_z;
      const double square = radius * radius - dx * dx - dz * dz;
      if (square <= 0) continue;
      const double half_chord = std::sqrt(square);
      const auto step = static_cast<std::size_t>(
          std::clamp(std::ceil(half_chord / radius * kSteps), 0.0, static_cast<double>(kSteps)));
      lengths[step] += half_chord;
      ++counts[step];
      ++longer;
    }
  }
  const double area = cell_x * cell_z / (static_cast<double>(chords) * chords);
  double shorter = 0;
  for (std::size_t s = 0; s <= kSteps; ++s) {
    shorter += lengths[s];
    longer -= counts[s];
    const double volume = shorter + longer * radius * static_cast<double>(s) / kSteps;
    out[s] = static_cast<std::int32_t>(std::lround(volume * area * scale));
  }
}

}  // namespace

SphereChords::SphereChords(double radius, double cell_x, double cell_z)
    : reach_x_(static_cast<int>(std::floor(radius / cell_x)) + 1),
      reach_z_(static_cast<int>(std::floor(radius / cell_z)) + 1) {
  const std::size_t columns =
      static_cast<std::size_t>(2 * reach_x_ + 1) * static_cast<std::size_t>(2 * reach_z_ + 1);
  volumes_.resize(columns * kPhases * kPhases * (kSteps + 1));
  totals_.reserve(kPhases * kPhases);
  const double scale = 268435456.0 / (radius * cell_x * cell_z);  // the most that fits a column becomes 2²⁸
  // At least 32 lines along the radius, or the smallest spheres would be coarse.
  const int chords =
      static_cast<int>(std::clamp(std::ceil(32 * std::max(cell_x, cell_z) / radius), 16.0, 256.0));
  std::size_t at = 0;
  for (int phase_z = 0; phase_z < kPhases; ++phase_z) {
    for (int phase_x = 0; phase_x < kPhases; ++phase_x) {
      std::int64_t total = 0;
      for (int dz = -reach_z_; dz <= reach_z_; ++dz) {
        for (int dx = -reach_x_; dx <= reach_x_; ++dx, at += kSteps + 1) {
          const std::span<std::int32_t> column = std::span(volumes_).subspan(at, kSteps + 1);
          integrate(dx - phase_x / double{kPhases}, dz - phase_z / double{kPhases}, cell_x, cell_z, radius,
                    chords, scale, column);
          total += 2 * static_cast<std::int64_t>(column.back());
        }
      }
      totals_.push_back(std::max<std::int64_t>(total, 2));
    }
  }
}

}  // namespace terrabench
