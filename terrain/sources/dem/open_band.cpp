#include "terrain/sources/dem/open_band.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "terrain/error.h"
#include "terrain/source.h"

namespace terrabench {

std::string label(const std::string& path) { return path.starts_with('<') ? "inline VRT" : path; }

DatasetPointer open_dataset(const std::string& path, const std::string& where, const GdalMessages& messages) {
  const bool virtual_path =
      path.starts_with('<') || path.starts_with("/vsi") || path.find(':') != std::string::npos;
  std::error_code error;
  if (path.empty() || (!virtual_path && !std::filesystem::exists(path, error))) {
    throw bad_input("no such file", path.empty() ? "''" : where, "check the path");
  }
  DatasetPointer dataset(
      GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR));
  if (dataset == nullptr || messages.failed()) {
    throw bad_input(fmt::format("cannot be opened as a terrain: {}",
                                messages.failed() ? messages.first_failure() : "no driver knows it"),
                    where,
                    "give a complete raster that gdalinfo opens: GeoTIFF, .hgt, .asc, .dem, .vrt, .png …");
  }
  return dataset;
}

namespace {

void check_type(GDALRasterBand& band, int number, const std::string& where) {
  const GDALDataType type = band.GetRasterDataType();
  if (type == GDT_Unknown || type >= GDT_TypeCount || GDALDataTypeIsComplex(type) != 0) {
    throw bad_input(fmt::format("band {} holds {} values, not heights", number, GDALGetDataTypeName(type)),
                    where, "choose another band, or convert it with gdal_translate -ot Float32");
  }
  if (band.GetColorTable() != nullptr && band.GetColorInterpretation() == GCI_PaletteIndex) {
    throw bad_input(fmt::format("band {} holds numbers of colours, not heights", number), where,
                    "give a raster whose values are heights, or make land of a picture: drawing:FILE.png");
  }
}

bool is_colour_picture(GDALDataset& dataset) {
  constexpr GDALColorInterp kColours[] = {GCI_RedBand, GCI_GreenBand, GCI_BlueBand};
  if (dataset.GetRasterCount() < 3) return false;
  for (int k = 0; k < 3; ++k) {
    if (dataset.GetRasterBand(k + 1)->GetColorInterpretation() != kColours[k]) return false;
  }
  return true;
}

}  // namespace

std::vector<GDALRasterBand*> choose_bands(GDALDataset& dataset, const DemOptions& options,
                                          const std::string& where, std::vector<std::string>& notes) {
  const int bands = dataset.GetRasterCount();
  if (bands == 0) {
    throw bad_input("holds no raster, only subdatasets", where,
                    "name one of the subdatasets that gdalinfo lists for it");
  }
  if (options.encoding != HeightEncoding::kNumbers) {
    if (options.band) {
      throw usage_error("heights that colours encode have no band of their own", where, "leave out the band");
    }
    std::vector<GDALRasterBand*> colours;
    for (int k = 1; k <= std::min(bands, 3); ++k) colours.push_back(dataset.GetRasterBand(k));
    if (colours.size() < 3 || colours[0]->GetRasterDataType() != GDT_Byte) {
      throw usage_error("is no picture of red, green and blue bytes, which could encode heights", where,
                        "leave out the encoding");
    }
    notes.push_back(fmt::format("its colours were decoded as heights ({})",
                                options.encoding == HeightEncoding::kMapbox ? "Mapbox" : "Terrarium"));
    return colours;
  }
  if (!options.band && is_colour_picture(dataset)) {
    throw bad_input(
        "is a colour picture: its bands hold red, green and blue, not heights", where,
        fmt::format("if its colours encode heights, name it {0}FILE,encoding=terrarium or "
                    "encoding=mapbox; to make land of a picture, {1}FILE; to read one band all the "
                    "same, {0}FILE,band=1",
                    kDemPrefix, kDrawingPrefix));
  }
  const int number = options.band.value_or(1);
  if (number < 1 || number > bands) {
    throw usage_error(fmt::format("has no band {}", number), where,
                      fmt::format("bands 1 to {} exist", bands));
  }
  GDALRasterBand* const band = dataset.GetRasterBand(number);
  check_type(*band, number, where);
  if (bands > 1) notes.push_back(fmt::format("band {} of {} was read", number, bands));
  return {band};
}

// ENVI allows sparse files.
void check_raw_length(GDALDataset& dataset, int band, const std::string& where) {
  GDALDataset::RawBinaryLayout layout;
  VSIStatBufL file;
  if (!dataset.GetRawBinaryLayout(layout) || VSIStatL(layout.osRawFilename.c_str(), &file) != 0) return;
  // In double: the offsets come from the file and may have any value.
  const auto stretch = [](int count, GIntBig step) { return (count - 1.0) * static_cast<double>(step); };
  const double needed = static_cast<double>(layout.nImageOffset) + stretch(band, layout.nBandOffset) +
                        std::max(0.0, stretch(dataset.GetRasterYSize(), layout.nLineOffset)) +
                        std::max(0.0, stretch(dataset.GetRasterXSize(), layout.nPixelOffset)) +
                        GDALGetDataTypeSizeBytes(layout.eDataType);
  if (static_cast<double>(file.st_size) < needed) {
    throw bad_input(fmt::format("its pixels need {:.0f} bytes, but there are {}", needed, file.st_size),
                    where, "the file was cut short: fetch it again");
  }
}

}  // namespace terrabench
