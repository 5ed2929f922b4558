#include "lod/roam/roam.h"

#include <algorithm>
#include <cmath>

namespace terrabench {

using roam::kNone;
using roam::Node;
using roam::Sight;

namespace {

double extent_of(const GroundGrid& grid) {
  double highest = 0;
  for (const float height : grid.heights) highest = std::max(highest, std::abs(static_cast<double>(height)));
  return static_cast<double>(grid.width) * grid.cell_x + static_cast<double>(grid.depth) * grid.cell_z +
         highest;
}

}  // namespace

std::span<const ParameterSpec> Roam::parameters() {
  static const ParameterSpec specs[] = {
      {"max_error", 1.0, "px", "largest screen-space error of a sample that shows", 1e-3, 1e5},
      {"triangles", std::int64_t{0}, "", "largest mesh, what lies outside the view included; 0: any", 0, 4e9},
      {"milliseconds", 0.0, "ms", "longest update, after which the mesh stays as it is; 0: any", 0, 1e6}};
  return specs;
}

std::unique_ptr<Lod> Roam::build(const Heightfield& ground, const Parameters& parameters,
                                 Progress& progress) {
  check_ground(ground);
  const RoamOptions options{.max_error = parameters.number("max_error"),
                            .triangles = static_cast<std::size_t>(parameters.integer("triangles")),
                            .milliseconds = parameters.number("milliseconds")};
  return std::make_unique<Roam>(ground, options, progress);
}

Roam::Roam(const Heightfield& ground, const RoamOptions& options, Progress& progress)
    : mesh_(grid_of(ground), progress), options_(options), extent_(extent_of(mesh_.grid())), batches_(1) {}

void Roam::tune(double max_error) {
  options_.max_error = max_error;
  retuned_ = true;
}

const Frame& Roam::update(const View& view) {
  check_view(view);
  start_ = std::chrono::steady_clock::now();
  changes_ = 0;
  const roam::Camera before = camera_;
  camera_ = roam::Camera(view, extent_);
  const bool afresh = first_ || retuned_ || !camera_.same_lens(before);
  const roam::Motion motion = afresh ? roam::Motion{} : camera_.since(before);
  due_.clear();
  if (afresh || !motion.none()) {
    for (std::uint32_t id = 0; id < mesh_.roots(); ++id) look(id, 0);
  }
  if (afresh) {
    reference_ = kAsked;
    reconsider_all();
  } else {
    deadlines_.advance(mesh_.nodes(), motion, due_);
    for (const std::uint32_t id : due_) reconsider(id);
  }
  do settle();
  while (lower_reference());

  uploads_.clear();
  drawn_.finish(mesh_.nodes(), uploads_);
  const GroundGrid& grid = mesh_.grid();
  if (first_) {
    uploads_.push_back(
        {.target = DirtyRange::Target::kHeights, .count = static_cast<std::uint32_t>(grid.heights.size())});
  }
  first_ = retuned_ = false;
  batches_[0] = {.index_count = static_cast<std::uint32_t>(drawn_.indices().size())};
  frame_ = {.grid = grid,
            .levels = {},
            .cell_x = grid.cell_x,
            .cell_z = grid.cell_z,
            .indices = drawn_.indices(),
            .batches = batches_,
            .uploads = uploads_,
            .stats = count(batches_, uploads_, changes_)};
  return frame_;
}

// Culling labels, from the root down to where neither they nor what they imply below can have changed.
void Roam::look(std::uint32_t id, Sight parent) {
  const Node& node = mesh_.nodes()[id];
  const Sight before = node.sight;
  see(id, parent);
  const Sight now = node.sight;
  if (now == before && (now == roam::kAllInside || now == roam::kOutside)) return;
  const bool turned_up = (now & roam::kOutside) != (before & roam::kOutside);
  if (node.leaf()) {
    if (!turned_up) return;
    show(id);
    due_.push_back(id);
    return;
  }
  if (turned_up) due_.push_back(id);
  const std::uint32_t child = node.child;
  look(child, now);
  look(child + 1, now);
}

void Roam::see(std::uint32_t id, Sight parent) {
  Node& node = mesh_.nodes()[id];
  const bool inherited = parent == roam::kAllInside || (parent & roam::kOutside) != 0;
  node.sight =
      inherited ? parent : camera_.sight(mesh_.corners(node), node.thickness, mesh_.spill(node), parent);
}

// Puts a leaf on or off the draw list, as its sight has it.
void Roam::show(std::uint32_t id) {
  const Node& node = mesh_.nodes()[id];
  if (!node.visible()) {
    drawn_.remove(mesh_.nodes(), id);
  } else if (node.slot == kNone) {
    const std::array<std::uint32_t, 3> vertices = mesh_.vertices(node);
    if (!mesh_.empty(vertices)) drawn_.add(mesh_.nodes(), id, vertices);
  }
}

Memory Roam::memory() const {
  Memory memory = mesh_.memory();
  memory.index += heap_bytes(this);
  memory += splits_.memory();
  memory += merges_.memory();
  memory += deadlines_.memory();
  memory += drawn_.memory();
  memory += index_memory(due_);
  memory += index_memory(batches_);
  memory += index_memory(uploads_);
  return memory;
}

}  // namespace terrabench
