#include "experiments/figures/maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "results/report/ground_name.h"

namespace terrabench::figures {
namespace {

Rgb blend(const Rgb& a, const Rgb& b, double t) {
  Rgb c;
  for (int i = 0; i < 3; ++i) c[i] = static_cast<std::uint8_t>(std::lround(a[i] + (b[i] - a[i]) * t));
  return c;
}

// Stops as 0xRRGGBB, evenly spaced.
template <std::size_t N>
Rgb along(const std::array<std::uint32_t, N>& stops, double t) {
  const double at = std::clamp(t, 0.0, 1.0) * (N - 1);
  const auto i = std::min(static_cast<std::size_t>(at), N - 2);
  const auto rgb = [](std::uint32_t c) {
    return Rgb{static_cast<std::uint8_t>(c >> 16), static_cast<std::uint8_t>(c >> 8),
               static_cast<std::uint8_t>(c)};
  };
  return blend(rgb(stops[i]), rgb(stops[i + 1]), at - static_cast<double>(i));
}

}  // namespace

Rgb elevation_colour(double t) {
  static constexpr std::array kStops{0x5B9CD6U, 0x86BE74U, 0xCBA06AU, 0xFFFFFFU};
  return along(kStops, t);
}

Rgb difference_colour(double t) {
  static constexpr std::array kStops{0x053061U, 0x4393C3U, 0xBEDAE9U, 0xFAFAFAU,
                                     0xFAC8B2U, 0xD6604DU, 0x67001FU};
  return along(kStops, t);
}

Rgb error_colour(double t) {
  static constexpr std::array kStops{0x313695U, 0x5A8FC3U, 0xABD9E9U, 0xFFFFBFU,
                                     0xFDAE61U, 0xE15538U, 0xA50026U};
  return along(kStops, t);
}

Rgb direction_colour(double turn) {
  // Four of Okabe & Ito's.
  static constexpr std::array kStops{0x0072B2U, 0xCC79A7U, 0xD55E00U, 0x009E73U, 0x0072B2U};
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

Image shaded_map(const Heightfield& field, const Light& light, const std::function<Rgb(float)>& colour,
                 double base, double by) {
  Image image(field.width, field.depth, {255, 255, 255});
  for (int j = 0; j < field.depth; ++j) {
    for (int i = 0; i < field.width; ++i) {
      const float height = field.at(i, j);
      if (Heightfield::is_no_data(height)) continue;
      image.set(i, j, lit(colour(height), base + by * light.at(i, j)));
    }
  }
  return image;
}

void PanelGrid::place(Sheet& sheet, int number, std::string_view words, const Image& image) const {
  sheet.text(x(number), y(number) - 8, words, text_size);
  sheet.picture(x(number), y(number), width, height, image);
}

Sheet titled_sheet(int columns, double width, double below, const std::vector<Panel>& panels) {
  const int count = static_cast<int>(panels.size());
  const Image& first = panels.front().image;
  const PanelGrid grid{.columns = columns,
                       .rows = (count + columns - 1) / columns,
                       .width = width,
                       .height = width * first.height / first.width,
                       .gap = 14,
                       .below = below,
                       .title = 30,
                       .text_size = 16};
  Sheet sheet(grid.sheet_width(), grid.bottom() + grid.gap);
  for (int i = 0; i < count; ++i) grid.place(sheet, i, panels[i].words, panels[i].image);
  return sheet;
}

void add_colour_key(Sheet& sheet, double x, double y, std::string_view words, double indent, double width,
                    const std::function<Rgb(double)>& colour, const std::vector<std::string>& labels) {
  std::vector<Sheet::Tick> ticks;
  for (std::size_t k = 0; k < labels.size(); ++k) {
    ticks.push_back({static_cast<double>(k) / static_cast<double>(labels.size() - 1), labels[k]});
  }
  sheet.text(x, y + 11, words, 12);
  sheet.colour_bar(x + indent, y, width, colour, ticks);
}

std::string ground_suffix(std::string_view ground, std::string_view main_ground) {
  if (ground == main_ground) return "";
  const bool plain = std::ranges::all_of(
      ground, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-'; });
  return fmt::format(".{}", plain ? std::string(ground) : ground_id(ground));
}

}  // namespace terrabench::figures
