// The terrains that have a name: real ones from packages or inside the program, and generated ones.
#include "terrain/sources/catalogue.h"

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "terrain/error.h"
#include "terrain/events/event_file.h"
#include "terrain/events/scripts.h"
#include "terrain/files.h"
#include "terrain/source.h"
#include "terrain/sources/dem/dem.h"
#include "terrain/sources/dem/embedded_dem.h"
#include "terrain/sources/drawing/drawing.h"
#include "terrain/sources/fractal/diamond_square.h"
#include "terrain/sources/fractal/faults.h"
#include "terrain/sources/fractal/hills.h"
#include "terrain/sources/mosaic.h"
#include "terrain/sources/noise/cave_terrain.h"

namespace terrabench {
namespace {

constexpr std::string_view kSampleData = "/usr/share/matplotlib/mpl-data/sample_data";

// One array inside one of matplotlib's .npz files, which are plain zip archives of raw arrays with a short
// header.
struct PackagedArray {
  std::string_view archive, member;
  int width, depth;
  std::string_view type;  // GDAL's name
  int sample_bytes, header_bytes;
  std::array<double, 6> transform;  // the archives hold no georeference that GDAL would find
};

// SRTM, 3″, at Jacksboro, Tennessee. The archive's ymin and ymax are swapped: the rows run from north to
// south.
constexpr PackagedArray kJacksboro = {"jacksboro_fault_dem.npz",
                                      "elevation.npy",
                                      403,
                                      344,
                                      "Int16",
                                      2,
                                      80,
                                      {-84.41375, 1.0 / 1200, 0, 36.732916666666668, 0, -1.0 / 1200}};

// Off Vancouver Island. A Mercator grid of 2′: its parallels lie 0.0223° apart in the south and 0.0214° in
// the north, here 0.02186° throughout, which moves no row by more than one. The rows run from south to north.
constexpr PackagedArray kTopobathy = {
    "topobathy.npz", "topo.npy", 120, 91,
    "Float32",       4,          128, {-126.0 - 1.0 / 3000, 1.0 / 30, 0, 48.0054366, 0, 0.0218646}};

std::string vrt(const PackagedArray& array) {
  const std::string path = fmt::format("{}/{}", kSampleData, array.archive);
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    throw environment_error("no such file", path, "install it: apt-get install python-matplotlib-data");
  }
  return fmt::format(
      "<VRTDataset rasterXSize=\"{}\" rasterYSize=\"{}\">"
      "<SRS dataAxisToSRSAxisMapping=\"2,1\">EPSG:4326</SRS><GeoTransform>{}</GeoTransform>"
      "<VRTRasterBand dataType=\"{}\" band=\"1\" subClass=\"VRTRawRasterBand\"><UnitType>m</UnitType>"
      "<SourceFilename relativeToVRT=\"0\">/vsizip/{{{}}}/{}</SourceFilename><ImageOffset>{}</ImageOffset>"
      "<PixelOffset>{}</PixelOffset><LineOffset>{}</LineOffset><ByteOrder>LSB</ByteOrder>"
      "</VRTRasterBand></VRTDataset>",
      array.width, array.depth, fmt::join(array.transform, ", "), array.type, path, array.member,
      array.header_bytes, array.sample_bytes, array.sample_bytes * array.width);
}

TerrainSource from_dem(std::string_view name, const std::string& path) {
  Dem dem = read_dem(path);
  TerrainSource source = source_of(name, std::move(dem.heights));
  source.notes = std::move(dem.notes);
  return source;
}

// With a note of what the user's file holds.
TerrainSource from_file(const std::string& path) {
  TerrainSource source = from_dem(path, path);
  const Heightfield& field = *source.heights;
  const HeightRange range = height_range(field);
  const std::string system = name_of_reference_system(field.georeference.crs);
  source.notes.insert(
      source.notes.begin(),
      fmt::format("{} × {} samples, cells of {:.4g} m × {:.4g} m, heights {:.5g}…{:.5g} m, {}", field.width,
                  field.depth, field.cell_x, field.cell_z, range.lowest, range.highest,
                  system.empty() ? "no reference system" : system));
  return source;
}

TerrainSource from_drawing(std::string_view name) {
  const NamedDrawing drawing = parse_drawing(name.substr(kDrawingPrefix.size()));
  const GreyImage picture = read_grey_png(drawing.file);
  if (picture.width < 2 || picture.height < 2) {
    throw bad_input(
        fmt::format("a drawing must have at least 2 × 2 pixels, got {} × {}", picture.width, picture.height),
        drawing.file, "give a larger picture");
  }
  const DrawingOptions& o = drawing.options;
  TerrainSource source = source_of(name, land_from_drawing(picture, o));
  source.notes.push_back(
      fmt::format("read as a drawing: black is {:.6g} m, intensity {:.6g} the shore, white {:.6g} m, a pixel "
                  "{:.6g} m wide",
                  o.sea_level > 0 ? -o.seabed * o.peak : 0, o.sea_level, o.peak, o.cell));
  return source;
}

TerrainSource open_helens() { return from_dem("helens", embedded_dem("helens")); }

constexpr TerrainType kTerrains[] = {
    {"jacksboro", "mountains with a fault valley, 403×344 samples of 3″",
     "SRTM, in Debian's python-matplotlib-data",
     [](std::uint64_t) { return from_dem("jacksboro", vrt(kJacksboro)); }},
    {"helens", "Mount St. Helens after its eruption of 1980, 317×460 samples of 30 m", "USGS, terrain/dems",
     [](std::uint64_t) { return open_helens(); }},
    {kHelensMosaic,
     "helens, repeated with every second tile mirrored: 4097×4097 samples, no measured ground of that size",
     "USGS, terrain/dems", [](std::uint64_t) { return open_helens_mosaic(4097); }},
    {"maine", "low hills, lakes and coast of Maine, 1201×1201 samples of 3″", "SRTM, terrain/dems",
     [](std::uint64_t) { return from_dem("maine", embedded_dem("maine")); }},
    {"topobathy", "sea floor and coast off Vancouver Island, 120×91 samples of 2′",
     "ETOPO, in Debian's python-matplotlib-data",
     [](std::uint64_t) { return from_dem("topobathy", vrt(kTopobathy)); }},
    {"caves", "hills with overhangs and tunnels from 3-D noise, a cube of 128 m",
     "the hybrid paper's noise graph", [](std::uint64_t seed) { return noise::cave_source({.seed = seed}); }},
    {"diamond-square", "mountains that close on themselves, 513×513 samples of 30 m", "diamond-square method",
     [](std::uint64_t seed) { return source_of("diamond-square", fractal::diamond_square({.seed = seed})); }},
    {"faults", "mountains of 1000 faults of 10 m, 513×513 samples of 30 m", "fault formation",
     [](std::uint64_t seed) {
       return source_of("faults", fractal::fault_terrain({.seed = seed, .faults = 1000, .step = 10}));
     }},
    {"planet-faults", "a sphere of 100 km radius after 1000 faults, 1025×513 samples of equal angles",
     "fault formation on the sphere",
     [](std::uint64_t seed) { return source_of("planet-faults", fractal::planet_faults({.seed = seed})); }},
    {"hills", "400 overlapping hills, 513×513 samples of 30 m", "hill technique",
     [](std::uint64_t seed) {
       return source_of("hills", fractal::hill_terrain({.seed = seed, .scale = 5e-5F}));
     }},
    {"canyon", "hills with trenches, faults, craters and a tunnel that overlap, 129×129 samples of 120 m",
     "events on hill technique", [](std::uint64_t) { return events::open_named_script("canyon"); }},
    {"two-tunnels", "hills with two tunnels through a ridge, 129×129 samples of 120 m",
     "events on hill technique", [](std::uint64_t) { return events::open_named_script("two-tunnels"); }},
};

// Whether it can only be a path: a misspelt name holds none of these characters.
bool looks_like_path(std::string_view text) { return text.find_first_of("./\\<") != std::string_view::npos; }

}  // namespace

