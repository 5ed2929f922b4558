#include "lod/geomipmap/geomipmap.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "terrain/error.h"
#include "terrain/memory.h"

namespace terrabench {
namespace {

constexpr int kLargestSide = 256;

// Smaller patches need fewer triangles, but more patches cost more time. From the paper's 16 up, the smallest
// side that cuts the ground into at most 64 × 64 patches.
int default_side(const Heightfield& ground) {
  constexpr int kPaperSide = 16, kMostAcross = 64;
  int side = kPaperSide;
  while (side < kLargestSide && std::max(ground.width, ground.depth) - 1 > side * kMostAcross) side *= 2;
  return side;
}

}  // namespace

std::span<const ParameterSpec> GeoMipMap::parameters() {
  static const ParameterSpec kSpecs[] = {
      {"patch", std::int64_t{0}, "cells",
       "side of a patch, a power of two; 0: 16, or the least that makes at most 64 × 64 patches", 0,
       kLargestSide},
      {"level_camera", false, "",
       "choose levels by the paper's rule for a level camera, which is not a strict bound"},
      {"morph", false, "", "morph between levels by distance (trilinear geomipmapping)"},
      {"stitch", true, "", "join patches to coarser neighbours; false leaves gaps between them"},
  };
  return kSpecs;
}

std::unique_ptr<Lod> GeoMipMap::build(const LodGround& from, const Parameters& parameters,
                                      Progress& progress) {
  const Heightfield& ground = from.heights;
  check_ground(ground);
  Options options{static_cast<int>(parameters.integer("patch")), parameters.flag("level_camera"),
                  parameters.flag("morph"), parameters.flag("stitch")};
  if (options.side == 0) options.side = default_side(ground);
  if (options.side == 1 || !std::has_single_bit(static_cast<unsigned>(options.side))) {
    throw usage_error(fmt::format("patch must be a power of two, got {}", options.side), "patch",
                      "choose 2, 4, 8, 16, 32, 64, 128 or 256, or 0 for the default");
  }
  return std::make_unique<GeoMipMap>(ground, options, progress);
}

GeoMipMap::GeoMipMap(const Heightfield& ground, const Options& options, Progress& progress)
    : grid_(grid_of(ground)),
      options_(options),
      cut_{grid_.width, grid_.depth, options.side},
      offsets_(cut_.offsets()),
      levels_(std::bit_width(static_cast<unsigned>(options.side))),
      pixels_(knob().fallback),
      patterns_(cut_, levels_,
                options.morph ? PatchPatterns::Split::kThroughOdd : PatchPatterns::Split::kOneWay),
      tree_(grid_, cut_),
      level_(cut_.slots(), kUnseen),
      last_level_(cut_.count(), kUnseen),
      queued_(cut_.slots(), 0),
      number_of_(cut_.slots()),
      allowed_(cut_.count()) {
  if (options.morph) {
    morphing_.emplace(grid_, cut_, patterns_, levels_, progress);
    morphs_.reserve(cut_.count());
  } else {
    errors_.emplace(grid_, cut_, tree_, patterns_, levels_, progress);
  }
  for (std::uint32_t k = 0; k < cut_.count(); ++k) number_of_[tree_.places()[k].slot] = k;
  seen_.reserve(tree_.most_ranges());
  last_seen_.reserve(tree_.most_ranges());
  queue_.reserve(cut_.count());
  batches_.reserve(cut_.count());
  uploads_.reserve(3);
}

void GeoMipMap::edited(const SampleRect& rect) {
  check_edit(rect, grid_.width, grid_.depth);
  const PatchGrid::PatchRect patches = cut_.holding(rect.low, rect.high);
  tree_.measure(grid_, patches);
  if (morphing_) {
    morphing_->measure(grid_, cut_, patterns_, patches);
  } else {
    errors_->measure(grid_, cut_, tree_, patterns_, patches);
  }
  if (!first_) append_heights(grid_, rect, edits_);
}

void GeoMipMap::tune(double pixels) { pixels_ = setting(knob(), pixels); }

const Frame& GeoMipMap::update(const View& view) {
  check_view(view);
  begin_frame();
  tree_.collect(Frustum(view), seen_);
  allow(ScreenBound(view, pixels_));
  if (morphing_) {
    morphing_->choose(tree_.places(), last_seen_, seen_, allowed_);
    for_each_patch(seen_, [&](std::uint32_t k) {
      const std::uint32_t slot = tree_.places()[k].slot;
      level_[slot] = static_cast<std::uint8_t>(morphing_->level(slot) + 1);
    });
  } else {
    choose_levels();
    fit_neighbours();
  }
  make_frame();
  return frame_;
}

// Moves the levels and patches of the last frame to last_level_ and last_seen_.
void GeoMipMap::begin_frame() {
  for (const PatchTree::PatchRange& patches : last_seen_) {
    std::fill(last_level_.begin() + patches.first, last_level_.begin() + patches.last, kUnseen);
  }
  const std::span<const PatchTree::Place> places = tree_.places();
  for_each_patch(seen_,
                 [&](std::uint32_t k) { last_level_[k] = std::exchange(level_[places[k].slot], kUnseen); });
  std::swap(seen_, last_seen_);
  seen_.clear();
}

void GeoMipMap::allow(const ScreenBound& bound) {
  for (const PatchTree::PatchRange& patches : seen_) {
    if (options_.level_camera) {
      bound.allow_level_camera(tree_.boxes(), patches.first, patches.last, allowed_.data());
    } else {
      bound.allow(tree_.boxes(), patches.first, patches.last, allowed_.data());
    }
  }
}

void GeoMipMap::choose_levels() {
  const std::span<const PatchTree::Place> places = tree_.places();
  for_each_patch(seen_, [&](std::uint32_t k) {
    level_[places[k].slot] = static_cast<std::uint8_t>(errors_->coarsest(k, allowed_[k]) + 1);
  });
}

// Refines the coarser of two neighbours until they differ by at most one level and the seam keeps the bound.
// `side`: of the finer patch.
void GeoMipMap::fit(std::uint32_t fine, std::uint32_t coarse, int side) {
  const int level = level_[fine];
  if (level_[coarse] <= level || level == kUnseen) return;
  const int most = errors_->of_seam(fine, level - 1, side) <= allowed_[number_of_[fine]] ? level + 1 : level;
  if (level_[coarse] <= most) return;
  level_[coarse] = static_cast<std::uint8_t>(most);
  if (std::exchange(queued_[coarse], 1) == 0) queue_.push_back(coarse);
}

// Terminates because levels only decrease; a patch whose level decreased checks its four sides again.
void GeoMipMap::fit_neighbours() {
  const std::span<const PatchTree::Place> places = tree_.places();
  for_each_patch(seen_, [&](std::uint32_t k) {
    const std::uint32_t slot = places[k].slot;
    // Each pair once. Patches out of view do not constrain their neighbours.
    for (const int side : {kEast, kSouth}) {
      const std::uint32_t neighbour = slot + offsets_[side];
      if (level_[neighbour] > level_[slot]) fit(slot, neighbour, side);
      if (level_[neighbour] < level_[slot]) fit(neighbour, slot, side ^ 2);
    }
  });
  while (!queue_.empty()) {
    const std::uint32_t slot = queue_.back();
    queue_.pop_back();
    queued_[slot] = 0;
    for (const int side : {kNorth, kEast, kSouth, kWest}) {
      fit(slot, slot + offsets_[side], side);
      fit(slot + offsets_[side], slot, side ^ 2);
    }
  }
}

void GeoMipMap::make_frame() {
  batches_.clear();
  morphs_.clear();
  std::size_t changes = 0;
  const std::span<const PatchTree::Place> places = tree_.places();
  for_each_patch(seen_, [&](std::uint32_t k) {
    const PatchTree::Place& p = places[k];
    const std::uint8_t level = level_[p.slot];
    changes += level != last_level_[k] ? 1 : 0;
    int seams = 0;
    for (const int side : {kNorth, kEast, kSouth, kWest}) {
      seams |= options_.stitch && level_[p.slot + offsets_[side]] > level ? 1 << side : 0;
    }
    const IndexRange& pattern = patterns_.pattern(p.shape, level - 1, seams);
    batches_.push_back({pattern.first_index, pattern.index_count, p.corner,
                        static_cast<std::uint16_t>(level - 1), static_cast<std::uint32_t>(morphs_.size())});
    if (morphing_) {
      morphs_.push_back(morphing_->morph(p.slot));
      if (!options_.stitch) morphs_.back().sides.fill(morphs_.back().inside);
    }
  });
  uploads_.assign(edits_.begin(), edits_.end());
  edits_.clear();
  const auto size = [](const auto& values) { return static_cast<std::uint32_t>(values.size()); };
  if (first_) {
    uploads_.push_back({.target = DirtyRange::Target::kIndices, .count = size(patterns_.indices())});
    uploads_.push_back({.target = DirtyRange::Target::kHeights, .count = size(grid_.heights)});
    first_ = false;
  }
  if (!morphs_.empty()) {
    uploads_.push_back({.target = DirtyRange::Target::kMorphs, .count = size(morphs_)});
  }
  frame_ = {.grid = grid_,
            .cell_x = grid_.cell_x,
            .cell_z = grid_.cell_z,
            .indices = patterns_.indices(),
            .batches = batches_,
            .morphs = morphs_,
            .patch_side = morphing_ ? cut_.side : 0,
            .uploads = uploads_,
            .stats = count(batches_, uploads_, changes)};
}

Memory GeoMipMap::memory() const {
  Memory memory = patterns_.memory();
  memory.index += heap_bytes(this);
  memory += morphing_ ? morphing_->memory() : errors_->memory();
  memory += tree_.memory();
  memory += index_memory(level_, last_level_, queued_, seen_, last_seen_, number_of_, allowed_, queue_,
                         batches_, morphs_, uploads_, edits_);
  return memory;
}

}  // namespace terrabench
