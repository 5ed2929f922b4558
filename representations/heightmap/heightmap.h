// Heights on a grid, bilinear between samples: the form that "hybrid" §2.1 and all other papers start from.
// One span per column, so no overhangs: a solid loses all but its topmost surface. 4 B per sample; a query is
// O(1).
#pragma once

#include <vector>

#include "representations/representation.h"

namespace terrabench {

// The positions of a heightmap's samples.
struct HeightGrid {
  int width = 1, depth = 1;
  double origin_x = 0, origin_z = 0;  // of sample (0, 0), metres
  double cell_x = 1, cell_z = 1;
  Bounds bounds;

  // Row and column of the sample nearest to the point; none outside the bounds.
  struct Place {
    int i, j;
  };
  std::optional<Place> nearest(float x, float z) const;

  void save(ByteSink&) const;
  static HeightGrid load(ByteSource&);
};

// What Heightmap::edit() makes of a height; NaN is no data.
float edited_height(float height, const Span& what, const Bounds&);

class Heightmap final : public Representation {
 public:
  static std::unique_ptr<Representation> build(const TerrainSource&, const Parameters&, Progress&);
  static std::unique_ptr<Representation> load(ByteSource&);
  static std::unique_ptr<Representation> decode(ByteSource&);
  // Row-major, NaN where there is no data.
  Heightmap(const HeightGrid& grid, std::vector<float> heights) : grid_(grid), heights_(std::move(heights)) {}

  const HeightGrid& grid() const { return grid_; }
  std::span<const float> heights() const { return heights_; }

  // Bilinear; no-data outside the bounds, and where a sample with weight has none. Between the outermost
  // samples and the bounds (half a cell, for solids) the border's height continues.
  float height(float x, float z) const;

  void spans(Columns where, SpanSink& out) const override;
  // Afterwards a sample is the topmost ground of what its line would be: a roof over dug air fills it.
  void edit(Columns where, std::span<const Span> what) override;
  std::optional<LineGrid> edited_lines() const override;
  // The block between surface and floor, closed by walls along the border and around no-data; always
  // watertight. Empty for a single row of samples, which has no area.
  TriangleMesh mesh(MeshDetail) const override;
  Memory memory() const override;
  void save(ByteSink&) const override;
  bool encode(double largest_error, ByteSink&) const override;
  Bounds bounds() const override { return grid_.bounds; }
  LineGrid lines() const override;
  std::unique_ptr<RayCaster> ray_caster()
      const override;  // the two triangles of each square, as mesh() draws

 private:
  Heightmap() = default;
  void take_heights(const Heightfield&, const Bounds&);
  void take_topmost(const TerrainSource&, const Parameters&, Progress&);
  std::vector<float> lines(float cell, float low, float high, double origin, double own_cell,
                           int samples) const;

  HeightGrid grid_;
  std::vector<float> heights_;
};

}  // namespace terrabench
