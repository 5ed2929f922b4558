#include "lod/mrbsp/visibility/sets.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <bit>

#include "lod/mrbsp/visibility/area_occlusion.h"
#include "lod/mrbsp/visibility/line_of_sight.h"
#include "terrain/error.h"
#include "terrain/files.h"

namespace terrabench::mrbsp::visibility {
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

void check(const Options& options) {
  const auto check_range = [](std::string_view name, auto value, auto low, auto high) {
    if (value >= low && value <= high) return;
    throw usage_error(fmt::format("{} must be from {} to {}, got {}", name, low, high, value), name, "");
  };
  check_range("cells", options.cells, 1, 1024);
  check_range("coarseness", options.coarseness, 0, BisectionTree::kDeepest);
  check_range("eye_height", options.eye_height, 0.0F, 1e6F);
}

Sampling sampling_of(const Options& options) {
  switch (options.mode) {
    case Mode::kVertices:
      return {.eyes = Eyes::kSamples};
    case Mode::kFacing:
      return {.facing = true};
    case Mode::kInterior:
      return {.eyes = Eyes::kInside, .facing = true, .per_side = 2};
    default:
      return {};
  }
}

}  // namespace

GroundChecksum ground_checksum(const GroundGrid& ground, const BisectionTree& tree) {
  const std::string name = checksum(fmt::format("{} {} {:a} {:a} {} {} {}", ground.width, ground.depth,
                                                ground.cell_x, ground.cell_z, tree.side(), tree.depth(),
                                                checksum(std::as_bytes(ground.heights))));
  GroundChecksum sum{};
  std::copy_n(name.begin(), sum.size(), sum.begin());
  return sum;
}

Sets::Sets(CellGrid cells, int depth, float eye_height)
    : cells(cells), depth(depth), words(((std::size_t{1} << depth) + 63) / 64), eye_height(eye_height) {
  constexpr std::size_t kMostWords = std::size_t{1} << 26;
  const std::size_t count = words * static_cast<std::size_t>(cells.count());
  if (count > kMostWords) {
    throw usage_error(fmt::format("sets of {} cells and {} triangles exceed 512 MiB", cells.count(),
                                  std::size_t{1} << depth),
                      "cells", "choose fewer cells or coarser triangles");
  }
  bits.resize(count);
}

std::size_t Sets::count(int cell) const {
  std::size_t count = 0;
  for (std::size_t w = 0; w < words; ++w)
    count += static_cast<std::size_t>(std::popcount(bits[cell * words + w]));
  return count;
}

Layout layout_of(const GroundGrid& ground, const BisectionTree& tree, const Options& options) {
  check(options);
  int depth = std::clamp(tree.depth() - options.coarseness, 1, kDeepestCoarse);
  depth -= depth % 2 == 0 ? 1 : 0;
  return {make_cells(ground, tree, options.cells), depth};
}

Sets find_sets(const GroundGrid& ground, const BisectionTree& tree, const Options& options,
               Progress& progress) {
  const Layout layout = layout_of(ground, tree, options);
  Sets sets(layout.cells, layout.depth, options.eye_height);
  sets.ground = ground_checksum(ground, tree);
  sets.mode = options.mode;
  const CoarseSquares squares(tree, layout.depth);
  const auto each_cell = [&](const auto& find) {
    progress.begin("computing visible sets", static_cast<std::uint64_t>(sets.cells.count()));
    tbb::parallel_for(0, sets.cells.count(), [&](int cell) {
      find(cell);
      progress.advance();
    });
    progress.end();
  };
  if (options.mode == Mode::kConservative) {
    const AreaOcclusion areas(ground, tree, sets.cells, options.eye_height);
    each_cell([&](int cell) { areas.find(squares, cell, sets); });
  } else {
    const LineOfSight lines(ground, squares);
    const Sampling sampling = sampling_of(options);
    each_cell([&](int cell) { lines.find(cell, sampling, sets); });
  }
  return sets;
}

}  // namespace terrabench::mrbsp::visibility
