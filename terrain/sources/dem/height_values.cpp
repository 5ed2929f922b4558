#include "terrain/sources/dem/height_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <type_traits>

#include "terrain/error.h"
#include "terrain/heightfield.h"

namespace terrabench {
namespace {

// Metres per unit, by the unit's name in GDAL.
double metres_per_height_unit(const std::string& unit, std::vector<std::string>& notes) {
  struct Unit {
    std::string_view name;
    double metres;
  };
  constexpr double kFoot = 0.3048, kSurveyFoot = 1200.0 / 3937.0;
  constexpr Unit kUnits[] = {{"m", 1},
                             {"metre", 1},
                             {"metres", 1},
                             {"meter", 1},
                             {"meters", 1},
                             {"ft", kFoot},
                             {"foot", kFoot},
                             {"feet", kFoot},
                             {"international foot", kFoot},
                             {"us survey foot", kSurveyFoot},
                             {"us survey feet", kSurveyFoot},
                             {"us-ft", kSurveyFoot},
                             {"ftus", kSurveyFoot},
                             {"foot_us", kSurveyFoot},
                             {"km", 1000},
                             {"kilometre", 1000},
                             {"kilometer", 1000},
                             {"dm", 0.1},
                             {"decimetre", 0.1},
                             {"decimeter", 0.1},
                             {"cm", 0.01},
                             {"centimetre", 0.01},
                             {"centimeter", 0.01},
                             {"mm", 0.001},
                             {"millimetre", 0.001},
                             {"millimeter", 0.001},
                             {"fathom", 1.8288},
                             {"yd", 0.9144},
                             {"yard", 0.9144}};
  if (unit.empty()) return 1;
  std::string lower(unit);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  for (const Unit& known : kUnits) {
    if (known.name != lower) continue;
    if (known.metres != 1) notes.push_back(fmt::format("heights in '{}' were converted to metres", unit));
    return known.metres;
  }
  notes.push_back(
      fmt::format("heights are in '{}', which is no known unit of length: taken as metres", unit));
  return 1;
}

// No ground is a thousand kilometres high: such values are undeclared no-data (±3.4e38, 1e20), as are NaN and
// infinity.
constexpr float kImpossible = 1e6F;

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
  const double scale = rule.scale, offset = rule.offset;
  // Without branches, and counted in 32 bits, so that it vectorises.
  unsigned missing = 0, impossible = 0;
  for (int i = 0; i < width; ++i) {
    const T value = in[i];
    const auto height = static_cast<float>(static_cast<double>(value) * scale + offset);
    unsigned is_hole = unsigned{value == hole} | (unsigned{nan_is_missing} & unsigned{value != value});
    if constexpr (kMasked) is_hole |= unsigned{mask[i] == 0};
    const unsigned is_wrong = unsigned{!(std::abs(height) <= kImpossible)} & ~is_hole;
    missing += is_hole;
    impossible += is_wrong;
    out[i] = (is_hole | is_wrong) != 0 ? Heightfield::kNoData : height;
  }
  tally.missing += missing;
  tally.impossible += impossible;
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

}  // namespace

HeightRule height_rule(GDALRasterBand& band, const std::string& where, std::vector<std::string>& notes) {
  HeightRule rule;
  int given = 0;
  const GDALDataType type = band.GetRasterDataType();
  if (type == GDT_Int64) {
    const std::int64_t value = band.GetNoDataValueAsInt64(&given);
    if (given != 0) rule.no_data = static_cast<double>(value);
  } else if (type == GDT_UInt64) {
    const std::uint64_t value = band.GetNoDataValueAsUInt64(&given);
    if (given != 0) rule.no_data = static_cast<double>(value);
  } else {
    const double value = band.GetNoDataValue(&given);
    if (given != 0) rule.no_data = value;
  }
  rule.masked = (band.GetMaskFlags() & (GMF_ALL_VALID | GMF_NODATA)) == 0;
  const double scale = band.GetScale(&given), offset = band.GetOffset(&given);
  if (!std::isfinite(scale) || !std::isfinite(offset) || scale == 0) {
    throw bad_input(fmt::format("its heights are scaled by {} and shifted by {}", scale, offset), where,
                    "set both anew with gdal_edit.py -scale 1 -offset 0");
  }
  if (scale != 1 || offset != 0) {
    notes.push_back(fmt::format("heights are the stored numbers times {:.6g} plus {:.6g}", scale, offset));
  }
  const double metres = metres_per_height_unit(band.GetUnitType(), notes);
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
