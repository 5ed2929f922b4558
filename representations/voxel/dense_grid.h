// One byte per voxel, with which "hybrid" Table 1 compares the material stacks. n³ bytes for any content; a
// point query is one read, a column query and an edit are O(levels).
#pragma once

#include <vector>

#include "representations/column_grid.h"
#include "representations/representation.h"

namespace terrabench {

class DenseGrid final : public Representation {
 public:
  static std::unique_ptr<Representation> build(const TerrainSource&, const Parameters&, Progress&);
  static std::unique_ptr<Representation> load(ByteSource&);
  static std::unique_ptr<Representation> decode(ByteSource&);

  const ColumnGrid& grid() const { return grid_; }
  // All levels of a column, bottom up.
  std::span<const Material> column(int i, int j) const {
    return {voxels_.data() + grid_.index(i, j) * grid_.levels, static_cast<std::size_t>(grid_.levels)};
  }

  void spans(Columns where, SpanSink& out) const override;
  void materials(Points where, std::span<Material> out) const override;
  void edit(Columns where, std::span<const Span> what) override;  // clipped to bounds()
  TriangleMesh mesh(MeshDetail) const override;  // the voxels' boundary as blocks, watertight
  Memory memory() const override;
  void save(ByteSink&) const override;
  Bounds bounds() const override { return grid_.bounds(); }
  const ColumnGrid* column_grid() const override { return &grid_; }

 private:
  explicit DenseGrid(const ColumnGrid& grid) : grid_(grid) {}

  ColumnGrid grid_;
  std::vector<Material> voxels_;  // columns row-major, the levels of a column contiguous
};

}  // namespace terrabench
