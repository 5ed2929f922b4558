// Real-time optimally adapting meshes (Duchaineau, Wolinsky, Sigeti, Miller, Aldrich and Mineev-Weinstein
// 1997): binary triangle trees under two priority queues, one of triangles to split and one of diamonds to
// merge, that carry the last frame's mesh over to the next.
//
// The screen-space error of every sample that shows stays at or below the knob, unless the limit on triangles
// or on time stops refinement first; then what is left is spread evenly, to a bucket (1/16 octave). The mesh
// never has cracks. Same views, same triangles, unless time is limited. A frame costs O(changes log samples),
// besides the triangles on the view's border and those whose priority the motion may have changed.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <vector>

#include "lod/lod.h"
#include "lod/roam/camera.h"
#include "lod/roam/deadlines.h"
#include "lod/roam/draw_list.h"
#include "lod/roam/mesh.h"
#include "lod/roam/node.h"

namespace terrabench {

struct RoamOptions {
  double max_error = 1;       // pixels, > 0
  std::size_t triangles = 0;  // in the whole mesh, those outside the view included; 0 for no limit
  double milliseconds = 0;    // an update; 0 for no limit
};

class Roam : public Lod {
 public:
  // The field must outlive it.
  static std::unique_ptr<Lod> build(const Heightfield&, const Parameters&, Progress&);
  static std::span<const ParameterSpec> parameters();
  static Knob knob() { return {"max_error", "px", 0.1, 1000, 1, false}; }

  Roam(const Heightfield&, const RoamOptions&, Progress&);
  const Frame& update(const View&) override;
  void tune(double max_error) override;
  Memory memory() const override;

 private:
  friend struct RoamAudit;  // tests look inside

  // Buckets of priorities, 16 an octave, from 2^-8 of the asked error up. The asked error begins a bucket, so
  // that none is split or kept for a bucket's width.
  static constexpr int kPerOctave = 16;
  static constexpr int kAsked = 8 * kPerOctave + 1;
  static constexpr int kBuckets = 40 * kPerOctave;
  // A bucket's number, from this on, is a float's exponent and four bits of its mantissa.
  static constexpr int kFirst = (127 << 4) - kAsked;
  static_assert(kPerOctave == 1 << 4);
  static std::uint16_t bucket_of(double ratio);
  static double ratio_from(int bucket);

  void look(std::uint32_t id, roam::Sight parent, bool parent_changed);
  void see(std::uint32_t id, roam::Sight parent, const roam::Corners& corners);
  void reconsider(std::uint32_t id);
  void reconsider_due();
  void reconsider_all();
  void rank_leaf(std::uint32_t id, const roam::Distortion&);
  void rank_diamond(std::uint32_t id);
  void rank_pending();
  static roam::Patience patience(const roam::Distortion&, double share);
  void place_fresh();
  void take_off(std::uint32_t id);
  roam::Distortion distortion(const roam::Node&, const roam::Spot&, const roam::Spot&,
                              const roam::Spot&) const;
  roam::Distortion distortion(std::uint32_t id, const roam::Corners&) const;

  // The two halves of a diamond, the second kNone on the border.
  std::array<std::uint32_t, 2> halves(std::uint32_t id) const { return {id, mesh_.nodes()[id].base}; }
  std::uint32_t diamond(std::uint32_t id) const;
  bool mergeable(std::uint32_t id) const;
  void requeue_diamond(std::uint32_t id);
  void disturb_ancestors(std::uint32_t id);
  void show(std::uint32_t id);
  void split(std::uint32_t id);
  void split_diamond(std::uint32_t id);
  void add_children(std::uint32_t id, const roam::Spot& apex, const roam::Spot& left, const roam::Spot& right,
                    const roam::Spot& middle);
  void merge(std::uint32_t id);
  void merge_diamond(std::uint32_t id);
  std::size_t cost_of_split(std::uint32_t id) const;
  void fetch_ahead(std::uint32_t id) const;
  void settle();
  bool lower_reference();
  bool out_of_time() const;

  roam::Mesh mesh_;
  RoamOptions options_;
  double extent_;  // of the ground, metres
  roam::Camera camera_;
  roam::PriorityQueue splits_{kBuckets}, merges_{kBuckets};
  roam::Deadlines deadlines_;
  roam::DrawList drawn_;
  std::vector<std::uint32_t> due_;      // whose priority must be looked at
  std::vector<std::uint32_t> pending_;  // diamonds of this frame that are not in the merge queue yet
  std::vector<std::uint32_t> fresh_;    // leaves ranked in this frame
  // For each node, the journey up to which no sight in its subtree changes.
  struct Quiet {
    float moved, turned;
  };
  std::vector<Quiet> quiet_;
  roam::Motion journey_;  // all motion since quiet_ was made anew
  std::vector<Batch> batches_;
  std::vector<DirtyRange> uploads_;
  Frame frame_;
  // No leaf whose priority is put off has risen to this bucket: above it the order of the queue is right.
  int reference_ = kAsked;
  std::size_t changes_ = 0;
  std::chrono::steady_clock::time_point start_;
  bool first_ = true, retuned_ = false;
};

}  // namespace terrabench
