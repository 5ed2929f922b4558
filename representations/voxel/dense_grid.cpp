#include "representations/voxel/dense_grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "representations/block_mesh.h"
#include "representations/coding/column_codec.h"
#include "representations/runs.h"
#include "representations/voxel/voxel.h"

namespace terrabench {
namespace {

std::size_t voxels_of(const ColumnGrid& grid) {
  return grid.columns() * static_cast<std::size_t>(grid.levels);
}

// Calls solid(bottom, top, material) for each run of a column that is not air.
template <class Visit>
void for_each_solid(std::span<const Material> column, const Visit& solid) {
  for (std::size_t begin = 0, end = 0; begin < column.size(); begin = end) {
    end = run_end(column, begin);
    if (column[begin] != Material::kAir) solid(static_cast<int>(begin), static_cast<int>(end), column[begin]);
  }
}

}  // namespace

std::unique_ptr<Representation> DenseGrid::build(const TerrainSource& source, const Parameters& parameters,
                                                 Progress& progress) {
  const ColumnSampler sampler(source, parameters, kVoxelLevels);
  std::unique_ptr<DenseGrid> built(new DenseGrid(sampler.grid()));
  const ColumnGrid& grid = built->grid_;
  require_memory(voxels_of(grid), "dense_voxel");
  built->voxels_.resize(voxels_of(grid));
  progress.begin("dense_voxel", static_cast<std::uint64_t>(grid.depth));
  tbb::parallel_for(0, grid.depth, [&](int j) {
    for (int i = 0; i < grid.width; ++i) {
      sampler.sample(
          i, j,
          {built->voxels_.data() + grid.index(i, j) * grid.levels, static_cast<std::size_t>(grid.levels)});
    }
    progress.advance();
  });
  return built;
}

void DenseGrid::spans(Columns where, SpanSink& out) const {
  const ColumnLookup lookup(grid_);
  for (std::size_t c = 0; c < where.size(); ++c) {
    if (int i, j; lookup.column(where.x[c], where.z[c], i, j)) {
      for_each_solid(column(i, j), [&](int bottom, int top, Material material) {
        out.add({grid_.edge_y(bottom), grid_.edge_y(top), material});
      });
    }
    out.end_column();
  }
}

void DenseGrid::materials(Points where, std::span<Material> out) const {
  const ColumnLookup lookup(grid_);
  for (std::size_t p = 0; p < where.size(); ++p) {
    int i, j;
    const int level = lookup.level(where.y[p]);
    const bool inside = level >= 0 && lookup.column(where.x[p], where.z[p], i, j);
    out[p] = inside ? voxels_[grid_.index(i, j) * grid_.levels + level] : Material::kAir;
  }
}

void DenseGrid::edit(Columns where, std::span<const Span> what) {
  check_edit(where, what);
  const ColumnLookup lookup(grid_);
  for (std::size_t c = 0; c < where.size(); ++c) {
    int i, j;
    if (!lookup.column(where.x[c], where.z[c], i, j)) continue;
    const LevelRange levels = grid_.quantise(what[c].bottom, what[c].top);
    Material* const column = voxels_.data() + grid_.index(i, j) * grid_.levels;
    if (levels.begin < levels.end) std::fill(column + levels.begin, column + levels.end, what[c].material);
  }
}

TriangleMesh DenseGrid::mesh(MeshDetail detail) const {
  return block_mesh(grid_, detail, [&](int j, SurfaceRow& row) {
    for (int i = 0; i < grid_.width; ++i) {
      for_each_solid(column(i, j), [&](int bottom, int top, Material) { row.add_solid(bottom, top); });
      row.end_column();
    }
  });
}

Memory DenseGrid::memory() const {
  Memory memory = payload_memory(voxels_);
  memory.index += heap_bytes(this);
  return memory;
}

void DenseGrid::save(ByteSink& out) const {
  grid_.save(out);
  out.put_array(std::span<const Material>(voxels_));
}

std::unique_ptr<Representation> DenseGrid::load(ByteSource& in) {
  std::unique_ptr<DenseGrid> built(new DenseGrid(ColumnGrid::load(in)));
  built->voxels_ = in.get_array<Material>(voxels_of(built->grid_));
  return built;
}

std::unique_ptr<Representation> DenseGrid::decode(ByteSource& in) {
  ColumnGrid grid;
  const ColumnsOfRuns columns = decode_columns(in, grid);
  if (voxels_of(grid) > available_memory()) in.fail("more voxels than fit the memory");
  std::unique_ptr<DenseGrid> built(new DenseGrid(grid));
  built->voxels_.resize(voxels_of(grid));
  fill(*built, grid, columns);
  return built;
}

}  // namespace terrabench
