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
// frame, and the bound is not kept meanwhile. By default an update passes until nothing changes, from the
// second pass on over what the last one changed.
//
// A pass is O(leaves · levels), about 0.5 µs per leaf, plus O(levels²) per change. The tree is one byte per
// lattice point, or up to two for several root squares. Uploads all indices from the first on that differs.
#pragma once

#include <vector>

#include "lod/cbt/bisection.h"
#include "lod/cbt/bit_tree.h"
#include "lod/fresh_frame.h"
#include "lod/rtin/nested_errors.h"
#include "lod/screen_bound.h"
#include "terrain/frustum.h"

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

 private:
  struct Criterion;  // of a view
  // What a pass does to a node: a leaf is split, or the halves of a split node are merged.
  struct Decision {
    cbt::NodeId node = 0;  // 0: nothing
    bool merge = false;
  };

  void decide_all(const Criterion&);
  void decide_touched(const Criterion&);
  Decision decide(const cbt::Place& leaf, const cbt::Place& parent, const Criterion&) const;
  bool mergeable(const cbt::Place& parent, const Criterion&) const;
  std::size_t apply();
  std::size_t split(cbt::NodeId);
  std::size_t merge(cbt::NodeId);
  void draw(const cbt::Place&, unsigned planes, const Frustum&);

  Options options_;
  rtin::NestedErrors errors_;
  cbt::Bisection bisection_;
  cbt::BitTree tree_;
  double pixels_ = knob().fallback;
  std::vector<Decision> decisions_;   // of a pass
  std::vector<cbt::NodeId> touched_;  // nodes that may decide otherwise in the next pass
  FreshFrame frame_;
};

}  // namespace terrabench
