#include "lod/roam/roam.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace terrabench {

using roam::kNone;
using roam::Node;
using roam::Sight;

namespace {

double extent_of(const GroundGrid& grid) {
  // Of positive floats the larger has the larger bits: integers, so that many are compared at once.
  std::uint32_t highest = 0;
  for (const float height : grid.heights) {
    highest = std::max(highest, std::bit_cast<std::uint32_t>(height) & 0x7FFFFFFFU);
  }
  return static_cast<double>(grid.width) * grid.cell_x + static_cast<double>(grid.depth) * grid.cell_z +
         static_cast<double>(std::bit_cast<float>(highest));
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
    : mesh_(grid_of(ground), options.triangles, progress),
      options_(options),
      extent_(extent_of(mesh_.grid())),
      drawn_(mesh_.room()),
      fresh_(2 * mesh_.room()),
      quiet_(mesh_.nodes().size()),
      batches_(1) {
  fresh_.clear();
}

void Roam::tune(double max_error) {
  options_.max_error = setting(knob(), max_error);
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
  const double far_moved = camera_.far_moved(before);
  due_.clear();
  if (afresh || !motion.none() || far_moved > 0) {
    journey_ = {journey_.moved + motion.moved + far_moved, journey_.turned + motion.turned};
    // Before floats cannot tell small motions apart.
    const bool anew = afresh || !(journey_.moved < 1e3 && journey_.turned < 10);
    if (anew) journey_ = {};
    for (std::uint32_t id = 0; id < mesh_.roots(); ++id) look(id, 0, anew);
  }
  if (afresh) {
    reference_ = kAsked;
    reconsider_all();
  } else {
    deadlines_.advance(mesh_.nodes(), motion, due_);
    reconsider_due();
  }
  do {
    settle();
    rank_pending();
  } while (lower_reference());
  place_fresh();

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

// Culling labels, from the root down, but not into where neither the labels above nor the motion can have
// changed any.
void Roam::look(std::uint32_t id, Sight parent, bool parent_changed) {
  if (!parent_changed && journey_.moved <= quiet_[id].moved && journey_.turned <= quiet_[id].turned) return;
  const Node& node = mesh_.nodes()[id];
  const Sight before = node.sight;
  see(id, parent, mesh_.corners(node));
  const Sight now = node.sight;
  if (now == before && roam::inherited(now)) return;
  const bool turned_up = (now & roam::kOutside) != (before & roam::kOutside);
  if (turned_up) due_.push_back(id);
  if (node.leaf()) return;
  for (const std::uint32_t child : {node.child, node.child + 1}) {
    look(child, now, parent_changed || now != before);
    quiet_[id].moved = std::min(quiet_[id].moved, quiet_[child].moved);
    quiet_[id].turned = std::min(quiet_[id].turned, quiet_[child].turned);
  }
}

void Roam::see(std::uint32_t id, Sight parent, const roam::Corners& corners) {
  Node& node = mesh_.nodes()[id];
  if (roam::inherited(parent)) {
    node.sight = parent;
    quiet_[id] = {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity()};
    return;
  }
  const roam::Seeing seeing = camera_.sight(corners, node.thickness, mesh_.spill(node), parent);
  node.sight = seeing.sight;
  quiet_[id] = {static_cast<float>(journey_.moved + seeing.slack.moved),
                static_cast<float>(journey_.turned + seeing.slack.turned)};
}

// Lets the ancestors of a new triangle know how long its sight stays.
void Roam::disturb_ancestors(std::uint32_t id) {
  const Quiet quiet = quiet_[id];
  if (std::isinf(quiet.moved)) return;
  for (id = mesh_.nodes()[id].parent; id != kNone; id = mesh_.nodes()[id].parent) {
    if (quiet_[id].moved <= quiet.moved && quiet_[id].turned <= quiet.turned) return;
    quiet_[id].moved = std::min(quiet_[id].moved, quiet.moved);
    quiet_[id].turned = std::min(quiet_[id].turned, quiet.turned);
  }
}

// Puts a leaf on or off the draw list, as its sight has it.
void Roam::show(std::uint32_t id) {
  const Node& node = mesh_.nodes()[id];
  if (!node.visible()) {
    drawn_.remove(mesh_.nodes(), id);
  } else if (node.slot == kNone) {
    const auto [a, b, c] = mesh_.vertices(node);
    if (!roam::Mesh::empty({a, b, c})) drawn_.add(mesh_.nodes(), id, a, b, c);
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
  memory += index_memory(pending_);
  memory += index_memory(fresh_);
  memory += index_memory(quiet_);
  memory += index_memory(batches_);
  memory += index_memory(uploads_);
  return memory;
}

}  // namespace terrabench
