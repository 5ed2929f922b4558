#include "terrain/sources/dem/compressed_sizes.h"

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "terrain/error.h"
#include "terrain/sources/dem/gdal_session.h"

namespace terrabench {
namespace {

constexpr double kMostSteps = 65535;
constexpr int kZstdLevel = 19;

// A file in memory, deleted with this object.
struct MemoryFile {
  std::string path;
  MemoryFile() {
    static std::atomic<unsigned> next{0};
    path = fmt::format("/vsimem/terrabench_size_{}", next++);
  }
  ~MemoryFile() { VSIUnlink(path.c_str()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::size_t size() const {
    VSIStatBufL status;
    return VSIStatL(path.c_str(), &status) == 0 ? static_cast<std::size_t>(status.st_size) : 0;
  }
};

// Heights as whole steps above the lowest.
struct Steps {
  double step, lowest;
  std::vector<std::uint16_t> numbers;

  Steps(const Heightfield& field, double step) : step(step) {
    const HeightRange range = height_range(field);
    lowest = range.lowest;
    if (!(step > 0) || std::round((range.highest - lowest) / step) > kMostSteps) {
      throw usage_error(fmt::format("a step of {} m does not cover the heights in 16 bits", step),
                        "compressed size",
                        fmt::format("choose at least {} m", (range.highest - lowest) / kMostSteps));
    }
    numbers.reserve(field.heights.size());
    for (const float h : field.heights) {
      numbers.push_back(static_cast<std::uint16_t>(std::lround((h - lowest) / step)));
    }
  }
  std::vector<double> heights() const {
    std::vector<double> all;
    all.reserve(numbers.size());
    for (const std::uint16_t number : numbers) all.push_back(lowest + number * step);
    return all;
  }
};

// Whole metres where all heights are, otherwise as fine as 16 bits allow.
double natural_step(const Heightfield& field) {
  const HeightRange range = height_range(field);
  const double finest = (static_cast<double>(range.highest) - range.lowest) / kMostSteps;
  for (const float h : field.heights) {
    if (h != std::round(h)) return finest > 0 ? finest * (1 + 1e-9) : 1;
  }
  return std::max(1.0, finest * (1 + 1e-9));
}

std::size_t zstd_bytes(const void* data, std::size_t raw) {
  std::vector<char> packed(ZSTD_compressBound(raw));
  const std::size_t bytes = ZSTD_compress(packed.data(), packed.size(), data, raw, kZstdLevel);
  if (ZSTD_isError(bytes) != 0) throw std::bad_alloc();  // the only way left to fail
  return bytes;
}

// No codec here keeps holes: they are filled, and a bit per sample says where they are.
struct Raster {
  const Heightfield& given;
  Heightfield filled;
  std::size_t mask_bytes = 0;

  explicit Raster(const Heightfield& field) : given(field), filled(field) {
    const auto is_hole = [](float h) { return Heightfield::is_no_data(h); };
    if (std::ranges::none_of(field.heights, is_hole)) return;
    filled = fill_no_data(field);
    std::vector<std::uint8_t> mask((field.heights.size() + 7) / 8);
    bool whole = true;
    for (std::size_t i = 0; i < field.heights.size(); ++i) {
      const float h = field.heights[i];
      if (is_hole(h)) mask[i / 8] |= static_cast<std::uint8_t>(1U << i % 8);
      whole = whole && (is_hole(h) || h == std::round(h));
    }
    mask_bytes = zstd_bytes(mask.data(), mask.size());
    if (!whole) return;
    for (float& h : filled.heights) h = std::round(h);
  }
};

// What a codec makes of the filled field.
struct Coded {
  std::size_t bytes = 0;
  std::vector<double> heights;  // read back
};

CompressedSize compared(const Raster& raster, const Coded& coded, double setting) {
  double sum = 0, largest = 0;
  std::size_t n = 0;
  for (std::size_t i = 0; i < coded.heights.size(); ++i) {
    if (Heightfield::is_no_data(raster.given.heights[i])) continue;
    const double error = coded.heights[i] - raster.given.heights[i];
    sum += error * error;
    largest = std::max(largest, std::abs(error));
    ++n;
  }
  return {coded.bytes + raster.mask_bytes, std::sqrt(sum / static_cast<double>(n)), largest, setting};
}

Coded zstd_size(const Heightfield& field, double step, bool differences) {
  const Steps steps(field, step);
  std::vector<std::uint16_t> numbers = steps.numbers;
  if (differences) {
    for (std::size_t i = numbers.size() - 1; i > 0; --i) {
      if (i % static_cast<std::size_t>(field.width) != 0) {
        numbers[i] = static_cast<std::uint16_t>(numbers[i] - numbers[i - 1]);
      }
    }
  }
  return {zstd_bytes(numbers.data(), numbers.size() * sizeof numbers[0]), steps.heights()};
}

Error gdal_failed(RasterCodec codec, const GdalMessages& messages) {
  return environment_error(fmt::format("GDAL cannot write {}: {}", name(codec),
                                       messages.failed() ? messages.first_failure() : "no reason"),
                           "compressed size", "install a GDAL with this format (Debian's libgdal has it)");
}

// Rows of `data` written into a new band of a GeoTIFF in memory.
DatasetPointer make_tiff(const MemoryFile& file, const Heightfield& field, GDALDataType type, void* data,
                         const CPLStringList& options) {
  auto* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  DatasetPointer tiff(driver->Create(file.path.c_str(), field.width, field.depth, 1, type, options.List()));
  if (tiff != nullptr &&
      tiff->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, field.width, field.depth, data, field.width,
                                       field.depth, type, 0, 0, nullptr) != CE_None) {
    tiff.reset();
  }
  return tiff;
}

template <class Number>
bool read_back(const MemoryFile& file, const Heightfield& field, GDALDataType type,
               std::vector<Number>& numbers) {
  const DatasetPointer dataset(GDALDataset::Open(file.path.c_str(), GDAL_OF_RASTER));
  numbers.resize(field.heights.size());
  return dataset != nullptr &&
         dataset->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, field.width, field.depth, numbers.data(),
                                             field.width, field.depth, type, 0, 0, nullptr) == CE_None;
}

// The steps as 16-bit pixels in a format that GDAL only copies into, read back.
Coded copied_size(const Heightfield& field, RasterCodec codec, Steps steps, const char* format,
                  const CPLStringList& options) {
  register_gdal();
  const GdalMessages messages;
  const MemoryFile plain, packed;
  auto* const driver = GetGDALDriverManager()->GetDriverByName(format);
  const DatasetPointer source = make_tiff(plain, field, GDT_UInt16, steps.numbers.data(), {});
  if (driver == nullptr || source == nullptr) throw gdal_failed(codec, messages);
  DatasetPointer copy(
      driver->CreateCopy(packed.path.c_str(), source.get(), FALSE, options.List(), nullptr, nullptr));
  if (copy == nullptr) throw gdal_failed(codec, messages);
  copy.reset();
  if (!read_back(packed, field, GDT_UInt16, steps.numbers)) throw gdal_failed(codec, messages);
  return {packed.size(), steps.heights()};
}

Coded png_size(const Heightfield& field, double step) {
  CPLStringList options;
  options.SetNameValue("ZLEVEL", "9");
  return copied_size(field, RasterCodec::kPng, Steps(field, step), "PNG", options);
}

Coded jpeg2000_size(const Heightfield& field, double quality) {
  if (!(quality > 0 && quality <= 100)) {
    throw usage_error(fmt::format("quality must be above 0 and at most 100, got {}", quality),
                      "compressed size", "it is a percentage of the uncompressed size");
  }
  CPLStringList options;
  options.SetNameValue("CODEC", "J2K");
  options.SetNameValue("QUALITY", fmt::format("{:.6f}", quality).c_str());
  options.SetNameValue("REVERSIBLE", quality == 100 ? "YES" : "NO");
  // OpenJPEG's own default. GDAL's stops halving at 128 samples: at 3 kB of 327 × 468 heights, that has nine
  // times the RMSE.
  constexpr unsigned kResolutions = 6;
  const auto side = static_cast<unsigned>(std::min(field.width, field.depth));
  options.SetNameValue("RESOLUTIONS",
                       std::to_string(std::min<unsigned>(kResolutions, std::bit_width(side))).c_str());
  return copied_size(field, RasterCodec::kJpeg2000, Steps(field, natural_step(field)), "JP2OpenJPEG",
                     options);
}

// The bytes of a GeoTIFF's first block: the rest is the container's, not the codec's.
std::size_t block_bytes(const MemoryFile& file) {
  const DatasetPointer dataset(GDALDataset::Open(file.path.c_str(), GDAL_OF_RASTER));
  const char* const bytes =
      dataset == nullptr ? nullptr : dataset->GetRasterBand(1)->GetMetadataItem("BLOCK_SIZE_0_0", "TIFF");
  return bytes == nullptr ? file.size() : std::strtoull(bytes, nullptr, 10);
}

Coded lerc_size(const Heightfield& field, double largest_error, bool deflate) {
  if (!(largest_error >= 0)) {
    throw usage_error(fmt::format("the largest error must be at least 0 m, got {} m", largest_error),
                      "compressed size", "0 is without loss");
  }
  register_gdal();
  const RasterCodec codec = deflate ? RasterCodec::kLercDeflate : RasterCodec::kLerc;
  const GdalMessages messages;
  const MemoryFile packed;
  CPLStringList options;
  options.SetNameValue("COMPRESS", deflate ? "LERC_DEFLATE" : "LERC");
  if (deflate) options.SetNameValue("ZLEVEL", "9");
  options.SetNameValue("MAX_Z_ERROR", fmt::format("{:.9g}", largest_error).c_str());
  options.SetNameValue("BLOCKYSIZE", fmt::format("{}", field.depth).c_str());
  std::vector<float> heights = field.heights;
  DatasetPointer tiff = make_tiff(packed, field, GDT_Float32, heights.data(), options);
  if (tiff == nullptr) throw gdal_failed(codec, messages);
  tiff.reset();
  if (messages.failed() || !read_back(packed, field, GDT_Float32, heights)) {
    throw gdal_failed(codec, messages);
  }
  return {block_bytes(packed), {heights.begin(), heights.end()}};
}

// The range of settings that bisection searches, from the finest to the coarsest.
std::pair<double, double> setting_range(const Heightfield& field, RasterCodec codec) {
  const HeightRange range = height_range(field);
  const double span = std::max(static_cast<double>(range.highest) - range.lowest, 1e-6);
  switch (codec) {
    case RasterCodec::kJpeg2000:
      return {100, 0.01};
    case RasterCodec::kLerc:
    case RasterCodec::kLercDeflate:
      return {span * 1e-6, span};
    default:
      return {natural_step(field), span};
  }
}

CompressedSize size_of(const Raster& raster, RasterCodec codec, double setting) {
  const auto coded = [&]() -> Coded {
    const Heightfield& field = raster.filled;
    switch (codec) {
      case RasterCodec::kJpeg2000:
        return jpeg2000_size(field, setting);
      case RasterCodec::kLerc:
      case RasterCodec::kLercDeflate:
        return lerc_size(field, setting, codec == RasterCodec::kLercDeflate);
      case RasterCodec::kPng:
        return png_size(field, setting);
      default:
        return zstd_size(field, setting, codec == RasterCodec::kZstdDifferences);
    }
  };
  return compared(raster, coded(), setting);
}

}  // namespace

std::string_view name(RasterCodec codec) {
  switch (codec) {
    case RasterCodec::kZstd:
      return "int16 + zstd";
    case RasterCodec::kZstdDifferences:
      return "int16 differences + zstd";
    case RasterCodec::kJpeg2000:
      return "JPEG 2000";
    case RasterCodec::kLerc:
      return "LERC";
    case RasterCodec::kPng:
      return "PNG, 16 bits";
    default:
      return "LERC + DEFLATE";
  }
}

CompressedSize compressed_size(const Heightfield& field, RasterCodec codec, double setting) {
  return size_of(Raster(field), codec, setting);
}

CompressedSize compressed_size_at(const Heightfield& field, RasterCodec codec, double most,
                                  double CompressedSize::*error) {
  constexpr int kSteps = 14;
  const Raster raster(field);
  auto [fine, coarse] = setting_range(raster.filled, codec);
  CompressedSize best = size_of(raster, codec, fine);
  // Bisects the logarithm of the setting.
  for (int i = 0; i < kSteps; ++i) {
    const double middle = std::sqrt(fine * coarse);
    const CompressedSize at = size_of(raster, codec, middle);
    if (at.*error > most) {
      coarse = middle;
      continue;
    }
    fine = middle;
    if (at.bytes <= best.bytes) best = at;
  }
  return best;
}

}  // namespace terrabench
