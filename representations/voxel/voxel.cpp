#include "representations/voxel/voxel.h"

#include <openvdb/tools/Prune.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <set>

#include "representations/coding/column_codec.h"
#include "representations/runs.h"
#include "representations/voxel/block.h"
#include "terrain/error.h"

namespace terrabench {
namespace {

using Tree = openvdb::MaskTree;
using Leaf = VoxelLeaf;
using Coord = openvdb::Coord;
// Reads without a lock and without registering with the tree: for trees that are not edited meanwhile.
using Reader = openvdb::tree::ValueAccessor<const Tree, false>;
constexpr int kLeaf = kLeafSide;
// The side, in voxels, of a tile at each depth: root and both inner levels. Depth -1 stands for no node.
constexpr int kTileSize[] = {4096, 128, 8};

// Calls solid(bottom, top) for the stretches of one column, upward; neighbouring calls may touch.
template <class Visit>
void for_each_stretch(const Reader& reader, int i, int j, int levels, const Visit& solid) {
  for (int level = 0; level < levels;) {
    if (const Leaf* leaf = reader.probeConstLeaf(voxel_at(i, j, level))) {
      const auto byte = leaf->getValueMask().getWord<std::uint8_t>((i % kLeaf) * kLeaf + j % kLeaf);
      for (int bit = 0; bit < kLeaf;) {
        const auto rest = static_cast<std::uint8_t>(byte >> bit);
        if (rest == 0) break;
        const int bottom = bit + std::countr_zero(rest);
        bit = bottom + std::countr_one(static_cast<std::uint8_t>(byte >> bottom));
        solid(level + bottom, level + bit);
      }
      level += kLeaf;
    } else {
      const int size = kTileSize[std::max(0, reader.getValueDepth(voxel_at(i, j, level)))];
      const int top = std::min((level / size + 1) * size, levels);
      if (reader.isValueOn(voxel_at(i, j, level))) solid(level, top);
      level = top;
    }
  }
}

// The size that the allocator gives a block of so many bytes.
std::size_t block_bytes(std::size_t size) {
  const std::unique_ptr<std::byte[]> probe = std::make_unique_for_overwrite<std::byte[]>(size);
  return heap_bytes(probe.get());
}

// The node that std::map allocates for a child of the root: the tree's links and colour, then key and value
// (RootNode::NodeStruct is private: a pointer, and a tile of two bools).
struct RootEntry {
  void* links[4];
  Coord key;
  void* child;
  bool tile[2];
};

template <class Node>
void count_node(const Node& node, Memory& memory) {
  if constexpr (Node::LEVEL == 0) {
    memory.payload += sizeof node;
  } else {
    memory.index += sizeof node;
    for (auto child = node.cbeginChildOn(); child; ++child) count_node(*child, memory);
  }
  memory.slack += heap_bytes(&node) - sizeof node;
}

Memory tree_memory(const Tree& tree) {
  const std::size_t entries = tree.root().getTableSize();
  const std::size_t entry = entries == 0 ? 0 : block_bytes(sizeof(RootEntry));
  Memory memory{0, heap_bytes(&tree) + entries * sizeof(RootEntry),
                entries * (entry - std::min(entry, sizeof(RootEntry)))};
  for (auto child = tree.root().cbeginChildOn(); child; ++child) count_node(*child, memory);
  return memory;
}

bool inside(const ColumnGrid& grid, const openvdb::CoordBBox& box) {
  return box.min().x() >= 0 && box.min().y() >= 0 && box.min().z() >= 0 && box.max().x() < grid.width &&
         box.max().y() < grid.depth && box.max().z() < grid.levels;
}

}  // namespace

struct Voxel::Layers {
  struct Layer {
    Material material;
    std::unique_ptr<Tree> tree;
  };
  std::vector<Layer> layers;
  std::size_t edits_since_prune = 0;
  std::size_t known_leaves = 0;  // when they were last counted

