// Ground on disk, larger than memory: every level of detail of a DEM as a tiled, losslessly
// compressed GeoTIFF, so that reading a window of any level costs the tiles that it touches. Level l holds
// every 2ˡ-th sample along x and z, unaveraged, and the ground's last samples at its far borders.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "terrain/progress.h"

namespace terrabench {

class HeightPyramid {
 public:
  // Converts any DEM that read_dem() takes, in rows of tiles: bounded memory at any size; on disk a third
  // more bytes than the ground alone. Holes are filled from a reduced copy of the ground. The folder is
  // written whole or not at all. A whole pyramid with nothing beside it is replaced, anything else that
  // exists is refused (usage_error).
  static void build(const std::string& dem, const std::filesystem::path& folder, Progress&);

  // Throws bad_input for a folder that does not hold a whole pyramid.
  static std::unique_ptr<HeightPyramid> open(const std::filesystem::path& folder);
  ~HeightPyramid();

  int width() const;  // of level 0, samples
  int depth() const;
  int levels() const;    // on disk
  float cell_x() const;  // metres
  float cell_z() const;
  // Lattice samples [a, a + columns) × [b, b + rows) of the level, row by row into `out`, rows `stride`
  // apart; beyond the ground its border is repeated. Any level ≥ 0. GDAL keeps decoded tiles within its cache
  // (64 MiB unless GDAL_CACHEMAX says otherwise). Throws bad_input when the disk's bytes cannot be
  // decoded. Not thread-safe.
  void read(int level, int a, int b, int columns, int rows, float* out, int stride);
  std::uint64_t tiles_read() const;  // decoded since open(); cache hits do not count
  std::size_t bytes() const;         // heap bytes, without GDAL's own

 private:
  struct Levels;
  explicit HeightPyramid(std::unique_ptr<Levels>);
  std::unique_ptr<Levels> levels_;
};

}  // namespace terrabench
