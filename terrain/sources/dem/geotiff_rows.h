// A GeoTIFF of heights written from top to bottom, for ground that never is in memory whole: tiled, Float32,
// compressed without loss. Memory: a row of tiles, whatever the size.
#pragma once

#include <filesystem>
#include <memory>
#include <span>

namespace terrabench {

inline constexpr int kGeotiffTile = 256;  // samples a side; whole rows of tiles are the quickest to write

class GeotiffRows {
 public:
  // Cells in metres. All throw environment_error where the disk takes no more. The file is a raster that can
  // be read only after close(); whoever gives up before removes it.
  GeotiffRows(const std::filesystem::path&, int width, int depth, float cell_x, float cell_z);
  ~GeotiffRows();
  // Rows from the first one not yet written; whole rows, `heights` a multiple of the width.
  void write(std::span<const float> heights);
  void close();

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace terrabench
