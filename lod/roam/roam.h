// Real-time optimally adapting meshes (Duchaineau, Wolinsky, Sigeti, Miller, Aldrich and Mineev-Weinstein
// 1997): binary triangle trees under two priority queues, one of triangles to split and one of diamonds to
// merge, so that each frame starts from the mesh of the last.
//
// The screen-space error of every visible sample stays at or below the knob, unless the limit on triangles or
// on time stops refinement first. At the limit on triangles, the error of a new mesh is even, to a bucket
// (1/16 octave); while the camera moves, a diamond whose priority falls may be merged late (`exact_from_`).
// The mesh never has cracks. The same views give the same triangles, unless time is limited. A frame costs
// O(changes · log samples), plus the triangles on the view's border and those with expired priorities.
//
// To follow one split (of the glossary: diamond, priority, bisect, split, force_split): the comment of Node
// (node.h); refinement.cpp from its start, of refine() the branch that splits the highest leaf, then
// force_split(), split_diamond(), add_children() and withdraw_parents(); and in mesh.cpp bisect_diamond().
// After refine(), update() fills the merge queue (queue_split_diamonds()), repeats both while
// lower_exact_bucket() says so, then draws and defers the leaves that remain (finish_ranked_leaves()). What
// can wait: these three, the limits and merges in refine(), the validity in rank_leaf(), lattice, wedgies,
// deferral, prefetching and everything degenerate.
//
// Glossary:
//   wedgie       the prism around a triangle that contains its samples and its descendants' wedgies
//   diamond      two triangles with a common hypotenuse, or one at the border; has the smaller node's number
//   distortion   upper bound of a wedgie's screen-space error, in pixels
//   priority     of a leaf: its distortion; of a diamond: the largest distortion that its merge would bring
//                back. A multiple of max_error, kept as the number of its bucket
//   rank         to compute a priority and enter the leaf or diamond into its queue
//   label        which planes of the view a wedgie lies inside (CullLabel)
//   bisect, join what Mesh does to the two triangles of a diamond, without regard to the queues
//   split, merge what Roam does to a diamond: the mesh, the queues, the culling labels, the draw list
//   force_split  splits coarser neighbours first, until the triangle is half of a diamond
//   force_merge  merges degenerate children first
//   degenerate   of a triangle: its corners are collinear in plan, so it must always be split. Only where
//                Lattice::exact is false; skip it at a first reading
//   deferred     not ranked again before the camera has moved so far that the rank may matter
//   exact_from_  lowest bucket in which priorities are kept exact to within one bucket. It lies a little
//                below the bucket where the queues meet; nothing splits or merges further down
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <vector>

#include "lod/lod.h"
#include "lod/roam/deferral_lists.h"
#include "lod/roam/draw_list.h"
#include "lod/roam/mesh.h"
#include "lod/roam/node.h"
#include "lod/roam/wedgie_view.h"

namespace terrabench {

struct RoamOptions {
  double max_error = 1;       // pixels, > 0
  std::size_t triangles = 0;  // largest mesh, triangles outside the view included; 0 for no limit
  double milliseconds = 0;    // per update; 0 for no limit
};

class Roam : public Lod {
 public:
  // The field must outlive it.
  static std::unique_ptr<Lod> build(const LodGround&, const Parameters&, Progress&);
  static std::span<const ParameterSpec> parameters();
  static Knob knob() { return {"max_error", "px", 0.1, 1000, 1, false}; }

  Roam(const Heightfield&, const RoamOptions&, Progress&);
  const Frame& update(const View&) override;
  void tune(double max_error) override;
  // O(edited samples + nodes); O(all samples + nodes) if the edit covers the sample with the largest absolute
  // height, on which the ground's extent depends. The next update() computes all culling labels and
  // priorities anew: O(triangles in the mesh).
  void edited(const SampleRect&) override;
  Memory memory() const override;

 private:
  friend struct RoamAudit;  // tests inspect the state

