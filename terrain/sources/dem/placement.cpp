#include "terrain/sources/dem/placement.h"

#include <cpl_conv.h>
#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "terrain/error.h"

namespace terrabench {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

// What the coordinates of the grid are measured in.
struct CoordinateUnit {
  bool angular = false;
  double size = 1;  // degrees or metres in one unit
  double semi_major = 6378137.0, inverse_flattening = 298.257223563;
};

std::string angle(double degrees) {
  if (degrees < 1.0 / 60) return fmt::format("{:.4g}″", degrees * 3600);
  return fmt::format("{:.4g}°", degrees);
}

std::string latitude_text(double latitude) {
  return fmt::format("{:.1f}° {}", std::abs(latitude), latitude < 0 ? "S" : "N");
}

std::string well_known_text(const OGRSpatialReference& reference) {
  char* text = nullptr;
  const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
  std::string out;
  if (reference.exportToWkt(&text, options) == OGRERR_NONE && text != nullptr) out = text;
  CPLFree(text);
  return out;
}

CoordinateUnit unit_of(const OGRSpatialReference& reference) {
  CoordinateUnit unit;
  if (reference.IsGeographic() != 0) {
    unit.angular = true;
    unit.size = reference.GetAngularUnits() / kRadiansPerDegree;
    OGRErr error = OGRERR_NONE;
    const double semi_major = reference.GetSemiMajor(&error);
    if (error == OGRERR_NONE && semi_major > 0) {
      unit.semi_major = semi_major;
      unit.inverse_flattening = reference.GetInvFlattening(&error);
    }
  } else {
    unit.size = reference.GetLinearUnits();
  }
  return unit;
}

// Nobody surveys ground at centimetre cells from an origin that happens to be a longitude and a latitude.
bool looks_like_degrees(const std::array<double, 6>& t, int width, int depth) {
  constexpr double kLargestCell = 0.1;
  const double east = t[0] + width * t[1], south = t[3] + depth * t[5];
  const auto within = [](double a, double b, double limit) {
    return std::max(std::abs(a), std::abs(b)) <= limit;
  };
  return std::abs(t[1]) < kLargestCell && std::abs(t[5]) < kLargestCell && within(t[0], east, 360) &&
         within(t[3], south, 90) && !(t[0] == 0 && t[3] == 0);
}

void check_transform(const std::array<double, 6>& t, const std::string& where) {
  if (!std::all_of(t.begin(), t.end(), [](double v) { return std::isfinite(v); })) {
    throw bad_input("its georeference holds values that are no numbers", where,
                    "set it anew with gdal_edit.py -a_ullr WEST NORTH EAST SOUTH");
  }
  // Rounding of writers leaves shears around 1e-12 of a cell.
  constexpr double kStraight = 1e-6;
  if (std::abs(t[2]) > kStraight * std::abs(t[1]) || std::abs(t[4]) > kStraight * std::abs(t[5])) {
    throw bad_input("its grid is rotated against north", where,
                    "turn it with gdalwarp INPUT OUTPUT.tif, which resamples it to rows from west to east");
  }
  if (t[1] == 0 || t[5] == 0) {
    throw bad_input("its cells have no size", where,
                    "set it anew with gdal_edit.py -a_ullr WEST NORTH EAST SOUTH");
  }
}

void size_in_degrees(const CoordinateUnit& unit, const std::array<double, 6>& t, const DemWindow& window,
                     const std::string& where, Placement& placement, std::vector<std::string>& notes) {
  const double middle = (t[3] + 0.5 * window.depth * t[5]) * unit.size;
  // Grids that cover the Earth may reach half a cell beyond the pole, but their middle cannot.
  if (!(std::abs(middle) < 90)) {
    throw bad_input(
        fmt::format("its middle latitude would be {:.6g}°", middle), where,
        "its coordinates are no degrees: name the right reference system with gdal_translate -a_srs");
  }
  const DegreeLengths degree = degree_lengths(middle, unit.semi_major, unit.inverse_flattening);
  const double dx = std::abs(t[1]) * unit.size, dy = std::abs(t[5]) * unit.size;
  placement.cell_x = dx * degree.east;
  placement.cell_z = dy * degree.north;
  const std::string cells = angle(dx) == angle(dy) ? angle(dx) : angle(dx) + " × " + angle(dy);
  notes.push_back(fmt::format("cells of {} are {:.1f} m × {:.1f} m at {}", cells, placement.cell_x,
                              placement.cell_z, latitude_text(middle)));
}

}  // namespace

