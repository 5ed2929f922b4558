#include "lod/mrbsp/mrbsp.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <iterator>

#include "lod/mrbsp/bisection_tree.h"
#include "lod/mrbsp/nearest_three.h"
#include "lod/mrbsp/visibility/codec.h"
#include "terrain/error.h"
#include "terrain/memory.h"

namespace terrabench {

using mrbsp::visibility::ChangeTable, mrbsp::visibility::ground_checksum, mrbsp::visibility::kModeNames;

namespace {

constexpr std::string_view kThresholds[] = {"printed", "area"}, kHeights[] = {"samples", "nearest"},
                           kVisibility[] = {"off",         kModeNames[0], kModeNames[1],
                                            kModeNames[2], kModeNames[3], kModeNames[4]};
static_assert(std::size(kVisibility) == kModeNames.size() + 1);

MrbspOptions options_of(const Parameters& parameters) {
  MrbspOptions options;
  options.depth = static_cast<int>(parameters.integer("depth"));
  options.area_consistent = parameters.choice("threshold") == 1;
  options.holes = static_cast<HoleRule>(parameters.choice("holes"));
  options.three_nearest = parameters.choice("heights") == 1;
  options.cull = parameters.flag("cull");
  const std::size_t visibility = parameters.choice("visibility");
  options.visibility = visibility > 0;
  if (options.visibility) options.visible.mode = static_cast<mrbsp::visibility::Mode>(visibility - 1);
  options.visible.cells = static_cast<int>(parameters.integer("cells"));
  options.visible.coarseness = static_cast<int>(parameters.integer("coarseness"));
  options.visible.eye_height = static_cast<float>(parameters.number("eye_height"));
  return options;
}

// The tree for interpolated heights: its vertices need not be samples, so its square is as small as the depth
// allows.
BisectionTree tree_for_interpolation(const Heightfield& ground, int depth) {
  return depth == 0 ? BisectionTree::over(ground.width, ground.depth) : BisectionTree(depth / 2, depth);
}

}  // namespace

std::unique_ptr<Lod> Mrbsp::build(const LodGround& from, const Parameters& parameters, Progress& progress) {
  const Heightfield& ground = from.heights;
  const MrbspOptions options = options_of(parameters);
  const std::string& file = parameters.text("visibility_file");
  if (!file.empty() && !options.visibility) {
    throw usage_error("a file needs sets to hold, such as visibility=sampled", "visibility_file",
                      "set visibility, or leave the file out");
  }
  return std::make_unique<Mrbsp>(ground, options, progress, file);
}

std::span<const ParameterSpec> Mrbsp::parameters() {
  static const ParameterSpec kParameters[] = {
      {"depth", std::int64_t{0}, "levels", "depth of the finest triangles; 0: down to every sample", 0,
       BisectionTree::kDeepest},
      choice("threshold", kThresholds, "LOD threshold: printed M - log2(D/S), area M - 2 log2(D/S)"),
      choice("holes", kHoleRuleNames,
             "printed: the paper's one-vertex rule; conforming: no holes; left: no rule, for measurements"),
      choice("heights", kHeights, "samples, or interpolated from the three nearest samples"),
      {"cull", true, "", "skip triangles outside the view frustum"},
      choice("visibility", kVisibility,
             "skip triangles that the ground hides; sampled: as printed; vertices, facing, interior: other "
             "readings of the paper; conservative: misses nothing"),
      {"cells", std::int64_t{16}, "cells", "upper limit of visibility cells along the longer side", 1, 1024},
      {"coarseness", std::int64_t{6}, "levels",
       "from the finest triangles up to the coarse ones of visibility", 0, BisectionTree::kDeepest},
      {"eye_height", 1.8, "m", "eye height above the ground, for visibility", 0, 1e6},
      {"visibility_file", std::string(), "",
       "file of visibility changes: loaded if it exists (it must fit the ground, depth and options), else "
       "computed and saved; text if the name ends in .txt; empty: no file"},
  };
  return kParameters;
}

Mrbsp::Mrbsp(const Heightfield& ground, const MrbspOptions& options, Progress& progress,
             const std::filesystem::path& visibility_file)
    : Mrbsp(ground, options, {}, progress) {
  if (!options_.visibility) return;
  use_visibility(visibility_file.empty()
                     ? changes_of(find_sets(grid_, tree_, options_.visible, progress))
                     : load_or_find(visibility_file, grid_, tree_, options_.visible, progress));
}

Mrbsp::Mrbsp(const Heightfield& ground, const MrbspOptions& options, ChangeTable visibility,
             Progress& progress)
    : ground_(ground), options_(options), tree_(BisectionTree::over(2, 2)) {
  check_ground(ground);
  if (options.three_nearest) {
    tree_ = tree_for_interpolation(ground, options.depth);
    interpolated_ = interpolate_heights(height_points(ground), tree_, progress);
    grid_ = grid_of(interpolated_);
  } else {
    tree_ = BisectionTree::over(ground.width, ground.depth, options.depth);
    grid_ = grid_of(ground);
  }
  const double area = static_cast<double>(grid_.cell_x) * grid_.cell_z * tree_.side() * tree_.side();
  short_side_ = static_cast<float>(std::sqrt(2 * area / static_cast<double>(tree_.triangles())));
  bounds_ = TriangleBounds(grid_, tree_, progress);
  if (options_.holes == HoleRule::kConforming) splits_.emplace(tree_);
  if (visibility.depth > 0) use_visibility(std::move(visibility));
}

void Mrbsp::use_visibility(ChangeTable visibility) {
  const mrbsp::visibility::CellGrid& cells = visibility.cells;
  const bool fits = visibility.depth <= tree_.depth() && visibility.ground == ground_checksum(grid_, tree_) &&
                    (grid_.width - 2) / cells.side + 1 == cells.columns &&
                    (grid_.depth - 2) / cells.side + 1 == cells.rows;
  if (!fits) {
    throw usage_error("the change table is for other ground or another depth", "visibility",
                      "compute it for this field and depth");
  }
  options_.visibility = true;
  visibility_ = std::move(visibility);
  flags_ = mrbsp::visibility::Flags(visibility_);
}

void Mrbsp::edited(const SampleRect& rect) {
  check_edit(rect, ground_.width, ground_.depth);
  Progress silent;
  SampleRect changed = rect;
  if (options_.three_nearest) {
    interpolated_ = interpolate_heights(height_points(ground_), tree_, silent);
    grid_ = grid_of(interpolated_);
    changed = {{0, 0}, {grid_.width - 1, grid_.depth - 1}};
  }
  bounds_.update(grid_, tree_, changed.low, changed.high);
  if (!first_) append_heights(grid_, changed, edits_);
  if (options_.visibility) use_visibility(changes_of(find_sets(grid_, tree_, options_.visible, silent)));
}

int Mrbsp::threshold(const glm::vec3& eye, const glm::vec3& vertex) const {
  return std::clamp(rule().threshold(eye, vertex), 1, tree_.depth());
}

bool Mrbsp::on_the_ground(const glm::vec3& eye) const {
  const float u = eye.x / grid_.cell_x, v = eye.z / grid_.cell_z;
  const auto width = static_cast<float>(grid_.width - 1), depth = static_cast<float>(grid_.depth - 1);
  if (!(u >= 0 && v >= 0 && u <= width && v <= depth)) return false;
  // Less than the slack of the conservative sets.
  constexpr float kSlack = 0.005F;
  const float samples = sample_height(grid_, u, v);
  const float surface = surface_height(tree_, grid_, eye.x, eye.z);
  // The ground does not block lines of sight that stay below it, so an eye below it sees hidden triangles.
  return eye.y >= surface && eye.y <= std::max(samples, surface) + visibility_.eye_height + kSlack;
}

const Frame& Mrbsp::update(const View& view) {
  check_view(view);
  std::size_t toggled = 0;
  const bool hide = options_.visibility && on_the_ground(view.eye);
  if (hide) {
    const glm::vec2 at(view.eye.x / grid_.cell_x, view.eye.z / grid_.cell_z);
    toggled = flags_.move_to(visibility_, visibility_.cells.cell_at(at.x, at.y));
  }
  const Frustum frustum(view);
  next_.clear();
  const WalkEye eye{view.eye, options_.cull ? &frustum : nullptr, hide ? &flags_ : nullptr};
  walk_tree({grid_, tree_, bounds_}, rule(), eye,
            {splits_ ? &*splits_ : nullptr, pending_, options_.holes == HoleRule::kPrinted}, next_);
  publish(toggled);
  return frame_;
}

void Mrbsp::publish(std::size_t toggled) {
  uploads_.assign(edits_.begin(), edits_.end());
  edits_.clear();
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
  Memory memory =
      payload_memory(interpolated_.heights, visibility_.start, visibility_.changes, indices_, next_);
  memory.index += heap_bytes(this);
  memory += index_memory(pending_, visibility_.first, batches_, uploads_, edits_);
  memory += bounds_.memory();
  memory += flags_.memory();
  if (splits_) memory += splits_->memory();
  return memory;
}

}  // namespace terrabench
