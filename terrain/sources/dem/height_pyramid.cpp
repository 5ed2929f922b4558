#include "terrain/sources/dem/height_pyramid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "terrain/error.h"
#include "terrain/memory.h"
#include "terrain/sources/dem/dem.h"
#include "terrain/sources/dem/gdal_session.h"
#include "terrain/sources/dem/geotiff_rows.h"
#include "terrain/temporary_name.h"

namespace terrabench {
namespace {

namespace fs = std::filesystem;

constexpr int kCoarsest = 16;   // samples along the longer side of the last level kept
constexpr int kReduced = 1024;  // samples along the longer side of the copy that fills holes

std::string level_file(const fs::path& folder, int level) {
  return (folder / fmt::format("{}.tif", level)).string();
}

// Samples of a level along an axis with so many in the level below: every second one and the last.
int halved(int samples) { return samples / 2 + 1; }

Error damaged(const fs::path& path, const std::string& why) {
  return bad_input(why, path.string(), "the pyramid is not whole: build it again");
}

DatasetPointer open_level(const std::string& path) {
  const GdalMessages messages;
  const char* const drivers[] = {"GTiff", nullptr};
  return DatasetPointer(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers));
}

// The size of a level's cells, metres; 0 where the file does not give it.
struct Cells {
  float x = 0, z = 0;
};
Cells cells_of(GDALDataset& level) {
  double transform[6];
  if (level.GetGeoTransform(transform) != CE_None) return {};
  return {static_cast<float>(transform[1]), static_cast<float>(-transform[5])};
}

bool is_level(GDALDataset* dataset) {
  if (dataset == nullptr || dataset->GetRasterCount() != 1) return false;
  int tile_x = 0, tile_z = 0;
  dataset->GetRasterBand(1)->GetBlockSize(&tile_x, &tile_z);
  return tile_x == kGeotiffTile && tile_z == kGeotiffTile;
}

struct RasterSize {
  int width, depth;
};

RasterSize raster_size(const std::string& dem) {
  const DemHeader header = read_dem_header(dem);
  return {header.width, header.depth};
}

// Replaces missing heights by those of the reduced copy.
class HoleFiller {
 public:
  HoleFiller(const std::string& dem, const RasterSize& size) : dem_(dem), size_(size) {}

  void fill(Heightfield& band, int first_row) {
    for (int j = 0; j < band.depth; ++j) {
      for (int i = 0; i < band.width; ++i) {
        if (Heightfield::is_no_data(band.at(i, j))) band.at(i, j) = at(i, first_row + j);
      }
    }
  }

 private:
  float at(int i, int j) {
    if (reduced_.heights.empty()) {
      const double by = std::min(1.0, static_cast<double>(kReduced) / std::max(size_.width, size_.depth));
      DemOptions options;
      options.fill_no_data = true;
      options.width = std::max(1, static_cast<int>(size_.width * by));
      options.depth = std::max(1, static_cast<int>(size_.depth * by));
      reduced_ = read_dem(dem_, options).heights;
    }
    const auto scaled = [](int at, int samples, int reduced) {
      return samples < 2
                 ? 0.0F
                 : static_cast<float>(at) / static_cast<float>(samples - 1) * static_cast<float>(reduced - 1);
    };
    return reduced_.sample(scaled(i, size_.width, reduced_.width) * reduced_.cell_x,
                           scaled(j, size_.depth, reduced_.depth) * reduced_.cell_z);
  }

