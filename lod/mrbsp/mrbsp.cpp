#include "lod/mrbsp/mrbsp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "lod/mrbsp/height_points.h"
#include "lod/mrbsp/surface_height.h"
#include "lod/mrbsp/visibility_file.h"
#include "terrain/error.h"

namespace terrabench {
namespace {

// Which of the words a text parameter has.
std::size_t choice(const Parameters& parameters, std::string_view name,
                   std::initializer_list<std::string_view> words) {
  const auto at = std::find(words.begin(), words.end(), parameters.text(name));
  if (at == words.end()) {
    throw usage_error(fmt::format("'{}' is none of its values", parameters.text(name)), name,
                      fmt::format("choose {}", fmt::join(words, ", ")));
  }
  return static_cast<std::size_t>(at - words.begin());
}

MrbspOptions options_of(const Parameters& parameters) {
  MrbspOptions options;
  options.depth = static_cast<int>(parameters.integer("depth"));
  options.area_consistent = choice(parameters, "threshold", {"printed", "area"}) == 1;
  options.conforming = choice(parameters, "holes", {"printed", "conforming"}) == 1;
  options.three_nearest = choice(parameters, "heights", {"samples", "nearest"}) == 1;
  options.cull = parameters.flag("cull");
  const std::size_t visibility = choice(parameters, "visibility", {"off", "sampled", "conservative"});
  options.visibility = visibility > 0;
  options.visible.conservative = visibility == 2;
  options.visible.cells = static_cast<int>(parameters.integer("cells"));
  options.visible.coarseness = static_cast<int>(parameters.integer("coarseness"));
  options.visible.eye_height = static_cast<float>(parameters.number("eye_height"));
  return options;
}

// A lattice of its own for interpolated heights, no finer than its depth needs.
BisectionTree lattice_tree(const Heightfield& ground, int depth) {
  return depth == 0 ? BisectionTree::over(ground.width, ground.depth) : BisectionTree(depth / 2, depth);
}

}  // namespace

std::unique_ptr<Lod> Mrbsp::build(const Heightfield& ground, const Parameters& parameters,
                                  Progress& progress) {
  const MrbspOptions options = options_of(parameters);
  const std::string& file = parameters.text("visibility_file");
  if (!file.empty() && !options.visibility) {
    throw usage_error("there is no visibility to keep in a file", "visibility_file",
                      "set visibility to sampled or conservative too");
  }
  return std::make_unique<Mrbsp>(ground, options, progress, file);
}

std::span<const ParameterSpec> Mrbsp::parameters() {
  static const ParameterSpec kParameters[] = {
      {"depth", std::int64_t{0}, "levels", "bisections down to the finest triangles; 0: down to every sample",
       0, BisectionTree::kDeepest},
      {"threshold", std::string("printed"), "",
       "depth by distance: printed M - log2(D/S), area M - 2 log2(D/S)"},
      {"holes", std::string("conforming"), "", "printed: the paper's one-vertex rule; conforming: none left"},
      {"heights", std::string("samples"), "", "of vertices: samples, or nearest (interpolated from three)"},
      {"cull", true, "", "leave out what lies outside the view"},
      {"visibility", std::string("off"), "", "leave out what the ground hides: off, sampled, conservative"},
      {"cells", std::int64_t{16}, "cells", "of visibility, at most, along the longer side", 1, 1024},
      {"coarseness", std::int64_t{6}, "levels", "from the finest triangles up to those of visibility", 0,
       BisectionTree::kDeepest},
      {"eye_height", 1.8, "m", "above the ground, for visibility", 0, 1e6},
      {"visibility_file", std::string(), "",
       "keeps the visibility of one ground: read where it exists, which must be for the same ground, depth "
       "and "
       "options, else computed and written; text where it ends in .txt; empty: none"},
  };
  return kParameters;
}

Mrbsp::Mrbsp(const Heightfield& ground, const MrbspOptions& options, Progress& progress,
             const std::filesystem::path& visibility_file)
    : Mrbsp(ground, options, {}, progress) {
  if (!options_.visibility) return;
  take_visibility(visibility_file.empty()
                      ? changes_of(find_visible(grid_, tree_, options_.visible, progress))
                      : kept_visibility(visibility_file, grid_, tree_, options_.visible, progress));
}

Mrbsp::Mrbsp(const Heightfield& ground, const MrbspOptions& options, VisibilityTable visibility,
             Progress& progress)
    : options_(options), tree_(BisectionTree::over(2, 2)) {
  check_ground(ground);
  if (options.three_nearest) {
    tree_ = lattice_tree(ground, options.depth);
    interpolated_ = interpolate_lattice(height_points(ground), tree_, progress);
    grid_ = grid_of(interpolated_);
  } else {
    tree_ = BisectionTree::over(ground.width, ground.depth, options.depth);
    grid_ = grid_of(ground);
  }
  const double area = static_cast<double>(grid_.cell_x) * grid_.cell_z * tree_.side() * tree_.side();
  short_side_ = static_cast<float>(std::sqrt(2 * area / static_cast<double>(tree_.triangles())));
  bounds_ = TriangleBounds(grid_, tree_, progress);
  if (options_.conforming) cuts_.emplace(tree_);
  if (visibility.depth > 0) take_visibility(std::move(visibility));
}

void Mrbsp::take_visibility(VisibilityTable visibility) {
  const CellGrid& cells = visibility.cells;
  const bool fits =
      visibility.depth <= tree_.depth() && visibility.surface == surface_checksum(grid_, tree_) &&
      (grid_.width - 2) / cells.side + 1 == cells.columns && (grid_.depth - 2) / cells.side + 1 == cells.rows;
  if (!fits) {
    throw usage_error("the visibility was computed for other ground", "visibility",
                      "compute it for this field and depth");
  }
  options_.visibility = true;
  visibility_ = std::move(visibility);
  flags_ = VisibleFlags(visibility_);
}

int Mrbsp::threshold(const glm::vec3& eye, const glm::vec3& vertex) const {
  return std::clamp(rule().threshold(eye, vertex), 1, tree_.depth());
}

bool Mrbsp::on_the_ground(const glm::vec3& eye) const {
  const float u = eye.x / grid_.cell_x, v = eye.z / grid_.cell_z;
  const auto width = static_cast<float>(grid_.width - 1), depth = static_cast<float>(grid_.depth - 1);
  if (!(u >= 0 && v >= 0 && u <= width && v <= depth)) return false;
  // Within the slack that the conservative sets are computed with.
  constexpr float kSlack = 0.005F;
  const float samples = sample_height(grid_, u, v);
  const float surface = surface_height(tree_, grid_, eye.x, eye.z);
  // From beneath, the ground hides nothing: a line of sight that runs under it all the way is free.
  return eye.y >= surface && eye.y <= std::max(samples, surface) + visibility_.eye_height + kSlack;
}

const Frame& Mrbsp::update(const View& view) {
  check_view(view);
  std::size_t toggled = 0;
  const bool hide = options_.visibility && on_the_ground(view.eye);
  if (hide) {
    const CellGrid& cells = visibility_.cells;
    const glm::ivec2 at(static_cast<int>(view.eye.x / grid_.cell_x) / cells.side,
                        static_cast<int>(view.eye.z / grid_.cell_z) / cells.side);
    toggled = flags_.move_to(visibility_, glm::min(at, glm::ivec2(cells.columns - 1, cells.rows - 1)));
  }
  const Frustum frustum(view);
  next_.clear();
  const WalkEye eye{view.eye, options_.cull ? &frustum : nullptr, hide ? &flags_ : nullptr};
  walk_tree({grid_, tree_, bounds_}, rule(), eye, {cuts_ ? &*cuts_ : nullptr, whole_}, next_);
  publish(toggled);
  return frame_;
}

void Mrbsp::publish(std::size_t toggled) {
  uploads_.clear();
  const auto differs = std::mismatch(next_.begin(), next_.end(), indices_.begin(), indices_.end()).first;
  const auto kept = static_cast<std::uint32_t>(differs - next_.begin());
  std::swap(indices_, next_);
  const auto count_of = static_cast<std::uint32_t>(indices_.size());
  if (kept < count_of) {
    uploads_.push_back({.target = DirtyRange::Target::kIndices, .first = kept, .count = count_of - kept});
  }
  if (first_) {
    uploads_.push_back(
        {.target = DirtyRange::Target::kHeights, .count = static_cast<std::uint32_t>(grid_.heights.size())});
    first_ = false;
  }
  batches_.clear();
  if (count_of > 0) batches_.push_back({.first_index = 0, .index_count = count_of});
  frame_ = {.grid = grid_,
            .cell_x = grid_.cell_x,
            .cell_z = grid_.cell_z,
            .indices = indices_,
            .batches = batches_,
            .uploads = uploads_,
            .stats = count(batches_, uploads_, toggled)};
}

Memory Mrbsp::memory() const {
  Memory memory = payload_memory(interpolated_.heights);
  memory.index += heap_bytes(this);
  for (const Memory& part : {bounds_.memory(), cuts_ ? cuts_->memory() : Memory{}, index_memory(whole_),
                             payload_memory(visibility_.start), index_memory(visibility_.first),
                             payload_memory(visibility_.changes), flags_.memory(), payload_memory(indices_),
                             payload_memory(next_), index_memory(batches_), index_memory(uploads_)}) {
    memory += part;
  }
  return memory;
}

}  // namespace terrabench
