#include "lod/mrbsp/mrbsp.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "lod/mrbsp/height_points.h"
#include "terrain/error.h"
#include "terrain/frustum.h"

namespace terrabench {
namespace {

// Bounds are kept for triangles so many levels above the finest, and at most 2^21 of them (16 MiB): what is
// smaller is culled with the triangle above it.
constexpr int kLevelsUnderBounds = 4, kDeepestBounds = 20;

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

// ⌊log2(x)⌋ for x ≥ 0, infinity included; far below for what is smaller than any normal number.
int floor_log2(float x) { return static_cast<int>(std::bit_cast<std::uint32_t>(x) >> 23) - 127; }

}  // namespace

// One walk down the tree for one view.
class Mrbsp::Walk {
 public:
  Walk(Mrbsp& lod, const View& view, const Frustum* frustum, bool hide)
      : lod_(lod),
        grid_(lod.grid_),
        eye_(view.eye),
        frustum_(frustum),
        hidden_depth_(hide ? lod.visibility_.depth : 0),
        depth_(lod.tree_.depth()),
        last_(grid_.width - 1, grid_.depth - 1) {
    const double s = lod.size_ * lod.short_side_;
    per_square_ = static_cast<float>(1 / (s * s));
  }

  void run() {
    const auto roots = lod_.tree_.roots();
    const unsigned planes = frustum_ != nullptr ? Frustum::kAllPlanes : 0;
    for (unsigned which = 0; which < 2; ++which) {
      const PlanTriangle& t = roots[which];
      descend(corner(t.apex), corner(t.left), corner(t.right), 1, 2 + which, planes);
    }
    // The cuts are known now: what distance left whole is drawn as they say.
    for (const Whole& w : lod_.whole_) {
      settle({place(w.apex), place(w.left), place(w.right)}, depth_of(w.node), w.node, w.planes);
    }
  }

 private:
  struct Corner {
    glm::ivec2 at;  // in the lattice, perhaps beyond the field
    int threshold;
  };

  glm::vec3 position(glm::ivec2 at) const {
    const glm::ivec2 drawn_in = glm::min(at, last_);
    return {static_cast<float>(drawn_in.x) * grid_.cell_x, grid_.heights[vertex(at)],
            static_cast<float>(drawn_in.y) * grid_.cell_z};
  }
  std::uint32_t vertex(glm::ivec2 at) const {
    const glm::ivec2 drawn_in = glm::min(at, last_);
    return static_cast<std::uint32_t>(drawn_in.y) * static_cast<std::uint32_t>(grid_.width) +
           static_cast<std::uint32_t>(drawn_in.x);
  }
  Corner corner(glm::ivec2 at) const {
    const glm::vec3 to = position(at) - eye_;
    const int steps = floor_log2(glm::dot(to, to) * per_square_);
    return {at, depth_ - (lod_.options_.area_consistent ? steps : steps >> 1)};
  }

  // Is there anything to draw in the triangle? Takes the planes of the view out that it lies inside of.
  bool is_seen(const PlanTriangle& t, int depth, std::uint32_t node, unsigned& planes) const {
    const glm::ivec2 low = glm::min(glm::min(t.apex, t.left), t.right);
    if (low.x >= last_.x || low.y >= last_.y) return false;  // flat: beyond the border, drawn in to a line
    if (depth <= hidden_depth_ && !lod_.visible_[node]) return false;
    if (planes == 0 || depth > lod_.bounds_depth_) return true;
    const Range& range = lod_.bounds_[node];
    const glm::ivec2 high = glm::min(glm::max(glm::max(t.apex, t.left), t.right), last_);
    const Bounds box{
        {static_cast<float>(low.x) * grid_.cell_x, range.lowest, static_cast<float>(low.y) * grid_.cell_z},
        {static_cast<float>(high.x) * grid_.cell_x, range.highest,
         static_cast<float>(high.y) * grid_.cell_z}};
    return frustum_->see(box, planes) != Sight::kOutside;
  }

  void descend(const Corner& apex, const Corner& left, const Corner& right, int depth, std::uint32_t node,
               unsigned planes) {
    const PlanTriangle t{apex.at, left.at, right.at};
    if (!is_seen(t, depth, node, planes)) return;
    if (depth < std::min({depth_, apex.threshold, left.threshold, right.threshold})) {
      const Corner foot = corner((left.at + right.at) / 2);
      if (lod_.options_.conforming) cut(foot.at);
      descend(foot, apex, left, depth + 1, 2 * node, planes);
      descend(foot, right, apex, depth + 1, 2 * node + 1, planes);
    } else if (depth == depth_) {
      put(t);
    } else if (lod_.options_.conforming) {
      lod_.whole_.push_back({packed(t.apex), packed(t.left), packed(t.right), node, planes});
    } else if (std::min(apex.threshold, depth_) < std::min({left.threshold, right.threshold, depth_})) {
      // The printed rule: the right angle alone is further off than the other two, so a hole may open at the
      // foot.
      put(BisectionTree::child(t, 0));
      put(BisectionTree::child(t, 1));
    } else {
      put(t);
    }
  }

