#include "representations/layered_stack/layered_stack.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <optional>

#include "representations/block_mesh.h"
#include "representations/coding/column_codec.h"
#include "representations/layered_stack/tile.h"

namespace terrabench {

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

constexpr std::size_t kGroup = 32;

// Calls use(c, runs) for each of `count` positions, in groups, so that the cache misses of many random
// positions overlap: first all addresses, then all starts, then all runs. Before, locate(c, i, j) finds the
// column; where it returns false, there are no runs.
template <class Locate, class Use>
void LayeredStack::for_each_column(std::size_t count, const Locate& locate, const Use& use) const {
  struct Probe {
    const StackTile* tile;  // null: none
    std::size_t slot;
  };
  std::array<Probe, kGroup> probes;
  for (std::size_t first = 0; first < count; first += kGroup) {
    const std::size_t size = std::min(kGroup, count - first);
    for (std::size_t g = 0; g < size; ++g) {
      probes[g].tile = nullptr;
      int i, j;
      if (!locate(first + g, i, j)) continue;
      const Place at = place(i, j);
      probes[g] = {&tiles_[at.tile], at.slot};
      __builtin_prefetch(probes[g].tile->start_address(at.slot));
    }
    for (std::size_t g = 0; g < size; ++g) {
      if (probes[g].tile == nullptr) continue;
      __builtin_prefetch(probes[g].tile->tops_address(probes[g].slot));
      __builtin_prefetch(probes[g].tile->materials_address(probes[g].slot));
    }
    for (std::size_t g = 0; g < size; ++g) {
      use(first + g, probes[g].tile == nullptr ? ColumnRuns{} : probes[g].tile->column(probes[g].slot));
    }
  }
}

void LayeredStack::spans(Columns where, SpanSink& out) const {
  const ColumnLookup lookup(grid_);
  for_each_column(
      where.size(),
      [&](std::size_t c, int& i, int& j) { return lookup.column(where.x[c], where.z[c], i, j); },
      [&](std::size_t, const ColumnRuns& runs) {
        runs.each_solid([&](int bottom, int top, Material material) {
          out.add({grid_.edge_y(bottom), grid_.edge_y(top), material});
        });
        out.end_column();
      });
}

void LayeredStack::materials(Points where, std::span<Material> out) const {
  constexpr std::size_t kLinear = 16;  // up to so many runs counting is faster than bisecting
  const ColumnLookup lookup(grid_);
  std::array<int, kGroup> levels;
  for_each_column(
      where.size(),
      [&](std::size_t c, int& i, int& j) {
        levels[c % kGroup] = lookup.level(where.y[c]);
        return levels[c % kGroup] >= 0 && lookup.column(where.x[c], where.z[c], i, j);
      },
      [&](std::size_t c, const ColumnRuns& runs) {
        const int level = levels[c % kGroup];
        std::size_t below = 0;  // runs that end at or under the level
        if (runs.count <= kLinear) {
          for (std::size_t r = 0; r < runs.count; ++r) below += runs.tops[r] <= level ? 1U : 0U;
        } else {
          below = static_cast<std::size_t>(std::upper_bound(runs.tops, runs.tops + runs.count, level) -
                                           runs.tops);
        }
        out[c] = below < runs.count ? runs.materials[below] : Material::kAir;
      });
}

struct LayeredStack::ColumnEdit {
  std::size_t tile, slot;
  Run run;  // to be set
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
      after.edit(before.runs(), at->run.bottom, at->run.top, at->run.material);
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
  const auto edit_of = [&](std::size_t c) -> std::optional<ColumnEdit> {
    int i, j;
    const LevelRange levels = grid_.quantise(what[c].bottom, what[c].top);
    if (levels.begin >= levels.end || !lookup.column(where.x[c], where.z[c], i, j)) return {};
    const Place at = place(i, j);
    return ColumnEdit{
        at.tile,
        at.slot,
        {static_cast<std::uint16_t>(levels.begin), static_cast<std::uint16_t>(levels.end), what[c].material}};
  };
  if (where.size() == 1) {
    const auto one = edit_of(0);
    if (!one || tiles_[one->tile].edit(one->slot, one->run)) return;
  }
  std::vector<ColumnEdit> edits;
  for (std::size_t c = 0; c < where.size(); ++c) {
    if (const auto one = edit_of(c)) edits.push_back(*one);
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
