#include "experiments/mrbsp/extruded_profile.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <set>

#include "experiments/mrbsp/ground.h"
#include "lod/lod.h"
#include "lod/mrbsp/bisection_tree.h"
#include "lod/mrbsp/mrbsp.h"

namespace terrabench::mrbsp {
namespace {

constexpr int kFineSegments = 1 << kFineDigits, kCoarseSegments = 1 << kCoarseDigits;
// Two triangles form an upright square at odd depths of the tree.
constexpr int kStripDepth = 2 * kFineDigits + 1, kStripCoarseDepth = 2 * kCoarseDigits + 1;

// Table 1 as printed, with its ellipsis.
constexpr std::array<PrintedStep, 3> kTable1{{{"a-b", "11", "1100, 1101, 1110, 1111"},
                                              {"d-e", "00, 01, 10, 11", "0000, 0001, 0010, 0011, ..."},
                                              {"g-h", "00", "0000, 0001, 0010, 0011"}}};

// Whether the step agrees with the table. Steps that the table does not list must change nothing.
bool is_printed(const std::string& name, const ProfileStep& step) {
  const auto line =
      std::find_if(kTable1.begin(), kTable1.end(), [&](const PrintedStep& l) { return l.name == name; });
  if (line == kTable1.end()) return step.coarse.empty() && step.fine.empty();
  const std::string fine = segment_labels(step.fine, kFineDigits);
  const std::string_view printed = line->fine.substr(0, line->fine.find("..."));
  const bool same_fine = printed == line->fine ? fine == printed : fine.starts_with(printed);
  return step.whole && same_fine && segment_labels(step.coarse, kCoarseDigits) == line->coarse;
}

using Segments = std::set<std::uint32_t>;

// The fine segments drawn for an observer on the ground in the middle of the cell.
Segments drawn_from(int cell, const Heightfield& strip, Mrbsp& lod) {
  View view;
  view.eye.x = (static_cast<float>(cell) + 0.5F) * strip.extent_x() / kProfileCells;
  view.eye.z = 0.5F * strip.extent_z();
  view.eye.y = surface_height(lod.tree(), grid_of(strip), view.eye.x, view.eye.z);
  view.target = view.eye + glm::vec3(1, 0, 0);
  Segments segments;
  const Frame& frame = lod.update(view);
  for (std::size_t k = 0; k < frame.indices.size(); k += 3) {
    const auto column = [&](std::size_t c) {
      return frame.indices[k + c] % static_cast<std::uint32_t>(strip.width);
    };
    segments.insert(std::min({column(0), column(1), column(2)}));
  }
  return segments;
}

}  // namespace

std::span<const float> table1_profile() {
  static constexpr std::array<float, kFineSegments + 1> kHeights{
      10.0F, 7.9F, 4.6F, 2.2F, 0.0F, 1.7F, 4.9F, 6.4F, 9.0F, 7.1F, 4.2F, 2.6F, 0.0F, 2.9F, 5.4F, 7.2F, 10.0F};
  return kHeights;
}

Heightfield extrude(std::span<const float> profile) {
  Heightfield strip;
  strip.width = static_cast<int>(profile.size());
  strip.depth = kFineSegments / kProfileCells + 1;  // a cell is square
  strip.cell_x = strip.cell_z = 1;
  for (int row = 0; row < strip.depth; ++row) {
    strip.heights.insert(strip.heights.end(), profile.begin(), profile.end());
  }
  return strip;
}

visibility::ChangeTable find_changes(const Heightfield& strip, visibility::Mode mode, Progress& progress) {
  const visibility::Options options{
      .mode = mode, .cells = kProfileCells, .coarseness = kStripDepth - kStripCoarseDepth, .eye_height = 0};
  const BisectionTree tree = BisectionTree::over(strip.width, strip.depth, kStripDepth);
  return changes_of(find_sets(grid_of(strip), tree, options, progress));
}

std::vector<ProfileStep> profile_steps(const Heightfield& strip, const visibility::ChangeTable& table,
                                       Progress& progress) {
  Mrbsp lod(strip, {.depth = kStripDepth, .cull = false}, table, progress);
  lod.tune(kFinest);
  const NodeNumber level = NodeNumber{1} << table.depth;
  std::vector<ProfileStep> steps;
  Segments before = drawn_from(0, strip, lod);
  for (int cell = 0; cell + 1 < table.cells.columns; ++cell) {
    ProfileStep& step = steps.emplace_back();
    std::array<int, kCoarseSegments> triangles{};
    for (const std::uint32_t element : table.step(table.step_right(cell, 0))) {
      const PlanTriangle t = lod.tree().triangle(level + element);
      ++triangles[static_cast<std::size_t>(std::min({t.apex.x, t.left.x, t.right.x}) /
                                           lod.tree().square_at(table.depth))];
    }
    for (std::uint32_t segment = 0; segment < kCoarseSegments; ++segment) {
      if (triangles[segment] > 0) step.coarse.push_back(segment);
      step.whole = step.whole && triangles[segment] % 2 == 0;
    }
    Segments after = drawn_from(cell + 1, strip, lod);
    std::set_symmetric_difference(before.begin(), before.end(), after.begin(), after.end(),
                                  std::back_inserter(step.fine));
    before = std::move(after);
  }
  return steps;
}

std::span<const PrintedStep> table1() { return kTable1; }

int lines_unlike_table1(std::span<const ProfileStep> steps) {
  int differing = 0;
  for (std::size_t k = 0; k < steps.size(); ++k) differing += !is_printed(step_name(k), steps[k]);
  return differing;
}

}  // namespace terrabench::mrbsp
