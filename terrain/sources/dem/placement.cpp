#include "terrain/sources/dem/placement.h"

#include <cpl_conv.h>
#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "terrain/error.h"

namespace terrabench {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;
constexpr std::array<double, 6> kNoTransform{0, 1, 0, 0, 0, 1};  // GDAL's way to say that there is none

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

CoordinateUnit unit_of(const OGRSpatialReference& reference, const std::string& where) {
  CoordinateUnit unit;
  if (reference.IsGeocentric() != 0) {
    throw bad_input(
        "its reference system is geocentric: it measures from the Earth's centre, not along the ground",
        where, "project it with gdalwarp -t_srs, to a UTM zone for example");
  }
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

bool within_the_globe(const std::array<double, 6>& t, int width, int depth) {
  const double east = t[0] + width * t[1], south = t[3] + depth * t[5];
  const auto within = [](double a, double b, double limit) {
    return std::max(std::abs(a), std::abs(b)) <= limit;
  };
  // A plot measured from its own corner begins at 0.
  const bool own_origin = t[0] == 0 && (t[3] == 0 || std::abs(south) < 1e-6 * std::abs(t[5]));
  return within(t[0], east, 360) && within(t[3], south, 90) && !own_origin;
}

// Nobody surveys ground at centimetre cells from an origin that happens to be a longitude and a latitude.
bool looks_like_degrees(const std::array<double, 6>& t, int width, int depth) {
  constexpr double kLargestCell = 0.1;
  return std::abs(t[1]) < kLargestCell && std::abs(t[5]) < kLargestCell && within_the_globe(t, width, depth);
}

// Whole degrees of a coarse grid of the Earth, or the metres of a small plot.
bool could_be_degrees(const std::array<double, 6>& t, int width, int depth) {
  constexpr double kLeastExtent = 10;
  return width * std::abs(t[1]) >= kLeastExtent && depth * std::abs(t[5]) >= kLeastExtent &&
         within_the_globe(t, width, depth);
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

std::optional<double> vertical_unit(const OGRSpatialReference& reference) {
  if (reference.IsVertical() == 0) return std::nullopt;
  const double metres = reference.GetTargetLinearUnits("VERT_CS");
  return metres > 0 ? std::optional(metres) : std::nullopt;
}

void remove_authority(OGR_SRSNode& node) {
  if (const int at = node.FindChild("AUTHORITY"); at >= 0) node.DestroyChild(at);
}

// The reference system of what is read: where the file's has heights in another unit than metres, the same
// with heights in metres.
OGRSpatialReference in_metres_of_height(const OGRSpatialReference& reference) {
  const std::optional<double> unit = vertical_unit(reference);
  char* text = nullptr;
  if (!unit || *unit == 1 || reference.exportToWkt(&text) != OGRERR_NONE) return reference;
  OGR_SRSNode root;
  const char* rest = text;
  const bool parsed = root.importFromWkt(&rest) == OGRERR_NONE;
  CPLFree(text);
  OGR_SRSNode* const vertical = parsed ? root.GetNode("VERT_CS") : nullptr;
  OGR_SRSNode* const named_unit = vertical == nullptr ? nullptr : vertical->GetNode("UNIT");
  if (named_unit == nullptr) return reference;
  // EPSG's names end in the unit: "NAVD88 height (ftUS)". Its codes are those of the system in feet.
  const std::string name = vertical->GetChild(0)->GetValue();
  vertical->GetChild(0)->SetValue(name.substr(0, name.rfind(" (")).c_str());
  remove_authority(root);
  remove_authority(*vertical);
  named_unit->ClearChildren();
  named_unit->AddChild(new OGR_SRSNode("metre"));  // the parent deletes it
  named_unit->AddChild(new OGR_SRSNode("1"));
  OGRSpatialReference metric;
  char* changed = nullptr;
  if (root.exportToWkt(&changed) == OGRERR_NONE) metric.importFromWkt(changed);
  CPLFree(changed);
  return metric;
}

// What a step of one cell along the columns and along the rows is on the ground.
struct GroundStep {
  double east, north;  // metres
  double length() const { return std::hypot(east, north); }
};

// Replaces the size of the cells by that of the ground under them where a projection stretches it, measured
// in the middle of the window. One per cent is more than the projections of surveys (UTM, state planes)
// stretch: their cells keep the size that the file names.
void size_on_ground(const OGRSpatialReference& reference, const DemWindow& window, Placement& placement,
                    std::vector<std::string>& notes) {
  constexpr double kMostStretched = 0.01;
  const GdalMessages quiet;  // a place that PROJ cannot compute is no failure of the file
  OGRSpatialReference plan = reference;
  plan.StripVertical();
  plan.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const std::unique_ptr<OGRSpatialReference> sphere(plan.CloneGeogCS());
  if (sphere == nullptr) return;
  sphere->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const std::unique_ptr<OGRCoordinateTransformation> to_degrees(
      OGRCreateCoordinateTransformation(&plan, sphere.get()));
  const std::array<double, 6>& t = placement.georeference.transform;
  const double x = t[0] + 0.5 * window.width * t[1], y = t[3] + 0.5 * window.depth * t[5];
  // The middle, and half a cell to each side of it.
  double xs[] = {x, x - t[1] / 2, x + t[1] / 2, x, x}, ys[] = {y, y, y, y - t[5] / 2, y + t[5] / 2};
  const auto fail = [&] {
    notes.push_back(
        "how its map projection stretches the ground cannot be computed: cells keep the map's size");
  };
  if (to_degrees == nullptr || to_degrees->Transform(5, xs, ys) == 0) return fail();
  // Some of these systems count in grads.
  const double in_degrees = sphere->GetAngularUnits() / kRadiansPerDegree;
  for (double& angle : xs) angle *= in_degrees;
  for (double& angle : ys) angle *= in_degrees;
  const DegreeLengths degree =
      degree_lengths(ys[0], sphere->GetSemiMajor(nullptr), sphere->GetInvFlattening(nullptr));
  const auto step = [&](int from, int to) {
    return GroundStep{std::remainder(xs[to] - xs[from], 360) * degree.east,
                      (ys[to] - ys[from]) * degree.north};
  };
  const GroundStep across = step(1, 2), down = step(3, 4);
  const double stretched_x = across.length() / placement.cell_x,
               stretched_z = down.length() / placement.cell_z;
  if (!(stretched_x > 0 && stretched_z > 0 && std::isfinite(stretched_x) && std::isfinite(stretched_z)))
    return fail();
  if (std::abs(stretched_x - 1) <= kMostStretched && std::abs(stretched_z - 1) <= kMostStretched) return;
  notes.push_back(
      fmt::format("cells of {:.6g} m × {:.6g} m on the map are {:.6g} m × {:.6g} m on the ground at {}",
                  placement.cell_x, placement.cell_z, across.length(), down.length(), latitude_text(ys[0])));
  placement.cell_x = across.length();
  placement.cell_z = down.length();
  const double cosine =
      (across.east * down.east + across.north * down.north) / (across.length() * down.length());
  constexpr double kMostSkewed = 0.05;  // 3 degrees from a right angle
  if (std::abs(cosine) > kMostSkewed) {
    notes.push_back(
        fmt::format("its rows and columns meet at {:.0f}° on the ground, and are taken to meet at 90°: "
                    "gdalwarp -t_srs to a UTM zone mends that",
                    std::acos(std::abs(cosine)) / kRadiansPerDegree));
  }
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

std::string name_of_reference_system(const std::string& wkt) {
  OGRSpatialReference reference;
  if (wkt.empty() || reference.importFromWkt(wkt.c_str()) != OGRERR_NONE) return "";
  const char *const authority = reference.GetAuthorityName(nullptr), *const code =
                                                                         reference.GetAuthorityCode(nullptr);
  if (authority != nullptr && code != nullptr) return fmt::format("{}:{}", authority, code);
  const char* const name = reference.GetName();
  return name == nullptr ? "" : name;
}

bool same_reference_system(const std::string& a, const std::string& b) {
  if (a == b) return true;
  OGRSpatialReference first, second;
  return first.importFromWkt(a.c_str()) == OGRERR_NONE && second.importFromWkt(b.c_str()) == OGRERR_NONE &&
         first.IsSame(&second) != 0;
}

Directions directions_of(GDALDataset& dataset) {
  std::array<double, 6> t{};
  if (dataset.GetGeoTransform(t.data()) != CE_None || t == kNoTransform) return {};
  return {.mirrored = std::signbit(t[1]), .south_first = !std::signbit(t[5])};
}

Placement place_raster(GDALDataset& dataset, const DemWindow& window, const std::string& where,
                       std::vector<std::string>& notes) {
  Placement placement;
  std::array<double, 6>& t = placement.georeference.transform;
  if (dataset.GetGeoTransform(t.data()) != CE_None || t == kNoTransform) {
    t = {};
    notes.push_back("the file does not say how large its cells are: taken as 1 m");
    return placement;
  }
  check_transform(t, where);
  t[0] += window.x * t[1] + window.y * t[2];
  t[3] += window.x * t[4] + window.y * t[5];
  const Directions directions = directions_of(dataset);
  placement.mirrored = directions.mirrored;
  placement.south_first = directions.south_first;
  CoordinateUnit unit;
  const OGRSpatialReference* const reference = dataset.GetSpatialRef();
  if (reference != nullptr && !reference->IsEmpty()) {
    placement.georeference.crs = well_known_text(in_metres_of_height(*reference));
    placement.vertical_unit = vertical_unit(*reference);
    unit = unit_of(*reference, where);
  } else if (looks_like_degrees(t, window.width, window.depth)) {
    unit.angular = true;
    notes.push_back(
        "the file names no reference system, but its coordinates look like degrees: taken as WGS 84");
  } else {
    notes.push_back("the file names no reference system: its coordinates are taken as metres");
    if (could_be_degrees(t, window.width, window.depth)) {
      notes.push_back(
          "its coordinates could be degrees: if they are, name the reference system with "
          "gdal_translate -a_srs EPSG:4326");
    }
  }
  if (unit.angular) {
    size_in_degrees(unit, t, window, where, placement, notes);
  } else {
    placement.plan_unit = unit.size;
    placement.cell_x = std::abs(t[1]) * unit.size;
    placement.cell_z = std::abs(t[5]) * unit.size;
    if (unit.size != 1) {
      notes.push_back(fmt::format("cells of {:.6g} × {:.6g} units are {:.6g} m × {:.6g} m", std::abs(t[1]),
                                  std::abs(t[5]), placement.cell_x, placement.cell_z));
    }
    if (reference != nullptr && reference->IsProjected() != 0) {
      size_on_ground(*reference, window, placement, notes);
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
