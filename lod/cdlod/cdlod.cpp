#include "lod/cdlod/cdlod.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "terrain/error.h"

namespace terrabench {

using cdlod::Extremes;

namespace {

constexpr int kMostLevels = 8, kLargestSide = 256;
constexpr std::string_view kRanges[] = {"errors", "distance"};

// As many as one node needs to cover the ground.
int levels_of(const GroundGrid& grid, int side) {
  int levels = 1;
  while (levels < kMostLevels && side << (levels - 1) < std::max(grid.width, grid.depth) - 1) ++levels;
  return levels;
}

double focal_length(const View& view) {  // pixels
  return 0.5 * view.height / std::tan(0.5 * static_cast<double>(view.vertical_fov));
}

// The distance from the eye, in metres per metre of vertical error, from which on the error is at most
// `pixels` wherever it is on the screen: ScreenBound::allow() for a depth of distance / secant and the
// greatest spread.
double distance_per_error(const View& view, double pixels) {
  const double slope_y = std::tan(0.5 * static_cast<double>(view.vertical_fov));
  const double slope_x = slope_y * view.width / view.height;
  const double secant = std::sqrt(1 + slope_x * slope_x + slope_y * slope_y);
  // Slightly more, so that a check of the bound may round differently.
  return (1 + 1e-6) * secant * (focal_length(view) * secant + pixels) / pixels;
}

}  // namespace

std::span<const ParameterSpec> Cdlod::parameters() {
  static const ParameterSpec kSpecs[] = {
      {"node", std::int64_t{16}, "cells", "side of a node's mesh, a power of two", 4, kLargestSide},
      choice("ranges", kRanges,
             "of levels: by their errors on this ground, or doubling from level to level as in the paper"),
      {"morph", true, "", "morph vertices to the next coarser level; false leaves gaps between levels"},
  };
  return kSpecs;
}

std::unique_ptr<Lod> Cdlod::build(const LodGround& from, const Parameters& parameters, Progress& progress) {
  check_ground(from.heights);
  const Options options{static_cast<int>(parameters.integer("node")), parameters.choice("ranges") == 1,
                        parameters.flag("morph")};
  if (!std::has_single_bit(static_cast<unsigned>(options.side))) {
    throw usage_error(fmt::format("node must be a power of two, got {}", options.side), "node",
                      "choose 4, 8, 16, 32, 64, 128 or 256");
  }
  return std::make_unique<Cdlod>(from.heights, options, progress);
}

Cdlod::Cdlod(const Heightfield& ground, const Options& options, Progress& progress)
    : grid_(grid_of(ground)),
      options_(options),
      pixels_(knob().fallback),
      tree_(grid_, options.side, levels_of(grid_, options.side)),
      patterns_(tree_, options.side),
      errors_(grid_, tree_, options.side, progress),
      needs_(static_cast<std::size_t>(tree_.levels())),
      ranges_(needs_.size()),
      last_quarters_(tree_.count(), 0) {
  if (options.morph) morph_ranges_.resize(needs_.size());
}

void Cdlod::edited(const SampleRect& rect) {
  check_edit(rect, grid_.width, grid_.depth);
  tree_.measure(grid_, rect);
  errors_.measure(grid_, tree_, rect);
  if (!first_) append_heights(grid_, rect, edits_);
}

void Cdlod::tune(double pixels) { pixels_ = setting(knob(), pixels); }

void Cdlod::choose_ranges(const View& view) {
  const double per_error = distance_per_error(view, pixels_);
  const double per_cell = focal_length(view) / pixels_;
  const double cell_x = static_cast<double>(grid_.cell_x), cell_z = static_cast<double>(grid_.cell_z);
  for (int level = 0; level < tree_.levels(); ++level) {
    const Extremes& here = errors_.of(level);
    const double step = 1 << level, side = step * options_.side;
    cdlod::LevelNeeds& needs = needs_[static_cast<std::size_t>(level)];
    needs.node = std::hypot(side * cell_x, side * cell_z, static_cast<double>(here.relief));
    // A triangle at a joined side is two cells long.
    needs.triangle =
        std::hypot(step * std::max(std::hypot(2 * cell_x, cell_z), std::hypot(cell_x, 2 * cell_z)),
                   static_cast<double>(here.rise));
    if (level + 1 == tree_.levels()) break;
    if (options_.by_distance) {
      needs.end = per_cell * step * std::max(cell_x, cell_z);
    } else {
      needs.end = per_error * static_cast<double>(errors_.of(level + 1).drawn);
      // A vertex that has gone a share s of its way at distance d lies in triangles whose error is at most
      // (1 - s)·drawn + s·morphed, and whose points may be nearer. Both d and this are linear in s.
      needs.from = per_error * static_cast<double>(here.drawn) + needs.triangle;
      needs.to = per_error * static_cast<double>(here.morphed) + needs.triangle;
    }
  }
  cdlod::fit_ranges(needs_, ranges_);
  for (std::size_t level = 0; level < morph_ranges_.size(); ++level) {
    morph_ranges_[level] = ranges_[level].morph;
  }
}

// Whether some of the box may be nearer than the end of the level's range.
bool Cdlod::reaches(const Bounds& box, int level) const {
  const double end = ranges_[static_cast<std::size_t>(level)].end;
  double squares = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double eye = static_cast<double>(eye_[axis]);
    const double away =
        std::max({static_cast<double>(box.low[axis]) - eye, eye - static_cast<double>(box.high[axis]), 0.0});
    squares += away * away;
  }
  return squares < end * end;
}

