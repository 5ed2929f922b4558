// The DEM reader on damaged files. The first byte chooses the format by its extension; the rest is the file,
// in memory. The result must be a consistent terrain or an Error.
#include <cpl_vsi.h>
#include <gdal_priv.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include "terrain/error.h"
#include "terrain/sources/dem/dem.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace terrabench;

constexpr std::string_view kEndings[] = {"tif", "asc", "png", "dem", "vrt",
                                         "hgt", "bil", "dt0", "grd", "xyz"};
constexpr int kTif = 0, kAsc = 1, kPng = 2, kVrt = 4, kXyz = 9;

std::vector<std::uint8_t> seed(int format, std::string_view content) {
  std::vector<std::uint8_t> bytes(1 + content.size());
  bytes[0] = static_cast<std::uint8_t>(format);
  std::copy(content.begin(), content.end(), bytes.begin() + 1);
  return bytes;
}

// A valid file that GDAL writes, as bytes.
std::vector<std::uint8_t> written_seed(int format, const char* driver, const char* option) {
  const char* const options[] = {option, nullptr};
  const std::string path = "/vsimem/seed." + std::string(kEndings[format]);
  GDALDriver* const tiff = GetGDALDriverManager()->GetDriverByName("GTiff");
  GDALDataset* dataset = tiff->Create("/vsimem/source.tif", 20, 12, 1, GDT_UInt16, nullptr);
  double transform[] = {7, 0.001, 0, 47, 0, -0.001};
  dataset->SetGeoTransform(transform);
  std::uint16_t heights[240];
  for (int k = 0; k < 240; ++k) heights[k] = static_cast<std::uint16_t>(k * 37 % 991);
  if (dataset->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, 20, 12, heights, 20, 12, GDT_UInt16, 0, 0,
                                          nullptr) != CE_None) {
    std::abort();
  }
  GDALClose(GetGDALDriverManager()->GetDriverByName(driver)->CreateCopy(
      path.c_str(), dataset, 0, const_cast<char**>(options), nullptr, nullptr));
  GDALClose(dataset);
  vsi_l_offset size = 0;
  const GByte* const bytes = VSIGetMemFileBuffer(path.c_str(), &size, FALSE);
  const std::vector<std::uint8_t> out =
      seed(format, {reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size)});
  VSIUnlink(path.c_str());
  VSIUnlink("/vsimem/source.tif");
  return out;
}

void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

FuzzSeeds fuzz_seeds() {
  GDALAllRegister();
  return {
      written_seed(kTif, "GTiff", "COMPRESS=NONE"),
      written_seed(kTif, "GTiff", "COMPRESS=DEFLATE"),
      written_seed(kTif, "GTiff", "TILED=YES"),
      written_seed(kPng, "PNG", "ZLEVEL=1"),
      written_seed(kXyz, "XYZ", "COLUMN_SEPARATOR=,"),
      seed(kAsc,
           "ncols 3\nnrows 2\nxllcorner 7.5\nyllcorner 46.5\ncellsize 0.01\nNODATA_value -9999\n1 2 3\n4 "
           "-9999 6\n"),
      // Raw bands over the file itself: references without other files.
      seed(kVrt,
           "<VRTDataset rasterXSize=\"8\" rasterYSize=\"4\"><SRS>EPSG:4326</SRS><GeoTransform>7, 0.1, 0, 47, "
           "0, -0.1"
           "</GeoTransform><VRTRasterBand dataType=\"Byte\" band=\"1\" "
           "subClass=\"VRTRawRasterBand\"><UnitType>ft"
           "</UnitType><NoDataValue>60</NoDataValue><Scale>0.5</Scale><SourceFilename "
           "relativeToVRT=\"1\">fuzz.vrt"
           "</SourceFilename><ImageOffset>8</ImageOffset><PixelOffset>1</PixelOffset><LineOffset>8</"
           "LineOffset>"
           "</VRTRasterBand></VRTDataset>"),
      // A source on the network, which must be refused. Nothing listens on port 9.
      seed(kVrt,
           "<VRTDataset rasterXSize=\"3\" rasterYSize=\"2\"><GeoTransform>7, 0.1, 0, 47, 0, "
           "-0.1</GeoTransform>"
           "<VRTRasterBand dataType=\"Float32\" band=\"1\"><SimpleSource><SourceFilename>"
           "NETCDF:\"http://127.0.0.1:9/x\":z</SourceFilename><SourceBand>1</SourceBand></SimpleSource>"
           "</VRTRasterBand></VRTDataset>"),
  };
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string path = "/vsimem/fuzz." + std::string(kEndings[data[0] % std::size(kEndings)]);
  std::vector<std::uint8_t> content(data + 1, data + size);
  VSIFCloseL(VSIFileFromMemBuffer(path.c_str(), content.data(), content.size(), FALSE));
  for (const int reduced : {0, 5}) {
    DemOptions options;
    options.max_samples = std::uint64_t{1} << 20;
    options.width = options.depth = reduced;
    options.fill_no_data = reduced != 0;
    try {
      const Heightfield field = read_dem(path, options).heights;
      require(field.width >= 1 && field.depth >= 1);
      require(field.heights.size() ==
              static_cast<std::size_t>(field.width) * static_cast<std::size_t>(field.depth));
      require(field.cell_x > 0 && field.cell_z > 0);
      const HeightRange range = height_range(field);
      require(range.no_data == field.heights.size() || (range.lowest >= -1e6F && range.highest <= 1e6F));
    } catch (const Error& error) {
      require(error.code() == ExitCode::kBadInput && std::strlen(error.what()) > 0 &&
              !error.advice().empty());
    }
  }
  VSIUnlink(path.c_str());
  return 0;
}
