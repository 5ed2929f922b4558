#include "lod/clipmap/clipmap.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "terrain/error.h"
#include "terrain/frustum.h"

namespace terrabench {
namespace {

constexpr float kHighestEye =
    0.4F;  // of a window's extent: from further up it shows more than the screen needs
constexpr float kTransition = 0.1F;  // of the window's side
constexpr int kSmallestM = 4, kLargestM = 1024;

constexpr float kLeast = 1e-6F;  // share of its height that a level about to go has left

// Samples from the eye that endless ground is drawn to at most, so that all sample numbers fit.
constexpr double kFarthestSight = 1 << 26;

// Samples of bounded ground along its longer side.
int longest(const HeightSource& source) {
  const glm::ivec2 samples = source.last() - source.first() + 1;
  return std::max(samples.x, samples.y);
}

// At most what covers the ground from wherever the eye is over it: a larger window only has more triangles
// beyond the border.
int m_of(const HeightSource& source, int window) {
  const int covering =
      source.bounded() ? std::clamp(longest(source) / 2 + 2, kSmallestM, kLargestM) : kLargestM;
  return std::clamp((window + 1) / 4, kSmallestM, covering);
}

// Levels until one window reaches so many samples from wherever the eye is in it.
int level_count(double samples, int n) {
  int levels = 1;
  while (std::ldexp(n / 2 - 1, levels - 1) < samples) ++levels;
  return levels;
}

// Metres to the farthest corner of the view's far plane: how far ground can be seen.
double sight(const View& view) {
  const double up = std::tan(0.5 * view.vertical_fov), aside = up * view.width / view.height;
  return view.far * std::sqrt(1 + up * up + aside * aside);
}

// Floor of eye / spacing as a whole number.
int lattice_floor(double eye, int spacing) { return static_cast<int>(std::floor(eye / spacing)); }

int ceiling(int samples, int spacing) {
  return static_cast<int>((static_cast<std::int64_t>(samples) + spacing - 1) & -spacing) / spacing;
}

}  // namespace

std::unique_ptr<Lod> Clipmap::build(const Heightfield& ground, const Parameters&, Progress&) {
  check_ground(ground);
  return std::make_unique<Clipmap>(heights_in_memory(ground), static_cast<int>(knob().fallback));
}

Clipmap::Clipmap(std::unique_ptr<HeightSource> source, int window) : source_(std::move(source)) {
  reset(window);
}

void Clipmap::tune(double window) {
  const int samples = static_cast<int>(setting(knob(), window));
  if (m_of(*source_, samples) != window_.m) reset(samples);
}

void Clipmap::reset(int window) {
  window_ = clipmap::make_window(m_of(*source_, window));
  levels_.clear();
  shown_.clear();
  const int levels = source_->bounded() ? level_count(longest(*source_), window_.n) : 1;
  while (this->levels() < levels) add_level();
  indices_uploaded_ = false;
}

void Clipmap::add_level() {
  const std::size_t blocks = window_.ring.size() + window_.middle.size() + window_.trims.size();
  Level& level = levels_.emplace_back();
  level.heights.assign(static_cast<std::size_t>(window_.side) * window_.side, 0.0F);
  level.heights_of_tiles = clipmap::HeightBounds(window_.n);
  level.ranges.assign(blocks, {});
  level.run_ends.assign(blocks, 0);
  shown_.push_back({.side = window_.side, .spacing = 1 << (levels() - 1), .heights = level.heights});
  // All that a frame has where no border cuts blocks: four parts of two strips a level, and the indices.
  batches_.reserve(levels_.size() * blocks);
  uploads_.reserve(levels_.size() * 8 + 1);
}

// Over endless ground, levels until the coarsest window reaches beyond all that can be seen.
void Clipmap::reach(const View& view) {
  if (source_->bounded()) return;
  const double cell = std::min(source_->cell_x(), source_->cell_z());
  const int levels = level_count(std::min(sight(view) / cell, kFarthestSight), window_.n);
  while (this->levels() < levels) add_level();
}

void Clipmap::move_origin(glm::ivec2 sample) {
  if (glm::clamp(sample, source_->first(), source_->last()) != sample)
    throw usage_error("no sample of the ground to count metres from", "", "choose one of the ground's");
  origin_ = sample;
}

// Over the ground: from outside it, the nearest of its border.
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
  batches_.clear();
  uploads_.clear();
  moved_ = 0;
  if (!indices_uploaded_) {
    uploads_.push_back({.target = DirtyRange::Target::kIndices,
                        .count = static_cast<std::uint32_t>(window_.indices.size())});
    indices_uploaded_ = true;
  }
  reach(view);
  const glm::dvec2 eye = eye_in_samples(view);
  const float height = view.eye.y - ground_below_eye(eye);
  const float cell = std::max(source_->cell_x(), source_->cell_z());
  int finest = 0;
  while (finest + 1 < levels() && height > kHighestEye * static_cast<float>(window_.n << finest) * cell)
    ++finest;

