// Where this departs from Losasso & Hoppe 2004, or they leave a choice: a level is every second sample
// of the finer one, not filtered, so that a vertex has one height in all levels. A window follows the eye in
// steps of two of its samples. A level is left out while the eye's height over the ground exceeds 0.4 of its
// window's extent (§3.2). The transition is a tenth of the window wide (§3.3). Blocks are culled by their
// present heights. Over bounded ground, blocks are cut at the border, beyond which triangles have no plan
// area.
#include "lod/clipmap/clipmap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "terrain/error.h"
#include "terrain/frustum.h"
#include "terrain/memory.h"

namespace terrabench {
namespace {

// A level is left out while the eye's height over the ground exceeds this share of its window's extent.
constexpr float kHighestEye = 0.4F;
constexpr float kTransition = 0.1F;              // width, as a share of the window's side
constexpr int kSmallestM = 4, kLargestM = 1024;  // m determines the window's side: window_pattern.h
constexpr float kLeastDivisor = 1e-6F;           // in set_transition(): keeps the width finite

// Largest distance to which endless ground is drawn, samples, so that all sample numbers fit into an int.
constexpr double kFarthestSight = 1 << 26;

// Width of the transition in a window of n samples.
float transition_width(int n) { return std::max(1.0F, kTransition * static_cast<float>(n)); }

// Samples of bounded ground along its longer side.
int longest(const HeightSource& source) {
  const glm::ivec2 samples = source.last() - source.first() + 1;
  return std::max(samples.x, samples.y);
}

// Limits m to what covers the ground from any eye position: a larger window only adds triangles beyond the
// border.
int m_of(const HeightSource& source, int window) {
  const int covering =
      source.bounded() ? std::clamp(longest(source) / 2 + 2, kSmallestM, kLargestM) : kLargestM;
  return std::clamp((window + 1) / 4, kSmallestM, covering);
}

// The number of levels whose coarsest window reaches at least `samples` from any position of the eye in it.
int level_count(double samples, int n) {
  int levels = 1;
  while (std::ldexp(n / 2 - 1, levels - 1) < samples) ++levels;
  return levels;
}

// Distance to a corner of the far plane, metres: how far ground can be seen.
double sight(const View& view) {
  const double up = std::tan(0.5 * view.vertical_fov), aside = up * view.width / view.height;
  return view.far * std::sqrt(1 + up * up + aside * aside);
}

// Floor of eye / spacing as a whole number.
int lattice_floor(double eye, int spacing) { return static_cast<int>(std::floor(eye / spacing)); }

// Ceiling of samples / spacing, a power of two.
int ceiling(int samples, int spacing) {
  return static_cast<int>((static_cast<std::int64_t>(samples) + spacing - 1) & -spacing) / spacing;
}

}  // namespace

std::span<const ParameterSpec> Clipmap::parameters() {
  static const ParameterSpec kSpecs[] = {
      {"stitch", true, "", "join each level to the next coarser one; false leaves gaps between them"}};
  return kSpecs;
}

std::unique_ptr<Lod> Clipmap::build(const LodGround& from, const Parameters& parameters, Progress&) {
  const Heightfield& ground = from.heights;
  check_ground(ground);
  return std::make_unique<Clipmap>(heights_in_memory(ground), static_cast<int>(knob().fallback),
                                   parameters.flag("stitch"));
}

Clipmap::Clipmap(std::unique_ptr<HeightSource> source, int window, bool stitch)
    : source_(std::move(source)), stitch_(stitch) {
  reset(window);
}

void Clipmap::tune(double window) {
  const int samples = static_cast<int>(setting(knob(), window));
  if (m_of(*source_, samples) != pattern_.m) reset(samples);
}

void Clipmap::reset(int window) {
  pattern_ = clipmap::make_window_pattern(m_of(*source_, window), stitch_);
  storage_.clear();
  clip_levels_.clear();
  const int levels = source_->bounded() ? level_count(longest(*source_), pattern_.n) : 1;
  while (this->levels() < levels) add_level();
  indices_uploaded_ = false;
}

void Clipmap::add_level() {
  const std::size_t blocks = pattern_.ring.size() + pattern_.middle.size() + pattern_.trims.size();
  LevelStorage& level = storage_.emplace_back();
  level.heights.assign(static_cast<std::size_t>(pattern_.side) * pattern_.side, 0.0F);
  level.tile_bounds = clipmap::HeightBounds(pattern_.n);
  level.block_heights.assign(blocks, {});
  level.block_ends.assign(blocks, 0);
  clip_levels_.push_back({.side = pattern_.side, .spacing = 1 << (levels() - 1), .heights = level.heights});
  // The most that a frame needs where no border cuts blocks: per level two strips in four parts each, and the
  // indices.
  batches_.reserve(storage_.size() * blocks);
  uploads_.reserve(storage_.size() * 8 + 1);
}

// Over endless ground, adds levels until the coarsest window reaches the far plane, so that no edge is seen.
void Clipmap::add_levels_in_sight(const View& view) {
  if (source_->bounded()) return;
  const double cell = std::min(source_->cell_x(), source_->cell_z());
  const int levels = level_count(std::min(sight(view) / cell, kFarthestSight), pattern_.n);
  while (this->levels() < levels) add_level();
}

void Clipmap::move_origin(glm::ivec2 sample) {
  if (glm::clamp(sample, source_->first(), source_->last()) != sample)
    throw usage_error(fmt::format("sample ({}, {}) is not on the ground", sample.x, sample.y), "origin",
                      "choose a sample of the ground");
  origin_ = sample;
}

int Clipmap::reach_of(int window) {
  const int m = (window + 1) / 4;
  return static_cast<int>(static_cast<float>(2 * m - 3) - transition_width(4 * m - 1));
}

int Clipmap::window_of(int reach) {
  int m = kSmallestM;
  while (m < kLargestM && reach_of(4 * m - 1) < reach) ++m;
  return 4 * m - 1;
}

void Clipmap::set_hole(glm::ivec2 low, glm::ivec2 high) {
  if (low == high) high = low = glm::ivec2(0);
  if (low == hole_low_ && high == hole_high_) return;
  hole_low_ = low;
  hole_high_ = high;
  hole_cut_ = false;
}

// Finds how far the hole reaches. Where one level covers all ground, nothing has to fit around the hole.
void Clipmap::check_hole(glm::dvec2 eye) {
  if (!has_hole()) return;
  const glm::dvec2 reach = glm::max(glm::dvec2(hole_high_) - eye, eye - glm::dvec2(hole_low_));
  hole_reach_ = static_cast<float>(std::max(reach.x, reach.y));
  const bool on_ground = glm::all(glm::greaterThanEqual(hole_low_, source_->first())) &&
                         glm::all(glm::lessThanEqual(hole_high_, source_->last())) &&
                         glm::all(glm::lessThan(hole_low_, hole_high_));
  const bool one_level = levels() == 1 && source_->bounded();
  if (on_ground && (one_level || hole_reach_ <= static_cast<float>(reach_of(pattern_.n)))) return;
  throw usage_error(
      fmt::format("a hole from sample ({}, {}) to ({}, {}) is not on the ground, or reaches {:.0f} samples "
                  "from the eye and the finest window only {}",
                  hole_low_.x, hole_low_.y, hole_high_.x, hole_high_.y, hole_reach_, reach_of(pattern_.n)),
      "hole", "choose a smaller hole or a larger window");
}

// The eye in samples, clamped to the ground.
glm::dvec2 Clipmap::eye_in_samples(const View& view) const {
  const glm::dvec2 eye(view.eye.x / static_cast<double>(source_->cell_x()),
                       view.eye.z / static_cast<double>(source_->cell_z()));
  return glm::clamp(eye + glm::dvec2(origin_), glm::dvec2(source_->first()), glm::dvec2(source_->last()));
}

float Clipmap::ground_below_eye(glm::dvec2 eye) {
  float height = 0;
  source_->read(0, lattice_floor(eye.x, 1), lattice_floor(eye.y, 1), 1, 1, &height, 1);
  return height;
}

const Frame& Clipmap::update(const View& view) {
  check_view(view);
  const glm::dvec2 eye = eye_in_samples(view);
  check_hole(eye);
  batches_.clear();
  uploads_.clear();
  moved_ = 0;
  if (!indices_uploaded_) {
    uploads_.push_back({.target = DirtyRange::Target::kIndices,
                        .count = static_cast<std::uint32_t>(pattern_.indices.size())});
    indices_uploaded_ = true;
  }
  for (const SampleRect& rect : edits_) {
    for (int l = 0; l < levels(); ++l) read_edit(l, rect);
  }
  edits_.clear();
  add_levels_in_sight(view);
  const float height = view.eye.y - ground_below_eye(eye);
  const float cell = std::max(source_->cell_x(), source_->cell_z());
  int finest = 0;  // the finest level that is drawn
  while (!has_hole() && finest + 1 < levels() &&
         height > kHighestEye * static_cast<float>(pattern_.n << finest) * cell)
    ++finest;

  // Levels below `finest` are not drawn and stay where they were; move_window() catches up when they return.
  for (int l = finest; l < levels(); ++l) {
    const int spacing = 1 << l;
    // On each axis the next finer window may begin at one of two samples only, for which there are trims. In
    // samples of this level: the corner is even, the eye 2m - 2 to 2m from it, near the middle of n = 4m - 1.
    // The next finer corner is floor(eye) - m + 1, hence m - 1 or m samples from this corner.
    move_window(l, {2 * (lattice_floor(eye.x, 2 * spacing) - pattern_.m + 1),
                    2 * (lattice_floor(eye.y, 2 * spacing) - pattern_.m + 1)});
    if (l == 0 && !hole_cut_) update_blocks(l);
    ClipLevel& level = clip_levels_[l];
    level.eye = eye / static_cast<double>(spacing) - glm::dvec2(level.corner);
    // With a hole, the eye may be higher than where the finest level is left out otherwise. Beyond the
    // finest, transitions must not grow: they would move vertices that the next finer level ends at.
    const float rise = height / (kHighestEye * static_cast<float>(pattern_.n << l) * cell);
    set_transition(l, l == finest ? rise : std::min(rise, 0.5F));
  }
  const Frustum frustum(view);
  for (int l = finest; l < levels(); ++l) draw_level(l, finest, frustum);
  frame_ = {.clip_levels = clip_levels_,
            .first = source_->first(),
            .last = source_->last(),
            .origin = origin_,
            .cell_x = source_->cell_x(),
            .cell_z = source_->cell_z(),
            .indices = pattern_.indices,
            .batches = batches_,
            .uploads = uploads_,
            .stats = count(batches_, uploads_, moved_, clip_levels_.size())};
  return frame_;
}

// Reads the samples that entered the window; samples that stay keep their place in the array.
void Clipmap::move_window(int l, glm::ivec2 corner) {
  ClipLevel& level = clip_levels_[l];
  const glm::ivec2 by = corner - level.corner;
  if (storage_[l].filled && by == glm::ivec2(0)) return;
  level.corner = corner;
  ++moved_;
  const int n = pattern_.n;
  if (!storage_[l].filled || std::abs(by.x) >= n || std::abs(by.y) >= n) {
    read_strip(l, corner.x, corner.y, n, n);
    storage_[l].filled = true;
  } else {
    if (by.x != 0) {
      read_strip(l, by.x > 0 ? corner.x + n - by.x : corner.x, corner.y, std::abs(by.x), n);
    }
    if (by.y != 0) {
      // Skips the corner that was read with the columns: at the low end if the window moved to lower x, where
      // the rows begin later; else at the high end, where they end earlier.
      const int a = by.x < 0 ? corner.x - by.x : corner.x;
      read_strip(l, a, by.y > 0 ? corner.y + n - by.y : corner.y, n - std::abs(by.x), std::abs(by.y));
    }
  }
  update_blocks(l);
}

// Reads lattice samples [a, a + columns) × [b, b + rows), in up to four parts where the array wraps around.
// Sample (a, b) has its place at (a mod side, b mod side); side is a power of two, so & mask is that modulus
// for negative coordinates too.
void Clipmap::read_strip(int l, int a, int b, int columns, int rows) {
  const int side = pattern_.side, mask = side - 1;
  for (int j = 0; j < rows;) {
    const int z = (b + j) & mask;
    const int depth = std::min(rows - j, side - z);
    for (int i = 0; i < columns;) {
      const int x = (a + i) & mask;
      const int width = std::min(columns - i, side - x);
      source_->read(l, a + i, b + j, width, depth,
                    &storage_[l].heights[static_cast<std::size_t>(z) * side + x], side);
      uploads_.push_back({.target = DirtyRange::Target::kClipLevel,
                          .level = static_cast<std::uint16_t>(l),
                          .x = static_cast<std::uint16_t>(x),
                          .z = static_cast<std::uint16_t>(z),
                          .width = static_cast<std::uint16_t>(width),
                          .depth = static_cast<std::uint16_t>(depth)});
      i += width;
    }
    j += depth;
  }
}

// `rise`: the eye's height as a share of the height at which the level is left out. Only the finest drawn
// level has a rise over ½; from ½ to 1 its transition widens inwards until it covers the whole window, so
// that no vertex jumps when the level is left out.
void Clipmap::set_transition(int l, float rise) {
  ClipLevel& level = clip_levels_[l];
  if (l + 1 == levels() || !stitch_) return;
  level.to = static_cast<float>(2 * pattern_.m - 2);  // the eye's least distance from the border, samples
  level.from = level.to - transition_width(pattern_.n) / std::clamp(2 - 2 * rise, kLeastDivisor, 1.0F);
  // One sample more, so that rounding cannot move vertices at the rim of the hole.
  if (l == 0 && has_hole()) level.from = std::max(level.from, hole_reach_ + 1);
}

// Finds each block's height range and the index ranges that lie on the ground. The height range includes one
// more sample on each side, because in the transition a vertex lies between its neighbours.
void Clipmap::update_blocks(int l) {
  LevelStorage& level = storage_[l];
  level.tile_bounds.update(clip_levels_[l]);
  const int spacing = clip_levels_[l].spacing;
  const glm::ivec2 corner = clip_levels_[l].corner, first = source_->first(), last = source_->last();
  const glm::ivec2 begin(lattice_floor(first.x, spacing), lattice_floor(first.y, spacing));
  const glm::ivec2 end(ceiling(last.x, spacing), ceiling(last.y, spacing));
  std::size_t number = 0;
  if (l == 0) hole_cut_ = true;
  level.ranges.clear();
  for (const auto* blocks : {&pattern_.ring, &pattern_.middle, &pattern_.trims}) {
    for (const clipmap::Block& block : *blocks) {
      const bool cut = l == 0 && has_hole();
      append_outside(pattern_, block, begin - corner, end - corner, cut ? hole_low_ - corner : glm::ivec2(0),
                     cut ? hole_high_ - corner : glm::ivec2(0), level.ranges);
      level.block_ends[number] = static_cast<std::uint32_t>(level.ranges.size());
      const glm::ivec2 low = glm::max(glm::ivec2(block.x0, block.z0) - 1, 0);
      const glm::ivec2 high = glm::min(glm::ivec2(block.x1, block.z1) + 1, pattern_.n - 1);
      level.block_heights[number++] = level.tile_bounds.range(corner + low, corner + high);
    }
  }
}

// Draws the ring of a level, and inside it the middle (finest level) or the trims around the finer window.
void Clipmap::draw_level(int l, int finest, const Frustum& frustum) {
  std::size_t number = 0;
  for (const clipmap::Block& block : pattern_.ring) draw_block(l, number++, block, frustum);
  for (const clipmap::Block& block : pattern_.middle) {
    if (l == finest) draw_block(l, number, block, frustum);
    ++number;
  }
  if (l == finest) return;
  // Where the finer window begins, 0 or 1 per axis beyond cell m - 1: see WindowPattern::trims.
  const glm::ivec2 finer = clip_levels_[l - 1].corner / 2 - clip_levels_[l].corner - (pattern_.m - 1);
  const auto trim = static_cast<std::size_t>(2 * (2 * finer.y + finer.x));
  for (std::size_t k = trim; k < trim + 2; ++k) draw_block(l, number + k, pattern_.trims[k], frustum);
}

void Clipmap::draw_block(int l, std::size_t number, const clipmap::Block& block, const Frustum& frustum) {
  const ClipLevel& level = clip_levels_[l];
  const LevelStorage& storage = storage_[l];
  const std::uint32_t begin = number == 0 ? 0 : storage.block_ends[number - 1];
  const std::uint32_t end = storage.block_ends[number];
  if (begin == end) return;  // beyond the ground
  const auto place = [&](int x, float y, int z) {
    const glm::ivec2 sample =
        glm::clamp((level.corner + glm::ivec2(x, z)) * level.spacing, source_->first(), source_->last()) -
        origin_;
    return glm::vec3(static_cast<float>(sample.x) * source_->cell_x(), y,
                     static_cast<float>(sample.y) * source_->cell_z());
  };
  // Extended to even samples, which triangles at the window's border reach.
  const Bounds box{place(block.x0 & ~1, storage.block_heights[number].lowest, block.z0 & ~1),
                   place((block.x1 + 1) & ~1, storage.block_heights[number].highest, (block.z1 + 1) & ~1)};
  if (frustum.see(box) == Sight::kOutside) return;
  for (std::uint32_t k = begin; k < end; ++k) {
    batches_.push_back(
        {storage.ranges[k].first_index, storage.ranges[k].index_count, 0, static_cast<std::uint16_t>(l)});
  }
}

Memory Clipmap::memory() const {
  Memory memory;
  memory.index += heap_bytes(this) + source_->bytes();
  memory += payload_memory(pattern_.indices);
  memory += index_memory(pattern_.rows, pattern_.ring, pattern_.middle, pattern_.trims);
  for (const LevelStorage& level : storage_) {
    memory += payload_memory(level.heights);
    memory += level.tile_bounds.memory();
    memory += index_memory(level.block_heights, level.block_ends, level.ranges);
  }
  memory.index += heap_bytes(storage_.data());
  memory += index_memory(clip_levels_, batches_, uploads_, edits_);
  return memory;
}

}  // namespace terrabench
