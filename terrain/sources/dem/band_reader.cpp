#include "terrain/sources/dem/band_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "terrain/error.h"
#include "terrain/resampling.h"
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

BandReader::BandReader(std::vector<GDALRasterBand*> bands, const DemWindow& window, const HeightRule& rule,
                       const GdalMessages& messages, const std::string& where)
    : bands_(std::move(bands)), window_(window), rule_(rule), messages_(messages), where_(where) {
  band().GetBlockSize(&block_width_, &block_depth_);
  const std::uint64_t block_bytes =
      std::uint64_t(block_width_) * block_depth_ * GDALGetDataTypeSizeBytes(band().GetRasterDataType());
  // A few blocks side by side, so that tall blocks of a wide raster do not push each other out of GDAL's
  // cache.
  constexpr std::uint64_t kSideBySide = std::uint64_t{16} << 20;
  columns_per_read_ = static_cast<int>(std::min<std::uint64_t>(
      std::max<std::uint64_t>(1, kSideBySide / std::max<std::uint64_t>(1, block_bytes)) * block_width_,
      window.width));
  // Whole rows of blocks, so that each block is decoded once; several where blocks are low.
  constexpr int kFewestRows = 64;
  rows_per_strip_ = std::max(block_depth_, kFewestRows / block_depth_ * block_depth_);
}

// Float holds the values of these types exactly; the others are read as double.
bool BandReader::reads_floats() const {
  const GDALDataType type = bands_[0]->GetRasterDataType();
  return !rule_.encoded() &&
         (type == GDT_Byte || type == GDT_Int16 || type == GDT_UInt16 || type == GDT_Float32);
}

std::uint64_t BandReader::buffer_bytes(bool resampled) const {
  const std::uint64_t samples = std::uint64_t(window_.width) * std::min(rows_per_strip_, window_.depth);
  const std::uint64_t wide = reads_floats() ? 0 : sizeof(double) * (rule_.encoded() ? 2 : 1);
  return samples * (wide + (resampled ? sizeof(float) : 0) + (rule_.masked ? 1 : 0));
}

void BandReader::read_whole(float* out, Progress* progress) {
  each_strip(progress, [&](int y, int rows) {
    read_strip(y, rows, out + static_cast<std::size_t>(y) * window_.width);
  });
}

void BandReader::read_reduced(int width, int depth, float* out, Progress* progress) {
  const std::vector<Taps> columns = resampling_taps(window_.width, width);
  const std::vector<Taps> rows = resampling_taps(window_.depth, depth);
  RowAccumulator accumulator(window_.width);
  std::vector<float> strip(static_cast<std::size_t>(window_.width) *
                           std::min(rows_per_strip_, window_.depth));
  int j = 0;
  each_strip(progress, [&](int y0, int count) {
    read_strip(y0, count, strip.data());
    for (int y = y0; y < y0 + count; ++y) {
      const float* const row = strip.data() + static_cast<std::size_t>(y - y0) * window_.width;
      accumulator.add(row, rows[j].weight(y));
      while (j < depth && rows[j].last() == y) {
        accumulator.finish(columns, out + static_cast<std::size_t>(j) * width);
        accumulator.clear();
        ++j;
        if (j < depth && rows[j].first == y) accumulator.add(row, rows[j].weight(y));
      }
    }
  });
}

void BandReader::each_strip(Progress* progress, const std::function<void(int y, int rows)>& body) {
  if (progress != nullptr) progress->begin("reading " + where_, static_cast<std::uint64_t>(window_.depth));
  // The first strip ends where a row of blocks ends in the file.
  for (int y = 0; y < window_.depth;) {
    const int left_of_block = rows_per_strip_ - (window_.y + y) % rows_per_strip_;
    const int rows = std::min(left_of_block, window_.depth - y);
    body(y, rows);
    y += rows;
    if (progress != nullptr) progress->advance(static_cast<std::uint64_t>(rows));
  }
  if (progress != nullptr) progress->end();
}

// The numbers that colours stand for, into wide_.
void BandReader::decode(int y, int rows) {
  std::ranges::fill(wide_, 0.0);
  colour_.resize(wide_.size());
  for (std::size_t c = 0; c < bands_.size(); ++c) {
    fetch(*bands_[c], y, rows, colour_.data(), GDT_Float64);
    for (std::size_t i = 0; i < wide_.size(); ++i) wide_[i] += rule_.weights[c] * colour_[i];
  }
}

void BandReader::read_strip(int y, int rows, float* out) {
  const std::size_t samples = static_cast<std::size_t>(window_.width) * static_cast<std::size_t>(rows);
  const std::uint8_t* mask = nullptr;
  if (rule_.masked) {
    mask_.resize(samples);
    fetch(*band().GetMaskBand(), y, rows, mask_.data(), GDT_Byte);
    mask = mask_.data();
  }
  if (reads_floats()) {
    fetch(band(), y, rows, out, GDT_Float32);
    if (rule_.signed_bytes) {
      for (std::size_t i = 0; i < samples; ++i) out[i] = out[i] > 127 ? out[i] - 256 : out[i];
    }
    to_metres(out, mask, window_.width, rows, rule_, tally_);
    return;
  }
  wide_.resize(samples);
  if (rule_.encoded()) {
    decode(y, rows);
  } else {
    fetch(band(), y, rows, wide_.data(), GDT_Float64);
  }
  to_metres(wide_.data(), mask, window_.width, rows, rule_, out, tally_);
}

template <class T>
void BandReader::fetch(GDALRasterBand& band, int y, int rows, T* out, GDALDataType type) {
  for (int x = 0; x < window_.width;) {
    // The first read ends where a block ends in the file.
    const int columns = std::min(columns_per_read_ - (window_.x + x) % columns_per_read_, window_.width - x);
    const CPLErr error =
        band.RasterIO(GF_Read, window_.x + x, window_.y + y, columns, rows, out + x, columns, rows, type,
                      sizeof(T), static_cast<GSpacing>(sizeof(T)) * window_.width, nullptr);
    if (error != CE_None || messages_.failed()) {
      throw bad_input(
          fmt::format("cannot be read at rows {} to {}: {}", window_.y + y, window_.y + y + rows - 1,
                      messages_.failed() ? messages_.first_failure() : "GDAL gave no reason"),
          where_, "the file is damaged or was cut short: fetch it again");
    }
    x += columns;
  }
}

}  // namespace terrabench
