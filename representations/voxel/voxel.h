// Sparse voxels: one OpenVDB mask tree (Museth 2013) per material, the packaged peer of the stacks in
// "hybrid" Table 1. A mask costs one bit per voxel near surfaces and nothing inside; the vertical lies along
// the tree's contiguous axis, so that a byte of a leaf is eight levels of a column. Queries are O(materials),
// a column O(levels / 8) at most.
#pragma once

#include <memory>

#include "representations/column_grid.h"
#include "representations/representation.h"

namespace terrabench {

// For heights and step 0 there are between half of this and this many levels. Also for the dense grid.
inline constexpr int kVoxelLevels = 512;

class Voxel final : public Representation {
 public:
  static std::unique_ptr<Representation> build(const TerrainSource&, const Parameters&, Progress&);
  static std::unique_ptr<Representation> load(ByteSource&);
  static std::unique_ptr<Representation> decode(ByteSource&);
  ~Voxel() override;

  const ColumnGrid& grid() const { return grid_; }

  void spans(Columns where, SpanSink& out) const override;
  void materials(Points where, std::span<Material> out) const override;
  void edit(Columns where, std::span<const Span> what) override;  // clipped to bounds()
  // OpenVDB's volumeToMesh on the union of all materials: smoothed, vertices within half a voxel of the true
  // faces. No edge is open, but where solids touch along an edge only, an edge can have four triangles.
  // Always at the grid's resolution.
  TriangleMesh mesh(MeshDetail) const override;
  // Includes what OpenVDB's memUsage() omits: the allocator's rounding, the padding of inner nodes, the nodes
  // of the root's map and the tree objects' own blocks.
  Memory memory() const override;
  void save(ByteSink&) const override;
  Bounds bounds() const override { return grid_.bounds(); }
  const ColumnGrid* column_grid() const override { return &grid_; }

 private:
  struct Layers;  // keeps OpenVDB's headers in one file
  explicit Voxel(const ColumnGrid&);

  ColumnGrid grid_;
  std::unique_ptr<Layers> layers_;
};

}  // namespace terrabench