  Tree& of(Material material) {
    for (Layer& layer : layers) {
      if (layer.material == material) return *layer.tree;
    }
    return *layers.emplace_back(Layer{material, std::make_unique<Tree>(false)}).tree;
  }
  void prune() {
    for (Layer& layer : layers) openvdb::tools::prune(*layer.tree);
    edits_since_prune = 0;
  }
  // Pruning and counting walk all leaves. After at least as many edits as there are leaves, their cost per
  // edit is constant.
  void prune_if_due() {
    if (edits_since_prune <= known_leaves) return;
    count_leaves();
    if (edits_since_prune <= known_leaves) return;
    prune();
    count_leaves();
  }
  void count_leaves() {
    known_leaves = 0;
    for (const Layer& layer : layers) known_leaves += layer.tree->leafCount();
  }
};

Voxel::Voxel(const ColumnGrid& grid) : grid_(grid), layers_(std::make_unique<Layers>()) {}
Voxel::~Voxel() = default;

// The blocks are sampled in parallel and added to the trees in order: cheaper than merging one tree
// per thread, and the same tree for any number of threads.
std::unique_ptr<Representation> Voxel::build(const TerrainSource& source, const Parameters& parameters,
                                             Progress& progress) {
  const ColumnSampler sampler(source, parameters, kVoxelLevels);
  std::unique_ptr<Voxel> built(new Voxel(sampler.grid()));
  const ColumnGrid& grid = built->grid_;
  const int blocks_x = (grid.width + kLeaf - 1) / kLeaf, blocks_z = (grid.depth + kLeaf - 1) / kLeaf;
  tbb::enumerable_thread_specific<std::vector<Material>> samples;
  progress.begin("voxel", static_cast<std::uint64_t>(blocks_x) * static_cast<std::uint64_t>(blocks_z));
  constexpr int kBatch = 64;  // rows of blocks held beside the tree
  std::vector<std::map<Material, VoxelBlock>> blocks;
  for (int first = 0; first < blocks_z; first += kBatch) {
    const int rows = std::min(kBatch, blocks_z - first);
    blocks.clear();
    blocks.resize(static_cast<std::size_t>(rows) * blocks_x);
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
      const int i0 = static_cast<int>(b % blocks_x) * kLeaf;
      const int j0 = (first + static_cast<int>(b / blocks_x)) * kLeaf;
      blocks[b] = sample_block(sampler, i0, j0, samples.local());
      progress.advance();
    });
    for (auto& of_materials : blocks) {
      for (auto& [material, block] : of_materials) {
        Tree& tree = built->layers_->of(material);
        for (auto& leaf : block.leaves) tree.addLeaf(leaf.release());
        for (const Coord& origin : block.full) tree.addTile(1, origin, true, true);
      }
    }
  }
  built->layers_->prune();
  built->layers_->count_leaves();
  return built;
}

void Voxel::spans(Columns where, SpanSink& out) const {
  const ColumnLookup lookup(grid_);
  std::vector<Reader> readers;
  for (const auto& layer : layers_->layers) readers.emplace_back(*layer.tree);
  std::vector<Run> runs;
  for (std::size_t c = 0; c < where.size(); ++c) {
    runs.clear();
    int i, j;
    const bool found = lookup.column(where.x[c], where.z[c], i, j);
    for (std::size_t l = 0; found && l < readers.size(); ++l) {
      const std::size_t first = runs.size();
      for_each_stretch(readers[l], i, j, grid_.levels, [&](int bottom, int top) {
        if (runs.size() > first && runs.back().top == bottom) {
          runs.back().top = static_cast<std::uint16_t>(top);
        } else {
          runs.push_back({static_cast<std::uint16_t>(bottom), static_cast<std::uint16_t>(top),
                          layers_->layers[l].material});
        }
      });
    }
    if (readers.size() > 1) {
      std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.bottom < b.bottom; });
    }
    for (const Run& run : runs) out.add({grid_.edge_y(run.bottom), grid_.edge_y(run.top), run.material});
    out.end_column();
  }
}