  const std::string& dem_;
  RasterSize size_;
  Heightfield reduced_;
};

void write_ground(const std::string& dem, const RasterSize& size, const fs::path& folder,
                  Progress& progress) {
  // The cells in the middle: along a parallel they shrink towards the poles.
  DemOptions middle;
  middle.window = {0, std::max(0, size.depth / 2 - 1), size.width, std::min(2, size.depth)};
  const Heightfield rows = read_dem(dem, middle).heights;
  GeotiffRows writer(level_file(folder, 0), size.width, size.depth, rows.cell_x, rows.cell_z);
  HoleFiller holes(dem, size);
  progress.begin("copying the ground into tiles", (size.depth - 1) / kGeotiffTile + 1);
  for (int y = 0; y < size.depth; y += kGeotiffTile) {
    const int count = std::min(kGeotiffTile, size.depth - y);
    DemOptions tiles;
    tiles.window = {0, y, size.width, count};
    Heightfield band = read_dem(dem, tiles).heights;
    holes.fill(band, y);
    writer.write(band.heights);
    progress.advance();
  }
  writer.close();
}

// A level from the one below it.
void write_level(const fs::path& folder, int level, Progress& progress) {
  const DatasetPointer below = open_level(level_file(folder, level - 1));
  if (below == nullptr) throw damaged(folder, fmt::format("level {} cannot be read back", level - 1));
  const int width = below->GetRasterXSize(), depth = below->GetRasterYSize();
  const Cells cells = cells_of(*below);
  GeotiffRows writer(level_file(folder, level), halved(width), halved(depth), 2 * cells.x, 2 * cells.z);
  progress.begin(fmt::format("thinning to level {}", level), (halved(depth) - 1) / kGeotiffTile + 1);
  std::vector<float> rows, kept;
  for (int b = 0; b < halved(depth); b += kGeotiffTile) {
    const int count = std::min(kGeotiffTile, halved(depth) - b);
    // For an even depth the last row kept is the ground's last, which the row before may be too.
    const int last = depth - 1, first = std::min(2 * b, last);
    const int read = std::min(2 * (b + count - 1), last) - first + 1;
    rows.resize(static_cast<std::size_t>(width) * read);
    if (below->GetRasterBand(1)->RasterIO(GF_Read, 0, first, width, read, rows.data(), width, read,
                                          GDT_Float32, 0, 0, nullptr) != CE_None) {
      throw damaged(folder, fmt::format("level {} cannot be read back", level - 1));
    }
    kept.clear();
    for (int j = 0; j < count; ++j) {
      const float* const row = &rows[static_cast<std::size_t>(std::min(2 * (b + j), last) - first) * width];
      for (int a = 0; a < halved(width); ++a) kept.push_back(row[std::min(2 * a, width - 1)]);
    }
    writer.write(kept);
    progress.advance();
  }
  writer.close();
}

// Tiles that a read of these samples must decode, because GDAL's cache does not hold them.
std::uint64_t tiles_missing(GDALRasterBand& band, int x0, int z0, int x1, int z1) {
  std::uint64_t missing = 0;
  for (int z = z0 / kGeotiffTile; z <= z1 / kGeotiffTile; ++z) {
    for (int x = x0 / kGeotiffTile; x <= x1 / kGeotiffTile; ++x) {
      GDALRasterBlock* const block = band.TryGetLockedBlockRef(x, z);
      if (block == nullptr) {
        ++missing;
      } else {
        block->DropLock();
      }
    }
  }
  return missing;
}

// Whether nothing but a pyramid would be lost with the folder.
bool is_pyramid_alone(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(fs::symlink_status(folder, error))) return false;
  const auto entries = std::distance(fs::directory_iterator(folder, error), fs::directory_iterator());
  try {
    return !error && HeightPyramid::open(folder)->levels() == entries;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

struct HeightPyramid::Levels {
  fs::path folder;
  std::vector<DatasetPointer> datasets;
  float cell_x = 1, cell_z = 1;
  std::vector<float> block;  // samples read from disk, before the borders are repeated
  std::uint64_t tiles_read = 0;
};

void HeightPyramid::build(const std::string& dem, const fs::path& folder, Progress& progress) {
  register_gdal();
  std::error_code error;
  if (fs::exists(fs::symlink_status(folder, error)) && !is_pyramid_alone(folder)) {
    throw usage_error("exists, and is not a whole pyramid with nothing beside it", folder.string(),
                      "choose another folder, or remove this one");
  }
  const RasterSize size = raster_size(dem);
  const fs::path temporary = temporary_name(folder);
  struct Remove {
    const fs::path& path;
    ~Remove() {
      std::error_code ignored;
      fs::remove_all(path, ignored);
    }
  } remove{temporary};
  fs::create_directories(temporary, error);
  if (error) throw cannot_write(temporary, error.message());
  write_ground(dem, size, temporary, progress);
  int level = 0;
  for (int longest = std::max(size.width, size.depth); longest > kCoarsest; longest = halved(longest)) {
    write_level(temporary, ++level, progress);
  }
  progress.end();
  fs::remove_all(folder, error);
  fs::rename(temporary, folder, error);
  if (error) throw cannot_write(folder, error.message());
}

std::unique_ptr<HeightPyramid> HeightPyramid::open(const fs::path& folder) {
  register_gdal();
  auto levels = std::make_unique<Levels>();
  levels->folder = folder;
  for (int level = 0;; ++level) {
    DatasetPointer dataset = open_level(level_file(folder, level));
    if (!is_level(dataset.get())) {
      throw damaged(folder, fmt::format("level {} is missing or cannot be read", level));
    }
    const int width = dataset->GetRasterXSize(), depth = dataset->GetRasterYSize();
    if (level == 0) {
      const Cells cells = cells_of(*dataset);
      if (!(cells.x > 0 && cells.z > 0 && std::isfinite(cells.x) && std::isfinite(cells.z)))
        throw damaged(folder, "the size of its cells is not there");
      levels->cell_x = cells.x;
      levels->cell_z = cells.z;
    } else {
      const DatasetPointer& below = levels->datasets.back();
      if (width != halved(below->GetRasterXSize()) || depth != halved(below->GetRasterYSize())) {
        throw damaged(folder, fmt::format("level {} does not fit the one below", level));
      }
    }
    levels->datasets.push_back(std::move(dataset));
    if (std::max(width, depth) <= kCoarsest) break;
  }
  return std::unique_ptr<HeightPyramid>(new HeightPyramid(std::move(levels)));
}

HeightPyramid::HeightPyramid(std::unique_ptr<Levels> levels) : levels_(std::move(levels)) {}
HeightPyramid::~HeightPyramid() = default;

int HeightPyramid::width() const { return levels_->datasets.front()->GetRasterXSize(); }
int HeightPyramid::depth() const { return levels_->datasets.front()->GetRasterYSize(); }
int HeightPyramid::levels() const { return static_cast<int>(levels_->datasets.size()); }
float HeightPyramid::cell_x() const { return levels_->cell_x; }
float HeightPyramid::cell_z() const { return levels_->cell_z; }
std::uint64_t HeightPyramid::tiles_read() const { return levels_->tiles_read; }
std::size_t HeightPyramid::bytes() const {
  return heap_bytes(this) + heap_bytes(levels_.get()) + heap_bytes(levels_->datasets.data()) +
         heap_bytes(levels_->block.data());
}

void HeightPyramid::read(int level, int a, int b, int columns, int rows, float* out, int stride) {
  const int kept = std::min(level, static_cast<int>(levels_->datasets.size()) - 1);
  const std::int64_t step = std::int64_t{1} << std::min(level - kept, 30);
  GDALDataset& dataset = *levels_->datasets[kept];
  // In the kept level's lattice, inside it.
  const auto inside = [&](std::int64_t at, int samples) {
    return static_cast<int>(std::clamp<std::int64_t>(at * step, 0, samples - 1));
  };
  const int width = dataset.GetRasterXSize(), depth = dataset.GetRasterYSize();
  const int x0 = inside(a, width), x1 = inside(std::int64_t{a} + columns - 1, width);
  const int z0 = inside(b, depth), z1 = inside(std::int64_t{b} + rows - 1, depth);
  const int w = x1 - x0 + 1, h = z1 - z0 + 1;
  levels_->block.resize(static_cast<std::size_t>(w) * h);
  levels_->tiles_read += tiles_missing(*dataset.GetRasterBand(1), x0, z0, x1, z1);
  const GdalMessages messages;
  if (dataset.GetRasterBand(1)->RasterIO(GF_Read, x0, z0, w, h, levels_->block.data(), w, h, GDT_Float32, 0,
                                         0, nullptr) != CE_None) {
    throw damaged(levels_->folder, fmt::format("level {}: {}", kept, messages.first_failure()));
  }
  for (int j = 0; j < rows; ++j, out += stride) {
    const float* const row =
        &levels_->block[static_cast<std::size_t>(inside(std::int64_t{b} + j, depth) - z0) * w];
    for (int i = 0; i < columns; ++i) out[i] = row[inside(std::int64_t{a} + i, width) - x0];
  }
}

}  // namespace terrabench
