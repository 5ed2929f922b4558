#include "experiments/cross/lod_disk_ground.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "terrain/files.h"
#include "terrain/sources/dem/geotiff_rows.h"
#include "terrain/sources/fractal/diamond_square_bands.h"

namespace terrabench::cross {

std::string write_disk_ground(const std::filesystem::path& path, int side, std::uint64_t seed,
                              Progress& progress) {
  constexpr int kRows = 32;  // a task
  fractal::DiamondSquareOptions options;
  options.seed = seed;
  options.side = static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::max(2, side - 1)))) + 1;
  options.amplitude = 2000;
  const fractal::DiamondSquareBands whole(options);
  GeotiffRows file(path, side, side, options.cell, options.cell);
  std::vector<float> band;
  progress.begin("making mountains on disk", static_cast<std::uint64_t>((side - 1) / kGeotiffTile + 1));
  for (int first = 0; first < side; first += kGeotiffTile) {
    const int rows = std::min(kGeotiffTile, side - first);
    band.resize(static_cast<std::size_t>(rows) * side);
    tbb::parallel_for(
        tbb::blocked_range<int>(0, rows, kRows),
        [&](const tbb::blocked_range<int>& part) {
          const auto width = static_cast<std::size_t>(whole.side());
          std::vector<float> read((part.end() - part.begin()) * width);
          whole.read(first + part.begin(), part.end() - part.begin(), read);
          for (int row = part.begin(); row < part.end(); ++row) {
            const float* const from = &read[(row - part.begin()) * width];
            std::transform(from, from + side, &band[static_cast<std::size_t>(row) * side],
                           [](float height) { return std::nearbyint(height); });
          }
        },
        tbb::simple_partitioner());
    file.write(band);
    progress.advance();
  }
  file.close();
  return checksum(fmt::format("diamond-square {} {} {} {} {} {} whole metres", seed, side, options.side,
                              options.cell, options.amplitude, options.hurst));
}

}  // namespace terrabench::cross
