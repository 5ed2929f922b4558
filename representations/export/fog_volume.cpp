#include "representations/export/fog_volume.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Prune.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <utility>

#include "terrain/error.h"
#include "terrain/files.h"
#include "terrain/memory.h"

namespace terrabench {
namespace {

using openvdb::Coord;
using openvdb::FloatTree;
using openvdb::Int32Tree;
constexpr int kLeaf = 8, kCells = kLeaf * kLeaf * kLeaf;
static_assert(FloatTree::LeafNodeType::SIZE == kCells);

// Where a cell of an 8³ block lies in OpenVDB's leaves.
constexpr std::size_t offset(int x, int y, int z) {
  return (static_cast<std::size_t>(x) * kLeaf + static_cast<std::size_t>(y)) * kLeaf +
         static_cast<std::size_t>(z);
}

// The part of a grid over 8 × 8 columns: leaves, and blocks that have one value throughout.
template <class Tree>
struct Part {
  using Leaf = typename Tree::LeafNodeType;
  using Value = typename Tree::ValueType;
  std::vector<std::unique_ptr<Leaf>> leaves;
  std::vector<std::pair<Coord, Value>> tiles;

  // Cells of value 0 are inactive.
  void add(const Coord& origin, std::span<const Value, kCells> values) {
    const Value first = values[0];
    if (std::ranges::all_of(values, [&](Value value) { return value == first; })) {
      if (first != Value(0)) tiles.emplace_back(origin, first);
      return;
    }
    auto leaf = std::make_unique<Leaf>(origin, Value(0));
    for (std::size_t cell = 0; cell < kCells; ++cell) {
      if (values[cell] != Value(0)) leaf->setValueOn(static_cast<openvdb::Index>(cell), values[cell]);
    }
    leaves.push_back(std::move(leaf));
  }
  void move_to(Tree& tree) {
    for (auto& leaf : leaves) tree.addLeaf(leaf.release());
    for (const auto& [origin, value] : tiles) tree.addTile(1, origin, value, true);
  }
};

struct Block {
  Part<FloatTree> density;
  Part<Int32Tree> material;
};

class Sampler {
 public:
  Sampler(const Representation& built, const ColumnGrid& grid) : built_(built), grid_(grid) {}

  Block sample(int i0, int j0) const {
    const int width = std::min(kLeaf, grid_.width - i0), depth = std::min(kLeaf, grid_.depth - j0);
    std::vector<float> x, z;
    for (int j = 0; j < depth; ++j) {
      for (int i = 0; i < width; ++i) {
        x.push_back(grid_.centre_x(i0 + i));
        z.push_back(grid_.centre_z(j0 + j));
      }
    }
    SpanSink sink;
    built_.spans({x, z}, sink);
    const auto leaves = static_cast<std::size_t>((grid_.levels + kLeaf - 1) / kLeaf);
    std::vector<float> density(leaves * kCells), largest(leaves * kCells);
    std::vector<std::int32_t> material(leaves * kCells);
    for (std::size_t c = 0; c < sink.columns(); ++c) {
      const int i = static_cast<int>(c) % width, j = static_cast<int>(c) / width;
      for (const Span& span : sink.column(c)) {
        each_cell(span, [&](int level, float share) {
          const std::size_t cell =
              static_cast<std::size_t>(level / kLeaf) * kCells + offset(i, level % kLeaf, j);
          density[cell] = std::min(1.0F, density[cell] + share);
          if (share <= largest[cell]) return;
          largest[cell] = share;
          material[cell] = span.material == Material::kBedrock ? 0 : static_cast<std::int32_t>(span.material);
        });
      }
    }
    Block block;
    for (std::size_t leaf = 0; leaf < leaves; ++leaf) {
      const Coord origin(i0, static_cast<int>(leaf) * kLeaf, j0);
      block.density.add(origin, std::span(density).subspan(leaf * kCells).first<kCells>());
      block.material.add(origin, std::span(material).subspan(leaf * kCells).first<kCells>());
    }
    return block;
  }

