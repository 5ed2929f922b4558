#include "experiments/figures/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "results/plot/rasterise.h"
#include "results/store/format.h"
#include "terrain/files.h"

namespace terrabench::figures {
namespace {

std::string css(const Rgb& c) { return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]); }

std::string base64(std::span<const std::byte> bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return text;
}

// The texts of an SVG as written by plot_svg(), in the order drawn. Entities stay: no number has one.
std::vector<std::string> words_of(std::string_view svg) {
  std::vector<std::string> words;
  for (std::size_t at = svg.find("<text"); at != svg.npos; at = svg.find("<text", at)) {
    const std::size_t begin = svg.find('>', at) + 1;
    at = svg.find("</text>", begin);
    words.emplace_back(svg.substr(begin, at - begin));
  }
  return words;
}

// By whole numbers, so that the SVG renderer has nothing to interpolate.
Image enlarged(const Image& image, int across, int down) {
  Image large(image.width * across, image.height * down, {});
  for (int y = 0; y < large.height; ++y) {
    for (int x = 0; x < large.width; ++x) large.set(x, y, image.pixel(x / across, y / down));
  }
  return large;
}

}  // namespace

Sheet::Sheet(double width, double height)
    : width_(static_cast<int>(std::ceil(width))), height_(static_cast<int>(std::ceil(height))) {}

void Sheet::box(double x, double y, double width, double height, Rgb fill) {
  body_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n", x, y, width,
                       height, css(fill));
}

void Sheet::line(std::span<const SheetPoint> points, const Stroke& stroke) {
  body_ += fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-opacity=\"{}\"",
                       css(stroke.colour), stroke.thickness, stroke.opacity);
  if (!stroke.dashes.empty()) body_ += fmt::format(" stroke-dasharray=\"{}\"", stroke.dashes);
  body_ += " points=\"";
  for (const SheetPoint& p : points) body_ += fmt::format("{:.2f},{:.2f} ", p.x, p.y);
  body_ += "\"/>\n";
}

void Sheet::stroke(SheetPoint from, SheetPoint to, Rgb colour, double thickness) {
  line(std::array{from, to}, {.colour = colour, .thickness = thickness});
}

// A wide stroke along a circle of about half the radius fills the disc, its centre included.
void Sheet::dot(SheetPoint centre, double radius, Rgb colour) {
  circle(centre, 0.45 * radius, colour, 1.1 * radius);
}

void Sheet::ring(SheetPoint centre, double radius, Rgb colour, double thickness) {
  dot(centre, radius, {255, 255, 255});
  circle(centre, radius, colour, thickness);
}

void Sheet::cross(SheetPoint centre, double radius, Rgb colour) { rays(centre, radius, 2, 0.25, colour); }

void Sheet::star(SheetPoint centre, double radius, Rgb colour) { rays(centre, radius, 3, 0.5, colour); }

void Sheet::circle(SheetPoint centre, double radius, Rgb colour, double thickness) {
  constexpr int kCorners = 32;
  std::vector<SheetPoint> points;
  for (int k = 0; k <= kCorners + 1; ++k) {  // one corner past the first, so that the ends join
    const double angle = 2 * std::numbers::pi * k / kCorners;
    points.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  line(points, {.colour = colour, .thickness = thickness});
}

void Sheet::rays(SheetPoint centre, double radius, int count, double first, Rgb colour) {
  for (int k = 0; k < count; ++k) {
    const double angle = std::numbers::pi * (first + static_cast<double>(k) / count);
    const double dx = radius * std::cos(angle), dy = radius * std::sin(angle);
    stroke({centre.x - dx, centre.y - dy}, {centre.x + dx, centre.y + dy}, colour, radius / 3);
  }
}

void Sheet::text(double x, double y, std::string_view words, int size, std::string_view anchor, Rgb colour) {
  body_ += fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\" text-anchor=\"{}\" fill=\"{}\">{}</text>\n",
                       x, y, size, anchor, css(colour), escape_html(words));
  layout_.words.emplace_back(words);
}

void Sheet::picture(double x, double y, double width, double height, const Image& image) {
  panel(x, y, width, height);
  this->image(x, y, width, height, image);
}

void Sheet::panel(double x, double y, double width, double height) {
  const auto pixels = [](double units) { return static_cast<int>(std::lround(kPixels * units)); };
  const int left = std::max(0, pixels(x)), top = std::max(0, pixels(y));
  layout_.panels.push_back({left, top, std::min(pixels(x + width), kPixels * width_) - left,
                            std::min(pixels(y + height), kPixels * height_) - top});
}

void Sheet::image(double x, double y, double width, double height, const Image& image) {
  const auto times = [](double units, int pixels) {
    return std::max(1, static_cast<int>(std::lround(kPixels * units / pixels)));
  };
  const std::vector<std::byte> png =
      png_of(enlarged(image, times(width, image.width), times(height, image.height)));
  body_ += fmt::format(
      "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" "
      "image-rendering=\"optimizeSpeed\" href=\"data:image/png;base64,{}\"/>\n",
      x, y, width, height, base64(png));
}

void Sheet::colour_bar(double x, double y, double width, const std::function<Rgb(double)>& colour,
                       std::span<const Tick> ticks) {
  constexpr double kHeight = 12;
  constexpr Rgb kGrey{96, 96, 96};
  Image bar(static_cast<int>(kPixels * width), 1, {});
  for (int i = 0; i < bar.width; ++i) bar.set(i, 0, colour((i + 0.5) / bar.width));
  image(x, y, width, kHeight, bar);
  for (const Tick& tick : ticks) {
    const double at = x + tick.at * width;
    line(std::array{SheetPoint{at, y + kHeight}, SheetPoint{at, y + kHeight + 4}}, {.colour = kGrey});
    text(at, y + kHeight + 17, tick.words, 12, "middle");
  }
}

std::string Sheet::svg() const {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
      "viewBox=\"0 0 {0} {1}\" font-family=\"DejaVu Sans\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n{2}</svg>\n",
      width_, height_, body_);
}

void Sheet::write(const FigureFile& file) const {
  file.contains(with_repeats(layout_, write_svg(svg(), file.path, kPixels * width_)));
}

void write_chart(const FigureFile& file, const Plot& plot, int width) {
  const std::string svg = plot_svg(plot);
  const Image image = write_svg(svg, file.path, width);
  file.contains({{{0, 0, image.width, image.height}}, words_of(svg)});
}

}  // namespace terrabench::figures
