#include "experiments/figures/colours.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace terrabench::figures {
namespace {

Rgb blend(const Rgb& a, const Rgb& b, double t) {
  Rgb c;
  for (int i = 0; i < 3; ++i) c[i] = static_cast<std::uint8_t>(std::lround(a[i] + (b[i] - a[i]) * t));
  return c;
}

template <std::size_t N>
Rgb along(const std::array<Rgb, N>& stops, double t) {
  const double at = std::clamp(t, 0.0, 1.0) * (N - 1);
  const auto i = std::min(static_cast<std::size_t>(at), N - 2);
  return blend(stops[i], stops[i + 1], at - static_cast<double>(i));
}

}  // namespace

Rgb elevation_colour(double t) {
  static constexpr std::array<Rgb, 5> kStops{
      {{255, 253, 232}, {254, 236, 178}, {248, 206, 132}, {229, 166, 98}, {194, 124, 76}}};
  return along(kStops, t);
}

Rgb difference_colour(double t) {
  static constexpr std::array<Rgb, 7> kStops{{{5, 48, 97},
                                              {67, 147, 195},
                                              {190, 218, 233},
                                              {250, 250, 250},
                                              {250, 200, 178},
                                              {214, 96, 77},
                                              {103, 0, 31}}};
  return along(kStops, t);
}

Rgb error_colour(double t) {
  static constexpr std::array<Rgb, 7> kStops{{{49, 54, 149},
                                              {90, 143, 195},
                                              {171, 217, 233},
                                              {255, 255, 191},
                                              {253, 174, 97},
                                              {225, 85, 56},
                                              {165, 0, 38}}};
  return along(kStops, t);
}

Rgb direction_colour(double turn) {
  // Four of Okabe & Ito's.
  static constexpr std::array<Rgb, 5> kStops{
      {{0, 114, 178}, {204, 121, 167}, {213, 94, 0}, {0, 158, 115}, {0, 114, 178}}};
  return along(kStops, turn - std::floor(turn));
}

Light::Light(const Heightfield& field) : field_(field) {
  constexpr double kUsual = 0.45;  // the root mean square slope that looks best
  double squares = 0, count = 0;
  for (int j = 0; j < field.depth; ++j) {
    for (int i = 0; i < field.width; ++i) {
      if (Heightfield::is_no_data(field.at(i, j))) continue;
      const Slope s = slope(i, j);
      squares += s.east * s.east + s.south * s.south;
      ++count;
    }
  }
  if (squares > 0) exaggeration_ = std::clamp(kUsual / std::sqrt(squares / count), 0.1, 5.0);
}

Light::Slope Light::slope(int i, int j) const {
  const float here = field_.at(i, j);
  const auto height = [&](int x, int z) {
    const float h = field_.at(std::clamp(x, 0, field_.width - 1), std::clamp(z, 0, field_.depth - 1));
    return Heightfield::is_no_data(h) ? here : h;
  };
  return {(height(i + 1, j) - height(i - 1, j)) / (2 * field_.cell_x),
          (height(i, j + 1) - height(i, j - 1)) / (2 * field_.cell_z)};
}

double Light::at(int i, int j) const {
  const Slope s = slope(i, j);
  const double east = exaggeration_ * s.east, south = exaggeration_ * s.south;
  // Lambert's law.
  return std::max(0.0, (0.5 * east + 0.5 * south + 0.7071) / std::sqrt(1 + east * east + south * south));
}

Rgb lit(const Rgb& colour, double light) {
  return blend({0, 0, 0}, colour, std::clamp(0.45 + 0.75 * light, 0.0, 1.0));
}

Rgb ink_on(const Rgb& colour) {
  // Rec. 709 luminance, with gamma 2.2 in place of the sRGB curve.
  const auto linear = [](std::uint8_t v) { return std::pow(v / 255.0, 2.2); };
  const double luminance =
      0.2126 * linear(colour[0]) + 0.7152 * linear(colour[1]) + 0.0722 * linear(colour[2]);
  return luminance > 0.18 ? Rgb{0, 0, 0} : Rgb{255, 255, 255};
}

}  // namespace terrabench::figures
