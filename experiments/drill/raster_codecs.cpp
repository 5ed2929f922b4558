#include "experiments/drill/raster_codecs.h"

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <zstd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "terrain/error.h"
#include "terrain/metrics/elevation_error.h"
#include "terrain/sources/dem/gdal_session.h"

namespace terrabench::drill {
namespace {

constexpr std::int16_t kHole = -32768;

std::vector<std::int16_t> whole_metres(const Heightfield& field) {
  std::vector<std::int16_t> values(field.heights.size());
  std::transform(field.heights.begin(), field.heights.end(), values.begin(), [](float h) {
    return Heightfield::is_no_data(h)
               ? kHole
               : static_cast<std::int16_t>(std::lround(std::clamp(h, -32767.0F, 32767.0F)));
  });
  return values;
}

double error_of(const Heightfield& field, std::vector<float> decoded) {
  Heightfield other = field;
  other.heights = std::move(decoded);
  for (std::size_t i = 0; i < other.heights.size(); ++i) {
    if (Heightfield::is_no_data(field.heights[i])) other.heights[i] = Heightfield::kNoData;
  }
  return elevation_error(field, other).rmse;
}

GDALDriver& driver(const char* name) {
  register_gdal();
  GDALDriver* const found = GetGDALDriverManager()->GetDriverByName(name);
  if (found == nullptr) {
    throw environment_error(fmt::format("GDAL here has no {} driver", name), "", "install Debian's libgdal");
  }
  return *found;
}

// A file that GDAL keeps in memory.
struct MemoryFile {
  std::string path;
  ~MemoryFile() { VSIUnlink(path.c_str()); }
};

void check(bool good, const char* what) {
  if (good) return;
  throw environment_error(fmt::format("GDAL cannot {}: {}", what, CPLGetLastErrorMsg()), "",
                          "check GDAL's installation");
}

void write_tiff(const MemoryFile& file, const Heightfield& field, GDALDataType type, const void* samples,
                const CPLStringList& options) {
  const DatasetPointer dataset(
      driver("GTiff").Create(file.path.c_str(), field.width, field.depth, 1, type, options));
  check(dataset != nullptr, "write GeoTIFF");
  // GDAL's signature serves reading too; writing leaves the samples as they are.
  check(dataset->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, field.width, field.depth,
                                            const_cast<void*>(samples), field.width, field.depth, type, 0, 0,
                                            nullptr) == CE_None,
        "write GeoTIFF");
}

Encoded measure(const MemoryFile& file, const Heightfield& field) {
  VSIStatBufL status;
  check(VSIStatL(file.path.c_str(), &status) == 0, "find its own file");
  const DatasetPointer dataset(GDALDataset::Open(file.path.c_str()));
  check(dataset != nullptr, "open its own file");
  std::vector<float> decoded(field.heights.size());
  check(dataset->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, field.width, field.depth, decoded.data(),
                                            field.width, field.depth, GDT_Float32, 0, 0, nullptr) == CE_None,
        "read its own file");
  return {static_cast<std::size_t>(status.st_size), error_of(field, std::move(decoded))};
}

// Bisects a setting, in its logarithm, between one that is good enough and one that is not.
template <class Encode>
Encoded smallest(double good, double bad, double rmse, const Encode& encode) {
  Encoded best = encode(good);
  for (int i = 0; i < 14; ++i) {
    const double middle = std::sqrt(good * bad);
    const Encoded tried = encode(middle);
    if (tried.rmse <= rmse) {
      good = middle;
      if (best.rmse > rmse || tried.bytes < best.bytes) best = tried;
    } else {
      bad = middle;
    }
  }
  return best;
}

}  // namespace

Encoded zstd_int16(const Heightfield& field) {
  const std::vector<std::int16_t> values = whole_metres(field);
  std::vector<std::byte> packed(ZSTD_compressBound(values.size() * sizeof(values[0])));
  const std::size_t bytes = ZSTD_compress(packed.data(), packed.size(), values.data(),
                                          values.size() * sizeof(values[0]), ZSTD_maxCLevel());
  if (ZSTD_isError(bytes) != 0) throw std::bad_alloc();  // the only way to fail
  return {bytes, error_of(field, {values.begin(), values.end()})};
}

Encoded jpeg2000(const Heightfield& field, double quality) {
  CPLStringList options;
  options.SetNameValue("QUALITY", fmt::format("{}", quality).c_str());
  options.SetNameValue("REVERSIBLE", quality >= 100 ? "YES" : "NO");
  options.SetNameValue("GMLJP2", "NO");
  options.SetNameValue("GeoJP2", "NO");
  const std::vector<std::int16_t> values = whole_metres(field);
  const GdalMessages messages;
  const MemoryFile from{"/vsimem/terrabench-from.tif"}, to{"/vsimem/terrabench-to.jp2"};
  write_tiff(from, field, GDT_Int16, values.data(), {});
  {
    const DatasetPointer source(GDALDataset::Open(from.path.c_str()));
    check(source != nullptr, "open its own file");
    const DatasetPointer written(
        driver("JP2OpenJPEG").CreateCopy(to.path.c_str(), source.get(), 0, options, nullptr, nullptr));
    check(written != nullptr, "write JPEG 2000");
  }
  return measure(to, field);
}

Encoded lerc(const Heightfield& field, double error) {
  CPLStringList options;
  options.SetNameValue("COMPRESS", "LERC_DEFLATE");
  options.SetNameValue("MAX_Z_ERROR", fmt::format("{}", error).c_str());
  // One strip: the fewest headers.
  options.SetNameValue("BLOCKYSIZE", fmt::format("{}", field.depth).c_str());
  const GdalMessages messages;
  const MemoryFile file{"/vsimem/terrabench-lerc.tif"};
  write_tiff(file, field, GDT_Float32, field.heights.data(), options);
  return measure(file, field);
}

Encoded jpeg2000_at(const Heightfield& field, double rmse) {
  return smallest(100, 0.02, rmse, [&](double quality) { return jpeg2000(field, quality); });
}

Encoded lerc_at(const Heightfield& field, double rmse) {
  return smallest(std::max(rmse, 1e-3) / 4, std::max(rmse, 1e-3) * 16, rmse,
                  [&](double error) { return lerc(field, error); });
}

}  // namespace terrabench::drill