void Voxel::materials(Points where, std::span<Material> out) const {
  const ColumnLookup lookup(grid_);
  std::vector<Reader> readers;
  for (const auto& layer : layers_->layers) readers.emplace_back(*layer.tree);
  for (std::size_t p = 0; p < where.size(); ++p) {
    out[p] = Material::kAir;
    int i, j;
    const int level = lookup.level(where.y[p]);
    if (level < 0 || !lookup.column(where.x[p], where.z[p], i, j)) continue;
    for (std::size_t l = 0; l < readers.size(); ++l) {
      if (readers[l].isValueOn(voxel_at(i, j, level))) out[p] = layers_->layers[l].material;
    }
  }
}

void Voxel::edit(Columns where, std::span<const Span> what) {
  check_edit(where, what);
  const ColumnLookup lookup(grid_);
  for (std::size_t c = 0; c < where.size(); ++c) {
    int i, j;
    const LevelRange levels = grid_.quantise(what[c].bottom, what[c].top);
    if (levels.begin >= levels.end || !lookup.column(where.x[c], where.z[c], i, j)) continue;
    const openvdb::CoordBBox box(voxel_at(i, j, levels.begin), voxel_at(i, j, levels.end - 1));
    for (auto& layer : layers_->layers) {
      if (layer.material != what[c].material) layer.tree->fill(box, false, false);
    }
    if (what[c].material != Material::kAir) layers_->of(what[c].material).fill(box, true, true);
    ++layers_->edits_since_prune;
  }
  layers_->prune_if_due();
}

TriangleMesh Voxel::mesh(MeshDetail) const {
  TriangleMesh mesh;
  if (layers_->layers.empty()) return mesh;
  const Tree::Ptr all = std::make_shared<Tree>(*layers_->layers.front().tree);
  for (std::size_t l = 1; l < layers_->layers.size(); ++l) all->topologyUnion(*layers_->layers[l].tree);
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  std::vector<openvdb::Vec4I> quads;
  // Between on and off; otherwise the surface would pass through the outer centres.
  constexpr double kHalfway = 0.5;
  openvdb::tools::volumeToMesh(*openvdb::MaskGrid::create(all), points, triangles, quads, kHalfway);
  mesh.positions.reserve(points.size());
  for (const openvdb::Vec3s& p : points) {  // a voxel's centre has whole coordinates
    mesh.positions.emplace_back(static_cast<float>(grid_.origin_x + (p.x() + 0.5) * grid_.cell_x),
                                static_cast<float>(grid_.origin_y + (p.z() + 0.5) * grid_.step),
                                static_cast<float>(grid_.origin_z + (p.y() + 0.5) * grid_.cell_z));
  }
  // OpenVDB's faces run clockwise seen from outside; exchanging two axes mirrors them, so that the order is
  // right.
  mesh.indices.reserve(quads.size() * 6 + triangles.size() * 3);
  const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.indices.insert(mesh.indices.end(), {a, b, c});
  };
  for (const openvdb::Vec4I& q : quads) {
    triangle(q[0], q[1], q[2]);
    triangle(q[0], q[2], q[3]);
  }
  for (const openvdb::Vec3I& t : triangles) triangle(t[0], t[1], t[2]);
  return mesh;
}

Memory Voxel::memory() const {
  const std::size_t table = layers_->layers.size() * sizeof(Layers::Layer);
  Memory memory{0, heap_bytes(this) + heap_bytes(layers_.get()) + table,
                heap_bytes(layers_->layers.data()) - table};
  for (const auto& layer : layers_->layers) memory += tree_memory(*layer.tree);
  return memory;
}

void Voxel::save(ByteSink& out) const {
  grid_.save(out);
  out.put(static_cast<std::uint32_t>(layers_->layers.size()));
  for (const auto& layer : layers_->layers) {
    out.put(layer.material);
    ByteSink tiles;
    std::uint64_t count = 0;
    auto tile = layer.tree->cbeginValueOn();
    for (tile.setMaxDepth(Tree::ValueOnCIter::LEAF_DEPTH - 1); tile; ++tile, ++count) {
      const openvdb::CoordBBox box = tile.getBoundingBox();
      tiles.put(box.min());
      tiles.put(static_cast<std::uint8_t>(tile.getLevel()));
    }
    out.put(count);
    out.put_array(tiles.bytes());
    out.put(static_cast<std::uint64_t>(layer.tree->leafCount()));
    for (auto leaf = layer.tree->cbeginLeaf(); leaf; ++leaf) {
      out.put(leaf->origin());
      for (unsigned x = 0; x < kLeaf; ++x) out.put(leaf->getValueMask().getWord<openvdb::Index64>(x));
    }
  }
}

