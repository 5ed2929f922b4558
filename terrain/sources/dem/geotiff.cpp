#include <cpl_string.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <ogr_spatialref.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "terrain/error.h"
#include "terrain/sources/dem/dem.h"
#include "terrain/sources/dem/gdal_session.h"

namespace terrabench {
namespace {

struct RemoveUnlessKept {
  std::filesystem::path path;
  ~RemoveUnlessKept() {
    std::error_code ignored;
    if (!path.empty()) std::filesystem::remove(path, ignored);
  }
};

void describe(GDALDataset& dataset, const Heightfield& field, const std::string& unit) {
  const Georeference& georeference = field.georeference;
  if (georeference.transform != std::array<double, 6>{}) {
    std::array<double, 6> transform = georeference.transform;
    dataset.SetGeoTransform(transform.data());
  } else {
    // Without a georeference the file still holds the size of the cells.
    std::array<double, 6> transform{0, field.cell_x, 0, 0, 0, -field.cell_z};
    dataset.SetGeoTransform(transform.data());
  }
  if (!georeference.crs.empty()) {
    OGRSpatialReference reference;
    reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    if (reference.importFromWkt(georeference.crs.c_str()) == OGRERR_NONE) dataset.SetSpatialRef(&reference);
  }
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  // NaN in the file too: any number could be a height.
  band.SetNoDataValue(Heightfield::kNoData);
  band.SetUnitType(unit.c_str());
}

void write_rows(GDALRasterBand& band, const Heightfield& field, const GdalMessages& messages,
                const std::filesystem::path& path) {
  constexpr int kRows = 64;
  for (int y = 0; y < field.depth; y += kRows) {
    const int rows = std::min(kRows, field.depth - y);
    // One signature for reading and writing: writing does not change the buffer.
    auto* const from = const_cast<float*>(field.heights.data()) + static_cast<std::size_t>(y) * field.width;
    const CPLErr error =
        band.RasterIO(GF_Write, 0, y, field.width, rows, from, field.width, rows, GDT_Float32, 0, 0, nullptr);
    if (error != CE_None || messages.failed()) throw cannot_write(path, messages.first_failure());
  }
}

void sync(const std::filesystem::path& path) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0 || fsync(descriptor) != 0) {
    const int cause = errno;
    if (descriptor >= 0) close(descriptor);
    throw cannot_write(path, std::strerror(cause));
  }
  close(descriptor);
}

}  // namespace

void write_geotiff(const std::filesystem::path& path, const Heightfield& field, const std::string& unit) {
  register_gdal();
  std::error_code error;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
  if (error) throw cannot_write(path, error.message());
  // Declared before the dataset, so that it is destroyed after the dataset is closed.
  RemoveUnlessKept temporary{path.string() + fmt::format(".{}.tmp", getpid())};
  const GdalMessages messages;
  CPLStringList options;
  options.SetNameValue("COMPRESS", "DEFLATE");
  options.SetNameValue("PREDICTOR", "3");
  options.SetNameValue("BIGTIFF", "IF_SAFER");
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  DatasetPointer dataset(
      driver->Create(temporary.path.c_str(), field.width, field.depth, 1, GDT_Float32, options));
  if (dataset == nullptr) throw cannot_write(path, messages.first_failure());
  describe(*dataset, field, unit);
  write_rows(*dataset->GetRasterBand(1), field, messages, path);
  // A full disk may be reported only when the last blocks and the directory are written.
  dataset.reset();
  if (messages.failed()) throw cannot_write(path, messages.first_failure());
  sync(temporary.path);
  std::filesystem::rename(temporary.path, path, error);
  if (error) throw cannot_write(path, error.message());
  temporary.path.clear();
}

}  // namespace terrabench