 private:
  // In levels above the floor; a whole number for what lies between two levels of the lattice.
  double level_of(float y) const {
    const double level = (y - grid_.origin_y) / grid_.step, nearest = std::round(level);
    return grid_.edge_y(static_cast<int>(nearest)) == y ? nearest : level;
  }
  // Calls visit(level, share of the cell's height) upward.
  template <class Visit>
  void each_cell(const Span& span, const Visit& visit) const {
    const double bottom = std::max(0.0, level_of(span.bottom)),
                 top = std::min(static_cast<double>(grid_.levels), level_of(span.top));
    for (int level = static_cast<int>(bottom); level < top; ++level) {
      const double share = std::min(top, level + 1.0) - std::max(bottom, static_cast<double>(level));
      if (share > 0) visit(level, static_cast<float>(share));
    }
  }

  const Representation& built_;
  const ColumnGrid& grid_;
};

// Parallel over the blocks of some rows, whose parts are then added in order.
void fill(const Representation& built, const ColumnGrid& grid, FloatTree& density, Int32Tree& material,
          Progress& progress) {
  const Sampler sampler(built, grid);
  const int blocks_x = (grid.width + kLeaf - 1) / kLeaf, blocks_z = (grid.depth + kLeaf - 1) / kLeaf;
  constexpr int kBatch = 8;  // rows of blocks held beside the trees
  std::vector<Block> blocks;
  for (int first = 0; first < blocks_z; first += kBatch) {
    blocks.clear();
    blocks.resize(static_cast<std::size_t>(std::min(kBatch, blocks_z - first)) *
                  static_cast<std::size_t>(blocks_x));
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
      blocks[b] = sampler.sample(static_cast<int>(b) % blocks_x * kLeaf,
                                 (first + static_cast<int>(b) / blocks_x) * kLeaf);
      progress.advance();
    });
    std::size_t leaves = 0;
    for (Block& block : blocks) {
      leaves += block.density.leaves.size();
      block.density.move_to(density);
      block.material.move_to(material);
    }
    // The next batch will need about as much as this one.
    require_memory(leaves * sizeof(FloatTree::LeafNodeType) * 2, "the volume");
  }
  openvdb::tools::prune(density);
  openvdb::tools::prune(material);
}

openvdb::math::Transform::Ptr transform_of(const ColumnGrid& grid) {
  openvdb::Mat4R matrix = openvdb::Mat4R::identity();
  matrix[0][0] = grid.cell_x;
  matrix[1][1] = grid.step;
  matrix[2][2] = grid.cell_z;
  matrix.setTranslation({grid.origin_x + 0.5 * grid.cell_x, grid.origin_y + 0.5 * grid.step,
                         grid.origin_z + 0.5 * grid.cell_z});
  return openvdb::math::Transform::createLinearTransform(matrix);
}

openvdb::MetaMap metadata(const ColumnGrid& columns, const Georeference& place) {
  openvdb::MetaMap meta;
  meta.insertMeta("columns", openvdb::Vec2IMetadata({columns.width, columns.depth}));
  meta.insertMeta("units", openvdb::StringMetadata("metres: x east, y up, z south"));
  if (place.transform != std::array<double, 6>{}) {
    meta.insertMeta("georeference",
                    openvdb::StringMetadata(fmt::format("{}", fmt::join(place.transform, " "))));
  }
  if (!place.crs.empty()) meta.insertMeta("crs", openvdb::StringMetadata(place.crs));
  return meta;
}

Georeference georeference_of(const openvdb::MetaMap& meta) {
  Georeference place;
  const auto text = meta.getMetadata<openvdb::StringMetadata>("georeference"),
             crs = meta.getMetadata<openvdb::StringMetadata>("crs");
  if (text) {
    std::istringstream numbers(text->value());
    for (double& number : place.transform) numbers >> number;
  }
  if (crs) place.crs = crs->value();
  return place;
}

