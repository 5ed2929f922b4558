#include <fmt/format.h>

#include <array>
#include <cmath>

#include "terrain/error.h"
#include "terrain/number.h"
#include "terrain/sources/dem/dem.h"
#include "terrain/sources/dem/height_values.h"
#include "terrain/sources/named_file.h"

namespace terrabench {
namespace {

constexpr std::string_view kAsStored = "as stored";
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
  return dem;
}

}  // namespace terrabench
