// A GeoTIFF of heights written from top to bottom, for ground larger than memory: tiled, Float32, compressed
// without loss. Memory: one row of tiles at any size.
#pragma once

#include <filesystem>
#include <memory>
#include <span>

namespace terrabench {

inline constexpr int kGeotiffTile = 256;  // samples per side; whole rows of tiles are the quickest to write

class GeotiffRows {
 public:
  // Cells in metres. All functions throw environment_error when the disk is full. The file is readable only
  // after close(); a caller that stops earlier removes it.
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
