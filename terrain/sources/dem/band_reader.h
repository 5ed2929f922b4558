// Reads heights from a raster's bands, in strips of whole blocks, so that each block is decoded once.
// Internal to terrain/sources/dem.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "terrain/progress.h"
#include "terrain/sources/dem/dem.h"
#include "terrain/sources/dem/gdal_session.h"
#include "terrain/sources/dem/height_values.h"

namespace terrabench {

// Opens a raster and chooses what holds its heights. Internal to terrain/sources/dem.

// For messages: inline VRT is too long for them.
std::string label(const std::string& path);

// Throws bad_input with what GDAL said.
DatasetPointer open_dataset(const std::string& path, const std::string& where, const GdalMessages&);

// The band whose numbers are heights, or the three of a picture that encodes them. Throws bad_input for what
// holds no heights, and usage_error for options that do not fit; says in `notes` what was left out.
std::vector<GDALRasterBand*> choose_bands(GDALDataset&, const DemOptions&, const std::string& where,
                                          std::vector<std::string>& notes);

// Throws bad_input for a raw file that ends before its pixels do: some formats read zeros then.
void check_raw_length(GDALDataset&, int band, const std::string& where);

class BandReader {
 public:
  // `bands`: one, or the three that the rule's weights are for. `window` is in the file's own order. All that
  // is passed by reference must outlive the reader.
  BandReader(std::vector<GDALRasterBand*> bands, const DemWindow& window, const HeightRule& rule,
             const GdalMessages& messages, const std::string& where);

  // Bytes beside the output.
  std::uint64_t buffer_bytes(bool resampled) const;
  // Straight into the output. Throws bad_input where GDAL cannot read.
  void read_whole(float* out, Progress* progress);
  // Averages while reading: each row is added to the one or two new rows that it belongs to.
  void read_reduced(int width, int depth, float* out, Progress* progress);

  const Tally& tally() const { return tally_; }

 private:
  void each_strip(Progress* progress, const std::function<void(int y, int rows)>& body);
  void read_strip(int y, int rows, float* out);
  void decode(int y, int rows);
  template <class T>
  void fetch(GDALRasterBand& band, int y, int rows, T* out, GDALDataType type);
  GDALRasterBand& band() const { return *bands_[0]; }
  bool reads_floats() const;

  std::vector<GDALRasterBand*> bands_;
  DemWindow window_;
  HeightRule rule_;
  const GdalMessages& messages_;
  const std::string& where_;
  int block_width_ = 1, block_depth_ = 1, columns_per_read_ = 1, rows_per_strip_ = 1;
  std::vector<std::uint8_t> mask_;
  std::vector<double> wide_, colour_;
  Tally tally_;
};

}  // namespace terrabench
