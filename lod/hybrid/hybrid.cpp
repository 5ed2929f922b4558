#include "lod/hybrid/hybrid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <tuple>

#include "terrain/error.h"
#include "terrain/frustum.h"
#include "terrain/memory.h"

namespace terrabench {
namespace {

constexpr int kLargestRadius = 16;
constexpr double kAheadHeight =
    2;  // chunks are queued up to this many times the height at which they are drawn

}  // namespace

std::span<const ParameterSpec> Hybrid::parameters() {
  static const ParameterSpec kSpecs[] = {
      {"radius", std::int64_t{2}, "chunks", "near chunks on each side of the eye's", 0, kLargestRadius},
      {"ahead", std::int64_t{4}, "chunks",
       "chunks queued per frame before they are needed; 0: none, so that frames may stall", 0, 1024},
      {"band", std::int64_t{8}, "samples",
       "width of the transition along the rim, from the near surface to the far heights", 1, 4096},
      {"stitch", true, "",
       "join the near surface to the far heights, and their levels to each other; false leaves gaps"},
  };
  return kSpecs;
}

std::unique_ptr<Lod> Hybrid::build(const LodGround& ground, const Parameters& parameters, Progress&) {
  const bool stitch = parameters.flag("stitch");
  return std::make_unique<Hybrid>(ground,
                                  HybridOptions{.radius = static_cast<int>(parameters.integer("radius")),
                                                .ahead = static_cast<int>(parameters.integer("ahead")),
                                                .band = static_cast<int>(parameters.integer("band")),
                                                .interpolate = stitch,
                                                .stitch_far = stitch});
}

Hybrid::Hybrid(const LodGround& ground, const HybridOptions& options)
    : heights_(ground.heights), options_(options) {
  check_ground(heights_);
  const MeshChunks* surface = ground.near_surface;
  if (surface == nullptr) {
    auto own = std::make_unique<hybrid::HeightChunks>(heights_);
    layout_ = own->layout();
    own_ = std::move(own);
    surface = own_.get();
  } else {
    layout_ = hybrid::layout_of(*surface, heights_);
  }
  if (options.band < 1 || options.band > layout_.side) {
    throw usage_error(
        fmt::format("band must be 1 to {} samples, a chunk's side, got {}", layout_.side, options.band),
        "band", "choose a narrower band or larger chunks");
  }
  const int window = least_window();
  if (options.radius < 0 || options.radius > kLargestRadius || Clipmap::reach_of(window) < reach()) {
    throw usage_error(fmt::format("radius must be 0 to {} chunks and at most {} samples, got {} chunks of {}",
                                  kLargestRadius, Clipmap::reach_of(window), options.radius, layout_.side),
                      "radius", "choose a smaller radius or smaller chunks");
  }
  far_ = std::make_unique<Clipmap>(heights_in_memory(heights_),
                                   std::max(window, static_cast<int>(knob().fallback)), options.stitch_far);
  // One more ring of chunks, to be queued.
  store_ = std::make_unique<hybrid::ChunkStore>(*surface, 2 * (options.radius + 1) + 1);
}

void Hybrid::edited(const SampleRect& rect) {
  far_->edited(rect);
  store_->finish();
  if (own_) own_->edited(rect.low, rect.high);
  store_->forget_joins(layout_, rect.low, rect.high);
}

// Farthest that the near surface can reach from the eye, samples.
int Hybrid::reach() const {
  return std::min((options_.radius + 1) * layout_.side, std::max(heights_.width, heights_.depth));
}

// -1: none fits. A window that covers the ground has no transition that could get in their way.
int Hybrid::radius_in_window() const {
  if (far_->levels() == 1) return options_.radius;
  return std::min(options_.radius, Clipmap::reach_of(far_->window()) / layout_.side - 1);
}

// The eye's place over the ground, clamped to it, in chunks.
glm::dvec2 Hybrid::eye_in_chunks(const View& view) const {
  const glm::dvec2 eye(view.eye.x / static_cast<double>(heights_.cell_x),
                       view.eye.z / static_cast<double>(heights_.cell_z));
  const glm::dvec2 last(heights_.width - 1, heights_.depth - 1);
  return (glm::clamp(eye, glm::dvec2(0), last) - glm::dvec2(layout_.first)) /
         static_cast<double>(layout_.side);
}

double Hybrid::height_over_ground(const View& view, glm::dvec2 eye) const {
  const glm::ivec2 sample =
      glm::clamp(layout_.first + glm::ivec2(glm::floor(eye * static_cast<double>(layout_.side))),
                 glm::ivec2(0), {heights_.width - 1, heights_.depth - 1});
  return std::abs(static_cast<double>(view.eye.y) - heights_.at(sample.x, sample.y));
}

double Hybrid::near_height() const {
  if (options_.height > 0) return options_.height;
  return (options_.radius + 0.5) * layout_.side * std::max(heights_.cell_x, heights_.cell_z);
}

Hybrid::Square Hybrid::chunks_around(glm::dvec2 eye, int radius) const {
  glm::ivec2 own(glm::floor(eye));
  for (const int axis : {0, 1}) own[axis] -= eye[axis] == layout_.chunks[axis] ? 1 : 0;  // far border
  return {glm::max(own - radius, 0), glm::min(own + radius + 1, layout_.chunks)};
}

hybrid::Outline Hybrid::outline_of(const Square& square) const {
  if (square.empty()) return {};
  return {layout_.low(square.low), layout_.high(square.high - 1)};
}

const Frame& Hybrid::update(const View& view) {
  check_view(view);
  ++frames_;
  changes_ = 0;
  const glm::dvec2 eye = eye_in_chunks(view);
  const double height = height_over_ground(view, eye);
  const int radius = radius_in_window();
  const Square near = height <= near_height() && radius >= 0 ? chunks_around(eye, radius) : Square{};
  outline_ = outline_of(near);
  collect(near);
  far_->set_hole(outline_.low, outline_.high);
  const Frame& far = far_->update(view);
  uploads_.assign(far.uploads.begin(), far.uploads.end());
  list(view);
  frame_ = far;
  frame_.meshes = meshes_;
  frame_.uploads = uploads_;
  frame_.stats = count(far.batches, uploads_, far.stats.changes + changes_, far.clip_levels.size(), meshes_);
  if (height <= kAheadHeight * near_height()) queue_ahead(chunks_around(eye, radius + 1), eye);
  return frame_;
}

// The near chunks, built and joined. Missing ones are queued first, so that they are built in parallel.
void Hybrid::collect(const Square& near) {
  near_.clear();
  const auto each = [&](const auto& use) {
    for (int b = near.low.y; b < near.high.y; ++b) {
      for (int a = near.low.x; a < near.high.x; ++a) use(glm::ivec2(a, b));
    }
  };
  each([&](glm::ivec2 at) {
    if (store_->holds(at)) return;
    store_->queue(at);
    ++late_;
  });
  each([&](glm::ivec2 at) {
    near_.push_back(&store_->get(at));
    join(*near_.back());
  });
}

void Hybrid::join(hybrid::Chunk& chunk) {
  const hybrid::Outline outline{layout_.low(chunk.at), layout_.high(chunk.at)};
  const hybrid::Rim rim{outline_, options_.band};
  const hybrid::RimDistances place = hybrid::distances(outline, rim);
  if (chunk.id != 0 && place == chunk.rim) return;
  const hybrid::RimDistances inside{glm::ivec2(options_.band), glm::ivec2(options_.band)};
  chunk.id = 0;  // if joining throws
  chunk.is_joined = place != inside && options_.interpolate;
  chunk.joined = chunk.is_joined ? hybrid::join(chunk.mesh, outline, rim, heights_) : TriangleMesh{};
  chunk.box = bounds_of(chunk.is_joined ? chunk.joined : chunk.mesh);
  chunk.rim = place;
  chunk.id = ++ids_;
  chunk.last_listed_in = 0;
  ++changes_;
}

void Hybrid::list(const View& view) {
  const Frustum frustum(view);
  meshes_.clear();
  for (hybrid::Chunk* chunk : near_) {
    const TriangleMesh& mesh = chunk->is_joined ? chunk->joined : chunk->mesh;
    if (mesh.indices.empty()) continue;
    const auto number = static_cast<std::uint32_t>(meshes_.size());
    meshes_.push_back({.id = chunk->id,
                       .positions = mesh.positions,
                       .normals = mesh.normals,
                       .indices = mesh.indices,
                       .drawn = frustum.see(chunk->box) != Sight::kOutside});
    if (chunk->last_listed_in == 0 || chunk->last_listed_in + 1 != frames_) {
      uploads_.push_back({.target = DirtyRange::Target::kMesh,
                          .first = number,
                          .count = static_cast<std::uint32_t>(meshes_.back().bytes())});
    }
    chunk->last_listed_in = frames_;
  }
}

void Hybrid::queue_ahead(const Square& around, glm::dvec2 eye) {
  candidates_.clear();
  for (int b = around.low.y; b < around.high.y; ++b) {
    for (int a = around.low.x; a < around.high.x; ++a) {
      if (store_->holds({a, b})) continue;
      const glm::dvec2 away = glm::abs(glm::dvec2(a + 0.5, b + 0.5) - eye);
      candidates_.emplace_back(std::max(away.x, away.y), glm::ivec2(a, b));
    }
  }
  const auto key = [](const auto& c) { return std::tuple(c.first, c.second.y, c.second.x); };
  std::sort(candidates_.begin(), candidates_.end(),
            [&](const auto& a, const auto& b) { return key(a) < key(b); });
  const std::size_t n = std::min(candidates_.size(), static_cast<std::size_t>(options_.ahead));
  for (std::size_t k = 0; k < n; ++k) store_->queue(candidates_[k].second);
}

Memory Hybrid::memory() const {
  store_->finish();
  Memory memory;
  memory.index += heap_bytes(this) + heap_bytes(own_.get()) + heap_bytes(store_.get());
  if (own_) memory += own_->memory();
  memory += store_->memory();
  memory += far_->memory();
  memory += index_memory(near_);
  memory.index += heap_bytes(candidates_.data());
  memory += index_memory(meshes_, uploads_);
  return memory;
}

}  // namespace terrabench
