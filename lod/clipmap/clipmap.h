// Geometry clipmaps (Losasso & Hoppe 2004; the hybrid paper uses them, §3.2): nested windows of n × n samples
// around the eye, each twice as coarse as the one inside it. Windows are stored toroidally, so that a move of
// the eye reads only the strips that entered a window. As in the form for the GPU (Asirvatham & Hoppe 2005),
// blocks and indices never change, heights alone are sent, and the vertex shader blends them between levels;
// decoding heights as differences from the coarser level, on the GPU, is left out.
// Lattice coordinates number a level's own samples: (a, b) is sample (a·2^level, b·2^level) of the terrain. A
// window has n = 4m - 1 samples per side; a row of its array has the next power of two (terrain/frame.h).
//
// One update(): find the finest level by the eye's height; move each window, read its new strips and update
// its blocks' height ranges; set the transitions; append a batch for each block that is not culled.
// To follow a move of the eye: ClipLevel (terrain/frame.h), then update(), move_window() and read_strip(),
// which stand together in clipmap.cpp. What can wait: holes, endless ground, transitions and the pattern.
//
// update(): O(n) per window that moved by a step, and O(levels) to cull and draw. Memory: 4 bytes per sample
// of each window; the terrain's size affects only the number of levels.
#pragma once

#include <memory>
#include <vector>

#include "lod/clipmap/height_bounds.h"
#include "lod/clipmap/height_source.h"
#include "lod/clipmap/window_pattern.h"
#include "lod/lod.h"

namespace terrabench {

class Clipmap : public Lod {
 public:
  // The field must outlive it.
  static std::unique_ptr<Lod> build(const LodGround&, const Parameters&, Progress&);
  static Knob knob() { return {"window", "samples", 4095, 15, 255, true}; }

  static std::span<const ParameterSpec> parameters();

  // `window`: samples per side, rounded to 4m - 1 ≥ 15 and limited to what covers the ground. `stitch`: false
  // leaves gaps between the levels, without transitions; for measurements.
  Clipmap(std::unique_ptr<HeightSource> source, int window, bool stitch = true);

  const Frame& update(const View&) override;
  void tune(double window) override;
  // Reads these samples again at the next update(), in every window that holds some of them.
  void edited(const SampleRect&) override;
  Memory memory() const override;

  // From the next update() on, views and frames count metres from this sample. Throws usage_error when the
  // sample is not on the ground. Over endless ground (endless_heights()), move it along with the eye, so that
  // coordinates stay small enough for a float; this is free, since windows are placed by whole samples.
  void move_origin(glm::ivec2 sample);
  glm::ivec2 origin() const { return origin_; }

  // From the next update() on, the finest level is drawn at any height of the eye, but not its cells from
  // sample `low` to sample `high`, where something else is drawn; its transition begins outside them. low =
  // high: no hole. The next update() throws usage_error when the hole reaches more than reach_of(window())
  // samples from the eye along an axis, or beyond the ground.
  void set_hole(glm::ivec2 low, glm::ivec2 high);
  static int reach_of(int window);
  // The smallest window with at least this reach; see also the constructor.
  static int window_of(int reach);

  int levels() const { return static_cast<int>(storage_.size()); }
  int window() const { return pattern_.n; }

 private:
  // What a level stores: the samples that its ClipLevel points to, and for each block (ring, middle and
  // trims, in this order) its height range and the index ranges to draw.
  struct LevelStorage {
    std::vector<float> heights;  // side², toroidal
    bool filled = false;
    clipmap::HeightBounds tile_bounds;
    std::vector<clipmap::HeightBounds::Range> block_heights;
    std::vector<std::uint32_t> block_ends;  // in `ranges`
    std::vector<IndexRange> ranges;
  };

  void reset(int window);
  void add_level();
  void add_levels_in_sight(const View&);
  glm::dvec2 eye_in_samples(const View&) const;
  float ground_below_eye(glm::dvec2 eye);
  void set_transition(int level, float rise);
  void move_window(int level, glm::ivec2 corner);
  void read_strip(int level, int a, int b, int columns, int rows);
  void read_edit(int level, const SampleRect&);
  void update_blocks(int level);
  bool has_hole() const { return hole_low_ != hole_high_; }
  void check_hole(glm::dvec2 eye);
  void draw_level(int level, int finest, const class Frustum&);
  void draw_block(int level, std::size_t number, const clipmap::Block&, const Frustum&);

  std::unique_ptr<HeightSource> source_;
  bool stitch_;
  glm::ivec2 origin_{0};
  glm::ivec2 hole_low_{0}, hole_high_{0};  // samples
  float hole_reach_ = 0;                   // from the eye, samples, in this update
  bool hole_cut_ = true;                   // out of the index ranges
  clipmap::WindowPattern pattern_;
  std::vector<ClipLevel> clip_levels_;  // per level, finest first: as the frame describes them
  std::vector<LevelStorage> storage_;   // per level
  std::vector<Batch> batches_;
  std::vector<DirtyRange> uploads_;
  std::vector<SampleRect> edits_;  // since the last update
  bool indices_uploaded_ = false;
  std::size_t moved_ = 0;  // windows, in this update
  Frame frame_;
};

}  // namespace terrabench