  for (int l = finest; l < levels(); ++l) {
    const int spacing = 1 << l;
    // Even, and such that the finer window lies inside by m - 1 or m samples.
    move(l, {2 * (lattice_floor(eye.x, 2 * spacing) - window_.m + 1),
             2 * (lattice_floor(eye.y, 2 * spacing) - window_.m + 1)});
    ClipLevel& shown = shown_[l];
    shown.eye = eye / static_cast<double>(spacing) - glm::dvec2(shown.corner);
    blend(l, height / (kHighestEye * static_cast<float>(window_.n << l) * cell));
  }
  const Frustum frustum(view);
  for (int l = finest; l < levels(); ++l) draw(l, finest, frustum);
  frame_ = {.grid = {},
            .levels = shown_,
            .first = source_->first(),
            .last = source_->last(),
            .origin = origin_,
            .cell_x = source_->cell_x(),
            .cell_z = source_->cell_z(),
            .indices = window_.indices,
            .batches = batches_,
            .uploads = uploads_,
            .stats = count(batches_, uploads_, moved_, shown_.size())};
  return frame_;
}

// `rise` is the eye's height as a share of that from which on the level is left out. Over its last half,
// which concerns the finest level alone, the transition grows inwards until it holds the whole window, so
// that nothing moves when the level goes.
void Clipmap::blend(int l, float rise) {
  ClipLevel& shown = shown_[l];
  if (l + 1 == levels()) return;
  shown.to = static_cast<float>(2 * window_.m - 2);  // the border is nowhere nearer
  const float width = std::max(1.0F, kTransition * static_cast<float>(window_.n));
  shown.from = shown.to - width / std::clamp(2 - 2 * rise, kLeast, 1.0F);
}

// Fills what came into the window; what was there already keeps its place in the array.
void Clipmap::move(int l, glm::ivec2 corner) {
  ClipLevel& shown = shown_[l];
  const glm::ivec2 by = corner - shown.corner;
  if (levels_[l].filled && by == glm::ivec2(0)) return;
  shown.corner = corner;
  ++moved_;
  const int n = window_.n;
  if (!levels_[l].filled || std::abs(by.x) >= n || std::abs(by.y) >= n) {
    refill(l, corner.x, corner.y, n, n);
    levels_[l].filled = true;
  } else {
    if (by.x != 0) {
      refill(l, by.x > 0 ? corner.x + n - by.x : corner.x, corner.y, std::abs(by.x), n);
    }
    if (by.y != 0) {
      // Without the corner that the columns filled.
      const int a = by.x < 0 ? corner.x - by.x : corner.x;
      refill(l, a, by.y > 0 ? corner.y + n - by.y : corner.y, n - std::abs(by.x), std::abs(by.y));
    }
  }
  bound(l);
}

// Lattice samples [a, a + columns) × [b, b + rows), in up to four parts where the array wraps around.
void Clipmap::refill(int l, int a, int b, int columns, int rows) {
  const int side = window_.side, mask = side - 1;
  for (int j = 0; j < rows;) {
    const int z = (b + j) & mask;
    const int height = std::min(rows - j, side - z);
    for (int i = 0; i < columns;) {
      const int x = (a + i) & mask;
      const int width = std::min(columns - i, side - x);
      source_->read(l, a + i, b + j, width, height,
                    &levels_[l].heights[static_cast<std::size_t>(z) * side + x], side);
      uploads_.push_back({.target = DirtyRange::Target::kClipLevel,
                          .level = static_cast<std::uint16_t>(l),
                          .x = static_cast<std::uint16_t>(x),
                          .z = static_cast<std::uint16_t>(z),
                          .width = static_cast<std::uint16_t>(width),
                          .depth = static_cast<std::uint16_t>(height)});
      i += width;
    }
    j += height;
  }
}

