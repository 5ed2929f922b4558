#include "terrain/sources/dem/height_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <type_traits>

#include "terrain/error.h"
#include "terrain/heightfield.h"
#include "terrain/printable.h"

namespace terrabench {
namespace {

// Metres per unit of length, by the unit's name in lower case. The first ones are those that an option takes.
struct Unit {
  std::string_view name;
  double metres;
};
constexpr double kFoot = 0.3048, kSurveyFoot = 1200.0 / 3937.0;
constexpr std::array kUnits{Unit{"m", 1},
                            Unit{"ft", kFoot},
                            Unit{"us-ft", kSurveyFoot},
                            Unit{"km", 1000},
                            Unit{"dm", 0.1},
                            Unit{"cm", 0.01},
                            Unit{"mm", 0.001},
                            Unit{"yd", 0.9144},
                            Unit{"fathom", 1.8288},
                            Unit{"metre", 1},
                            Unit{"metres", 1},
                            Unit{"meter", 1},
                            Unit{"meters", 1},
                            Unit{"foot", kFoot},
                            Unit{"feet", kFoot},
                            Unit{"international foot", kFoot},
                            Unit{"us survey foot", kSurveyFoot},
                            Unit{"us survey feet", kSurveyFoot},
                            Unit{"ftus", kSurveyFoot},
                            Unit{"foot_us", kSurveyFoot},
                            Unit{"kilometre", 1000},
                            Unit{"kilometer", 1000},
                            Unit{"decimetre", 0.1},
                            Unit{"decimeter", 0.1},
                            Unit{"centimetre", 0.01},
                            Unit{"centimeter", 0.01},
                            Unit{"millimetre", 0.001},
                            Unit{"millimeter", 0.001},
                            Unit{"yard", 0.9144}};
constexpr std::size_t kUnitsOfOption = 9;

const Unit* find_unit(std::string name) {
  std::ranges::transform(name, name.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  const auto* const unit = std::ranges::find(kUnits, std::string_view(name), &Unit::name);
  return unit == kUnits.end() ? nullptr : unit;
}

// Metres per unit of the heights: by the option, or else the band, or else the vertical reference system.
double metres_per_height_unit(const std::string& stored, const DemOptions& options,
                              const Placement& placement, std::vector<std::string>& notes) {
  const std::string& named = options.unit.empty() ? stored : options.unit;
  if (!named.empty()) {
    const Unit* const unit = find_unit(named);
    if (unit == nullptr) {
      notes.push_back(fmt::format("heights are in '{}', which is no known unit of length: taken as metres",
                                  printable(named)));
      return 1;
    }
    if (unit->metres != 1) notes.push_back(fmt::format("heights in '{}' were converted to metres", named));
    return unit->metres;
  }
  if (placement.vertical_unit) {
    if (*placement.vertical_unit != 1)
      notes.push_back("heights in the unit of the vertical reference system were converted to metres");
    return *placement.vertical_unit;
  }
  if (placement.plan_unit != 1) {
    notes.push_back(
        fmt::format("its plan is not in metres, and the unit of its heights is not named: taken as "
                    "metres; {}FILE,unit=ft takes them as feet",
                    kDemPrefix));
  }
  return 1;
}

// No ground is a thousand kilometres high. Values beyond a million kilometres stand for no height (±3.4e38,
// 1e20, the least 32-bit number), as NaN and infinity do; those between come from another unit.
constexpr float kTooHigh = 1e6F, kImpossible = 1e9F;

// One row. Floats are converted in place, which the compiler must see to vectorise it: `in` is `out` then.
// `mask` is read when kMasked; 0 in it means no height.
template <bool kMasked, class T>
void convert_row(const T* in, const std::uint8_t* mask, int width, const HeightRule& rule, float* out,
                 Tally& tally) {
  if constexpr (std::is_same_v<T, float>) in = out;
  const bool nan_is_missing = rule.no_data && std::isnan(*rule.no_data);
  // Compared in the file's type: -3.4028234663852886e+38 stands for a float. NaN equals nothing.
  const double no_data = rule.no_data.value_or(std::nan(""));
  const T hole =
      std::abs(no_data) <= std::numeric_limits<T>::max() ? static_cast<T>(no_data) : static_cast<T>(NAN);
  std::array<T, 3> usual;
  std::ranges::transform(rule.undeclared, usual.begin(), [](double v) { return static_cast<T>(v); });
  const double scale = rule.scale, offset = rule.offset;
  // Without branches, and counted in 32 bits, so that it vectorises.
  unsigned missing = 0, impossible = 0, too_high = 0, first = 0, second = 0, third = 0;
  for (int i = 0; i < width; ++i) {
    const T value = in[i];
    const auto height = static_cast<float>(static_cast<double>(value) * scale + offset);
    unsigned is_hole = unsigned{value == hole} | (unsigned{nan_is_missing} & unsigned{value != value});
    if constexpr (kMasked) is_hole |= unsigned{mask[i] == 0};
    const unsigned is_first = unsigned{value == usual[0]} & ~is_hole;
    const unsigned is_second = unsigned{value == usual[1]} & ~is_hole;
    const unsigned is_third = unsigned{value == usual[2]} & ~is_hole;
    const unsigned is_any = is_hole | is_first | is_second | is_third;
    const unsigned is_wrong = unsigned{!(std::abs(height) <= kTooHigh)} & ~is_any;
    const unsigned is_impossible = unsigned{!(std::abs(height) <= kImpossible)} & is_wrong;
    missing += is_hole;
    first += is_first;
    second += is_second;
    third += is_third;
    impossible += is_impossible;
    too_high += is_wrong & ~is_impossible;
    out[i] = (is_any | is_wrong) != 0 ? Heightfield::kNoData : height;
  }
  tally.missing += missing;
  tally.undeclared[0] += first;
  tally.undeclared[1] += second;
  tally.undeclared[2] += third;
  tally.impossible += impossible;
  tally.too_high += too_high;
}

template <class T>
void convert(const T* in, const std::uint8_t* mask, int width, int rows, const HeightRule& rule, float* out,
             Tally& tally) {
  for (int j = 0; j < rows; ++j) {
    const std::size_t at = static_cast<std::size_t>(j) * static_cast<std::size_t>(width);
    if (mask != nullptr) {
      convert_row<true>(in + at, mask + at, width, rule, out + at, tally);
    } else {
      convert_row<false>(in + at, mask, width, rule, out + at, tally);
    }
  }
}

std::optional<double> declared_no_data(GDALRasterBand& band) {
  int given = 0;
  double value = 0;
  if (band.GetRasterDataType() == GDT_Int64) {
    value = static_cast<double>(band.GetNoDataValueAsInt64(&given));
  } else if (band.GetRasterDataType() == GDT_UInt64) {
    value = static_cast<double>(band.GetNoDataValueAsUInt64(&given));
  } else {
    value = band.GetNoDataValue(&given);
  }
  return given != 0 ? std::optional(value) : std::nullopt;
}

}  // namespace

std::span<const std::string_view> height_units() {
  static constexpr auto kNames = [] {
    std::array<std::string_view, kUnitsOfOption> names;
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = kUnits[i].name;
    return names;
  }();
  return kNames;
}

HeightRule height_rule(GDALRasterBand& band, const DemOptions& options, const Placement& placement,
                       const std::string& where, std::vector<std::string>& notes) {
  HeightRule rule;
  rule.undeclared.fill(std::nan(""));
  rule.masked = (band.GetMaskFlags() & (GMF_ALL_VALID | GMF_NODATA)) == 0;
  if (options.encoding != HeightEncoding::kNumbers) {
    const bool mapbox = options.encoding == HeightEncoding::kMapbox;
    rule.weights = mapbox ? std::array{65536.0, 256.0, 1.0} : std::array{256.0, 1.0, 1.0 / 256};
    rule.scale = mapbox ? 0.1 : 1;
    rule.offset = mapbox ? -10000 : -32768;
    rule.no_data = options.no_data ? (*options.no_data - rule.offset) / rule.scale : 0;  // black is no height
    return rule;
  }
  const char* const pixel_type = band.GetMetadataItem("PIXELTYPE", "IMAGE_STRUCTURE");
  rule.signed_bytes = band.GetRasterDataType() == GDT_Byte && pixel_type != nullptr &&
                      std::string_view(pixel_type) == "SIGNEDBYTE";
  rule.no_data = options.no_data ? options.no_data : declared_no_data(band);
  if (!options.no_data) {
    rule.undeclared = kUsualNoData;
    // Where another number is declared, this one may be a depth.
    if (rule.no_data) rule.undeclared[2] = std::nan("");
  }
  int given = 0;
  const double scale = band.GetScale(&given), offset = band.GetOffset(&given);
  if (!std::isfinite(scale) || !std::isfinite(offset) || scale == 0) {
    throw bad_input(fmt::format("its heights are scaled by {} and shifted by {}", scale, offset), where,
                    "set both anew with gdal_edit.py -scale 1 -offset 0");
  }
  if (scale != 1 || offset != 0) {
    notes.push_back(fmt::format("heights are the stored numbers times {:.6g} plus {:.6g}", scale, offset));
  }
  const double metres = metres_per_height_unit(band.GetUnitType(), options, placement, notes);
  rule.scale = scale * metres;
  rule.offset = offset * metres;
  return rule;
}

void to_metres(float* heights, const std::uint8_t* mask, int width, int rows, const HeightRule& rule,
               Tally& tally) {
  convert(heights, mask, width, rows, rule, heights, tally);
}

void to_metres(const double* in, const std::uint8_t* mask, int width, int rows, const HeightRule& rule,
               float* out, Tally& tally) {
  convert(in, mask, width, rows, rule, out, tally);
}

}  // namespace terrabench