// Of a node that reaches its level's range: draws the quarters at this level that do not reach the finer
// level's.
void Cdlod::select(int level, int x, int z, unsigned planes, const Frustum& frustum) {
  const Bounds box = tree_.box(level, x, z);
  if (frustum.see(box, planes) == Sight::kOutside) return;
  if (level == 0 || !reaches(box, level - 1)) {
    shown_.push_back({level, x, z, 0xF});
    return;
  }
  Shown here{level, x, z, 0};
  for (int quarter = 0; quarter < 4; ++quarter) {
    const int child_x = 2 * x + (quarter & 1), child_z = 2 * z + (quarter >> 1);
    if (!tree_.has(level - 1, child_x, child_z)) continue;
    const Bounds of_child = tree_.box(level - 1, child_x, child_z);
    unsigned planes_of_child = planes;
    if (reaches(of_child, level - 1)) {
      select(level - 1, child_x, child_z, planes, frustum);
    } else if (frustum.see(of_child, planes_of_child) != Sight::kOutside) {
      here.quarters |= 1U << quarter;
    }
  }
  if (here.quarters != 0) shown_.push_back(here);
}

// The sides at which a coarser level is drawn: that of neighbours which do not reach this level's range.
unsigned Cdlod::seams(const Shown& node) const {
  unsigned seams = 0;
  for (const auto& [side, dx, dz] :
       {std::tuple{kNorth, 0, -1}, {kEast, 1, 0}, {kSouth, 0, 1}, {kWest, -1, 0}}) {
    const int x = node.x + dx, z = node.z + dz;
    if (tree_.has(node.level, x, z) && !reaches(tree_.box(node.level, x, z), node.level)) seams |= 1U << side;
  }
  return seams;
}

void Cdlod::draw(const Shown& node) {
  const PatchGrid& grid = tree_.grid(node.level);
  const PatchGrid::Patch patch = grid.patch(node.x, node.z);
  const int shape = grid.shape(patch);
  const auto corner = static_cast<std::uint32_t>(patch.j0) * static_cast<std::uint32_t>(grid.width) +
                      static_cast<std::uint32_t>(patch.i0);
  const unsigned joined = options_.morph ? seams(node) : 0;
  for (int first = 0; first < 4;) {
    int last = first;
    while (last < 4 && (node.quarters >> last & 1U) != 0) ++last;
    const IndexRange range = patterns_.quarters(node.level, shape, first, last);
    if (range.index_count > 0) {
      batches_.push_back(
          {range.first_index, range.index_count, corner, static_cast<std::uint16_t>(node.level), joined});
    }
    first = last + 1;
  }
}

const Frame& Cdlod::update(const View& view) {
  check_view(view);
  choose_ranges(view);
  eye_ = view.eye;
  for (const Shown& node : last_shown_) last_quarters_[tree_.number(node.level, node.x, node.z)] = 0;
  for (const Shown& node : shown_) {
    last_quarters_[tree_.number(node.level, node.x, node.z)] = static_cast<std::uint8_t>(node.quarters);
  }
  std::swap(shown_, last_shown_);
  shown_.clear();
  const Frustum frustum(view);
  const PatchGrid& coarsest = tree_.grid(tree_.levels() - 1);
  for (int z = 0; z < coarsest.down(); ++z) {
    for (int x = 0; x < coarsest.across(); ++x) {
      select(tree_.levels() - 1, x, z, Frustum::kAllPlanes, frustum);
    }
  }
  make_frame();
  return frame_;
}

void Cdlod::make_frame() {
  batches_.clear();
  std::size_t changes = 0;
  for (const Shown& node : shown_) {
    changes += last_quarters_[tree_.number(node.level, node.x, node.z)] != node.quarters ? 1 : 0;
    draw(node);
  }
  uploads_.assign(edits_.begin(), edits_.end());
  edits_.clear();
  const auto size = [](const auto& values) { return static_cast<std::uint32_t>(values.size()); };
  if (first_) {
    uploads_.push_back({.target = DirtyRange::Target::kIndices, .count = size(patterns_.indices())});
    uploads_.push_back({.target = DirtyRange::Target::kHeights, .count = size(grid_.heights)});
    first_ = false;
  }
  frame_ = {.grid = grid_,
            .cell_x = grid_.cell_x,
            .cell_z = grid_.cell_z,
            .indices = patterns_.indices(),
            .batches = batches_,
            .patch_side = options_.morph ? options_.side : 0,
            .morph_ranges = morph_ranges_,
            .eye = eye_,
            .uploads = uploads_,
            .stats = count(batches_, uploads_, changes, morph_ranges_.size())};
}

Memory Cdlod::memory() const {
  Memory memory = patterns_.memory();
  memory.index += heap_bytes(this);
  memory += tree_.memory();
  memory += errors_.memory();
  memory += index_memory(needs_, ranges_, morph_ranges_, shown_, last_shown_, last_quarters_, batches_,
                         uploads_, edits_);
  return memory;
}

}  // namespace terrabench