  // Draws a triangle that distance leaves whole, in the parts that its neighbours' cuts ask for.
  void settle(const PlanTriangle& t, int depth, std::uint32_t node, unsigned planes) {
    if (depth == depth_ || !is_cut((t.left + t.right) / 2)) {
      put(t);
      return;
    }
    for (unsigned which = 0; which < 2; ++which) {
      const PlanTriangle half = BisectionTree::child(t, which);
      unsigned left = planes;
      if (is_seen(half, depth + 1, 2 * node + which, left)) settle(half, depth + 1, 2 * node + which, left);
    }
  }

  std::size_t bit_of(glm::ivec2 at) const {
    return static_cast<std::size_t>(at.y) * (static_cast<std::size_t>(lod_.tree_.side()) + 1) +
           static_cast<std::size_t>(at.x);
  }
  bool is_cut(glm::ivec2 foot) const {
    const std::size_t bit = bit_of(foot);
    return ((lod_.cuts_[bit / 64] >> (bit % 64)) & 1) != 0;
  }
  // With all that it needs. As deep as the tree at most: a cut's parents lie one level above it.
  void cut(glm::ivec2 at) {
    const std::size_t bit = bit_of(at);
    std::uint64_t& word = lod_.cuts_[bit / 64];
    const std::uint64_t mask = std::uint64_t{1} << (bit % 64);
    if ((word & mask) != 0) return;
    if (word == 0) lod_.marked_.push_back(static_cast<std::uint32_t>(bit / 64));
    word |= mask;
    const BisectionTree::Parents parents = lod_.tree_.parents(at);
    for (int k = 0; k < parents.count; ++k) cut(parents.at[k]);
  }

  void put(const PlanTriangle& t) {
    const glm::ivec2 low = glm::min(glm::min(t.apex, t.left), t.right);
    if (low.x >= last_.x || low.y >= last_.y) return;
    for (const glm::ivec2 at : {t.apex, t.left, t.right}) lod_.next_.push_back(vertex(at));
  }

  static std::array<std::uint16_t, 2> packed(glm::ivec2 at) {
    return {static_cast<std::uint16_t>(at.x), static_cast<std::uint16_t>(at.y)};
  }
  static glm::ivec2 place(std::array<std::uint16_t, 2> at) { return {at[0], at[1]}; }

  Mrbsp& lod_;
  const GroundGrid& grid_;
  glm::vec3 eye_;
  const Frustum* frustum_;
  int hidden_depth_;  // flags are looked at down to here
  int depth_;
  glm::ivec2 last_;
  float per_square_;  // 1 / (size·S)²
};

std::unique_ptr<Lod> Mrbsp::build(const Heightfield& ground, const Parameters& parameters,
                                  Progress& progress) {
  return std::make_unique<Mrbsp>(ground, options_of(parameters), progress);
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
  };
  return kParameters;
}

Mrbsp::Mrbsp(const Heightfield& ground, const MrbspOptions& options, Progress& progress)
    : Mrbsp(ground, options, {}, progress) {
  if (options_.visibility) {
    find_visibility(changes_of(find_visible(grid_, tree_, options_.visible, progress)));
  }
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
  find_bounds(progress);
  if (options_.conforming) {
    const std::size_t along = static_cast<std::size_t>(tree_.side()) + 1;
    cuts_.resize((along * along + 63) / 64);
  }
  if (visibility.depth > 0) find_visibility(std::move(visibility));
}

void Mrbsp::find_visibility(VisibilityTable visibility) {
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
  visible_ = VisibleNodes(visibility_);
}

