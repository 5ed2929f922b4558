#include "terrain/sources/dem/dem.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "terrain/error.h"
#include "terrain/memory.h"
#include "terrain/resampling.h"
#include "terrain/sources/dem/gdal_session.h"
#include "terrain/sources/dem/height_values.h"
#include "terrain/sources/dem/placement.h"

namespace terrabench {
namespace {

// For messages: inline VRT is too long for them.
std::string label(const std::string& path) { return path.starts_with('<') ? "inline VRT" : path; }

std::string size_text(std::uint64_t width, std::uint64_t depth) { return fmt::format("{}×{}", width, depth); }

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

GDALRasterBand& choose_band(GDALDataset& dataset, int number, const std::string& where,
                            std::vector<std::string>& notes) {
  const int bands = dataset.GetRasterCount();
  if (bands == 0) {
    throw bad_input("holds no raster, only subdatasets", where,
                    "name one of the subdatasets that gdalinfo lists for it");
  }
  if (number < 1 || number > bands) {
    throw usage_error(fmt::format("has no band {}", number), where,
                      fmt::format("bands 1 to {} exist", bands));
  }
  GDALRasterBand& band = *dataset.GetRasterBand(number);
  const GDALDataType type = band.GetRasterDataType();
  if (type == GDT_Unknown || type >= GDT_TypeCount || GDALDataTypeIsComplex(type) != 0) {
    throw bad_input(fmt::format("band {} holds {} values, not heights", number, GDALGetDataTypeName(type)),
                    where, "choose another band, or convert it with gdal_translate -ot Float32");
  }
  if (band.GetColorTable() != nullptr && band.GetColorInterpretation() == GCI_PaletteIndex) {
    throw bad_input(fmt::format("band {} holds numbers of colours, not heights", number), where,
                    "give a raster whose values are heights, or make land of a picture: drawing:FILE.png");
  }
  if (bands > 1) notes.push_back(fmt::format("band {} of {} was read", number, bands));
  return band;
}

// Some raw formats silently read zeros beyond the file's end (ENVI allows sparse files).
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

DemWindow choose_window(GDALDataset& dataset, const DemWindow& asked, const std::string& where) {
  const int width = dataset.GetRasterXSize(), depth = dataset.GetRasterYSize();
  if (asked.width == 0 && asked.depth == 0 && asked.x == 0 && asked.y == 0) return {0, 0, width, depth};
  if (asked.x < 0 || asked.y < 0 || asked.width < 1 || asked.depth < 1 || asked.width > width - asked.x ||
      asked.depth > depth - asked.y) {
    throw usage_error(
        fmt::format("a window of {} pixels from ({}, {}) does not lie inside its {}",
                    size_text(asked.width, asked.depth), asked.x, asked.y, size_text(width, depth)),
        where, "give a window of at least one pixel inside the raster");
  }
  return asked;
}

// Float holds the values of these types exactly; the others are read as double.
bool fits_float(GDALDataType type) {
  return type == GDT_Byte || type == GDT_Int16 || type == GDT_UInt16 || type == GDT_Float32;
}

class Reader {
 public:
  Reader(GDALRasterBand& band, const DemWindow& window, const HeightRule& rule, const GdalMessages& messages,
         const std::string& where)
      : band_(band), window_(window), rule_(rule), messages_(messages), where_(where) {
    band.GetBlockSize(&block_width_, &block_depth_);
    const std::uint64_t block_bytes =
        std::uint64_t(block_width_) * block_depth_ * GDALGetDataTypeSizeBytes(band.GetRasterDataType());
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

  // Bytes beside the output.
  std::uint64_t buffer_bytes(bool resampled) const {
    const std::uint64_t samples = std::uint64_t(window_.width) * std::min(rows_per_strip_, window_.depth);
    const std::uint64_t wide = fits_float(band_.GetRasterDataType()) ? 0 : sizeof(double);
    return samples * (wide + (resampled ? sizeof(float) : 0) + (rule_.masked ? 1 : 0));
  }

  // Straight into the output.
  void read_whole(float* out, Progress* progress) {
    each_strip(progress, [&](int y, int rows) {
      read_strip(y, rows, out + static_cast<std::size_t>(y) * window_.width);
    });
  }

  // Averages while reading: each row is added to the one or two new rows that it belongs to.
  void read_reduced(int width, int depth, float* out, Progress* progress) {
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

  const Tally& tally() const { return tally_; }

 private:
  template <class Body>
  void each_strip(Progress* progress, const Body& body) {
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

  void read_strip(int y, int rows, float* out) {
    const std::size_t samples = static_cast<std::size_t>(window_.width) * static_cast<std::size_t>(rows);
    const std::uint8_t* mask = nullptr;
    if (rule_.masked) {
      mask_.resize(samples);
      fetch(*band_.GetMaskBand(), y, rows, mask_.data(), GDT_Byte);
      mask = mask_.data();
    }
    if (fits_float(band_.GetRasterDataType())) {
      fetch(band_, y, rows, out, GDT_Float32);
      to_metres(out, mask, window_.width, rows, rule_, tally_);
    } else {
      wide_.resize(samples);
      fetch(band_, y, rows, wide_.data(), GDT_Float64);
      to_metres(wide_.data(), mask, window_.width, rows, rule_, out, tally_);
    }
  }

  template <class T>
  void fetch(GDALRasterBand& band, int y, int rows, T* out, GDALDataType type) {
    for (int x = 0; x < window_.width;) {
      // The first read ends where a block ends in the file.
      const int columns =
          std::min(columns_per_read_ - (window_.x + x) % columns_per_read_, window_.width - x);
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

  GDALRasterBand& band_;
  DemWindow window_;
  HeightRule rule_;
  const GdalMessages& messages_;
  const std::string& where_;
  int block_width_ = 1, block_depth_ = 1, columns_per_read_ = 1, rows_per_strip_ = 1;
  std::vector<std::uint8_t> mask_;
  std::vector<double> wide_;
  Tally tally_;
};

// The sizes at each step from the file to the result.
struct Plan {
  int width, depth;  // of the result
  bool reduced;      // averages while reading
  int read_width,
      read_depth;  // what is held first: the result's, or the window's when it is enlarged afterwards
};

Plan plan_sizes(const DemWindow& window, const DemOptions& options, const std::string& where) {
  if (options.width < 0 || options.depth < 0) {
    throw usage_error(
        fmt::format("width and depth must be at least 1, got {}", size_text(options.width, options.depth)),
        where, "choose the number of samples along both sides");
  }
  Plan plan{options.width > 0 ? options.width : window.width,
            options.depth > 0 ? options.depth : window.depth, false, window.width, window.depth};
  plan.reduced = plan.width <= window.width && plan.depth <= window.depth &&
                 (plan.width < window.width || plan.depth < window.depth);
  if (plan.reduced) {
    plan.read_width = plan.width;
    plan.read_depth = plan.depth;
  }
  return plan;
}

void check_sizes(const Plan& plan, const DemWindow& window, const DemOptions& options, std::uint64_t buffers,
                 const std::string& where) {
  const std::uint64_t samples =
      std::max(std::uint64_t(plan.width) * plan.depth, std::uint64_t(plan.read_width) * plan.read_depth);
  const bool resampled_after = plan.read_width != plan.width || plan.read_depth != plan.depth;
  std::uint64_t bytes = std::uint64_t(plan.read_width) * plan.read_depth * sizeof(float) + buffers;
  if (resampled_after) bytes += std::uint64_t(plan.width) * plan.depth * sizeof(float);
  const std::uint64_t available = available_memory();
  if (samples <= options.max_samples && bytes <= available) return;
  const double most = std::min(static_cast<double>(options.max_samples), static_cast<double>(available) / 8);
  const double factor = std::sqrt(most / (static_cast<double>(window.width) * window.depth));
  const int width = std::max(1, static_cast<int>(std::min(factor, 1.0) * window.width));
  const int depth = std::max(1, static_cast<int>(std::min(factor, 1.0) * window.depth));
  const std::string what =
      samples > options.max_samples
          ? fmt::format("{} samples are {:.0f} million, more than the {:.0f} million allowed",
                        size_text(plan.width, plan.depth), samples / 1e6, options.max_samples / 1e6)
          : fmt::format("{} samples need {:.1f} GB of memory, and {:.1f} GB are free",
                        size_text(plan.width, plan.depth), bytes / 1e9, available / 1e9);
  throw bad_input(
      what, where,
      fmt::format("read a part of it (crop) or read it smaller (resample), to {} samples for example",
                  size_text(width, depth)));
}

// Flips the field to rows from north to south and columns from west to east.
void turn(const Placement& placement, Heightfield& field) {
  std::array<double, 6>& t = field.georeference.transform;
  if (placement.mirrored) {
    tbb::parallel_for(0, field.depth,
                      [&](int j) { std::reverse(&field.at(0, j), &field.at(0, j) + field.width); });
    t[0] += field.width * t[1];
    t[1] = -t[1];
  }
  if (placement.south_first) {
    tbb::parallel_for(0, field.depth / 2, [&](int j) {
      std::swap_ranges(&field.at(0, j), &field.at(0, j) + field.width, &field.at(0, field.depth - 1 - j));
    });
    t[3] += field.depth * t[5];
    t[5] = -t[5];
  }
}

void note_holes(const Tally& tally, const DemWindow& window, const std::string& where,
                std::vector<std::string>& notes) {
  const std::uint64_t samples = std::uint64_t(window.width) * window.depth;
  if (tally.missing + tally.impossible == samples) {
    throw bad_input("no sample holds a height", where,
                    tally.missing > 0
                        ? "choose another window or band; check the file's no-data value and mask"
                        : "all are NaN, infinite or beyond ±1000 km: check its data type and scale");
  }
  if (tally.missing > 0)
    notes.push_back(fmt::format("{} of {} samples hold no height", tally.missing, samples));
  if (tally.impossible > 0) {
    notes.push_back(
        fmt::format("{} heights are NaN, infinite or beyond ±1000 km: taken as no-data", tally.impossible));
  }
}

Dem read(const std::string& path, const DemOptions& options, Progress* progress) {
  const std::string where = label(path);
  register_gdal();
  const GdalMessages messages;
  const DatasetPointer dataset = open_dataset(path, where, messages);
  Dem dem;
  dem.format = dataset->GetDriver() != nullptr ? dataset->GetDriver()->GetDescription() : "";
  GDALRasterBand& band = choose_band(*dataset, options.band, where, dem.notes);
  check_raw_length(*dataset, options.band, where);
  const DemWindow window = choose_window(*dataset, options.window, where);
  const Placement placement = place_raster(*dataset, window, where, dem.notes);
  Reader reader(band, window, height_rule(band, where, dem.notes), messages, where);
  const Plan plan = plan_sizes(window, options, where);
  check_sizes(plan, window, options, reader.buffer_bytes(plan.reduced), where);

  Heightfield& field = dem.heights;
  field.width = plan.read_width;
  field.depth = plan.read_depth;
  const double ratio_x = static_cast<double>(window.width) / field.width;
  const double ratio_z = static_cast<double>(window.depth) / field.depth;
  field.cell_x = static_cast<float>(placement.cell_x * ratio_x);
  field.cell_z = static_cast<float>(placement.cell_z * ratio_z);
  field.georeference = placement.georeference;
  for (const int k : {1, 4}) field.georeference.transform[k] *= ratio_x;
  for (const int k : {2, 5}) field.georeference.transform[k] *= ratio_z;
  field.heights.resize(static_cast<std::size_t>(field.width) * static_cast<std::size_t>(field.depth));
  if (plan.reduced) {
    reader.read_reduced(field.width, field.depth, field.heights.data(), progress);
  } else {
    reader.read_whole(field.heights.data(), progress);
  }
  note_holes(reader.tally(), window, where, dem.notes);
  turn(placement, field);
  if (field.width != plan.width || field.depth != plan.depth) field = resample(field, plan.width, plan.depth);
  if (plan.width != window.width || plan.depth != window.depth) {
    dem.notes.push_back(fmt::format("{} pixels were resampled to {}", size_text(window.width, window.depth),
                                    size_text(plan.width, plan.depth)));
  }
  if (options.fill_no_data) {
    const std::size_t holes = height_range(field).no_data;
    if (holes > 0) {
      field = terrabench::fill_no_data(field);
      dem.notes.push_back(fmt::format("{} samples without height were filled from around them", holes));
    }
  }
  for (const std::string& warning : messages.warnings()) dem.notes.push_back("GDAL warns: " + warning);
  return dem;
}

}  // namespace

Dem read_dem(const std::string& path, const DemOptions& options, Progress* progress) {
  try {
    return read(path, options, progress);
  } catch (const std::bad_alloc&) {
    throw environment_error("not enough memory to read it", label(path),
                            "read a part of it (crop) or read it smaller (resample)");
  }
}

}  // namespace terrabench