DegreeLengths degree_lengths(double latitude, double semi_major, double inverse_flattening) {
  const double flattening = inverse_flattening > 0 ? 1 / inverse_flattening : 0;  // 0 stands for a sphere
  const double e2 = flattening * (2 - flattening);
  const double sine = std::sin(latitude * kRadiansPerDegree), cosine = std::cos(latitude * kRadiansPerDegree);
  const double q = 1 - e2 * sine * sine;
  return {kRadiansPerDegree * semi_major * cosine / std::sqrt(q),
          kRadiansPerDegree * semi_major * (1 - e2) / (q * std::sqrt(q))};
}

bool same_reference_system(const std::string& a, const std::string& b) {
  if (a == b) return true;
  OGRSpatialReference first, second;
  return first.importFromWkt(a.c_str()) == OGRERR_NONE && second.importFromWkt(b.c_str()) == OGRERR_NONE &&
         first.IsSame(&second) != 0;
}

Placement place_raster(GDALDataset& dataset, const DemWindow& window, const std::string& where,
                       std::vector<std::string>& notes) {
  Placement placement;
  std::array<double, 6>& t = placement.georeference.transform;
  const std::array<double, 6> none{0, 1, 0, 0, 0, 1};  // GDAL's way to say that there is none
  if (dataset.GetGeoTransform(t.data()) != CE_None || t == none) {
    t = {};
    notes.push_back("the file does not say how large its cells are: taken as 1 m");
    return placement;
  }
  check_transform(t, where);
  t[0] += window.x * t[1] + window.y * t[2];
  t[3] += window.x * t[4] + window.y * t[5];
  placement.mirrored = t[1] < 0;
  placement.south_first = t[5] > 0;
  CoordinateUnit unit;
  const OGRSpatialReference* const reference = dataset.GetSpatialRef();
  if (reference != nullptr && !reference->IsEmpty()) {
    placement.georeference.crs = well_known_text(*reference);
    unit = unit_of(*reference);
  } else if (looks_like_degrees(t, window.width, window.depth)) {
    unit.angular = true;
    notes.push_back(
        "the file names no reference system, but its coordinates look like degrees: taken as WGS 84");
  } else {
    notes.push_back("the file names no reference system: its coordinates are taken as metres");
  }
  if (unit.angular) {
    size_in_degrees(unit, t, window, where, placement, notes);
  } else {
    placement.cell_x = std::abs(t[1]) * unit.size;
    placement.cell_z = std::abs(t[5]) * unit.size;
    if (unit.size != 1) {
      notes.push_back(fmt::format("cells of {:.6g} × {:.6g} units are {:.6g} m × {:.6g} m", std::abs(t[1]),
                                  std::abs(t[5]), placement.cell_x, placement.cell_z));
    }
  }
  const auto usable = [](double cell) {
    return static_cast<float>(cell) >= std::numeric_limits<float>::min() &&
           std::isfinite(static_cast<float>(cell));
  };
  if (!usable(placement.cell_x) || !usable(placement.cell_z)) {
    throw bad_input(fmt::format("its cells would be {:.6g} m × {:.6g} m", placement.cell_x, placement.cell_z),
                    where, "set its georeference anew with gdal_edit.py -a_ullr WEST NORTH EAST SOUTH");
  }
  return placement;
}

}  // namespace terrabench