// One sample more on each side: a vertex on its way to the coarser level stands between its neighbours.
void Clipmap::bound(int l) {
  Level& level = levels_[l];
  level.heights_of_tiles.follow(shown_[l]);
  const int spacing = shown_[l].spacing;
  const glm::ivec2 corner = shown_[l].corner, first = source_->first(), last = source_->last();
  const glm::ivec2 begin(lattice_floor(first.x, spacing), lattice_floor(first.y, spacing));
  const glm::ivec2 end(ceiling(last.x, spacing), ceiling(last.y, spacing));
  std::size_t slot = 0;
  level.runs.clear();
  for (const auto* blocks : {&window_.ring, &window_.middle, &window_.trims}) {
    for (const clipmap::Block& block : *blocks) {
      append_inside(window_, block, begin - corner, end - corner, level.runs);
      level.run_ends[slot] = static_cast<std::uint32_t>(level.runs.size());
      const glm::ivec2 low = glm::max(glm::ivec2(block.x0, block.z0) - 1, 0);
      const glm::ivec2 high = glm::min(glm::ivec2(block.x1, block.z1) + 1, window_.n - 1);
      level.ranges[slot++] = level.heights_of_tiles.range(corner + low, corner + high);
    }
  }
}

void Clipmap::draw(int l, int finest, const Frustum& frustum) {
  std::size_t slot = 0;
  for (const clipmap::Block& block : window_.ring) draw(l, slot++, block, frustum);
  for (const clipmap::Block& block : window_.middle) {
    if (l == finest) draw(l, slot, block, frustum);
    ++slot;
  }
  if (l == finest) return;
  const glm::ivec2 hole = shown_[l - 1].corner / 2 - shown_[l].corner - (window_.m - 1);
  const auto trim = static_cast<std::size_t>(2 * (2 * hole.y + hole.x));
  for (std::size_t k = trim; k < trim + 2; ++k) draw(l, slot + k, window_.trims[k], frustum);
}

void Clipmap::draw(int l, std::size_t slot, const clipmap::Block& block, const Frustum& frustum) {
  const ClipLevel& shown = shown_[l];
  const Level& level = levels_[l];
  const std::uint32_t begin = slot == 0 ? 0 : level.run_ends[slot - 1], end = level.run_ends[slot];
  if (begin == end) return;  // beyond the ground
  const auto place = [&](int x, float y, int z) {
    const glm::ivec2 sample =
        glm::clamp((shown.corner + glm::ivec2(x, z)) * shown.spacing, source_->first(), source_->last()) -
        origin_;
    return glm::vec3(static_cast<float>(sample.x) * source_->cell_x(), y,
                     static_cast<float>(sample.y) * source_->cell_z());
  };
  // Out to even samples: at the window's border, triangles reach those.
  const Bounds box{place(block.x0 & ~1, level.ranges[slot].lowest, block.z0 & ~1),
                   place((block.x1 + 1) & ~1, level.ranges[slot].highest, (block.z1 + 1) & ~1)};
  if (frustum.see(box) == Sight::kOutside) return;
  for (std::uint32_t k = begin; k < end; ++k) {
    batches_.push_back(
        {level.runs[k].first_index, level.runs[k].index_count, 0, static_cast<std::uint16_t>(l)});
  }
}

Memory Clipmap::memory() const {
  Memory memory;
  memory.index += heap_bytes(this) + source_->bytes();
  memory += payload_memory(window_.indices);
  memory += index_memory(window_.rows);
  for (const auto* blocks : {&window_.ring, &window_.middle, &window_.trims}) memory += index_memory(*blocks);
  for (const Level& level : levels_) {
    memory += payload_memory(level.heights);
    memory += level.heights_of_tiles.memory();
    memory += index_memory(level.ranges);
    memory += index_memory(level.run_ends);
    memory += index_memory(level.runs);
  }
  memory.index += heap_bytes(levels_.data());
  memory += index_memory(shown_);
  memory += index_memory(batches_);
  memory += index_memory(uploads_);
  return memory;
}

}  // namespace terrabench
