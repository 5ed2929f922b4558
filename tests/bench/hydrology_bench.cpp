// Flow routing compared with GRASS r.watershed (Debian: grass-core) on the same int16 DEM in one run,
// alternately:
//   hydrology_bench [SIZE [REPEATS]]
// GRASS runs as its own process with the map imported beforehand; its time includes reading that map and
// writing two. Ours is timed twice: from heights in memory to directions and accumulation in memory, and from
// a GeoTIFF to two, which is the fair comparison though GeoTIFF is not GRASS's own format. Prints medians as
// pixels per second and the ratios; without GRASS only ours.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "terrain/error.h"
#include "terrain/files.h"
#include "terrain/hydrology/channels.h"
#include "terrain/hydrology/flow.h"
#include "terrain/sources/dem/dem.h"
#include "tests/bench/mountains.h"

namespace terrabench {
namespace {

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "hydrology_bench.XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw environment_error("cannot make a folder", name, "check TMPDIR");
    path = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::filesystem::path path;
};

double median(std::vector<double> samples) {
  std::sort(samples.begin(), samples.end());
  return samples[samples.size() / 2];
}

template <class Work>
double seconds(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void route_in_memory(const Heightfield& field) {
  if (route_flow(field).accumulation.empty()) std::abort();  // keeps the result alive
}

void route_files(const std::filesystem::path& folder) {
  const Heightfield field = read_dem((folder / "dem.tif").string()).heights;
  const FlowNetwork network = route_flow(field);
  write_geotiff(folder / "accumulation.tif", accumulation_raster(network, field));
  write_geotiff(folder / "direction.tif", direction_raster(network, field));
}

// Runs shell commands in a GRASS session on the folder's map; false when that fails.
bool grass(const std::filesystem::path& folder, const std::string& commands) {
  write_file(folder / "commands.sh", "set -e\n" + commands);
  const auto run = [&](const std::string& arguments) {
    const std::string line = fmt::format("cd {} && grass {} >log 2>&1", folder.string(), arguments);
    return std::system(line.c_str()) == 0;
  };
  // GRASS needs the location's absolute path.
  if (!std::filesystem::exists(folder / "location") && !run("-c XY $PWD/location -e")) return false;
  return run("$PWD/location/PERMANENT --exec sh commands.sh");
}

int compare(int size, int repeats) {
  const Heightfield field = mountains(size);
  const auto pixels = static_cast<double>(field.heights.size());
  const TemporaryFolder folder;
  write_geotiff(folder.path / "dem.tif", field);
  const bool peer = grass(folder.path,
                          "r.in.gdal -o --quiet input=dem.tif output=floats\ng.region raster=floats\n"
                          "r.mapcalc 'dem = int(floats)'\n");
  std::vector<double> our_times, file_times, peer_times;
  for (int i = 0; i < repeats; ++i) {
    our_times.push_back(seconds([&] { route_in_memory(field); }));
    file_times.push_back(seconds([&] { route_files(folder.path); }));
    if (!peer) continue;
    if (!grass(folder.path,
               "g.region raster=dem\nbegin=$(date +%s.%N)\n"
               "r.watershed -s --overwrite elevation=dem accumulation=acc drainage=dir\n"
               "echo $begin $(date +%s.%N) >time\n")) {
      fmt::print(stderr, "r.watershed failed: {}\n", read_file(folder.path / "log"));
      return 1;
    }
    const std::string line = read_file(folder.path / "time");
    double begin = 0, end = 0;
    std::sscanf(line.c_str(), "%lf %lf", &begin, &end);
    peer_times.push_back(end - begin);
  }
  const auto report = [&](const char* what, double time) {
    fmt::print("{:<22} {:>8.3f} s, {:>5.1f} Mpixel/s\n", what, time, pixels / time * 1e-6);
  };
  fmt::print("{0}×{0} samples, {1} repeats\n", size, repeats);
  report("route_flow", median(our_times));
  report("  with files", median(file_times));
  if (!peer) {
    fmt::print("GRASS (Debian: grass-core) does not run here: {}\n", read_file(folder.path / "log"));
    return 0;
  }
  report("r.watershed -s", median(peer_times));
  fmt::print("route_flow vs_grass={:.1f}\nroute_flow/with_files vs_grass={:.1f}\n",
             median(peer_times) / median(our_times), median(peer_times) / median(file_times));
  return 0;
}

}  // namespace
}  // namespace terrabench

int main(int count, char** arguments) {
  const int size = count > 1 ? std::atoi(arguments[1]) : 4096,
            repeats = count > 2 ? std::atoi(arguments[2]) : 3;
  if (size < 1 || size > 32768 || repeats < 1) {
    fmt::print(stderr, "usage: hydrology_bench [SIZE [REPEATS]], SIZE up to 32768\n");
    return 2;
  }
  try {
    return terrabench::compare(size, repeats);
  } catch (const terrabench::Error& error) {
    fmt::print(stderr, "{}\n{}\n", error.what(), error.advice());
    return static_cast<int>(error.code());
  }
}
