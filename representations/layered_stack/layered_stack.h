// The discrete data structure of "hybrid" §3.1.1 (after Benes & Forsbach 2001): a two-dimensional array of
// material stacks. The paper gives no memory layout; here columns lie in square tiles of one heap block each,
// 2 B per column and 3 B per run. A point query is O(log runs of the column); an edit of one column moves
// what lies behind it in its tile, of several rewrites the tiles that it touches (2 to 4 KiB each).
#pragma once

#include <memory>
#include <vector>

#include "representations/column_grid.h"
#include "representations/layered_stack/tile.h"
#include "representations/representation.h"

namespace terrabench {

class LayeredStack final : public Representation {
 public:
  // From a solid, sampled at cell centres, or from heights (one run per column, to half a step). Parallel
  // over tiles; the same structure for any number of threads. O(samples).
  static std::unique_ptr<Representation> build(const TerrainSource&, const Parameters&, Progress&);
  static std::unique_ptr<LayeredStack> build_stack(const TerrainSource&, const Parameters&, Progress&);
  static std::unique_ptr<Representation> load(ByteSource&);
  static std::unique_ptr<Representation> decode(ByteSource&);

  const ColumnGrid& grid() const { return grid_; }
  // Valid until the next edit. i in [0, width), j in [0, depth).
  ColumnRuns column(int i, int j) const {
    const Place at = place(i, j);
    return tiles_[at.tile].column(at.slot);
  }
  std::size_t runs() const;
  bool operator==(const LayeredStack& other) const { return grid_ == other.grid_ && tiles_ == other.tiles_; }

  void spans(Columns where, SpanSink& out) const override;
  void materials(Points where, std::span<Material> out) const override;
  // Clipped to bounds(); columns outside are skipped. Later spans replace earlier ones. Strong guarantee.
  void edit(Columns where, std::span<const Span> what) override;
  ThermalErosion erode_to(double talus, Progress&) override;
  // The cells' boundary as blocks, watertight. A coarser detail takes every n-th column.
  TriangleMesh mesh(MeshDetail) const override;
  Memory memory() const override;
  void save(ByteSink&) const override;
  Bounds bounds() const override { return grid_.bounds(); }
  const ColumnGrid* column_grid() const override { return &grid_; }

 private:
  struct Place {
    std::size_t tile, slot;
  };
  struct ColumnEdit;

  template <class Locate, class Use>
  void for_each_column(std::size_t count, const Locate&, const Use&) const;
  explicit LayeredStack(const ColumnGrid&);
  Place place(int i, int j) const {
    constexpr int kSide = StackTile::kSide;
    const int tile_i = i / kSide, tile_j = j / kSide;
    const int row = tile_i == tiles_x_ - 1 ? last_tile_width_ : kSide;
    return {static_cast<std::size_t>(tile_j) * tiles_x_ + tile_i,
            static_cast<std::size_t>(j % kSide * row + i % kSide)};
  }
  template <class ColumnOf>
  StackTile make_tile(std::size_t tile, TileBuilder&, const ColumnOf&) const;
  StackTile edited_tile(std::size_t tile, std::span<const ColumnEdit>, TileBuilder&) const;

  ColumnGrid grid_;
  int tiles_x_ = 0, last_tile_width_ = 0;
  std::vector<StackTile> tiles_;  // row-major; at the borders a tile has fewer columns
};

}  // namespace terrabench
