#include "lod/chunked/paged_chunked.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "terrain/error.h"

namespace terrabench {

using namespace chunked;  // NOLINT

namespace {

constexpr std::size_t kMostAsked = 16;  // few, so that the next frame's choice is loaded soon
constexpr float kSeenFirst = 4;         // urgency of chunks in view, as a multiple

// Looks straight up, where no chunks are, so that what it allows does not depend on a direction.
View without_direction(View view) {
  view.target = view.eye + glm::vec3(0, 1, 0);
  return view;
}

}  // namespace

struct PagedChunked::Sights {
  ScreenBound bound, ahead;
  Frustum frustum;
};

template <class Use>
void PagedChunked::for_roots(const Use& use) const {
  const int level = file_.tree().levels() - 1;
  for (int z = 0; z < file_.tree().grid(level).down(); ++z) {
    for (int x = 0; x < file_.tree().grid(level).across(); ++x) use(ChunkPlace{level, x, z});
  }
}

template <class Use>
void PagedChunked::for_children(const ChunkPlace& at, const Use& use) const {
  for (const auto& [dx, dz] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
    const ChunkPlace child{at.level - 1, 2 * at.x + dx, 2 * at.z + dz};
    if (file_.tree().has(child.level, child.x, child.z)) use(child);
  }
}

PagedChunked::PagedChunked(const std::filesystem::path& path, std::size_t budget)
    : file_(path), budget_(budget), slots_(file_.tree().count()), pager_(file_, kMostAsked) {
  loaded_.reserve(kMostAsked);
  for_roots([&](const ChunkPlace& at) {
    if (held_ + file_.heap_bytes_at_most(at) > budget_) {
      throw usage_error(fmt::format("the coarsest chunks do not fit into {} bytes", budget), "budget",
                        "give more memory");
    }
    keep(at, file_.load(at));
  });
}

void PagedChunked::edited(const SampleRect&) {
  throw usage_error("chunks on disk cannot be edited", "", "build their file again");
}

const Frame& PagedChunked::update(const View& view) {
  check_view(view);
  ++frame_number_;
  take_loaded();
  const Sights sights{ScreenBound(view, pixels_), ScreenBound(without_direction(view), pixels_ / kAhead),
                      Frustum(view)};
  wanted_.clear();
  for_roots([&](const ChunkPlace& at) {
    want({std::numeric_limits<float>::infinity(), at}, true, Frustum::kAllPlanes, sights);
  });
  ask_for_wanted();
  const std::uint64_t late_before = late_chunks_;
  changes_ = 0;
  for_roots([&](const ChunkPlace& at) { select(at, Frustum::kAllPlanes, sights); });
  late_frames_ += late_chunks_ > late_before ? 1 : 0;
  make_frame();
  return frame_;
}

void PagedChunked::take_loaded() {
  pager_.take(loaded_);
  for (Pager::Page& page : loaded_) {
    held_ -= file_.heap_bytes_at_most(page.at);
    --asked_;
    slot(page.at).asked = false;
    // Its parent may have been freed meanwhile; without it, it could not be drawn.
    const ChunkPlace parent{page.at.level + 1, page.at.x / 2, page.at.z / 2};
    if (parent.level < file_.tree().levels() && !is_there(parent)) continue;
    keep(page.at, std::move(page.chunk));
  }
  loaded_.clear();
}

void PagedChunked::keep(const ChunkPlace& at, std::unique_ptr<LoadedChunk> chunk) {
  held_ += chunk->memory().total();
  bytes_read_ += file_.bytes(at);
  ++chunks_read_;
  slot(at).chunk = std::move(chunk);
  const auto number = [&](const ChunkPlace& place) { return file_.number(place); };
  there_.insert(std::ranges::lower_bound(there_, file_.number(at), {}, number), at);
}

void PagedChunked::want(const Wanted& chunk, bool seen, unsigned planes, const Sights& sights) {
  wanted_.push_back(chunk);
  const ChunkPlace& at = chunk.at;
  const Bounds box = file_.tree().box(at.level, at.x, at.z);
  const float urgency = file_.error(at) / sights.ahead.allow(box);
  if (at.level == 0 || urgency <= 1) return;
  seen = seen && (planes == 0 || sights.frustum.see(box, planes) != Sight::kOutside);
  for_children(at, [&](const ChunkPlace& child) {
    want({seen ? kSeenFirst * urgency : urgency, child}, seen, planes, sights);
  });
}

void PagedChunked::ask_for_wanted() {
  std::ranges::sort(wanted_, {}, [&](const Wanted& chunk) {
    return std::tuple(-chunk.urgency, -chunk.at.level, file_.number(chunk.at));
  });
  std::size_t reach = 0;
  for (std::size_t room = budget_; reach < wanted_.size(); ++reach) {
    const Slot& wanted = slot(wanted_[reach].at);
    const std::size_t bytes =
        wanted.chunk ? wanted.chunk->memory().total() : file_.heap_bytes_at_most(wanted_[reach].at);
    if (bytes > room) break;
    room -= bytes;
    slot(wanted_[reach].at).wanted_in = frame_number_;
  }
  settled_ = true;
  for (std::size_t k = 0; k < reach; ++k) {
    const ChunkPlace& at = wanted_[k].at;
    if (slot(at).chunk) continue;
    settled_ = false;
    if (slot(at).asked) continue;
    if (asked_ == kMostAsked || !make_room(file_.heap_bytes_at_most(at))) return;
    held_ += file_.heap_bytes_at_most(at);
    ++asked_;
    slot(at).asked = true;
    pager_.ask(at);
  }
}

// Frees chunks that this frame does not want: first those not wanted for longest, of these the finest.
bool PagedChunked::make_room(std::size_t bytes) {
  while (held_ + bytes > budget_) {
    const auto oldest = std::ranges::min_element(
        there_, {}, [&](const ChunkPlace& at) { return std::pair(slot(at).wanted_in, at.level); });
    if (slot(*oldest).wanted_in == frame_number_) return false;
    held_ -= slot(*oldest).chunk->memory().total();
    slot(*oldest) = {};
    there_.erase(oldest);
  }
  return true;
}

void PagedChunked::select(const ChunkPlace& at, unsigned planes, const Sights& sights) {
  const Bounds box = file_.tree().box(at.level, at.x, at.z);
  if (planes != 0 && sights.frustum.see(box, planes) == Sight::kOutside) return;
  const bool fine = at.level == 0 || file_.error(at) <= sights.bound.allow(box);
  bool late = false;
  if (!fine) for_children(at, [&](const ChunkPlace& child) { late = late || !is_there(child); });
  if (!fine && !late) {
    for_children(at, [&](const ChunkPlace& child) { select(child, planes, sights); });
    return;
  }
  late_chunks_ += late ? 1 : 0;
  Slot& shown = slot(at);
  changes_ += shown.drawn_in + 1 == frame_number_ ? 0 : 1;
  shown.drawn_in = frame_number_;
}

void PagedChunked::make_frame() {
  meshes_.clear();
  uploads_.clear();
  for (const ChunkPlace& at : there_) {
    Slot& there = slot(at);
    const LoadedChunk& chunk = *there.chunk;
    meshes_.push_back({.id = file_.number(at) + 1,
                       .positions = chunk.positions,
                       .normals = chunk.normals,
                       .indices = chunk.indices,
                       .drawn = there.drawn_in == frame_number_});
    if (std::exchange(there.listed, true)) continue;
    uploads_.push_back({.target = DirtyRange::Target::kMesh,
                        .first = static_cast<std::uint32_t>(meshes_.size() - 1),
                        .count = static_cast<std::uint32_t>(meshes_.back().bytes())});
  }
  frame_ = {.cell_x = file_.cell().x,
            .cell_z = file_.cell().y,
            .meshes = meshes_,
            .uploads = uploads_,
            .stats = count({}, uploads_, changes_, 0, meshes_)};
}

Memory PagedChunked::memory() const {
  pager_.finish();
  Memory memory = pager_.memory();
  memory += file_.memory();
  memory.index += heap_bytes(this) + heap_bytes(slots_.data()) + heap_bytes(loaded_.data());
  memory += index_memory(there_, wanted_, meshes_, uploads_);
  for (const Slot& slot : slots_) {
    if (slot.chunk) memory += slot.chunk->memory();
  }
  return memory;
}

}  // namespace terrabench
