// Which samples of the full terrain a view sees: where the meters measure. Depends on ground and view alone,
// so that all methods are measured at the same samples, and one answer serves them all.
//
// The full terrain (two triangles a cell) is drawn into a depth buffer of the view's size. A sample in the
// frustum is hidden when it lies behind all of the 3 × 3 pixels around its own, by more than four pixels'
// breadth at its depth: in doubt, at outlines and for detail under a pixel, it counts as visible. O(cells in
// view + pixels), in parallel; two bits a sample.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lod/meters/projector.h"
#include "terrain/heightfield.h"

namespace terrabench {

enum class Seen : std::uint8_t { kOutside, kHidden, kVisible };

class SeenSamples {
 public:
  SeenSamples(const Heightfield&, const View&);

  // What one takes for so much ground, to be asked for before many are made.
  static std::size_t bytes(int width, int depth);

  Seen at(int i, int j) const {
    const std::uint64_t word =
        seen_[static_cast<std::size_t>(j) * words_ + static_cast<std::size_t>(i / kSeenAWord)];
    return static_cast<Seen>(word >> (2 * (i % kSeenAWord)) & 3);
  }
  int width() const { return width_; }
  int depth() const { return depth_; }
  float cell_x() const { return cell_x_; }
  float cell_z() const { return cell_z_; }
  const View& view() const { return view_; }

 private:
  void find_seen(const Heightfield&, const std::vector<float>& nearness);

  static constexpr int kSeenAWord = 32;

  int width_, depth_;
  float cell_x_, cell_z_;
  View view_;
  std::size_t words_;  // a row; rows do not share any, so that each can be written by a thread of its own
  std::vector<std::uint64_t> seen_;
};

}  // namespace terrabench
