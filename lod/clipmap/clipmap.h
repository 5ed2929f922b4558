// Geometry clipmaps (Losasso & Hoppe 2004): nested windows of n × n samples around the eye, each twice as
// coarse as the one inside it, held toroidally so that a move of the eye refills only the strips that came
// into view.
//
// Where the paper leaves a choice: levels are every second sample of the one below, not filtered, so that a
// vertex has one height in all levels; a window follows the eye in steps of two of its samples; levels are
// skipped while the eye is higher than 0.4 of their window's extent over the ground (§3.2); the transition is
// a tenth of the window wide (§3.3); blocks are culled by the heights that lie in them now, and cut at the
// border of bounded ground, beyond which triangles have no plan area.
//
// Endless ground (endless_heights.h) has as many levels as the far plane asks for (up to 2^26 samples away),
// so that no edge comes into sight. What stands at x = z = 0 can be moved along with the eye: it costs
// nothing, since windows are held by whole samples, and metres stay small enough for a float wherever the eye
// goes.
//
// update(): O(n) a window that moved by a step, for its strips and their bounds, and O(levels) to draw.
// Memory: 4 bytes a sample of each window; nothing that depends on the terrain's size but the number of
// levels.
#pragma once

#include <memory>
#include <vector>

#include "lod/clipmap/height_bounds.h"
#include "lod/clipmap/height_source.h"
#include "lod/clipmap/window.h"
#include "lod/lod.h"

namespace terrabench {

class Clipmap : public Lod {
 public:
  // The field must outlive it.
  static std::unique_ptr<Lod> build(const Heightfield&, const Parameters&, Progress&);
  static Knob knob() { return {"window", "samples", 4095, 15, 255, true}; }

  // `window` samples a side, rounded to 4m - 1 ≥ 15, and no more than cover the ground.
  Clipmap(std::unique_ptr<HeightSource> source, int window);

  const Frame& update(const View&) override;
  void tune(double window) override;
  Memory memory() const override;

  // From the next update() on, views and frames count metres from this sample. Throws usage_error where the
  // ground has none.
  void move_origin(glm::ivec2 sample);
  glm::ivec2 origin() const { return origin_; }

  int levels() const { return static_cast<int>(levels_.size()); }
  int window() const { return window_.n; }

 private:
  struct Level {
    std::vector<float> heights;  // side², toroidal
    bool filled = false;
    clipmap::HeightBounds heights_of_tiles;
    // Of each block, ring, middle and trims: between which heights it lies, and what to draw of it.
    std::vector<clipmap::HeightBounds::Range> ranges;
    std::vector<std::uint32_t> run_ends;
    std::vector<clipmap::Run> runs;
  };

  void reset(int window);
  void add_level();
  void reach(const View&);
  glm::dvec2 eye_in_samples(const View&) const;
  float ground_below_eye(glm::dvec2 eye);
  void blend(int level, float rise);
  void move(int level, glm::ivec2 corner);
  void refill(int level, int a, int b, int columns, int rows);
  void bound(int level);
  void draw(int level, int finest, const class Frustum&);
  void draw(int level, std::size_t slot, const clipmap::Block&, const Frustum&);

  std::unique_ptr<HeightSource> source_;
  glm::ivec2 origin_{0};
  clipmap::Window window_;
  std::vector<Level> levels_;
  std::vector<ClipLevel> shown_;
  std::vector<Batch> batches_;
  std::vector<DirtyRange> uploads_;
  bool indices_uploaded_ = false;
  std::size_t moved_ = 0;
  Frame frame_;
};

}  // namespace terrabench
