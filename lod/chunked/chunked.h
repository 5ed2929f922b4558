// Chunked level of detail (Ulrich, "Rendering massive terrains using chunked level of detail control", 2002):
// a quadtree of static meshes, each with half the error of the one above. A frame takes, from the root down,
// the first chunks whose error is small enough on the screen; skirts cover the cracks between them.
//
// The meshes are triangulated by greedy insertion (Garland & Heckbert 1995) without regard to each other, so
// the vertices of neighbours differ along their sides: there are gaps, which the detector counts
// (lod/meters/cracks.h), but none can be seen through. A skirt hangs down to the lowest side of any chunk
// that can be drawn beside it (floors.h). Only skirts that face the eye are drawn.
//
// A chunk is drawn if the largest error of its samples, measured and no less than that of the chunks below,
// is allowed anywhere in its box (lod/screen_bound.h). So the knob bounds the error of every sample in view,
// which the paper's distance to the box does only for a level camera. Level 0 is exact. Coarsest chunks have
// at most 512 cells along a side, so that an edit triangulates few samples again.
//
// The paper's chunks have vertices of their own; here vertices are samples, so heights are stored once for
// all levels. Chunks as in the paper, loaded from disk, are in paged_chunked.h. A chunk pops by up to twice
// the knob when its level changes. With `morph`, its vertices move to the next coarser chunk's surface, by a
// share that follows the error that is allowed, so that the knob still bounds the error. That halves the
// popping, but cannot end it: the coarser chunk has other triangles, and level 0, which has no vertices of
// its own, does not morph.
//
// To follow a frame: update(), select(), draw(); to follow what is built, chunk_store.h and chunk_mesh.h.
// update(): O(chunks in view), 0.2 µs each (tests/bench/chunked_bench); uploads nothing but commands.
// Building: O(samples · levels · log vertices), in parallel. Memory: 1 to 34 bytes per sample on the
// reference grounds, as they are smooth or rough.
#pragma once

#include <vector>

#include "lod/chunked/floors.h"
#include "lod/lod.h"
#include "lod/screen_bound.h"
#include "terrain/frustum.h"

namespace terrabench {

class Chunked : public Lod {
 public:
  using Options = chunked::Options;

  // The field must outlive it.
  static std::unique_ptr<Lod> build(const LodGround&, const Parameters&, Progress&);
  static Knob knob() { return {"error", "px", 0.05, 200, 2}; }
  static std::span<const ParameterSpec> parameters();

  Chunked(const Heightfield&, const Options&, Progress&);
  const Frame& update(const View&) override;
  void tune(double pixels) override { pixels_ = setting(knob(), pixels); }
  // Triangulates all chunks again that contain an edited sample.
  void edited(const SampleRect&) override;
  Memory memory() const override;

  const chunked::NodeTree& tree() const { return tree_; }
  const chunked::ChunkStore& chunks() const { return chunks_; }
  // How far a chunk has morphed, 0 to 1, where so many metres of error are allowed.
  float share(int level, int x, int z, float allowed) const;

 private:
  struct Shown {
    int level, x, z;
    float share = 0;
  };
  struct Sights;
  void select(const Shown&, unsigned planes, const Sights&);
  void draw(const Shown&, const glm::vec3& eye);
  void make_frame();

  GroundGrid grid_;
  Options options_;
  double pixels_ = knob().fallback;
  chunked::NodeTree tree_;
  chunked::ChunkStore chunks_;
  std::optional<chunked::Floors> floors_;  // with skirts

  std::vector<Shown> shown_, last_shown_;
  std::vector<std::uint8_t> was_shown_;  // by number of the chunk: 1 if the last frame drew it
  std::vector<Batch> batches_;
  std::vector<DirtyRange> uploads_, edits_;  // edits_: heights, for the next frame
  Frame frame_;
  bool first_ = true;
};

}  // namespace terrabench
