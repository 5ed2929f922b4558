// Level of detail by a bisection tree (MRBSP paper, §3 and §4): the tree is walked from its square, a
// triangle is drawn at the depth that the distance D of its furthest corner asks for, and what cannot be seen
// from the ground around is left out. Nothing but heights, bounds of the upper triangles and a bit a vertex
// is held.
//
// lod_rule.h says at which depth a triangle is drawn, hole_rule.h how neighbours of different depths meet,
// visible_flags.h what the ground hides, tree_walk.h puts them together. update() is O(triangles drawn).
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "lod/lod.h"
#include "lod/mrbsp/bisection_tree.h"
#include "lod/mrbsp/tree_walk.h"
#include "lod/mrbsp/visibility.h"

namespace terrabench {

struct MrbspOptions {
  int depth = 0;                 // M; 0: as deep as the samples go
  bool area_consistent = false;  // threshold M - 2·log2(D/S)
  bool conforming = true;        // no holes at all
  bool cull = true;              // leave out what the view does not see
  bool three_nearest = false;    // heights by the paper's interpolation; false: the samples themselves
  bool visibility = false;       // leave out what the ground hides
  VisibilityOptions visible{};   // how it is found
};

class Mrbsp : public Lod {
 public:
  // The field must outlive it.
  static std::unique_ptr<Lod> build(const Heightfield&, const Parameters&, Progress&);
  static std::span<const ParameterSpec> parameters();
  static Knob knob() { return {"size", "short sides", 65536, 1.0 / 64, 1, false}; }

  // A file, when one is named, keeps the visibility: see kept_visibility().
  Mrbsp(const Heightfield&, const MrbspOptions&, Progress&,
        const std::filesystem::path& visibility_file = {});
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
  LodRule rule() const { return {tree_.depth(), size_ * short_side_, options_.area_consistent}; }
  void take_visibility(VisibilityTable);
  void publish(std::size_t toggled);

  MrbspOptions options_;
  Heightfield interpolated_;  // empty when the samples are taken as they are
  GroundGrid grid_;
  BisectionTree tree_;
  float short_side_ = 1;
  double size_ = 1;
  TriangleBounds bounds_;
  std::optional<Cuts> cuts_;  // conforming only
  std::vector<WholeTriangle> whole_;
  VisibilityTable visibility_;
  VisibleFlags flags_;
  std::vector<std::uint32_t> indices_, next_;
  std::vector<Batch> batches_;
  std::vector<DirtyRange> uploads_;
  Frame frame_;
  bool first_ = true;
};

}  // namespace terrabench
