// Concurrent binary trees with longest-edge bisection on the GPU (Dupuy, "Concurrent Binary Trees (with
// application to longest edge bisection)", 2020, §3 and §4): the tree lies in one buffer of 2^(D-1) bytes,
// laid out as by lod/cbt/bit_tree.h, where D is the level of the finest triangles. update() makes one pass by
// compute shaders: cbt_merge and cbt_split, one invocation per leaf, change bits atomically; cbt_sum, one
// dispatch per level, sums them and writes how many invocations the next pass takes. draw() finds each leaf
// by its number in the vertex shader. Nothing is read back, and only the view is sent.
//
// It follows lod/cbt with passes=1. All decisions of an update are made on the sums of the last one, so the
// result does not depend on the order of invocations. They are made in double, by the processor's operations
// in their order, and `precise` forbids to fuse these. Where the driver rounds them as IEEE 754 says, the
// leaves are the processor's: so in Mesa's llvmpipe, as the tests show. OpenGL does not promise this of
// division, square root and conversion in double. Where they are rounded otherwise, a triangle may be split
// on one side alone if its error equals the bound within rounding; the triangles conform, and the bound holds
// up to rounding.
//
// An update is O(leaves · D + 2^D), in D - 2 dispatches. Bytes on the GPU: the tree, 4 per sample, 8 per
// lattice point.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "renderers/context.h"
#include "renderers/frame_renderer.h"
#include "terrain/split_rule.h"
#include "terrain/view.h"

namespace terrabench {

class GpuCbt {
 public:
  // Uploads ground and tree; keeps neither. The context must outlive it. Throws environment_error where a
  // part has no room in this OpenGL's storage blocks, or D > 30.
  GpuCbt(GlContext&, const SplitGround&);
  ~GpuCbt();
  GpuCbt(const GpuCbt&) = delete;
  GpuCbt& operator=(const GpuCbt&) = delete;

  // One pass towards this view. Does not wait for the GPU.
  void update(const SplitRule&);
  // Draws all leaves as FrameRenderer::draw_uploaded() draws a frame, by height.
  void draw(const View&, const FrameStyle&);
  // The tree, as cbt::BitTree::words(). Waits for the GPU.
  std::vector<std::uint64_t> tree() const;
  std::size_t tree_bytes() const;  // on the GPU

 private:
  struct Gl;
  void bind() const;
  void sum_up();

  GlContext& context_;
  int depth_;
  std::unique_ptr<Gl> gl_;
};

}  // namespace terrabench
