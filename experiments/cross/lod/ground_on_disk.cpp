#include "experiments/cross/lod/ground_on_disk.h"

#include <fmt/format.h>
#include <malloc.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "terrain/error.h"
#include "terrain/files.h"
#include "terrain/sources/dem/dem.h"
#include "terrain/sources/dem/geotiff_rows.h"
#include "terrain/sources/dem/height_pyramid.h"
#include "terrain/sources/fractal/diamond_square.h"

namespace terrabench::cross {
namespace {

namespace fs = std::filesystem;

// Writes side × side samples, 30 m apart, of diamond-square ground in whole metres, as SRTM has them. Returns
// a digest of what determines every height. O(side²), in parallel; memory: a grid of 4097², and a row of
// tiles.
std::string write_mountains(const fs::path& path, int side, std::uint64_t seed, Progress& progress) {
  constexpr int kRows = 32;  // per task
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

// Digest of the pyramid's files, read in parts.
std::string digest(const fs::path& pyramid) {
  constexpr std::size_t kPart = std::size_t{1} << 20;
  std::vector<std::byte> part(kPart);
  std::string digests;
  for (int level = 0;; ++level) {
    const fs::path file = pyramid / fmt::format("{}.tif", level);
    std::ifstream in(file, std::ios::binary);
    if (!in) return checksum(digests);
    do {
      in.read(reinterpret_cast<char*>(part.data()), static_cast<std::streamsize>(kPart));
      digests += checksum(std::span(part).first(static_cast<std::size_t>(in.gcount())));
    } while (in);
    if (in.bad()) throw bad_input("cannot be read to its end", file.string(), "build the pyramid again");
  }
}

}  // namespace

std::vector<Case> cases_on_disk(std::span<const ParameterSpec> specs, const RunOptions& options) {
  std::vector<Case> cases;
  for (const std::string& terrain : options.terrains) cases.push_back({terrain, Parameters(specs), terrain});
  if (!cases.empty()) return cases;
  for (const std::int64_t side : {4096, 16384}) {
    if (side > 4096 && options.profile == Profile::kQuick) break;
    cases.push_back({fmt::format("side={}", side), {specs, {{"side", side}}}});
  }
  return cases;
}

fs::path pyramid_of(const Case& at, const RunOptions& options, const fs::path& folder, Recorder& recorder,
                    Progress& progress) {
  if (!at.terrain.empty() && fs::is_directory(at.terrain)) {
    recorder.terrain(at.terrain, digest(at.terrain));
    return at.terrain;
  }
  const fs::path pyramid = folder / "pyramid", made = folder / "ground.tif";
  std::string dem = at.terrain;
  if (at.terrain.empty()) {
    const int side = at.integer("side");
    recorder.terrain(fmt::format("mountains {0} × {0}", side),
                     write_mountains(made, side, options.seed, progress));
    dem = made.string();
  } else {
    const TerrainSource source = open_terrain(at.terrain, options.seed);
    recorder.terrain(source);
    if (!source.heights)
      throw usage_error("this terrain is a solid, not a height field", at.terrain, "choose a DEM");
    if (!names_dem_file(at.terrain)) {
      write_geotiff(made, *source.heights);
      dem = made.string();
    }
  }
  HeightPyramid::build(dem, pyramid, progress);
  std::error_code ignored;
  fs::remove(made, ignored);  // frees disk space
  return pyramid;
}

std::uint64_t peak_resident_bytes() {
  std::ifstream status("/proc/self/status");
  std::string line;
  unsigned long long kibibytes = 0;
  while (std::getline(status, line)) {
    if (std::sscanf(line.c_str(), "VmHWM: %llu kB", &kibibytes) == 1) return kibibytes * 1024;
  }
  throw environment_error("the system does not report peak resident memory", "/proc/self/status",
                          "measure on Linux");
}

void forget_peak() {
  malloc_trim(0);
  std::ofstream file("/proc/self/clear_refs");
  file << 5 << std::flush;  // proc(5): resets VmHWM
  if (!file) {
    throw environment_error("the system does not forget peak resident memory", "/proc/self/clear_refs",
                            "measure on Linux");
  }
}

}  // namespace terrabench::cross
