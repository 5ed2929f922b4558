// Detail in three dimensions near the eye, a clipmap beyond (hybrid paper, §3.5): the centre of the clipmap's
// finest level is cut out and replaced by chunks of a near surface, such as an implicit surface with
// overhangs and caves, which is joined to the clipmap's heights around its rim (rim.h).
//
// One update(): the near chunks are those up to `radius` chunks from the eye's own. Chunks that are missing
// are built, those whose place relative to the rim changed are joined anew, the clipmap gets a hole of their
// outline, and up to `ahead` chunks of those next to the near ones are queued for background threads, nearest
// first. A frame does not depend on threads: it waits for the chunks that it needs.
//
// Where the paper leaves a choice: chunks are whole cells of the clipmap, so that the cut leaves no
// T-junctions; the hole is a rectangle around the eye; the transition to coarser levels begins outside it.
// While the eye is farther above or below the ground than the near chunks reach in plan, the clipmap is drawn
// alone.
//
// Without a near surface (LodGround::near_surface), the heights themselves are cut into chunks. update():
// O(triangles of the chunks that changed) besides the clipmap's own cost, and O(radius²) to list chunks.
//
// To follow a frame: Hybrid::update() and collect() in hybrid.cpp; ChunkStore::get() and build()
// (chunk_store.cpp); join() in hybrid.cpp and in rim.cpp. What can wait: the clipmap (clipmap.h), chunks cut
// from heights (height_chunks.h), building ahead, edits.
#pragma once

#include <memory>
#include <vector>

#include "lod/clipmap/clipmap.h"
#include "lod/hybrid/chunk_layout.h"
#include "lod/hybrid/chunk_store.h"
#include "lod/hybrid/height_chunks.h"
#include "lod/lod.h"

namespace terrabench {

struct HybridOptions {
  int radius = 2;  // near chunks on each side of the eye's
  int ahead = 4;   // chunks queued per frame; 0: all are built when they are needed
  int band = 8;    // samples from the rim within which near points move towards the far heights
  // Metres above or below the ground up to which an eye sees the near surface; 0: `radius` chunks and a half.
  double height = 0;
  // False leaves the near surface as it is: the cut alone, with gaps along the rim. For measurements.
  bool interpolate = true;
  bool stitch_far = true;  // of the clipmap; for measurements
};

class Hybrid : public Lod {
 public:
  static std::unique_ptr<Lod> build(const LodGround&, const Parameters&, Progress&);
  static Knob knob() { return Clipmap::knob(); }
  static std::span<const ParameterSpec> parameters();

  // Throws usage_error when the chunks do not fit the heights (layout_of()), the band is wider than a chunk,
  // or no clipmap's window is large enough for the radius.
  Hybrid(const LodGround&, const HybridOptions&);

  // Throws what building a chunk throws, and bad_input for a near surface with openings at its rim. An edit
  // of the near surface shows in the next update.
  const Frame& update(const View&) override;
  // Near chunks that a small window cannot hold are not drawn, beginning with the outermost.
  void tune(double window) override { far_->tune(window); }
  // Of the heights: the near surface of ground that has another one is edited by its owner. Builds the near
  // chunks again that contain an edited sample.
  void edited(const SampleRect&) override;
  // The smallest window that holds all near chunks.
  int least_window() const { return Clipmap::window_of(reach()); }
  Memory memory() const override;

  // Waits until no background thread reads the near surface. To be called before an edit of it.
  void finish() const { store_->finish(); }

  // The outline of the near surface in the last frame, samples; low = high: none.
  const hybrid::Outline& near_outline() const { return outline_; }
  // Chunks that an update needed and that no earlier one had queued; those of the first frame included.
  std::size_t late() const { return late_; }
  std::size_t built() const { return store_->built(); }

 private:
  struct Square {  // chunks [low, high)
    glm::ivec2 low{0}, high{0};
    bool empty() const { return low.x >= high.x || low.y >= high.y; }
  };
  glm::dvec2 eye_in_chunks(const View&) const;
  double height_over_ground(const View&, glm::dvec2 eye) const;
  Square chunks_around(glm::dvec2 eye, int radius) const;
  hybrid::Outline outline_of(const Square&) const;
  int radius_in_window() const;
  double near_height() const;
  void collect(const Square& near);
  void join(hybrid::Chunk&);
  void list(const View&);
  void queue_ahead(const Square& around, glm::dvec2 eye);
  int reach() const;

  const Heightfield& heights_;
  HybridOptions options_;
  std::unique_ptr<hybrid::HeightChunks> own_;  // when the ground has no near surface
  hybrid::ChunkLayout layout_;
  std::unique_ptr<Clipmap> far_;
  std::unique_ptr<hybrid::ChunkStore> store_;
  std::vector<hybrid::Chunk*> near_;  // in this frame
  hybrid::Outline outline_;
  std::uint64_t frames_ = 0, ids_ = 0;
  std::size_t late_ = 0, changes_ = 0;
  std::vector<std::pair<double, glm::ivec2>> candidates_;  // for the queue: distance and chunk
  std::vector<FrameMesh> meshes_;
  std::vector<DirtyRange> uploads_;
  Frame frame_;
};

}  // namespace terrabench
