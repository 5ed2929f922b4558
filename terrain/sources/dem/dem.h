// Digital elevation models from files: whatever raster GDAL opens (GeoTIFF, SRTM .hgt, Arc/Info ASCII, USGS
// .dem, VRT, PNG …) as a Heightfield in metres, rows from north to south, and a Heightfield as GeoTIFF.
//
// Files are streamed in rows of blocks: reading needs the result's memory and about one row of blocks, and a
// reduction to `width` × `depth` averages while reading, so that a raster far larger than memory can be read
// at a lower resolution.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "terrain/heightfield.h"
#include "terrain/progress.h"
#include "terrain/resampling.h"

namespace terrabench {

// A rectangle of the raster's pixels, counted from its north-western one, however the file orders them; width
// 0 means the whole raster.
struct DemWindow {
  int x = 0, y = 0, width = 0, depth = 0;
  bool in_middle = false;  // of the raster, in place of x and y

  bool whole() const { return x == 0 && y == 0 && width == 0 && depth == 0; }
};

// How a colour picture holds heights, as web maps serve them.
enum class HeightEncoding {
  kNumbers,    // not at all: a band holds numbers
  kTerrarium,  // 256·red + green + blue/256 - 32768 m
  kMapbox,     // (65536·red + 256·green + blue)/10 - 10000 m
};

struct DemOptions {
  std::optional<int> band;        // counted from 1; none: the first, unless that is a picture's red
  std::optional<double> no_data;  // instead of the file's; NaN: every finite number is a height
  std::string unit;               // of the heights instead of the file's, such as "ft"; empty: the file's
  HeightEncoding encoding = HeightEncoding::kNumbers;
  DemWindow window;
  int width = 0, depth = 0;  // resample to so many samples; 0 keeps the file's (resample() in heightfield.h)
  bool fill_no_data = false;
  std::uint64_t max_samples = kMostSamples;  // more than this after cropping and resampling is refused
};

struct Dem {
  Heightfield heights;
  std::string format;              // GDAL's name of the driver that read it
  std::vector<std::string> notes;  // what was converted, guessed or left out, one sentence each, for the user
};

// `name` is anything that GDAL opens, /vsizip/… and inline VRT included, or "dem:FILE,OPTION=VALUE…"
// (parse_dem()), whose options replace those given. Drivers that fetch from the network are disabled, and so
// are virtual files on other machines (network.h). Throws bad_input for unusable files and usage_error for
// options that do not fit the file. Prints nothing. Safe to call from several threads at once. O(pixels of
// the window).
Dem read_dem(const std::string& name, const DemOptions& options = {}, Progress* progress = nullptr);

// What a file says of itself.
struct DemHeader {
  int width = 0, depth = 0;       // pixels
  double cell_x = 1, cell_z = 1;  // metres
  std::string type;               // of the stored numbers, GDAL's name, such as "Int16"
  std::string format;
  std::vector<std::string> notes;
  std::string too_large;  // why read_dem() refuses to read it whole; empty: it does not
};
// As read_dem(), without reading pixels. O(1) for binary formats.
DemHeader read_dem_header(const std::string& name, const DemOptions& options = {});

// The prefix of a path that options follow, as in "dem:lidar.tif,band=2,unit=ft".
inline constexpr std::string_view kDemPrefix = "dem:";
// The path and the options of a name: "FILE" or
// "dem:FILE[,band=N][,nodata=V|none][,unit=U][,encoding=E][,crop=WxD|WxD+X+Y]". Options that are not named
// are those given. Throws usage_error.
struct NamedDem {
  std::string path;
  DemOptions options;
};
NamedDem parse_dem(std::string_view name, const DemOptions& options = {});
// The name with the option crop, which it must not have yet.
std::string cropped(std::string_view name, const DemWindow&);
// The name without prefix, and its option crop in words: "my.tif, its middle 257 × 257". Other texts stay.
std::string readable_dem(std::string_view name);

// Float32, compressed without loss, with georeference and no-data value. Written whole or not at all. Throws
// environment_error. `unit` is that of the values; empty for counts and codes. O(n).
void write_geotiff(const std::filesystem::path& path, const Heightfield& field,
                   const std::string& unit = "m");

// What readers call the system that a text describes: "EPSG:32611", or its name; empty: none.
std::string name_of_reference_system(const std::string& wkt);
// Whether two texts name the same reference system; both empty: yes. Texts of the same system may differ.
bool same_reference_system(const std::string& a, const std::string& b);

// Metres per degree along the parallel and along the meridian at a latitude, on an ellipsoid (WGS 84 by
// default).
struct DegreeLengths {
  double east, north;
};
DegreeLengths degree_lengths(double latitude, double semi_major = 6378137.0,
                             double inverse_flattening = 298.257223563);

}  // namespace terrabench
