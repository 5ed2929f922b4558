#include "terrain/sources/dem/band_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "terrain/error.h"
#include "terrain/resampling.h"

namespace terrabench {

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
