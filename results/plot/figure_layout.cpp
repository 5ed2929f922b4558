#include "results/plot/figure_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace terrabench {
namespace {

// Levels of 255 by which a pixel of a blank panel may be off: what a lossy file makes of one colour beside
// others, and the eye does not see.
constexpr int kUnseen = 12;

bool inside(const Image& image, const FigurePanel& p) {
  return p.x >= 0 && p.y >= 0 && p.width >= 1 && p.height >= 1 && p.width <= image.width - p.x &&
         p.height <= image.height - p.y;
}

bool blank(const Image& image, const FigurePanel& p) {
  const Rgb first = image.pixel(p.x, p.y);
  for (int y = p.y; y < p.y + p.height; ++y) {
    for (int x = p.x; x < p.x + p.width; ++x) {
      const Rgb pixel = image.pixel(x, y);
      for (std::size_t c = 0; c < 3; ++c) {
        if (std::abs(pixel[c] - first[c]) > kUnseen) return false;
      }
    }
  }
  return true;
}

bool same(const Image& image, const FigurePanel& a, const FigurePanel& b) {
  if (a.width != b.width || a.height != b.height) return false;
  const auto row = [&](const FigurePanel& p, int y) {
    return &image.rgb[3 * (static_cast<std::size_t>(p.y + y) * static_cast<std::size_t>(image.width) +
                           static_cast<std::size_t>(p.x))];
  };
  for (int y = 0; y < a.height; ++y) {
    if (std::memcmp(row(a, y), row(b, y), 3 * static_cast<std::size_t>(a.width)) != 0) return false;
  }
  return true;
}

}  // namespace

FigureLayout with_repeats(FigureLayout layout, const Image& image) {
  const std::vector<FigurePanel>& panels = layout.panels;
  layout.repeats.clear();
  for (auto later = panels.begin(); later != panels.end(); ++later) {
    const auto first = std::find_if(panels.begin(), later, [&](const FigurePanel& p) {
      return inside(image, p) && inside(image, *later) && same(image, p, *later);
    });
    if (first == later) continue;
    for (const auto panel : {first, later})
      layout.repeats.push_back(static_cast<int>(panel - panels.begin()) + 1);
  }
  return layout;
}

std::string layout_fault(const FigureLayout& layout, const Image& image, std::span<const int> alike) {
  for (std::size_t i = 0; i < layout.panels.size(); ++i) {
    if (!inside(image, layout.panels[i])) return fmt::format("panel {} lies outside the picture", i + 1);
    if (blank(image, layout.panels[i])) return fmt::format("panel {} is blank", i + 1);
  }
  for (std::size_t i = 0; i + 1 < layout.repeats.size(); i += 2) {
    const int first = layout.repeats[i], later = layout.repeats[i + 1];
    if (std::ranges::count(alike, first) > 0 && std::ranges::count(alike, later) > 0) continue;
    return fmt::format("panels {} and {} show the same", first, later);
  }
  return "";
}

bool says(const FigureLayout& layout, double value) {
  for (std::string words : layout.words) {
    std::erase(words, ',');  // thousands
    for (std::size_t at = 0; at < words.size();) {
      const std::size_t begin = words.find_first_of("0123456789", at);
      if (begin == words.npos) break;
      std::size_t end = words.find_first_not_of("0123456789.", begin);
      if (end == words.npos) end = words.size();
      std::string digits = words.substr(begin, end - begin);
      at = end;
      while (digits.ends_with('.')) digits.pop_back();
      const std::size_t dot = digits.find('.');
      const auto decimals = dot == digits.npos ? 0 : static_cast<int>(digits.size() - dot - 1);
      double printed = std::strtod(digits.c_str(), nullptr);
      const bool negative = begin > 0 && (words[begin - 1] == '-' || words.substr(0, begin).ends_with("−"));
      if (negative) printed = -printed;
      const double half = 0.5 * std::pow(10.0, -decimals);  // a unit of the last digit
      const bool fine = half <= std::max(0.05 * std::abs(value), 0.005);
      // A little more than half, for numbers that end in 5. The 0 of an axis does not say 0.27; 0.00 says
      // 0.004.
      if (printed == value || (fine && std::abs(printed - value) <= 1.0002 * half)) return true;
    }
  }
  return false;
}

}  // namespace terrabench
