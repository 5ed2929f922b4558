#include "experiments/drill/sheet.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "results/rasterise.h"
#include "terrain/files.h"

namespace terrabench::drill {
namespace {

std::string css(const Rgb& c) { return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]); }

std::string escaped(std::string_view words) {
  std::string text;
  for (const char c : words) {
    if (c == '&') {
      text += "&amp;";
    } else if (c == '<') {
      text += "&lt;";
    } else {
      text += c;
    }
  }
  return text;
}

Rgb blend(const Rgb& a, const Rgb& b, double t) {
  Rgb c;
  for (int i = 0; i < 3; ++i) c[i] = static_cast<std::uint8_t>(std::lround(a[i] + (b[i] - a[i]) * t));
  return c;
}

std::string base64(std::string_view bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return text;
}

template <std::size_t N>
Rgb along(const std::array<Rgb, N>& stops, double t) {
  const double at = std::clamp(t, 0.0, 1.0) * (N - 1);
  const auto i = std::min(static_cast<std::size_t>(at), N - 2);
  return blend(stops[i], stops[i + 1], at - static_cast<double>(i));
}

}  // namespace

void Sheet::box(double x, double y, double width, double height, Rgb fill) {
  body_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n", x, y, width,
                       height, css(fill));
}

void Sheet::line(std::span<const SheetPoint> points, Rgb colour, double thickness, double opacity) {
  body_ +=
      fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-opacity=\"{}\" points=\"",
                  css(colour), thickness, opacity);
  for (const SheetPoint& p : points) body_ += fmt::format("{:.2f},{:.2f} ", p.x, p.y);
  body_ += "\"/>\n";
}

void Sheet::text(double x, double y, std::string_view words, int size, std::string_view anchor, Rgb colour) {
  body_ += fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\" text-anchor=\"{}\" fill=\"{}\">{}</text>\n",
                       x, y, size, anchor, css(colour), escaped(words));
}

void Sheet::picture(double x, double y, double width, double height, const Image& image) {
  // By way of a file, which is what writes PNG.
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / fmt::format("terrabench-panel.{}.png", getpid());
  write_png(file, image);
  const std::string bytes = read_file(file);
  std::filesystem::remove(file);
  body_ += fmt::format(
      "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" "
      "image-rendering=\"optimizeSpeed\" href=\"data:image/png;base64,{}\"/>\n",
      x, y, width, height, base64(bytes));
}

void Sheet::write(const std::filesystem::path& png) const {
  std::filesystem::path svg = png;
  svg += ".svg";
  write_file(svg, fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
                              "viewBox=\"0 0 {0} {1}\" font-family=\"DejaVu Sans\">\n"
                              "<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n{2}</svg>\n",
                              width_, height_, body_));
  try {
    svg_to_png(svg, png, 2 * width_);
  } catch (...) {
    std::filesystem::remove(svg);
    throw;
  }
  std::filesystem::remove(svg);
}

Rgb height_colour(double t) {
  static constexpr std::array<Rgb, 6> kStops{
      {{52, 98, 178}, {70, 150, 110}, {120, 170, 80}, {160, 130, 80}, {190, 165, 135}, {252, 252, 252}}};
  return along(kStops, t);
}

Rgb error_colour(double t) {
  static constexpr std::array<Rgb, 5> kStops{
      {{48, 80, 200}, {130, 180, 230}, {240, 240, 220}, {240, 150, 90}, {190, 20, 40}}};
  return along(kStops, t);
}

Image relief(const Heightfield& field, double lowest, double highest) {
  Image image(field.width, field.depth, {255, 255, 255});
  const auto height = [&](int i, int j, float fallback) {
    const float h = field.at(std::clamp(i, 0, field.width - 1), std::clamp(j, 0, field.depth - 1));
    return Heightfield::is_no_data(h) ? fallback : h;
  };
  for (int j = 0; j < field.depth; ++j) {
    for (int i = 0; i < field.width; ++i) {
      const float h = field.at(i, j);
      if (Heightfield::is_no_data(h)) continue;
      const double east = (height(i + 1, j, h) - height(i - 1, j, h)) / (2 * field.cell_x);
      const double south = (height(i, j + 1, h) - height(i, j - 1, h)) / (2 * field.cell_z);
      // Lambert's law with the sun in the north-west, halfway up.
      const double light = (0.5 * east + 0.5 * south + 0.7071) / std::sqrt(1 + east * east + south * south);
      const double shade = std::clamp(0.35 + 0.92 * light, 0.0, 1.0);
      const Rgb base =
          highest > lowest ? height_colour((h - lowest) / (highest - lowest)) : Rgb{225, 225, 225};
      image.set(i, j, blend({0, 0, 0}, base, shade));
    }
  }
  return image;
}

}  // namespace terrabench::drill
