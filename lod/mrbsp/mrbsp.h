// Level of detail by a bisection tree (MRBSP paper, §3 and §4). The tree is traversed from its square; a
// triangle is drawn at the depth given by the distance D of its furthest corner, and triangles that the
// ground hides from the observer's cell are skipped. Memory: heights, bounds of the upper triangles and one
// bit per vertex.
//
// bisection_tree.h   §2  the tree, without stored nodes; heights from height points: nearest_three.h
// lod_rule.h         §3  the depth at which a triangle is drawn, and how those of different depth meet
// visibility/sets.h  §4  which triangles the ground hides
// tree_walk.h            the traversal that applies them; update() is O(triangles drawn)
//
// To follow a frame: bisection_tree.h to the numbering of nodes; lod_rule.h; TreeWalk in tree_walk.cpp;
// Mrbsp::update() and publish(). Then visibility: the opening comment of visibility/sets.h,
// find_sets(), and Flags::move_to(). What can wait: heights by interpolation, area_occlusion.h, the codec and
// its two forms.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "lod/lod.h"
#include "lod/mrbsp/bisection_tree.h"
#include "lod/mrbsp/tree_walk.h"

namespace terrabench {

struct MrbspOptions {
  int depth = 0;                 // M; 0: down to every sample
  bool area_consistent = false;  // threshold M - 2·log2(D/S); false: the printed one
  HoleRule holes = HoleRule::kConforming;
  bool cull = true;            // skip triangles outside the view frustum
  bool three_nearest = false;  // heights by the paper's interpolation; false: the samples themselves
  bool visibility = false;     // skip triangles that the ground hides
  mrbsp::visibility::Options visible{};  // how the visible sets are computed
};

class Mrbsp : public Lod {
 public:
  // The field must outlive it.
  static std::unique_ptr<Lod> build(const LodGround&, const Parameters&, Progress&);
  static std::span<const ParameterSpec> parameters();
  static Knob knob() { return {"size", "short sides", 65536, 1.0 / 64, 1, false}; }

  // With options.visibility: `visibility_file` stores the change table, see load_or_find(); empty: no file.
  Mrbsp(const Heightfield&, const MrbspOptions&, Progress&,
        const std::filesystem::path& visibility_file = {});
  // Uses a change table computed before. Throws usage_error if it is for other ground or another depth.
  Mrbsp(const Heightfield&, const MrbspOptions&, mrbsp::visibility::ChangeTable, Progress&);
  const Frame& update(const View&) override;
  void tune(double size) override { size_ = setting(knob(), size); }
  // O(triangles that touch the samples), unless heights are interpolated, which are then computed anew, or
  // hidden triangles are skipped: visible sets depend on all of the ground, and are found anew.
  void edited(const SampleRect&) override;
  Memory memory() const override;

  const BisectionTree& tree() const { return tree_; }
  float short_side() const { return short_side_; }  // S, metres
  // The vertex's LOD threshold as in the paper's figure 1, clamped to 1 … M.
  int threshold(const glm::vec3& eye, const glm::vec3& vertex) const;
  const mrbsp::visibility::ChangeTable& visibility() const { return visibility_; }
  // Whether the visible sets hold for this eye: inside the field, not below the finest triangles, and at most
  // the eye height above the samples or these triangles. For other eyes, update() skips no hidden triangles.
  bool on_the_ground(const glm::vec3& eye) const;

 private:
  LodRule rule() const { return {tree_.depth(), size_ * short_side_, options_.area_consistent}; }
  void use_visibility(mrbsp::visibility::ChangeTable);
  void publish(std::size_t toggled);

  const Heightfield& ground_;
  MrbspOptions options_;
  Heightfield interpolated_;  // empty if the heights are the samples
  GroundGrid grid_;
  BisectionTree tree_;
  float short_side_ = 1;
  double size_ = 1;
  TriangleBounds bounds_;
  std::optional<SplitVertices> splits_;  // conforming only
  std::vector<PendingTriangle> pending_;
  mrbsp::visibility::ChangeTable visibility_;
  mrbsp::visibility::Flags flags_;
  std::vector<std::uint32_t> indices_, next_;
  std::vector<Batch> batches_;
  std::vector<DirtyRange> uploads_, edits_;  // edits_: for the next frame
  Frame frame_;
  bool first_ = true;
};

}  // namespace terrabench
