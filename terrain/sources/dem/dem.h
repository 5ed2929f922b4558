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
#include <span>
#include <string>
#include <vector>

#include "terrain/heightfield.h"
#include "terrain/progress.h"

namespace terrabench {

// A rectangle of the file's pixels, counted from its first row and column; width 0 means the whole raster.
struct DemWindow {
  int x = 0, y = 0, width = 0, depth = 0;
};

struct DemOptions {
  int band = 1;
  DemWindow window;
  int width = 0, depth = 0;  // resample to so many samples; 0 keeps the file's (resample() in heightfield.h)
  bool fill_no_data = false;
  std::uint64_t max_samples = std::uint64_t{1}
                              << 28;  // more than this after cropping and resampling is refused
};

struct Dem {
  Heightfield heights;
  std::string format;              // GDAL's name of the driver that read it
  std::vector<std::string> notes;  // what was converted, guessed or left out, one sentence each, for the user
};

// `path` is anything that GDAL opens, /vsizip/… and inline VRT included; drivers that fetch from the network
// are disabled, and so are virtual files on other machines (network.h). Throws bad_input for unusable files
// and usage_error for options that do not fit the file. Prints nothing. Safe to call from several threads at
// once. O(pixels of the window).
Dem read_dem(const std::string& path, const DemOptions& options = {}, Progress* progress = nullptr);

// Float32, compressed without loss, with georeference and no-data value. Written whole or not at all. Throws
// environment_error. `unit` is that of the values; empty for counts and codes. O(n).
void write_geotiff(const std::filesystem::path& path, const Heightfield& field,
                   const std::string& unit = "m");

// Heights that are made while they are written, so that only some rows are held.
struct HeightRows {
  int width = 0, depth = 0;            // samples along x and z, both ≥ 1
  float cell_x = 1.0F, cell_z = 1.0F;  // metres; used where there is no georeference
  Georeference georeference;
  // Fills whole rows, from the given one on, in ascending order. No-data as in a Heightfield.
  std::function<void(int first, std::span<float> heights)> fill;
};
void write_geotiff(const std::filesystem::path& path, const HeightRows& raster, const std::string& unit = "m",
                   Progress* progress = nullptr);

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
