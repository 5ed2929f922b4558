// Continuous distance-dependent level of detail, CDLOD (Strugar, "Continuous Distance-Dependent Level of
// Detail for Rendering Heightmaps", 2009): a quadtree whose nodes are drawn with one grid mesh each, by their
// distance from the eye, and whose vertices morph to the next coarser level before the node changes its
// level. So neighbours agree where levels meet, and nothing pops.
//
// Ranges of levels come from the errors measured on the ground (level_errors.h), so that the error on the
// screen is at most the knob from any eye in any direction; or, `ranges=distance`, as in the paper: each
// level's range is twice as long as the finer one's, and the knob is the size on the screen to which the
// cells of a level shrink before the level ends. Ranges that are too small for the nodes are enlarged, so
// that no setting opens a seam (ranges.h). Ranges hold for the whole ground, so the roughest place decides
// how fine the smooth ones are.
//
// Where the paper is vague or weaker, this was chosen. Vertices morph vertically (MorphingNode). Nodes that
// the ground's border cuts may pop in their last cells: these are narrower, and the diagonals of two levels
// cross there. The coarsest level has cells of at most 128 samples, so that an edit measures few samples
// again.
//
// To follow a frame: update(), then select(), which chooses nodes as the paper does, and draw().
// update(): O(nodes drawn). Memory: with nodes of 16 cells, less than 0.1 byte per sample, and 200 kB of
// index patterns.
#pragma once

#include <vector>

#include "lod/cdlod/level_errors.h"
#include "lod/cdlod/node_patterns.h"
#include "lod/cdlod/node_tree.h"
#include "lod/cdlod/ranges.h"
#include "lod/lod.h"
#include "terrain/frustum.h"

namespace terrabench {

class Cdlod : public Lod {
 public:
  struct Options {
    int side = 16;             // cells along a node's side, a power of two ≥ 4
    bool by_distance = false;  // ranges as in the paper, without the measured errors
    bool morph = true;         // false leaves gaps beside coarser nodes; for measurements
  };

  // The field must outlive it.
  static std::unique_ptr<Lod> build(const LodGround&, const Parameters&, Progress&);
  static Knob knob() { return {"error", "px", 0.05, 200, 2}; }
  static std::span<const ParameterSpec> parameters();

  Cdlod(const Heightfield&, const Options&, Progress&);
  const Frame& update(const View&) override;
  void tune(double pixels) override;
  // Also reads one measure per level and 64 × 64 samples.
  void edited(const SampleRect&) override;
  Memory memory() const override;

  // Of the last update().
  std::span<const cdlod::LevelRange> ranges() const { return ranges_; }

 private:
  struct Shown {
    int level, x, z;
    unsigned quarters;  // bit q: quarter q is drawn at this level
  };

  void choose_ranges(const View&);
  bool reaches(const Bounds&, int level) const;
  void select(int level, int x, int z, unsigned planes, const Frustum&);
  unsigned seams(const Shown&) const;
  void draw(const Shown&);
  void make_frame();

  GroundGrid grid_;
  Options options_;
  double pixels_;
  cdlod::NodeTree tree_;
  cdlod::NodePatterns patterns_;
  cdlod::LevelErrors errors_;
  std::vector<cdlod::LevelNeeds> needs_;   // by level
  std::vector<cdlod::LevelRange> ranges_;  // by level
  std::vector<MorphRange> morph_ranges_;   // by level
  glm::vec3 eye_{0};

  std::vector<Shown> shown_, last_shown_;
  std::vector<std::uint8_t> last_quarters_;  // by number of the node: what the last frame drew
  std::vector<Batch> batches_;
  std::vector<DirtyRange> uploads_, edits_;  // edits_: for the next frame
  Frame frame_;
  bool first_ = true;
};

}  // namespace terrabench
