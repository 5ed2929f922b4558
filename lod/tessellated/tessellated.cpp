#include "lod/tessellated/tessellated.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "terrain/error.h"

namespace terrabench {

using tessellated::factor_log, tessellated::kInside;

namespace {

constexpr int kLeastSide = 4, kLargestSide = 64;  // the largest factor of every OpenGL
constexpr std::uint8_t kUnknown = 0xFF;
constexpr std::string_view kFactors[] = {"error", "length"};

// Smaller patches need fewer triangles, but more patches cost more time and bytes. From 8 up, the smallest
// side that cuts the ground into at most 128 × 128 patches.
int default_side(const Heightfield& ground) {
  constexpr int kMostAcross = 128;
  int side = 8;
  while (side < kLargestSide && std::max(ground.width, ground.depth) - 1 > side * kMostAcross) side *= 2;
  return side;
}

}  // namespace

std::span<const ParameterSpec> Tessellated::parameters() {
  static const ParameterSpec kSpecs[] = {
      {"patch", std::int64_t{0}, "cells",
       "side of a patch, a power of two; 0: 8, or the least that makes at most 128 × 128 patches", 0,
       kLargestSide},
      choice("factor", kFactors,
             "of a side: by its errors on this ground, or by its length on the screen, which looks at no "
             "error; the knob is then the length of a segment"),
  };
  return kSpecs;
}

std::unique_ptr<Lod> Tessellated::build(const LodGround& from, const Parameters& parameters,
                                        Progress& progress) {
  check_ground(from.heights);
  Options options{static_cast<int>(parameters.integer("patch")), parameters.choice("factor") == 0};
  if (options.side == 0) options.side = default_side(from.heights);
  if (options.side < kLeastSide || !std::has_single_bit(static_cast<unsigned>(options.side))) {
    throw usage_error(fmt::format("patch must be a power of two from {}, got {}", kLeastSide, options.side),
                      "patch", "choose 4, 8, 16, 32 or 64, or 0 for the default");
  }
  return std::make_unique<Tessellated>(from.heights, options, progress);
}

Tessellated::Tessellated(const Heightfield& ground, const Options& options, Progress& progress)
    : grid_(grid_of(ground)),
      options_(options),
      pixels_(knob().fallback),
      cut_{grid_.width, grid_.depth, options.side},
      tree_(grid_, cut_),
      triangles_(cut_),
      errors_(grid_, cut_, triangles_, options.by_error, progress),
      allowed_(cut_.count()),
      side_factors_(errors_.sides()),
      factors_(cut_.count(), 0),
      last_factors_(cut_.count(), 0) {}

void Tessellated::edited(const SampleRect& rect) {
  check_edit(rect, grid_.width, grid_.depth);
  const PatchGrid::PatchRect patches = cut_.holding(rect.low, rect.high);
  tree_.measure(grid_, patches);
  errors_.measure(grid_, cut_, triangles_, patches);
  if (!first_) append_heights(grid_, rect, edits_);
}

const Frame& Tessellated::update(const View& view) {
  check_view(view);
  begin_frame();
  tree_.collect(Frustum(view), seen_);
  const ScreenBound bound(view, pixels_);
  for (const PatchTree::PatchRange& range : seen_) {
    bound.allow(tree_.boxes(), range.first, range.last, allowed_.data());
  }
  std::size_t changes = 0;
  for_each_patch(seen_, [&](std::uint32_t k) {
    const PatchTree::Place& place = tree_.places()[k];
    factors_[k] = factors(k, bound);
    changes += factors_[k] != last_factors_[k] ? 1 : 0;
    patches_.push_back({place.corner, factors_[k]});
    triangles_.append(patches_.back(), place.shape, batches_);
  });
  make_frame(changes);
  return frame_;
}

void Tessellated::begin_frame() {
  std::swap(seen_, last_seen_);
  std::swap(factors_, last_factors_);
  for_each_patch(seen_, [&](std::uint32_t k) { factors_[k] = 0; });  // of the last frame but one
  seen_.clear();
  patches_.clear();
  batches_.clear();
  std::ranges::fill(side_factors_, kUnknown);
}

std::uint32_t Tessellated::factors(std::uint32_t number, const ScreenBound& bound) {
  const std::uint32_t slot = tree_.places()[number].slot;
  std::uint32_t factors = 0;
  int finest = 1;
  for (const int side : {kNorth, kEast, kSouth, kWest}) {
    const int factor = factor_of(errors_.side(slot, side), bound);
    factors |= static_cast<std::uint32_t>(factor) << (4 * side);
    finest = std::max(finest, factor);
  }
  int inside = finest;
  if (options_.by_error) {
    inside = 1;
    while (!keeps_bound(slot, factors, inside, allowed_[number])) ++inside;
  }
  return factors | static_cast<std::uint32_t>(inside) << (4 * kInside);
}

int Tessellated::factor_of(std::size_t side, const ScreenBound& bound) {
  if (side_factors_[side] == kUnknown) {
    side_factors_[side] = static_cast<std::uint8_t>(choose_factor(side, bound));
  }
  return side_factors_[side];
}

int Tessellated::choose_factor(std::size_t side, const ScreenBound& bound) const {
  const tessellated::Sphere& sphere = errors_.sphere(side);
  const double radius = sphere.radius;
  int factor = 0;
  if (options_.by_error) {
    const double allowed = bound.allow(sphere.centre, radius);
    while (std::max(errors_.of_side(side, factor), errors_.beside(side, factor)) > allowed) ++factor;
  } else {
    const double segments = 2 * radius / bound.length(sphere.centre, radius);
    while (factor < triangles_.logs() && 1 << factor < segments) ++factor;
  }
  return factor;
}

bool Tessellated::keeps_bound(std::uint32_t slot, std::uint32_t factors, int inside, float allowed) const {
  if (errors_.of_inner(slot, inside) > allowed) return false;
  for (const int side : {kNorth, kEast, kSouth, kWest}) {
    if (errors_.of_strip(slot, inside, side, factor_log(factors, side)) > allowed) return false;
  }
  return true;
}

void Tessellated::make_frame(std::size_t changes) {
  uploads_.assign(edits_.begin(), edits_.end());
  edits_.clear();
  if (first_) {
    uploads_.push_back(
        {.target = DirtyRange::Target::kHeights, .count = static_cast<std::uint32_t>(grid_.heights.size())});
  }
  first_ = false;
  frame_ = {.grid = grid_,
            .cell_x = grid_.cell_x,
            .cell_z = grid_.cell_z,
            .indices = triangles_.indices(),
            .batches = batches_,
            .patch_side = cut_.side,
            .patches = patches_,
            .uploads = uploads_,
            .stats = count(batches_, uploads_, changes)};
  frame_.stats.bytes_commands = kBytesPerPatch * patches_.size();
}

Memory Tessellated::memory() const {
  Memory memory = triangles_.memory();
  memory.index += heap_bytes(this);
  memory += tree_.memory();
  memory += errors_.memory();
  memory += index_memory(allowed_, side_factors_, factors_, last_factors_, seen_, last_seen_, patches_,
                         batches_, uploads_, edits_);
  return memory;
}

}  // namespace terrabench
