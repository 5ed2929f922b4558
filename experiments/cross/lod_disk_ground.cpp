#include "experiments/cross/lod_disk_ground.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "terrain/files.h"
#include "terrain/sources/dem/geotiff_rows.h"
#include "terrain/sources/noise/program.h"

namespace terrabench::cross {
namespace {

constexpr float kCell = 30;  // metres

// Metres.
noise::Node mountains(noise::Graph& graph, std::uint64_t seed) {
  const noise::Node swells = graph.fbm({.seed = seed, .frequency = 1 / 150000.0F, .octaves = 3});
  const noise::Node ridges =
      graph.ridged_multifractal({.seed = seed + 1, .frequency = 1 / 30000.0F, .octaves = 8});
  return graph.add(graph.scale_offset(swells, 900, 700), graph.scale_offset(ridges, 2200, 0));
}

}  // namespace

std::string write_disk_ground(const std::filesystem::path& path, int side, std::uint64_t seed,
                              Progress& progress) {
  noise::Graph graph;
  const noise::Node root = mountains(graph, seed);
  const noise::Program program(graph, root);
  GeotiffRows file(path, side, side, kCell, kCell);
  std::vector<float> band;
  progress.begin("making mountains on disk", static_cast<std::uint64_t>((side - 1) / kGeotiffTile + 1));
  for (int first = 0; first < side; first += kGeotiffTile) {
    const int rows = std::min(kGeotiffTile, side - first);
    band.resize(static_cast<std::size_t>(rows) * side);
    tbb::parallel_for(0, rows, [&](int row) {
      // The slice is a vertical plane to the noise; its second axis is our z.
      const std::span<float> heights(&band[static_cast<std::size_t>(row) * side],
                                     static_cast<std::size_t>(side));
      program.slice({.y0 = static_cast<float>(first + row) * kCell, .dx = kCell, .width = side, .height = 1},
                    heights);
      for (float& height : heights) height = std::nearbyint(height);
    });
    file.write(band);
    progress.advance();
  }
  file.close();
  return checksum(fmt::format("{} {}\n{}", side, kCell, graph.describe()));
}

}  // namespace terrabench::cross