namespace {

// Inner nodes are large: a few distant leaves in a small damaged file could need any amount of memory. Sums
// the nodes before they are allocated.
class NodeBudget {
 public:
  void add(const Coord& origin, ByteSource& in) {
    if (large_.emplace(origin & ~4095).second) bytes_ += sizeof(Tree::RootNodeType::ChildNodeType);
    if (small_.emplace(origin & ~127).second)
      bytes_ += sizeof(Tree::RootNodeType::ChildNodeType::ChildNodeType);
    if (bytes_ > available_memory_) in.fail("the voxels are spread over more nodes than fit the memory");
  }

 private:
  std::set<Coord> large_, small_;
  std::size_t bytes_ = 0, available_memory_ = available_memory();
};

void load_tree(ByteSource& in, const ColumnGrid& grid, Tree& tree) {
  NodeBudget budget;
  for (auto tiles = in.get<std::uint64_t>(); tiles > 0; --tiles) {
    const auto origin = in.get<std::array<std::int32_t, 3>>();
    const auto level = in.get<std::uint8_t>();
    const Coord corner(origin.data());
    if (level < 1 || level > 3) in.fail("a tile has an impossible size");
    const int size = kTileSize[3 - level];
    if (!inside(grid, openvdb::CoordBBox::createCube(corner, size)) || (corner & ~(size - 1)) != corner) {
      in.fail("a tile lies outside the grid");
    }
    budget.add(corner, in);
    tree.addTile(level, corner, true, true);
  }
  for (auto leaves = in.get<std::uint64_t>(); leaves > 0; --leaves) {
    const auto origin = in.get<std::array<std::int32_t, 3>>();
    const Coord corner(origin.data());
    const auto words = in.get<std::array<std::uint64_t, kLeaf>>();
    if ((corner & ~(kLeaf - 1)) != corner || corner.x() < 0 || corner.y() < 0 || corner.z() < 0) {
      in.fail("a leaf lies outside the grid");
    }
    budget.add(corner, in);
    auto leaf = std::make_unique<Leaf>(corner);
    for (unsigned x = 0; x < kLeaf; ++x) leaf->getValueMask().getWord<openvdb::Index64>(x) = words[x];
    for (auto on = leaf->cbeginValueOn(); on; ++on) {
      if (!inside(grid, openvdb::CoordBBox(on.getCoord(), on.getCoord())))
        in.fail("a voxel lies outside the grid");
    }
    tree.addLeaf(leaf.release());
  }
}

}  // namespace

std::unique_ptr<Representation> Voxel::load(ByteSource& in) {
  std::unique_ptr<Voxel> built(new Voxel(ColumnGrid::load(in)));
  Tree all(false);
  const auto layers = in.get<std::uint32_t>();
  for (std::uint32_t l = 0; l < layers; ++l) {
    const auto material = in.get<Material>();
    Tree& tree = built->layers_->of(material);
    if (material == Material::kAir || built->layers_->layers.size() != l + 1)
      in.fail("a material is repeated, or is air");
    load_tree(in, built->grid_, tree);
    if (layers == 1) break;
    const auto voxels = all.activeVoxelCount();
    all.topologyUnion(tree);
    if (all.activeVoxelCount() != voxels + tree.activeVoxelCount())
      in.fail("two materials fill the same voxel");
  }
  built->layers_->count_leaves();
  return built;
}

std::unique_ptr<Representation> Voxel::decode(ByteSource& in) {
  ColumnGrid grid;
  const ColumnsOfRuns columns = decode_columns(in, grid);
  std::unique_ptr<Voxel> built(new Voxel(grid));
  fill(*built, grid, columns);
  return built;
}

}  // namespace terrabench
