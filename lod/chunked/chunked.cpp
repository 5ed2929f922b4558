#include "lod/chunked/chunked.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "terrain/error.h"

namespace terrabench {

using namespace chunked;  // NOLINT

namespace {

constexpr int kLargestSide = 512;  // cells

bool faces(Part part, const Bounds& box, const glm::vec3& eye) {
  switch (part) {
    case kSouthSkirt:
      return eye.z > box.high.z;
    case kWestSkirt:
      return eye.x < box.low.x;
    case kNorthSkirt:
      return eye.z < box.low.z;
    case kEastSkirt:
      return eye.x > box.high.x;
    default:
      return true;
  }
}

}  // namespace

struct Chunked::Sights {
  ScreenBound bound;
  Frustum frustum;
};

std::span<const ParameterSpec> Chunked::parameters() {
  static const ParameterSpec kSpecs[] = {
      {"chunk", std::int64_t{8}, "cells", "side of the smallest chunks, a power of two", 2, kLargestSide},
      {"error", 0.008, "", "largest error of a chunk's mesh, as a share of the chunk's side", 1e-6, 1},
      {"morph", false, "", "morph chunks to the next coarser ones by the error that is allowed"},
      {"skirts", true, "", "cover the cracks between chunks; false leaves them open"},
  };
  return kSpecs;
}

std::unique_ptr<Lod> Chunked::build(const LodGround& from, const Parameters& parameters, Progress& progress) {
  check_ground(from.heights);
  const Options options{static_cast<int>(parameters.integer("chunk")), parameters.number("error"),
                        parameters.flag("skirts"), parameters.flag("morph")};
  if (!std::has_single_bit(static_cast<unsigned>(options.side))) {
    throw usage_error(fmt::format("chunk must be a power of two, got {}", options.side), "chunk",
                      "choose 2, 4, 8, 16, 32, 64, 128, 256 or 512");
  }
  return std::make_unique<Chunked>(from.heights, options, progress);
}

Chunked::Chunked(const Heightfield& ground, const Options& options, Progress& progress)
    : grid_(grid_of(ground)),
      options_(options),
      tree_(grid_, options.side, cdlod::levels_of(grid_.width, grid_.depth, options.side, kLargestSide)),
      chunks_(grid_, tree_, options, progress),
      was_shown_(tree_.count(), 0) {
  if (options.skirts) floors_.emplace(grid_, tree_, chunks_);
}

void Chunked::edited(const SampleRect& rect) {
  check_edit(rect, grid_.width, grid_.depth);
  tree_.measure(grid_, rect);
  chunks_.update(rect);
  if (floors_) floors_->update(rect);
  if (!first_) append_heights(grid_, rect, edits_);
}

const Frame& Chunked::update(const View& view) {
  check_view(view);
  for (const Shown& chunk : last_shown_) was_shown_[tree_.number(chunk.level, chunk.x, chunk.z)] = 0;
  for (const Shown& chunk : shown_) was_shown_[tree_.number(chunk.level, chunk.x, chunk.z)] = 1;
  std::swap(shown_, last_shown_);
  shown_.clear();
  batches_.clear();
  const Sights sights{ScreenBound(view, pixels_), Frustum(view)};
  const int coarsest = tree_.levels() - 1;
  for (int z = 0; z < tree_.grid(coarsest).down(); ++z) {
    for (int x = 0; x < tree_.grid(coarsest).across(); ++x) {
      select({coarsest, x, z}, Frustum::kAllPlanes, sights);
    }
  }
  for (const Shown& chunk : shown_) draw(chunk, view.eye);
  make_frame();
  return frame_;
}

void Chunked::select(const Shown& chunk, unsigned planes, const Sights& sights) {
  const auto& [level, x, z, unused] = chunk;
  const Bounds box = tree_.box(level, x, z);
  if (planes != 0 && sights.frustum.see(box, planes) == Sight::kOutside) return;
  const float allowed = sights.bound.allow(box);
  if (level == 0 || chunks_.error(level, x, z) <= allowed) {
    shown_.push_back({level, x, z, share(level, x, z, allowed)});
    return;
  }
  for (const auto& [dx, dz] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
    const Shown child{level - 1, 2 * x + dx, 2 * z + dz};
    if (tree_.has(child.level, child.x, child.z)) select(child, planes, sights);
  }
}

// The error while morphing is at most linear between both ends'. The morph ends no later than where the
// coarser chunk's error is allowed, so it is complete when that chunk replaces this one.
float Chunked::share(int level, int x, int z, float allowed) const {
  if (!options_.morph || level == 0 || level + 1 == tree_.levels()) return 0;
  const float from = chunks_.error(level, x, z),
              to = std::max(chunks_.morphed_error(level, x, z), chunks_.error(level + 1, x / 2, z / 2));
  return to > from ? std::clamp((allowed - from) / (to - from), 0.0F, 1.0F) : 0;
}

// The surface and the skirts that face the eye: a batch for each run of parts.
void Chunked::draw(const Shown& chunk, const glm::vec3& eye) {
  const auto& [level, x, z, share] = chunk;
  const Bounds box = tree_.box(level, x, z);
  float floor = box.high.y;
  std::uint32_t base = 0;
  if (level == 0) {
    const PatchGrid::Patch square = tree_.grid(0).patch(x, z);
    base = static_cast<std::uint32_t>(square.j0) * static_cast<std::uint32_t>(grid_.width) +
           static_cast<std::uint32_t>(square.i0);
  }
  const std::size_t before = batches_.size();
  for (int k = 0; k < kParts; ++k) {
    const auto part = static_cast<Part>(k);
    const IndexRange range = chunks_.part(level, x, z, part);
    if (!faces(part, box, eye) || range.index_count == 0) continue;
    if (part != kSurface) floor = std::min(floor, floors_->at(level, x, z, side_of(part)));
    if (batches_.size() > before &&
        batches_.back().first_index + batches_.back().index_count == range.first_index) {
      batches_.back().index_count += range.index_count;
    } else {
      batches_.push_back({range.first_index, range.index_count, base, static_cast<std::uint16_t>(level)});
    }
  }
  for (std::size_t b = before; b < batches_.size(); ++b) {
    batches_[b].morph = std::bit_cast<std::uint32_t>(floor);
    batches_[b].share = share;
  }
}

void Chunked::make_frame() {
  const std::size_t changes = static_cast<std::size_t>(std::ranges::count_if(shown_, [&](const Shown& chunk) {
    return was_shown_[tree_.number(chunk.level, chunk.x, chunk.z)] == 0;
  }));
  uploads_.assign(edits_.begin(), edits_.end());
  edits_.clear();
  chunks_.take_changes(uploads_);
  const auto size = [](const auto& values) { return static_cast<std::uint32_t>(values.size()); };
  if (first_) {
    uploads_ = {{.target = DirtyRange::Target::kIndices, .count = size(chunks_.indices())},
                {.target = DirtyRange::Target::kHeights, .count = size(grid_.heights)}};
    if (options_.morph) {
      uploads_.push_back({.target = DirtyRange::Target::kChunkVertices, .count = size(chunks_.vertices())});
    }
    first_ = false;
  }
  frame_ = {.grid = grid_,
            .cell_x = grid_.cell_x,
            .cell_z = grid_.cell_z,
            .indices = chunks_.indices(),
            .batches = batches_,
            .chunk_vertices = chunks_.vertices(),
            .uploads = uploads_,
            .stats = count(batches_, uploads_, changes)};
}

Memory Chunked::memory() const {
  Memory memory = chunks_.memory();
  memory.index += heap_bytes(this);
  memory += tree_.memory();
  if (floors_) memory += floors_->memory();
  memory += index_memory(shown_, last_shown_, was_shown_, batches_, uploads_, edits_);
  return memory;
}

}  // namespace terrabench