TerrainSource open_helens_mosaic(int size) {
  return source_of(kHelensMosaic, mirrored_mosaic(*open_helens().heights, size));
}

std::span<const TerrainType> terrains() { return kTerrains; }

std::string terrain_file(std::string_view text) {
  if (text.starts_with(kDrawingPrefix)) return parse_drawing(text.substr(kDrawingPrefix.size())).file;
  if (text.starts_with(kDemPrefix)) return parse_dem(text).path;
  std::vector<std::string_view> known;
  for (const TerrainType& type : terrains()) {
    if (type.name == text) return "";
    known.push_back(type.name);
  }
  std::error_code error;
  if (looks_like_path(text) || std::filesystem::exists(std::filesystem::path(text), error))
    return std::string(text);
  const Error unknown = unknown_name("terrain", text, known);
  throw Error(unknown.code(), unknown.what(), "", unknown.advice() + "; the path of a DEM file works too");
}

namespace {

bool names_event_file(std::string_view text) {
  return !text.starts_with(kDrawingPrefix) && !text.starts_with(kDemPrefix) &&
         terrain_file(text).ends_with(events::kExtension);
}

}  // namespace

bool names_dem_file(std::string_view text) {
  return !text.starts_with(kDrawingPrefix) && !terrain_file(text).empty() && !names_event_file(text);
}

TerrainSource open_terrain(std::string_view name_or_path, std::uint64_t seed) {
  if (name_or_path.starts_with(kDrawingPrefix)) return from_drawing(name_or_path);
  const std::string path(name_or_path);
  if (names_event_file(path)) return events::open_script(read_file(path, events::kMostBytes), path);
  if (names_dem_file(path)) return from_file(path);
  for (const TerrainType& type : terrains()) {
    if (type.name == name_or_path) return type.open(seed);
  }
  std::abort();  // names_dem_file() found it in the same table
}

}  // namespace terrabench
