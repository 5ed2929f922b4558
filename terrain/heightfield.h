// A grid of heights: the form in which every digital elevation model (DEM) enters.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace terrabench {

// Where the grid lies on the Earth, kept so that our files can be opened in a GIS again.
struct Georeference {
  std::string crs;                    // WKT; empty when the file named none
  std::array<double, 6> transform{};  // GDAL's affine pixel-to-world transform
  bool operator==(const Georeference&) const = default;
};

// Heights in metres at grid points, row-major, rows from north to south: sample (i, j) stands at x = i·cell_x
// (east), z = j·cell_z (south). The field covers [0, (width-1)·cell_x] × [0, (depth-1)·cell_z].
struct Heightfield {
  // The one internal no-data value, whatever the file uses. Test with is_no_data(), never with ==.
  static constexpr float kNoData = std::numeric_limits<float>::quiet_NaN();
  static bool is_no_data(float height) { return std::isnan(height); }

  int width = 0, depth = 0;            // samples along x and z, both ≥ 1
  float cell_x = 1.0F, cell_z = 1.0F;  // metres between neighbouring samples, both > 0
  std::vector<float> heights;          // width·depth values
  Georeference georeference;

  // A flat field at height 0. Both sides ≥ 1.
  static Heightfield zeros(int width, int depth, float cell_x = 1, float cell_z = 1) {
    const std::size_t samples = static_cast<std::size_t>(width) * static_cast<std::size_t>(depth);
    return {width, depth, cell_x, cell_z, std::vector<float>(samples), {}};
  }

  float at(int i, int j) const { return heights[static_cast<std::size_t>(j) * width + i]; }
  float& at(int i, int j) { return heights[static_cast<std::size_t>(j) * width + i]; }
  float extent_x() const { return static_cast<float>(width - 1) * cell_x; }
  float extent_z() const { return static_cast<float>(depth - 1) * cell_z; }

  // Bilinear height at (x, z) metres; no-data outside the field or when one of the four neighbours is
  // no-data.
  float sample(float x, float z) const;
};

struct HeightRange {
  float lowest = 0, highest = 0;
  std::size_t no_data = 0;  // how many samples hold no height
};

// Over all samples that hold a height; lowest > highest when there is none. O(n).
HeightRange height_range(const Heightfield&);

// Part of the field; throws usage_error when the rectangle does not lie inside. O(size of the part).
Heightfield crop(const Heightfield&, int i0, int j0, int width, int depth);

// The same ground at another number of samples (bilinear up, area-averaged down). O(n).
Heightfield resample(const Heightfield&, int width, int depth);

// Fills every no-data hole smoothly from its rim (push-pull pyramid), so that flow routing and meshing need
// no special case. Throws bad_input when the whole field is no-data. O(n).
Heightfield fill_no_data(const Heightfield&);

// XXH3-128 of the dimensions, cell sizes and height bits, as 32 hex digits: names the input in every result.
std::string checksum(const Heightfield&);

}  // namespace terrabench
