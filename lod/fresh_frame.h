// The frame of a method that rewrites all indices in each update, over a grid whose vertices do not move.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lod/lod.h"

namespace terrabench {

class FreshFrame {
 public:
  explicit FreshFrame(const Heightfield& ground) : grid_(grid_of(ground)), batches_(1) {
    uploads_.reserve(2);
  }

  const GroundGrid& grid() const { return grid_; }
  // Starts the next frame, without indices.
  void begin();
  void add_corner(std::uint32_t vertex) { indices_.push_back(vertex); }
  void add_corners(std::span<const std::uint32_t> vertices) {
    indices_.insert(indices_.end(), vertices.begin(), vertices.end());
  }
  // Uploads the edited heights and the indices from the first on that differs from the last frame's.
  // O(indices)
  const Frame& finish(std::size_t changes);
  // Throws usage_error for samples that are not on the ground.
  void edited(const SampleRect&);
  Memory memory() const;  // without the object itself

 private:
  GroundGrid grid_;
  std::vector<std::uint32_t> indices_, last_;  // of this frame and the last
  std::vector<Batch> batches_;
  std::vector<DirtyRange> uploads_, edits_;  // edits_: for the next frame
  Frame frame_;
  bool first_ = true;
};

}  // namespace terrabench
