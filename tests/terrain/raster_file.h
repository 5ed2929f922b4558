// Raster files for tests, written through GDAL with every property that a DEM reader must handle.
#pragma once

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "terrain/sources/dem/dem.h"

namespace terrabench {

struct RasterFile {
  std::string format = "GTiff";
  int width = 6, depth = 4, bands = 1;
  GDALDataType type = GDT_Float32;
  std::optional<std::array<double, 6>> transform;
  int epsg = 0;
  std::string system;  // instead of `epsg`, such as "EPSG:2274+6360"
  std::optional<double> no_data;
  std::string unit;
  double scale = 1, offset = 0;
  std::vector<std::string> options;
  std::function<double(int, int)> value = [](int i, int j) { return 100.0 + i + 10.0 * j; };
  std::function<bool(int, int)> masked;  // true: no data by the file's own mask

  void write(const std::string& path) const {
    if (GDALGetDriverCount() == 0) GDALAllRegister();  // again would bring back what the reader removed
    CPLStringList list;
    for (const std::string& option : options) list.AddString(option.c_str());
    GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName(format.c_str());
    GDALDataset* const dataset = driver->Create(path.c_str(), width, depth, bands, type, list);
    if (transform) {
      std::array<double, 6> t = *transform;
      dataset->SetGeoTransform(t.data());
    }
    if (epsg != 0 || !system.empty()) {
      OGRSpatialReference reference;
      const std::string name = system.empty() ? "EPSG:" + std::to_string(epsg) : system;
      EXPECT_EQ(reference.SetFromUserInput(name.c_str()), OGRERR_NONE) << name;
      reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
      dataset->SetSpatialRef(&reference);
    }
    for (int b = 1; b <= bands; ++b) {
      GDALRasterBand* const band = dataset->GetRasterBand(b);
      if (no_data) band->SetNoDataValue(*no_data);
      if (!unit.empty()) band->SetUnitType(unit.c_str());
      if (scale != 1) band->SetScale(scale);
      if (offset != 0) band->SetOffset(offset);
      if (value) fill(*band, b);
    }
    if (masked) write_mask(*dataset);
    GDALClose(dataset);
  }

 private:
  static void require(CPLErr error) {
    if (error != CE_None) throw std::runtime_error(CPLGetLastErrorMsg());
  }
  void fill(GDALRasterBand& band, int number) const {
    std::vector<double> row(static_cast<std::size_t>(width));
    for (int j = 0; j < depth; ++j) {
      for (int i = 0; i < width; ++i) row[i] = value(i, j) + 1000 * (number - 1);
      require(band.RasterIO(GF_Write, 0, j, width, 1, row.data(), width, 1, GDT_Float64, 0, 0, nullptr));
    }
  }
  void write_mask(GDALDataset& dataset) const {
    CPLSetThreadLocalConfigOption("GDAL_TIFF_INTERNAL_MASK", "YES");
    dataset.CreateMaskBand(GMF_PER_DATASET);
    std::vector<std::uint8_t> row(static_cast<std::size_t>(width));
    for (int j = 0; j < depth; ++j) {
      for (int i = 0; i < width; ++i) row[i] = masked(i, j) ? 0 : 255;
      require(dataset.GetRasterBand(1)->GetMaskBand()->RasterIO(GF_Write, 0, j, width, 1, row.data(), width,
                                                                1, GDT_Byte, 0, 0, nullptr));
    }
    CPLSetThreadLocalConfigOption("GDAL_TIFF_INTERNAL_MASK", nullptr);
  }
};

inline constexpr std::array<double, 6> kUtm = {500000, 30, 0, 5100000, 0, -30};
inline constexpr int kUtm33 = 32633, kWgs84 = 4326;

// In UTM coordinates, cells of 30 m.
inline RasterFile metres() {
  RasterFile file;
  file.transform = kUtm;
  file.epsg = kUtm33;
  return file;
}

// The heights that RasterFile writes by default.
inline void expect_ramp(const Heightfield& field, int width, int depth) {
  ASSERT_EQ(field.width, width);
  ASSERT_EQ(field.depth, depth);
  ASSERT_EQ(field.heights.size(), static_cast<std::size_t>(width) * depth);
  for (int j = 0; j < depth; ++j) {
    for (int i = 0; i < width; ++i) EXPECT_EQ(field.at(i, j), 100.0F + i + 10.0F * j) << i << "," << j;
  }
}

}  // namespace terrabench
