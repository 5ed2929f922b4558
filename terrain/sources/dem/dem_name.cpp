// Names of DEMs with options: "dem:FILE,OPTION=VALUE…".
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "terrain/error.h"
#include "terrain/number.h"
#include "terrain/parameters.h"
#include "terrain/sources/dem/dem.h"
#include "terrain/sources/dem/height_values.h"

namespace terrabench {
namespace {

constexpr std::string_view kAsStored = "as stored", kCrop = ",crop=";
constexpr std::array<std::string_view, 3> kEncodings = {"numbers", "terrarium", "mapbox"};

std::span<const ParameterSpec> specs() {
  static const std::vector<std::string_view> units = [] {
    std::vector<std::string_view> names{kAsStored};
    names.insert(names.end(), height_units().begin(), height_units().end());
    return names;
  }();
  static const std::array all{
      ParameterSpec{"band", std::int64_t{0}, "", "counted from 1", 1, 65535},
      ParameterSpec{"nodata", std::string(), "", "the number that stands for no height, or none"},
      choice("unit", units, "of the heights"),
      choice("encoding", kEncodings, "of heights as colours"),
      ParameterSpec{"crop", std::string(), "", "the part to read, WIDTHxDEPTH or WIDTHxDEPTH+COLUMN+ROW"},
  };
  return all;
}

// NaN for "none".
double parse_no_data(const std::string& text) {
  if (text == "none") return std::nan("");
  const std::optional<double> value = parse_number<double>(text);
  if (!value) {
    throw usage_error(fmt::format("nodata must be a number or none, got '{}'", text), kDemPrefix,
                      "such as nodata=-9999");
  }
  return *value;
}

// "257x129" or "257x129+100+50".
std::optional<DemWindow> window_from(std::string_view text) {
  std::array<int, 4> numbers{};
  std::size_t count = 0;
  for (bool more = true; more; ++count) {
    const std::size_t end = text.find(count == 0 ? 'x' : '+');
    more = end != text.npos;
    const auto number = parse_number<int>(text.substr(0, end));
    if (!number || *number < (count < 2 ? 1 : 0) || count == numbers.size()) return std::nullopt;
    numbers[count] = *number;
    if (more) text.remove_prefix(end + 1);
  }
  if (count != 2 && count != 4) return std::nullopt;
  return DemWindow{numbers[2], numbers[3], numbers[0], numbers[1], count == 2};
}

DemWindow parse_crop(const std::string& text, const DemOptions& options) {
  const std::optional<DemWindow> window = window_from(text);
  if (!window) {
    throw usage_error(fmt::format("crop must be WIDTHxDEPTH, which lies in the middle, or "
                                  "WIDTHxDEPTH+COLUMN+ROW, got '{}'",
                                  text),
                      kDemPrefix, "such as crop=257x257 or crop=257x129+1000+400");
  }
  if (!options.window.whole()) throw usage_error("is cropped twice", "--crop", "leave out one");
  return *window;
}

}  // namespace

NamedDem parse_dem(std::string_view name, const DemOptions& options) {
  if (!name.starts_with(kDemPrefix)) return {std::string(name), options};
  NamedFile named = parse_named_file(name.substr(kDemPrefix.size()), specs());
  const Parameters& given = named.options;
  NamedDem dem{std::move(named.file), options};
  if (given.integer("band") > 0) dem.options.band = static_cast<int>(given.integer("band"));
  if (!given.text("nodata").empty()) dem.options.no_data = parse_no_data(given.text("nodata"));
  if (given.text("unit") != kAsStored) dem.options.unit = given.text("unit");
  if (const std::size_t k = given.choice("encoding"); k > 0)
    dem.options.encoding = static_cast<HeightEncoding>(k);
  if (!given.text("crop").empty()) dem.options.window = parse_crop(given.text("crop"), options);
  return dem;
}

std::string cropped(std::string_view name, const DemWindow& window) {
  const std::string text = fmt::format("{}{}{}x{}", name, kCrop, window.width, window.depth);
  const std::string place = window.in_middle ? "" : fmt::format("+{}+{}", window.x, window.y);
  return (name.starts_with(kDemPrefix) ? "" : std::string(kDemPrefix)) + text + place;
}

std::string readable_dem(std::string_view name) {
  if (name.starts_with(kDemPrefix)) name.remove_prefix(kDemPrefix.size());
  const std::size_t at = name.find(kCrop);
  if (at == name.npos) return std::string(name);
  const std::string_view value = name.substr(at + kCrop.size(), name.find(',', at + 1) - at - kCrop.size());
  const std::optional<DemWindow> window = window_from(value);
  if (!window) return std::string(name);
  const std::string size = fmt::format("{} × {}", window->width, window->depth);
  return fmt::format("{}, {}{}", name.substr(0, at),
                     window->in_middle ? "its middle " + size
                                       : fmt::format("{} from column {}, row {}", size, window->x, window->y),
                     name.substr(at + kCrop.size() + value.size()));
}

}  // namespace terrabench
