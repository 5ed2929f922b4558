#include "lod/mrbsp/visibility.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "lod/mrbsp/area_visibility.h"
#include "lod/mrbsp/line_of_sight.h"
#include "terrain/error.h"
#include "terrain/files.h"

namespace terrabench {
namespace {

CellGrid make_cells(const GroundGrid& ground, const BisectionTree& tree, int most) {
  const int longest = std::max(ground.width, ground.depth) - 1;
  CellGrid cells;
  cells.side = tree.square_at(tree.depth());
  while ((longest - 1) / cells.side + 1 > most) cells.side *= 2;
  cells.columns = (ground.width - 2) / cells.side + 1;
  cells.rows = (ground.depth - 2) / cells.side + 1;
  return cells;
}

void check(const VisibilityOptions& options) {
  const auto refuse = [](std::string_view what, std::string_view name, std::string_view advice) {
    throw usage_error(what, name, advice);
  };
  if (options.cells < 1 || options.cells > 1024)
    refuse("so many cells cannot be", "cells", "choose 1 to 1024");
  if (options.eyes < 1 || options.eyes > 64) refuse("so many eyes cannot be", "eyes", "choose 1 to 64");
  if (options.coarseness < 0 || options.coarseness > BisectionTree::kDeepest) {
    refuse("triangles of visibility cannot be so coarse", "coarseness",
           fmt::format("choose 0 to {}", BisectionTree::kDeepest));
  }
  if (!(options.eye_height >= 0 && options.eye_height <= 1e6F)) {
    refuse("eyes cannot be at this height", "eye_height", "choose 0 to 1e6 m");
  }
}

}  // namespace

SurfaceChecksum surface_checksum(const GroundGrid& ground, const BisectionTree& tree) {
  const std::string name = checksum(fmt::format("{} {} {:a} {:a} {} {} {}", ground.width, ground.depth,
                                                ground.cell_x, ground.cell_z, tree.side(), tree.depth(),
                                                checksum(std::as_bytes(ground.heights))));
  SurfaceChecksum sum{};
  std::copy_n(name.begin(), sum.size(), sum.begin());
  return sum;
}

VisibleSets::VisibleSets(CellGrid cells, int depth, float eye_height)
    : cells(cells), depth(depth), words(((std::size_t{1} << depth) + 63) / 64), eye_height(eye_height) {
  constexpr std::size_t kMostWords = std::size_t{1} << 26;
  const std::size_t count = words * static_cast<std::size_t>(cells.count());
  if (count > kMostWords) {
    throw usage_error(fmt::format("the sets of {} cells and {} triangles do not fit 512 MiB", cells.count(),
                                  std::size_t{1} << depth),
                      "cells", "choose fewer cells or coarser triangles");
  }
  bits.resize(count);
}

std::size_t VisibleSets::count(int cell) const {
  std::size_t count = 0;
  for (std::size_t w = 0; w < words; ++w)
    count += static_cast<std::size_t>(std::popcount(bits[cell * words + w]));
  return count;
}

VisibilityHead visibility_head(const GroundGrid& ground, const BisectionTree& tree,
                               const VisibilityOptions& options) {
  check(options);
  int depth = std::clamp(tree.depth() - options.coarseness, 1, kDeepestCoarse);
  depth -= depth % 2 == 0 ? 1 : 0;
  return {make_cells(ground, tree, options.cells), depth};
}

VisibleSets find_visible(const GroundGrid& ground, const BisectionTree& tree,
                         const VisibilityOptions& options, Progress& progress) {
  const VisibilityHead head = visibility_head(ground, tree, options);
  const CellGrid& cells = head.cells;
  VisibleSets sets(cells, head.depth, options.eye_height);
  sets.surface = surface_checksum(ground, tree);
  sets.conservative = options.conservative;
  progress.begin("finding what is visible", static_cast<std::uint64_t>(cells.count()));
  const CoarseSquares squares(tree, head.depth);
  if (options.conservative) {
    const AreaVisibility areas(ground, tree, cells, options.eye_height);
    tbb::parallel_for(0, cells.count(), [&](int cell) {
      areas.find(squares, cell, sets);
      progress.advance();
    });
  } else {
    const LineOfSight lines(ground, squares);
    tbb::parallel_for(0, cells.count(), [&](int cell) {
      lines.find(cell, options.eyes, sets);
      progress.advance();
    });
  }
  progress.end();
  return sets;
}

}  // namespace terrabench
