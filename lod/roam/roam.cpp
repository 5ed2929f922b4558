#include "lod/roam/roam.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "terrain/memory.h"

namespace terrabench {

using roam::CullLabel;
using roam::kNone;
using roam::Node;

namespace {

// Positive floats compare like their bits; integer comparisons are vectorised.
std::uint32_t bits_of_size(float height) { return std::bit_cast<std::uint32_t>(height) & 0x7FFFFFFFU; }

std::uint32_t furthest_height(std::span<const float> heights) {
  std::uint32_t furthest = 0;
  for (const float height : heights) furthest = std::max(furthest, bits_of_size(height));
  return furthest;
}

// The sample with the largest absolute height, or one of them.
glm::ivec2 furthest_sample(const GroundGrid& grid) {
  const std::uint32_t furthest = furthest_height(grid.heights);
  const auto at = std::ranges::find(grid.heights, furthest, bits_of_size) - grid.heights.begin();
  return {at % grid.width, at / grid.width};
}

std::span<const float> row(const GroundGrid& grid, glm::ivec2 from, int samples) {
  const std::size_t begin = static_cast<std::size_t>(from.y) * grid.width + static_cast<std::size_t>(from.x);
  return grid.heights.subspan(begin, static_cast<std::size_t>(samples));
}

// The same after an edit. Searches only the edited rectangle, unless the old sample lies within it.
glm::ivec2 furthest_sample(const GroundGrid& grid, glm::ivec2 furthest, const SampleRect& edited) {
  if (glm::all(glm::lessThanEqual(edited.low, furthest)) &&
      glm::all(glm::lessThanEqual(furthest, edited.high)))
    return furthest_sample(grid);
  for (int z = edited.low.y; z <= edited.high.y; ++z) {
    const auto heights = row(grid, {edited.low.x, z}, edited.high.x - edited.low.x + 1);
    const std::uint32_t here = furthest_height(heights);
    if (here <= bits_of_size(row(grid, furthest, 1)[0])) continue;
    const auto at = std::ranges::find(heights, here, bits_of_size) - heights.begin();
    furthest = {edited.low.x + static_cast<int>(at), z};
  }
  return furthest;
}

double extent_of(const GroundGrid& grid, glm::ivec2 furthest) {
  return static_cast<double>(grid.width) * grid.cell_x + static_cast<double>(grid.depth) * grid.cell_z +
         std::abs(static_cast<double>(row(grid, furthest, 1)[0]));
}

}  // namespace

std::span<const ParameterSpec> Roam::parameters() {
  static const ParameterSpec specs[] = {
      {"max_error", 1.0, "px", "largest screen-space error of a visible sample", 1e-3, 1e5},
      {"triangles", std::int64_t{0}, "",
       "most triangles in the mesh, those outside the view included; 0: no limit", 0, 4e9},
      {"milliseconds", 0.0, "ms", "time limit per update, after which refinement stops; 0: no limit", 0,
       1e6}};
  return specs;
}

std::unique_ptr<Lod> Roam::build(const LodGround& from, const Parameters& parameters, Progress& progress) {
  const Heightfield& ground = from.heights;
  check_ground(ground);
  const RoamOptions options{.max_error = parameters.number("max_error"),
                            .triangles = static_cast<std::size_t>(parameters.integer("triangles")),
                            .milliseconds = parameters.number("milliseconds")};
  return std::make_unique<Roam>(ground, options, progress);
}

Roam::Roam(const Heightfield& ground, const RoamOptions& options, Progress& progress)
    : mesh_(grid_of(ground), options.triangles, progress),
      options_(options),
      furthest_(furthest_sample(mesh_.grid())),
      extent_(extent_of(mesh_.grid(), furthest_)),
      drawn_(mesh_.capacity()),
      ranked_leaves_(2 * mesh_.capacity()),
      labels_valid_until_(mesh_.nodes().size()),
      batches_(1) {
  ranked_leaves_.clear();
}

void Roam::tune(double max_error) {
  options_.max_error = setting(knob(), max_error);
  retuned_ = true;
}

void Roam::edited(const SampleRect& rect) {
  const GroundGrid& grid = mesh_.grid();
  check_edit(rect, grid.width, grid.depth);
  mesh_.edited(rect.low, rect.high);
  furthest_ = furthest_sample(grid, furthest_, rect);
  extent_ = extent_of(grid, furthest_);
  retuned_ = true;
  if (!first_) append_heights(grid, rect, edits_);
}

const Frame& Roam::update(const View& view) {
  check_view(view);
  start_ = std::chrono::steady_clock::now();
  changes_ = 0;
  const roam::WedgieView before = view_;
  view_ = roam::WedgieView(view, extent_);
  const bool all_changed = first_ || retuned_ || !view_.same_lens(before);
  const roam::Motion motion = all_changed ? roam::Motion{} : view_.since(before);
  const double far_moved = view_.far_moved(before);
  expired_.clear();
  if (all_changed || !motion.none() || far_moved > 0) {
    total_motion_ = {total_motion_.moved + motion.moved + far_moved, total_motion_.turned + motion.turned};
    // Start again from zero before the floats of LabelValidity cannot resolve small motions.
    const bool all_labels = all_changed || !(total_motion_.moved < 1e3 && total_motion_.turned < 10);
    if (all_labels) total_motion_ = {};
    for (std::uint32_t id = 0; id < mesh_.roots(); ++id) update_labels(id, 0, all_labels);
  }
  if (all_changed) {
    exact_from_ = kMaxErrorBucket;
    rerank_all();
  } else {
    deferred_.advance(mesh_.nodes(), motion, expired_);
    rerank_expired();
  }
  // refine() leaves the merge queue, the draw list and the deferral lists behind the mesh; these calls update
  // them.
  do {
    refine();
    queue_split_diamonds();
  } while (lower_exact_bucket());
  finish_ranked_leaves();

  uploads_.assign(edits_.begin(), edits_.end());
  edits_.clear();
  drawn_.finish(mesh_.nodes(), uploads_);
  const GroundGrid& grid = mesh_.grid();
  if (first_) {
    uploads_.push_back(
        {.target = DirtyRange::Target::kHeights, .count = static_cast<std::uint32_t>(grid.heights.size())});
  }
  first_ = retuned_ = false;
  batches_[0] = {.index_count = static_cast<std::uint32_t>(drawn_.indices().size())};
  frame_ = {.grid = grid,
            .cell_x = grid.cell_x,
            .cell_z = grid.cell_z,
            .indices = drawn_.indices(),
            .batches = batches_,
            .uploads = uploads_,
            .stats = count(batches_, uploads_, changes_)};
  return frame_;
}

// Computes culling labels from the root down. Skips subtrees in which neither the labels above nor the motion
// can have changed any label.
void Roam::update_labels(std::uint32_t id, CullLabel parent, bool parent_changed) {
  LabelValidity& until = labels_valid_until_[id];
  if (!parent_changed && total_motion_.moved <= until.moved && total_motion_.turned <= until.turned) return;
  const Node& node = mesh_.nodes()[id];
  const CullLabel before = node.label;
  set_label(id, parent, mesh_.corners(node));
  const CullLabel now = node.label;
  if (now == before && roam::inherited(now)) return;
  const bool visibility_changed = (now & roam::kOutside) != (before & roam::kOutside);
  if (visibility_changed) expired_.push_back(id);
  if (node.leaf()) return;
  for (const std::uint32_t child : {node.child, node.child + 1}) {
    update_labels(child, now, parent_changed || now != before);
    until.moved = std::min(until.moved, labels_valid_until_[child].moved);
    until.turned = std::min(until.turned, labels_valid_until_[child].turned);
  }
}

void Roam::set_label(std::uint32_t id, CullLabel parent, const roam::Corners& corners) {
  Node& node = mesh_.nodes()[id];
  if (roam::inherited(parent)) {
    node.label = parent;
    labels_valid_until_[id] = {std::numeric_limits<float>::infinity(),
                               std::numeric_limits<float>::infinity()};
    return;
  }
  const roam::Culling culling = view_.cull(corners, node.thickness, mesh_.spill(node), parent);
  node.label = culling.label;
  labels_valid_until_[id] = {static_cast<float>(total_motion_.moved + culling.valid_for.moved),
                             static_cast<float>(total_motion_.turned + culling.valid_for.turned)};
}

// Limits the ancestors' validity to that of a new triangle's label.
void Roam::limit_ancestors(std::uint32_t id) {
  const LabelValidity own = labels_valid_until_[id];
  if (std::isinf(own.moved)) return;
  for (id = mesh_.nodes()[id].parent; id != kNone; id = mesh_.nodes()[id].parent) {
    LabelValidity& until = labels_valid_until_[id];
    if (until.moved <= own.moved && until.turned <= own.turned) return;
    until.moved = std::min(until.moved, own.moved);
    until.turned = std::min(until.turned, own.turned);
  }
}

// Adds a leaf to the draw list or removes it, by its culling label.
void Roam::update_drawn(std::uint32_t id) {
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
  memory += deferred_.memory();
  memory += drawn_.memory();
  memory += index_memory(expired_, split_diamonds_, ranked_leaves_, labels_valid_until_, batches_, uploads_,
                         edits_);
  return memory;
}

}  // namespace terrabench
