// Concurrent binary trees with longest-edge bisection (Dupuy, "Concurrent Binary Trees (with application to
// longest edge bisection)", 2020), on the processor: the mesh of the last frame is one bit per triangle of
// the finest level and the sums of these bits. A pass decides for every leaf in parallel whether to split it,
// with the coarser neighbours that keep the mesh conforming, or to merge it with its sibling; each pass
// changes leaves by one level.
//
// A leaf is split while it is in view and its nested exact error (lod/rtin/nested_errors.h) may show as more
// than the knob's pixels, as by rtin, whose triangles are the same. `split=edge` takes the paper's criterion
// instead, that the longest edge, in plan, shows as more than so many pixels, which bounds no error. The
// paper makes one pass per frame (`passes=1`): after a jump of the eye the mesh is behind by a level per
// frame, and the bound is not kept meanwhile. By default an update repeats passes until nothing
// changes; later ones visit only what the last changed.
//
// The first pass and drawing are O(leaves), in parallel by ranges of leaves: together 0.2 µs per leaf and
// processor (tests/bench/rtin_bench), most of it spent waiting for errors and heights from memory. A change
// is O(levels²), 2 to 3 µs. The tree is one byte per lattice point, or up to two for several root squares.
// Uploads all indices from the first on that differs.
#pragma once

#include <vector>

#include "lod/cbt/bisection.h"
#include "lod/cbt/bit_tree.h"
#include "lod/fresh_frame.h"
#include "lod/rtin/nested_errors.h"
#include "lod/screen_bound.h"
#include "terrain/frustum.h"
#include "terrain/split_rule.h"

namespace terrabench {

class Cbt : public Lod {
 public:
  struct Options {
    bool by_edge = false;  // split by the length of edges
    int passes = 0;        // most passes per update; 0: until nothing changes
  };

  // The field must outlive it.
  static std::unique_ptr<Lod> build(const LodGround&, const Parameters&, Progress&);
  static Knob knob() { return {"error", "px", 0.05, 200, 2}; }
  static std::span<const ParameterSpec> parameters();

  Cbt(const Heightfield&, const Options&, Progress&);
  const Frame& update(const View&) override;
  void tune(double pixels) override { pixels_ = setting(knob(), pixels); }
  // As NestedErrors::update().
  void edited(const SampleRect&) override;
  Memory memory() const override;

  const cbt::BitTree& tree() const { return tree_; }
  // For a tree on the GPU that goes on from this one (renderers/cbt/gpu_cbt.h): the ground as it is now, and
  // what update() decides a view by, with `split=error`. Copies 8 bytes per lattice point.
  SplitGround split_ground() const;
  SplitRule split_rule(const View&) const;

 private:
  struct Criterion;  // of a view
  // What a pass does to the two triangles of a diamond: leaves are split, or the halves of both are merged.
  struct Decision {
    cbt::Diamond diamond{};  // node 0: nothing
    bool merge = false;
  };
  // Parent whose halves the next pass decides again: both, or only the left one.
  struct Touched {
    cbt::Diamond parent;
    bool both;
  };
  // Whether each may be in view: false is certain; true is certain only if `known`.
  struct InView {
    bool leaf = true, parent = true;
    bool known = false;
  };
  // Of consecutive leaves, made by one task.
  struct Part {
    std::vector<Decision> decisions;
    std::vector<std::uint32_t> corners;
  };

  template <class Make>
  void make_parts(const Make&);
  void decide_all(const Criterion&);
  void decide_touched(const Criterion&);
  template <class AcrossLeaf>
  Decision decide(cbt::NodeId leaf, const rtin::Triangle&, const cbt::Diamond& parent, std::size_t of_parent,
                  const InView&, const Criterion&, const AcrossLeaf&) const;
  bool mergeable(const cbt::Diamond& parent, std::size_t leaves, const InView&, const Criterion&) const;
  std::size_t apply();
  std::size_t split(const cbt::Diamond&);
  std::size_t merge(const cbt::Diamond&);
  void draw(const Frustum&);

  Options options_;
  rtin::NestedErrors errors_;
  cbt::Bisection bisection_;
  cbt::BitTree tree_;
  double pixels_ = knob().fallback;
  std::vector<Part> parts_;
  std::vector<Decision> decisions_;  // of a pass
  std::vector<Touched> touched_;
  FreshFrame frame_;
};

}  // namespace terrabench
