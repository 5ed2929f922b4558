// Geometry clipmaps (Losasso & Hoppe 2004): nested windows of n × n samples around the eye, each twice as
// coarse as the one inside it, held toroidally so that a move of the eye refills only the strips that came
// into view.
//
// Where the paper leaves a choice: levels are every second sample of the one below, not filtered, so that a
// vertex has one height in all levels; a window follows the eye in steps of two of its samples; levels are
// skipped while the eye is higher than 0.4 of their window's extent over the ground (§3.2); the transition is
// a tenth of the window wide (§3.3); blocks are culled by the heights that lie in them now.
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

  int levels() const { return static_cast<int>(levels_.size()); }
  int window() const { return window_.n; }

 private:
  struct Level {
    std::vector<float> heights;  // side², toroidal
    bool filled = false;
    clipmap::HeightBounds heights_of_tiles;
    std::vector<clipmap::HeightBounds::Range> ranges;  // of what each block can show: ring, middle, trims
  };

  void reset(int window);
  glm::vec2 eye_in_samples(const View&) const;
  float ground_below_eye(glm::vec2 eye);
  void move(int level, glm::ivec2 corner);
  void refill(int level, int a, int b, int columns, int rows);
  void bound(int level);
  void draw(int level, int finest, const class Frustum&);
  void draw(int level, std::size_t slot, const clipmap::Block&, const Frustum&);

  std::unique_ptr<HeightSource> source_;
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