  // Priority buckets: 16 per octave, from 2^-8 of max_error up. One bucket starts exactly at max_error, so
  // that no triangle within a bucket's width of it is split or kept by mistake.
  static constexpr int kPerOctave = 16;
  static constexpr int kMaxErrorBucket = 8 * kPerOctave + 1;  // + 1: bucket 0 holds everything below 2^-8
  static constexpr int kBuckets = 40 * kPerOctave;
  // A bucket's number plus this is a float's exponent and four bits of its mantissa.
  static constexpr int kFirstBucket = (127 << 4) - kMaxErrorBucket;
  static_assert(kPerOctave == 1 << 4);
  static std::uint16_t bucket_of(double ratio);
  static double lowest_ratio(int bucket);

  // Culling and drawing: roam.cpp.
  void update_labels(std::uint32_t id, roam::CullLabel parent, bool parent_changed);
  void set_label(std::uint32_t id, roam::CullLabel parent, const roam::Corners& corners);
  void limit_ancestors(std::uint32_t id);
  void update_drawn(std::uint32_t id);

  // Refinement: refinement.cpp.

  // The two triangles of a diamond; the second is kNone at the border.
  using Halves = std::array<std::uint32_t, 2>;
  void refine();
  void force_split(std::uint32_t id);
  void split_diamond(std::uint32_t id);
  void withdraw_parents(const Halves&);
  void split_degenerate_children(const Halves&);
  void add_children(std::uint32_t id, const roam::ViewedCorner& apex, const roam::ViewedCorner& left,
                    const roam::ViewedCorner& right, const roam::ViewedCorner& middle);
  void force_merge(std::uint32_t id);
  void merge_diamond(std::uint32_t id);
  std::size_t cost_of_split(std::uint32_t id) const;
  void grow_nodes(std::size_t leaves);
  void prefetch_next_splits(std::uint32_t id) const;
  bool lower_exact_bucket();
  bool out_of_time() const;

  // Diamonds and their queue.
  Halves halves(std::uint32_t id) const { return {id, mesh_.nodes()[id].base}; }
  std::uint32_t diamond_of(std::uint32_t id) const;
  bool mergeable(std::uint32_t id) const;
  void requeue_diamond(std::uint32_t id);
  void unqueue(std::uint32_t id);

  // Priorities and their deferral.
  roam::Distortion distortion(const roam::Node&, const roam::ViewedCorner&, const roam::ViewedCorner&,
                              const roam::ViewedCorner&) const;
  roam::Distortion distortion(std::uint32_t id, const roam::Corners&) const;
  static roam::Validity validity(const roam::Distortion&, double share);
  void rank_leaf(std::uint32_t id, const roam::Distortion&);
  void rank_diamond(std::uint32_t id);
  void rerank(std::uint32_t id);
  void rerank_expired();
  void rerank_all();
  void queue_split_diamonds();
  void finish_ranked_leaves();

  roam::Mesh mesh_;
  RoamOptions options_;
  glm::ivec2 furthest_;  // a sample with the largest absolute height
  double extent_;        // of the ground, metres
  roam::WedgieView view_;
  roam::PriorityQueue splits_{kBuckets}, merges_{kBuckets};
  roam::DeferralLists deferred_;
  roam::DrawList drawn_;
  std::vector<std::uint32_t> expired_;         // nodes to rank again in this frame
  std::vector<std::uint32_t> split_diamonds_;  // split in this frame, not yet in the merge queue
  std::vector<std::uint32_t> ranked_leaves_;   // ranked in this frame, not yet drawn or deferred
  // Per node, the total motion up to which no culling label in its subtree can change.
  struct LabelValidity {
    float moved, turned;
  };
  std::vector<LabelValidity> labels_valid_until_;
  roam::Motion total_motion_;  // since all labels were last computed
  std::vector<Batch> batches_;
  std::vector<DirtyRange> uploads_, edits_;  // edits_: for the next frame
  Frame frame_;
  // Decides when a deferred priority is computed again (rank_leaf(), rank_diamond()). Of a leaf in this
  // bucket or above: as soon as the motion may have changed it by 1/16. Of a leaf below: before it may have
  // risen to this bucket. Of a diamond: before it may have fallen 1/16 below the value that this bucket had
  // when the diamond was ranked; the bucket may have risen since.
  int exact_from_ = kMaxErrorBucket;
  std::size_t changes_ = 0;
  std::chrono::steady_clock::time_point start_;
  bool first_ = true, retuned_ = false;
};

}  // namespace terrabench
