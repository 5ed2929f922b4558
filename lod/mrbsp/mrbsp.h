// Level of detail by a bisection tree (MRBSP paper, §3 and §4): the tree is walked from its square, a
// triangle is drawn at the depth that the distance D of its furthest corner asks for, and what cannot be seen
// from the ground around is left out. Nothing but heights, bounds of the upper triangles and a bit a vertex
// is held.
//
// Threshold. Printed: depth M - log2(D/S), S the short side of the smallest triangles. Bisection halves the
// area and not the side, so that the apparent side falls with 1/√D; M - 2·log2(D/S) keeps it the same. The
// paper's figure counts whole thresholds: ours are rounded up, so no triangle is larger than asked. The
// `size` knob multiplies S.
//
// Holes. Printed: a triangle whose right angle alone has a lower threshold than its other two corners is
// drawn as its two halves. That looks at one triangle and leaves holes where neighbours differ otherwise.
// Conforming: a cut needs the cuts of the two triangles that made its own (BisectionTree::parents), so these
// are made too, as few as are needed, whatever the threshold says.
//
// Any field: the tree's square reaches over its far borders, and vertices out there stand on the border. That
// keeps order and orientation in x and in z, so the triangles still cover the field once; the flat ones are
// left out. update() is O(triangles drawn).
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "lod/lod.h"
#include "lod/mrbsp/bisection_tree.h"
#include "lod/mrbsp/visibility.h"

namespace terrabench {

class Frustum;

struct MrbspOptions {
  int depth = 0;                 // M; 0: as deep as the samples go
  bool area_consistent = false;  // threshold M - 2·log2(D/S)
  bool conforming = true;        // no holes at all
  bool cull = true;              // leave out what the view does not see
  bool three_nearest = false;    // heights by the paper's interpolation; false: the samples themselves
  bool visibility = false;       // leave out what the ground hides
  VisibilityOptions visible;     // how it is found
};

class Mrbsp : public Lod {
 public:
  // The field must outlive it.
  static std::unique_ptr<Lod> build(const Heightfield&, const Parameters&, Progress&);
  static std::span<const ParameterSpec> parameters();
  static Knob knob() { return {"size", "short sides", 65536, 1.0 / 64, 1, false}; }

  Mrbsp(const Heightfield&, const MrbspOptions&, Progress&);
  // With a visibility that was computed before, for the same heights and depth: throws usage_error for one of
  // other ground.
  Mrbsp(const Heightfield&, const MrbspOptions&, VisibilityTable, Progress&);
  const Frame& update(const View&) override;
  void tune(double size) override { size_ = setting(knob(), size); }
  Memory memory() const override;

  const BisectionTree& tree() const { return tree_; }
  float short_side() const { return short_side_; }  // S, metres
  // The whole depth that a vertex asks for, 1 … M, as the paper's figure 1 marks it.
  int threshold(const glm::vec3& eye, const glm::vec3& vertex) const;
  const VisibilityTable& visibility() const { return visibility_; }
  // Does the set of visible triangles hold for this eye? Not for one outside, nor under the finest triangles,
  // nor above the height that it was computed for, over the samples or these triangles: then everything is
  // drawn.
  bool on_the_ground(const glm::vec3& eye) const;

 private:
  struct Range {
    float lowest, highest;
  };
  // A triangle that distance leaves whole, until all cuts are known.
  struct Whole {
    std::array<std::uint16_t, 2> apex, left, right;  // lattice
    std::uint32_t node;
    unsigned planes;  // of the view, that it may cross
  };
  class Walk;

  void find_bounds(Progress&);
  void find_visibility(VisibilityTable);

  MrbspOptions options_;
  Heightfield interpolated_;  // empty when the samples are taken as they are
  GroundGrid grid_;
  BisectionTree tree_;
  float short_side_ = 1;
  double size_ = 1;
  int bounds_depth_ = 1;
  std::vector<Range> bounds_;          // of the triangle's whole subtree, by node number
  std::vector<std::uint64_t> cuts_;    // a bit a lattice vertex: conforming only
  std::vector<std::uint32_t> marked_;  // words of cuts_ that are not zero
  std::vector<Whole> whole_;
  VisibilityTable visibility_;
  VisibleNodes visible_;
  std::vector<std::uint32_t> indices_, next_;
  std::vector<Batch> batches_;
  std::vector<DirtyRange> uploads_;
  Frame frame_;
  bool first_ = true;
};

}  // namespace terrabench
