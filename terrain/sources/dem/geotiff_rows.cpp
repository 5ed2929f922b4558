#include "terrain/sources/dem/geotiff_rows.h"

#include <cpl_string.h>
#include <fmt/format.h>

#include <cassert>

#include "terrain/error.h"
#include "terrain/sources/dem/gdal_session.h"

namespace terrabench {

struct GeotiffRows::File {
  std::filesystem::path path;
  GdalMessages messages;  // before the dataset: collects what closing reports
  DatasetPointer dataset;
  int written = 0;  // rows

  Error refused() const { return cannot_write(path, messages.first_failure()); }
};

GeotiffRows::GeotiffRows(const std::filesystem::path& path, int width, int depth, float cell_x,
                         float cell_z) {
  register_gdal();
  file_ = std::make_unique<File>();
  file_->path = path;
  CPLStringList options;
  const std::string tile = fmt::format("{}", kGeotiffTile);
  options.SetNameValue("TILED", "YES");
  options.SetNameValue("BLOCKXSIZE", tile.c_str());
  options.SetNameValue("BLOCKYSIZE", tile.c_str());
  options.SetNameValue("COMPRESS", "ZSTD");
  options.SetNameValue("ZSTD_LEVEL", "3");
  options.SetNameValue("PREDICTOR", "3");
  options.SetNameValue("BIGTIFF", "IF_SAFER");
  options.SetNameValue("NUM_THREADS", "ALL_CPUS");
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  file_->dataset.reset(driver->Create(path.c_str(), width, depth, 1, GDT_Float32, options));
  if (file_->dataset == nullptr) throw file_->refused();
  double transform[] = {0, cell_x, 0, 0, 0, -cell_z};
  file_->dataset->SetGeoTransform(transform);
}

GeotiffRows::~GeotiffRows() = default;

void GeotiffRows::write(std::span<const float> heights) {
  const int width = file_->dataset->GetRasterXSize();
  const int rows = static_cast<int>(heights.size() / width);
  assert(heights.size() % width == 0 && file_->written + rows <= file_->dataset->GetRasterYSize());
  // One signature for reading and writing: writing does not change the buffer.
  const CPLErr error = file_->dataset->GetRasterBand(1)->RasterIO(GF_Write, 0, file_->written, width, rows,
                                                                  const_cast<float*>(heights.data()), width,
                                                                  rows, GDT_Float32, 0, 0, nullptr);
  if (error != CE_None || file_->messages.failed()) throw file_->refused();
  file_->written += rows;
}

// A full disk may be reported only here.
void GeotiffRows::close() {
  file_->dataset.reset();
  if (file_->messages.failed()) throw file_->refused();
}

}  // namespace terrabench