// As io::File, which does not notice a full disk.
class Archive : private openvdb::io::Archive {
 public:
  void write_to(const std::filesystem::path& temporary, const std::filesystem::path& path,
                const openvdb::GridCPtrVec& grids, const openvdb::MetaMap& meta) const {
    std::ofstream out(temporary, std::ios::binary);
    std::string why;
    try {
      write(out, grids, true, meta);
    } catch (const openvdb::Exception& error) {
      why = fmt::format(": {}", error.what());
    }
    out.close();
    if (out && why.empty()) return;
    throw environment_error("cannot write the volume" + why, path.string(),
                            "check the folder's permissions and the space left on its disk");
  }
};

}  // namespace

void write_fog(const std::filesystem::path& path, const Representation& built, const LineGrid& lines,
               Progress& progress) {
  openvdb::initialize();
  NewFile file(path);
  const ColumnGrid* const own = built.column_grid();
  const ColumnGrid columns = own != nullptr ? *own : columns_around(lines, built.bounds());
  const auto density = openvdb::FloatGrid::create(0.0F);
  const auto material = openvdb::Int32Grid::create(0);
  progress.begin("sampling the volume", static_cast<std::uint64_t>((columns.width + kLeaf - 1) / kLeaf) *
                                            static_cast<std::uint64_t>((columns.depth + kLeaf - 1) / kLeaf));
  fill(built, columns, density->tree(), material->tree(), progress);
  progress.end();
  density->setName("density");
  density->setGridClass(openvdb::GRID_FOG_VOLUME);
  material->setName("material");
  openvdb::GridCPtrVec grids;
  for (const openvdb::GridBase::Ptr& grid :
       {openvdb::GridBase::Ptr(density), openvdb::GridBase::Ptr(material)}) {
    if (grid == material && material->empty()) continue;
    grid->setTransform(transform_of(columns));
    grid->setCreator("terrabench");
    grids.push_back(grid);
  }
  Archive().write_to(file.temporary(), path, grids, metadata(columns, place(lines_of(columns), lines)));
  file.keep();
}

Heightfield read_fog_heights(const std::filesystem::path& path) {
  openvdb::initialize();
  openvdb::FloatGrid::Ptr density;
  Heightfield field;
  try {
    openvdb::io::File file(path.string());
    file.setCopyMaxBytes(0);  // otherwise a small file is copied into the temporary folder first
    file.open();
    density = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("density"));
    const auto columns = file.getMetadata()->metaValue<openvdb::Vec2i>("columns");
    field = Heightfield::zeros(columns.x(), columns.y(), static_cast<float>(density->voxelSize().x()),
                               static_cast<float>(density->voxelSize().z()));
    field.georeference = georeference_of(*file.getMetadata());
  } catch (const std::exception& error) {
    throw bad_input(fmt::format("OpenVDB cannot read it: {}", error.what()), path.string(),
                    "give a file that `terrabench represent --save NAME.vdb` wrote");
  }
  std::vector<double> levels(field.heights.size(), -1);  // of the surface, above the floor
  for (auto value = std::as_const(*density).cbeginValueOn(); value; ++value) {
    const openvdb::CoordBBox cells = value.getBoundingBox();
    const double top = cells.max().y() + static_cast<double>(*value);
    for (int j = cells.min().z(); j <= cells.max().z(); ++j) {
      double* const row = levels.data() + static_cast<std::ptrdiff_t>(j) * field.width;
      for (int i = cells.min().x(); i <= cells.max().x(); ++i) row[i] = std::max(row[i], top);
    }
  }
  const double cell = density->voxelSize().y(),
               floor = density->indexToWorld(Coord(0, 0, 0)).y() - 0.5 * cell;
  for (std::size_t c = 0; c < levels.size(); ++c) {
    field.heights[c] = levels[c] < 0 ? Heightfield::kNoData : static_cast<float>(floor + levels[c] * cell);
  }
  return field;
}

}  // namespace terrabench