void Mrbsp::find_bounds(Progress& progress) {
  bounds_depth_ = std::clamp(tree_.depth() - kLevelsUnderBounds, 1, kDeepestBounds);
  bounds_.resize(std::size_t{2} << bounds_depth_);
  const int finest = tree_.depth();
  const auto height = [&](glm::ivec2 at) {
    return grid_.heights[static_cast<std::size_t>(std::min(at.y, grid_.depth - 1)) * grid_.width +
                         std::min(at.x, grid_.width - 1)];
  };
  const auto include = [](Range& range, float h) {
    range.lowest = std::min(range.lowest, h);
    range.highest = std::max(range.highest, h);
  };
  // Corners of a triangle's subtree that are not its own lie at the feet of the cuts within.
  const auto feet = [&](const auto& self, const PlanTriangle& t, int depth, Range& range) -> void {
    if (depth == finest) return;
    include(range, height((t.left + t.right) / 2));
    self(self, BisectionTree::child(t, 0), depth + 1, range);
    self(self, BisectionTree::child(t, 1), depth + 1, range);
  };
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const auto join = [](const Range& a, const Range& b) {
    return Range{std::min(a.lowest, b.lowest), std::max(a.highest, b.highest)};
  };
  const auto subtree = [&](const auto& self, const PlanTriangle& t, int depth, NodeNumber node) -> void {
    if (depth == bounds_depth_) {
      Range range{kInfinity, -kInfinity};
      for (const glm::ivec2 at : {t.apex, t.left, t.right}) include(range, height(at));
      feet(feet, t, depth, range);
      bounds_[node] = range;
      return;
    }
    for (unsigned which = 0; which < 2; ++which) {
      self(self, BisectionTree::child(t, which), depth + 1, 2 * node + which);
    }
    bounds_[node] = join(bounds_[2 * node], bounds_[2 * node + 1]);
  };
  const int shared = std::min(bounds_depth_, 8);
  const NodeNumber first = NodeNumber{1} << shared;
  progress.begin("bounding triangles", first);
  tbb::parallel_for(first, 2 * first, [&](NodeNumber node) {
    subtree(subtree, tree_.triangle(node), shared, node);
    progress.advance();
  });
  for (NodeNumber node = first - 1; node >= 1; --node)
    bounds_[node] = join(bounds_[2 * node], bounds_[2 * node + 1]);
  progress.end();
}

int Mrbsp::threshold(const glm::vec3& eye, const glm::vec3& vertex) const {
  const double s = size_ * short_side_;
  const glm::vec3 to = vertex - eye;
  const int steps = floor_log2(glm::dot(to, to) * static_cast<float>(1 / (s * s)));
  return std::clamp(tree_.depth() - (options_.area_consistent ? steps : steps >> 1), 1, tree_.depth());
}

bool Mrbsp::on_the_ground(const glm::vec3& eye) const {
  const float u = eye.x / grid_.cell_x, v = eye.z / grid_.cell_z;
  const auto width = static_cast<float>(grid_.width - 1), depth = static_cast<float>(grid_.depth - 1);
  if (!(u >= 0 && v >= 0 && u <= width && v <= depth)) return false;
  const int i = std::min(static_cast<int>(u), grid_.width - 2),
            j = std::min(static_cast<int>(v), grid_.depth - 2);
  const float* const at = grid_.heights.data() + static_cast<std::size_t>(j) * grid_.width + i;
  const float s = u - static_cast<float>(i), t = v - static_cast<float>(j);
  const float north = at[0] * (1 - s) + at[1] * s;
  const float south = at[grid_.width] * (1 - s) + at[grid_.width + 1] * s;
  // Within the slack that the conservative sets are computed with.
  constexpr float kSlack = 0.005F;
  const float samples = north * (1 - t) + south * t;
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
    toggled = visible_.move_to(visibility_, glm::min(at, glm::ivec2(cells.columns - 1, cells.rows - 1)));
  }
  const Frustum frustum(view);
  next_.clear();
  Walk(*this, view, options_.cull ? &frustum : nullptr, hide).run();
  for (const std::uint32_t word : marked_) cuts_[word] = 0;
  marked_.clear();
  whole_.clear();

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
            .levels = {},
            .cell_x = grid_.cell_x,
            .cell_z = grid_.cell_z,
            .indices = indices_,
            .batches = batches_,
            .uploads = uploads_,
            .stats = count(batches_, uploads_, toggled)};
  return frame_;
}

Memory Mrbsp::memory() const {
  Memory memory = payload_memory(interpolated_.heights);
  memory.index += heap_bytes(this);
  for (const Memory& part :
       {index_memory(bounds_), index_memory(cuts_), index_memory(marked_), index_memory(whole_),
        payload_memory(visibility_.start), index_memory(visibility_.first),
        payload_memory(visibility_.changes), visible_.memory(), payload_memory(indices_),
        payload_memory(next_), index_memory(batches_), index_memory(uploads_)}) {
    memory += part;
  }
  return memory;
}

}  // namespace terrabench
