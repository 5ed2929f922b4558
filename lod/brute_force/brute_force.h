// The full terrain at every sample, culled by the frustum only: the reference for the other methods ("brute"
// in Table 2 of the MRBSP paper). Blocks of 32 × 32 cells share one index pattern. update() is O(blocks),
// that is, cells / 1024.
#pragma once

#include <vector>

#include "lod/lod.h"

namespace terrabench {

class BruteForce : public Lod {
 public:
  // The field must outlive it.
  static std::unique_ptr<Lod> build(const LodGround&, const Parameters&, Progress&);
  static Knob knob() { return {"stride", "samples", 1, 1, 1, true}; }

  explicit BruteForce(const Heightfield&);
  const Frame& update(const View&) override;
  // Has only one setting.
  void tune(double stride) override { (void)setting(knob(), stride); }
  void edited(const SampleRect&) override;
  Memory memory() const override;

 private:
  static constexpr int kBlock = 32;  // cells along a block's side
  struct Block {
    std::uint32_t corner;  // vertex
    std::uint16_t shape;   // index pattern: whole, or cut by the field's border
    float lowest, highest;
  };
  // The indices of a block of `columns` × `rows` cells.
  struct Shape {
    int columns, rows;
    std::uint32_t first_index, index_count;
  };
  std::uint16_t shape_of(int columns, int rows);
  void add_block(int i0, int j0);
  void measure(Block&) const;

  GroundGrid grid_;
  std::vector<Shape> shapes_;  // at most four
  std::vector<Block> blocks_;
  std::vector<std::uint32_t> indices_;
  std::vector<Batch> batches_;
  std::vector<DirtyRange> uploads_, edits_;  // edits_: for the next frame
  Frame frame_;
  bool first_ = true;
};

}  // namespace terrabench
