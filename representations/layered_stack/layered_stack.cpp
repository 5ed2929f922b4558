#include "representations/layered_stack/layered_stack.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "representations/block_mesh.h"
#include "representations/coding/column_codec.h"
#include "representations/layered_stack/tile.h"

namespace terrabench {

Memory StackTile::memory() const {
  const std::size_t index = (columns_ + 1U) * start_bytes();
  return {used_bytes() - index, index, heap_bytes(block_.get()) - used_bytes()};
}

bool StackTile::operator==(const StackTile& other) const {
  return columns_ == other.columns_ && runs_ == other.runs_ &&
         std::memcmp(block_.get(), other.block_.get(), used_bytes()) == 0;
}

void TileBuilder::add(const StackTile& tile, std::size_t first, std::size_t end) {
  const std::size_t begin_run = tile.start(first), end_run = tile.start(end), begin = tops_.size();
  for (std::size_t slot = first; slot < end; ++slot) {
    starts_.push_back(static_cast<std::uint32_t>(begin + tile.start(slot + 1) - begin_run));
  }
  tops_.insert(tops_.end(), tile.tops() + begin_run, tile.tops() + end_run);
  materials_.insert(materials_.end(), tile.materials() + begin_run, tile.materials() + end_run);
}

StackTile TileBuilder::finish() const {
  StackTile tile;
  tile.runs_ = static_cast<std::uint32_t>(tops_.size());
  tile.columns_ = static_cast<std::uint16_t>(starts_.size() - 1);
  tile.wide_ = tops_.size() > std::numeric_limits<std::uint16_t>::max();
  tile.block_ = std::make_unique_for_overwrite<std::byte[]>(tile.used_bytes());
  std::byte* out = tile.block_.get();
  if (tile.wide_) {
    std::copy(starts_.begin(), starts_.end(), reinterpret_cast<std::uint32_t*>(out));
  } else {
    std::transform(starts_.begin(), starts_.end(), reinterpret_cast<std::uint16_t*>(out),
                   [](std::uint32_t start) { return static_cast<std::uint16_t>(start); });
  }
  out += starts_.size() * tile.start_bytes();
  std::copy(tops_.begin(), tops_.end(), reinterpret_cast<std::uint16_t*>(out));
  std::copy(materials_.begin(), materials_.end(),
            reinterpret_cast<Material*>(out + tops_.size() * sizeof tops_[0]));
  return tile;
}

LayeredStack::LayeredStack(const ColumnGrid& grid) : grid_(grid) {
  constexpr int kSide = StackTile::kSide;
  tiles_x_ = (grid.width + kSide - 1) / kSide;
  last_tile_width_ = grid.width - (tiles_x_ - 1) * kSide;
  tiles_ = std::vector<StackTile>(static_cast<std::size_t>(tiles_x_) * ((grid.depth + kSide - 1) / kSide));
}

// Calls column_of(i, j, builder) for each column of the tile, in slot order.
template <class ColumnOf>
StackTile LayeredStack::make_tile(std::size_t tile, TileBuilder& builder, const ColumnOf& column_of) const {
  constexpr int kSide = StackTile::kSide;
  const int i0 = static_cast<int>(tile % tiles_x_) * kSide, j0 = static_cast<int>(tile / tiles_x_) * kSide;
  builder.begin();
  for (int j = j0; j < std::min(j0 + kSide, grid_.depth); ++j) {
    for (int i = i0; i < std::min(i0 + kSide, grid_.width); ++i) column_of(i, j, builder);
  }
  return builder.finish();
}

std::unique_ptr<LayeredStack> LayeredStack::build_stack(const TerrainSource& source,
                                                        const Parameters& parameters, Progress& progress) {
  const ColumnSampler sampler(source, parameters, ColumnGrid::kMaxLevels);
  const ColumnGrid& grid = sampler.grid();
  require_memory(grid.columns() * 5, "layered_stack");  // at least a start and one run per column
  std::unique_ptr<LayeredStack> stack(new LayeredStack(grid));
  struct Scratch {
    std::vector<Material> samples;
    RunList runs;
    TileBuilder builder;
  };
  tbb::enumerable_thread_specific<Scratch> scratches;
  progress.begin("layered_stack", stack->tiles_.size());
  tbb::parallel_for(std::size_t{0}, stack->tiles_.size(), [&](std::size_t t) {
    Scratch& scratch = scratches.local();
    stack->tiles_[t] = stack->make_tile(t, scratch.builder, [&](int i, int j, TileBuilder& builder) {
      if (sampler.from_heights()) {
        scratch.runs.clear();
        scratch.runs.add(sampler.top(i, j), Material::kBedrock);
      } else {
        scratch.samples.resize(static_cast<std::size_t>(grid.levels));
        sampler.sample(i, j, scratch.samples);
        scratch.runs.encode(scratch.samples);
      }
      builder.add(scratch.runs.runs());
    });
    progress.advance();
  });
  return stack;
}

std::unique_ptr<Representation> LayeredStack::build(const TerrainSource& source, const Parameters& parameters,
                                                    Progress& progress) {
  return build_stack(source, parameters, progress);
}

std::size_t LayeredStack::runs() const {
  std::size_t runs = 0;
  for (const StackTile& tile : tiles_) runs += tile.runs();
  return runs;
}

void LayeredStack::spans(Columns where, SpanSink& out) const {
  const ColumnLookup lookup(grid_);
  for (std::size_t c = 0; c < where.size(); ++c) {
    int i, j;
    if (lookup.column(where.x[c], where.z[c], i, j)) {
      column(i, j).each_solid([&](int bottom, int top, Material material) {
        out.add({grid_.edge_y(bottom), grid_.edge_y(top), material});
      });
    }
    out.end_column();
  }
}

// In groups, so that the cache misses of many random points overlap: first all addresses, then all starts,
// then all searches.
void LayeredStack::materials(Points where, std::span<Material> out) const {
  constexpr std::size_t kGroup = 32;
  constexpr std::size_t kLinear = 16;  // up to so many runs counting is faster than bisecting
  struct Probe {
    const StackTile* tile;
    std::size_t slot;
    int level;
  };
  const ColumnLookup lookup(grid_);
  std::array<Probe, kGroup> probes;
  for (std::size_t first = 0; first < where.size(); first += kGroup) {
    const std::size_t count = std::min(kGroup, where.size() - first);
    for (std::size_t g = 0; g < count; ++g) {
      Probe& probe = probes[g];
      int i, j;
      probe.level = lookup.level(where.y[first + g]);
      if (probe.level < 0 || !lookup.column(where.x[first + g], where.z[first + g], i, j)) {
        probe.tile = nullptr;
        continue;
      }
      const Place at = place(i, j);
      probe.tile = &tiles_[at.tile];
      probe.slot = at.slot;
      __builtin_prefetch(probe.tile->start_address(at.slot));
    }
    for (std::size_t g = 0; g < count; ++g) {
      if (probes[g].tile == nullptr) continue;
      __builtin_prefetch(probes[g].tile->tops_address(probes[g].slot));
      __builtin_prefetch(probes[g].tile->materials_address(probes[g].slot));
    }
    for (std::size_t g = 0; g < count; ++g) {
      const Probe& probe = probes[g];
      out[first + g] = Material::kAir;
      if (probe.tile == nullptr) continue;
      const ColumnRuns runs = probe.tile->column(probe.slot);
      std::size_t below = 0;  // runs that end at or under the level
      if (runs.count <= kLinear) {
        for (std::size_t r = 0; r < runs.count; ++r) below += runs.tops[r] <= probe.level ? 1U : 0U;
      } else {
        below = static_cast<std::size_t>(std::upper_bound(runs.tops, runs.tops + runs.count, probe.level) -
                                         runs.tops);
      }
      if (below < runs.count) out[first + g] = runs.materials[below];
    }
  }
}

struct LayeredStack::ColumnEdit {
  std::size_t tile, slot;
  int bottom, top;
  Material material;
};

// The tile after `edits`, which are sorted by slot and within a slot in the order given.
StackTile LayeredStack::edited_tile(std::size_t tile, std::span<const ColumnEdit> edits,
                                    TileBuilder& builder) const {
  RunList before, after;
  const StackTile& old = tiles_[tile];
  std::size_t copied = 0;  // slots done
  builder.begin();
  for (auto at = edits.begin(); at != edits.end();) {
    const std::size_t slot = at->slot;
    builder.add(old, copied, slot);
    const ColumnRuns runs = old.column(slot);
    before.clear();
    for (std::size_t r = 0; r < runs.count; ++r) before.add(runs.tops[r], runs.materials[r]);
    for (; at != edits.end() && at->slot == slot; ++at) {
      after.edit(before.runs(), at->bottom, at->top, at->material);
      std::swap(before, after);
    }
    builder.add(before.runs());
    copied = slot + 1;
  }
  builder.add(old, copied, old.columns());
  return builder.finish();
}

void LayeredStack::edit(Columns where, std::span<const Span> what) {
  check_edit(where, what);
  const ColumnLookup lookup(grid_);
  std::vector<ColumnEdit> edits;
  for (std::size_t c = 0; c < where.size(); ++c) {
    int i, j;
    const LevelRange levels = grid_.quantise(what[c].bottom, what[c].top);
    if (levels.begin >= levels.end || !lookup.column(where.x[c], where.z[c], i, j)) continue;
    const Place at = place(i, j);
    edits.push_back({at.tile, at.slot, levels.begin, levels.end, what[c].material});
  }
  std::stable_sort(edits.begin(), edits.end(), [](const ColumnEdit& a, const ColumnEdit& b) {
    return std::pair(a.tile, a.slot) < std::pair(b.tile, b.slot);
  });
  std::vector<std::span<const ColumnEdit>> touched;  // one list per tile
  for (auto begin = edits.cbegin(), end = begin; begin != edits.cend(); begin = end) {
    end = std::find_if(begin, edits.cend(), [&](const ColumnEdit& at) { return at.tile != begin->tile; });
    touched.emplace_back(begin, end);
  }
  constexpr std::size_t kTilesATask = 16;
  std::vector<StackTile> edited(touched.size());
  using Range = tbb::blocked_range<std::size_t>;
  tbb::parallel_for(Range(0, touched.size(), kTilesATask), [&](const Range& range) {
    TileBuilder builder;
    for (std::size_t t = range.begin(); t < range.end(); ++t) {
      edited[t] = edited_tile(touched[t].front().tile, touched[t], builder);
    }
  });
  for (std::size_t t = 0; t < touched.size(); ++t) tiles_[touched[t].front().tile] = std::move(edited[t]);
}

TriangleMesh LayeredStack::mesh(MeshDetail detail) const {
  return block_mesh(grid_, detail, [&](int j, SurfaceRow& row) {
    for (int i = 0; i < grid_.width; ++i) {
      column(i, j).each_solid([&](int bottom, int top, Material) { row.add_solid(bottom, top); });
      row.end_column();
    }
  });
}

Memory LayeredStack::memory() const {
  const std::size_t table = tiles_.size() * sizeof(StackTile);
  Memory memory{0, table + heap_bytes(this), heap_bytes(tiles_.data()) - table};
  for (const StackTile& tile : tiles_) memory += tile.memory();
  return memory;
}

void LayeredStack::save(ByteSink& out) const {
  grid_.save(out);
  std::vector<std::uint16_t> counts, tops;
  std::vector<Material> materials;
  for (const StackTile& tile : tiles_) {
    counts.clear();
    tops.clear();
    materials.clear();
    for (std::size_t slot = 0; slot < tile.columns(); ++slot) {
      const ColumnRuns runs = tile.column(slot);
      counts.push_back(static_cast<std::uint16_t>(runs.count));
      tops.insert(tops.end(), runs.tops, runs.tops + runs.count);
      materials.insert(materials.end(), runs.materials, runs.materials + runs.count);
    }
    out.put_array(std::span<const std::uint16_t>(counts));
    out.put_array(std::span<const std::uint16_t>(tops));
    out.put_array(std::span<const Material>(materials));
  }
}

std::unique_ptr<Representation> LayeredStack::load(ByteSource& in) {
  const ColumnGrid grid = ColumnGrid::load(in);
  if (grid.columns() > in.left() / sizeof(std::uint16_t))
    in.fail("the file holds fewer columns than the grid");
  std::unique_ptr<LayeredStack> stack(new LayeredStack(grid));
  TileBuilder builder;
  RunList runs;
  constexpr int kSide = StackTile::kSide;
  for (std::size_t t = 0; t < stack->tiles_.size(); ++t) {
    const int i0 = static_cast<int>(t % stack->tiles_x_) * kSide,
              j0 = static_cast<int>(t / stack->tiles_x_) * kSide;
    const int columns = std::min(kSide, grid.width - i0) * std::min(kSide, grid.depth - j0);
    const auto counts = in.get_array<std::uint16_t>(static_cast<std::uint64_t>(columns));
    std::uint64_t total = 0;
    for (const std::uint16_t count : counts) total += count;
    const auto tops = in.get_array<std::uint16_t>(total);
    const auto materials = in.get_array<Material>(total);
    std::size_t r = 0;
    builder.begin();
    for (const std::uint16_t count : counts) {
      runs.clear();
      for (const std::size_t end = r + count; r < end; ++r) {
        if (tops[r] > grid.levels) in.fail("a run reaches above the grid");
        runs.add(tops[r], materials[r]);
      }
      runs.drop_trailing_air();
      if (runs.runs().size() != count) in.fail("a column's runs are not in order");
      builder.add(runs.runs());
    }
    stack->tiles_[t] = builder.finish();
  }
  return stack;
}

std::unique_ptr<Representation> LayeredStack::decode(ByteSource& in) {
  ColumnGrid grid;
  const ColumnsOfRuns columns = decode_columns(in, grid);
  std::unique_ptr<LayeredStack> built(new LayeredStack(grid));
  TileBuilder builder;
  RunList runs;
  for (std::size_t t = 0; t < built->tiles_.size(); ++t) {
    built->tiles_[t] = built->make_tile(t, builder, [&](int i, int j, TileBuilder& tile) {
      runs.clear();
      for (const Run& run : columns.column(grid.index(i, j))) runs.add(run.top, run.material);
      runs.drop_trailing_air();
      tile.add(runs.runs());
    });
  }
  return built;
}

}  // namespace terrabench
