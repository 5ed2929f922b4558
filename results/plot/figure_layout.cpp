#include "results/plot/figure_layout.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>

#include "terrain/error.h"
#include "terrain/files.h"

namespace terrabench {
namespace {

using Json = nlohmann::json;

// https://www.w3.org/TR/png: the signature, then chunks of length, type, content and CRC. IHDR comes first.
constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n", kType = "tEXt";
constexpr std::string_view kKey("terrabench layout\0", 18);
constexpr std::size_t kHeader = 8 + 12 + 13;            // signature and IHDR
constexpr std::size_t kLongest = std::size_t{1} << 20;  // bytes of a layout
constexpr std::size_t kMostPanels = 1000;

std::string big_endian(std::uint32_t value) {
  std::string bytes(4, '\0');
  for (std::size_t i = 0; i < 4; ++i) bytes[i] = static_cast<char>(value >> (24 - 8 * i) & 0xFF);
  return bytes;
}

std::size_t read_length(std::string_view bytes) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

std::string to_text(const FigureLayout& layout) {
  Json panels = Json::array();
  for (const FigurePanel& p : layout.panels) panels.push_back({p.x, p.y, p.width, p.height});
  // tEXt is Latin-1: JSON in ASCII escapes everything else.
  return Json{{"panels", panels}, {"words", layout.words}}.dump(-1, ' ', true,
                                                                Json::error_handler_t::replace);
}

std::optional<FigureLayout> from_text(std::string_view text) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) return std::nullopt;
  try {
    FigureLayout layout;
    for (const Json& p : json.at("panels")) {
      layout.panels.push_back(
          {p.at(0).get<int>(), p.at(1).get<int>(), p.at(2).get<int>(), p.at(3).get<int>()});
    }
    if (layout.panels.size() > kMostPanels) return std::nullopt;
    layout.words = json.at("words").get<std::vector<std::string>>();
    return layout;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

bool blank(const Image& image, const FigurePanel& p) {
  const Rgb first = image.pixel(p.x, p.y);
  for (int y = p.y; y < p.y + p.height; ++y) {
    for (int x = p.x; x < p.x + p.width; ++x) {
      if (image.pixel(x, y) != first) return false;
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

void write_layout(const std::filesystem::path& png, const FigureLayout& layout) {
  std::string bytes = read_file(png);
  if (bytes.size() < kHeader || !bytes.starts_with(kSignature)) {
    throw bad_input("is not a PNG", png.string(), "draw the figure again");
  }
  std::string chunk = std::string(kType) + std::string(kKey) + to_text(layout);
  const auto crc = static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(chunk.data()), static_cast<uInt>(chunk.size())));
  chunk = big_endian(static_cast<std::uint32_t>(chunk.size() - kType.size())) + chunk + big_endian(crc);
  write_file(png, bytes.insert(kHeader, chunk));
}

std::optional<FigureLayout> read_layout(const std::filesystem::path& png) {
  const std::string bytes = read_file(png);
  const std::string_view all(bytes);
  if (!all.starts_with(kSignature)) return std::nullopt;
  for (std::size_t at = kSignature.size(); at + 12 <= all.size();) {
    const std::size_t length = read_length(all.substr(at));
    if (length > all.size() - at - 12) return std::nullopt;
    const std::string_view content = all.substr(at + 8, length);
    if (all.substr(at + 4, 4) == kType && content.starts_with(kKey) && length <= kLongest) {
      return from_text(content.substr(kKey.size()));
    }
    at += length + 12;
  }
  return std::nullopt;
}

std::string layout_fault(const FigureLayout& layout, const Image& image, std::span<const int> alike) {
  const auto may_be_alike = [&](std::size_t panel) {
    return std::ranges::count(alike, static_cast<int>(panel) + 1) > 0;
  };
  const std::vector<FigurePanel>& panels = layout.panels;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const FigurePanel& p = panels[i];
    if (p.x < 0 || p.y < 0 || p.width < 1 || p.height < 1 || p.width > image.width - p.x ||
        p.height > image.height - p.y) {
      return fmt::format("panel {} lies outside the picture", i + 1);
    }
    if (blank(image, p)) return fmt::format("panel {} is blank", i + 1);
    for (std::size_t k = 0; k < i; ++k) {
      if (may_be_alike(k) && may_be_alike(i)) continue;
      if (same(image, panels[k], p)) return fmt::format("panels {} and {} show the same", k + 1, i + 1);
    }
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
