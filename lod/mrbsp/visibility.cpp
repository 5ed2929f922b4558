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

VisibleSets find_visible(const GroundGrid& ground, const BisectionTree& tree,
                         const VisibilityOptions& options, Progress& progress) {
  check(options);
  const CellGrid cells = make_cells(ground, tree, options.cells);
  int depth = std::clamp(tree.depth() - options.coarseness, 1, 24);
  depth -= depth % 2 == 0 ? 1 : 0;
  VisibleSets sets(cells, depth, options.eye_height);
  sets.surface = surface_checksum(ground, tree);
  progress.begin("finding what is visible", static_cast<std::uint64_t>(cells.count()));
  const CoarseSquares squares(tree, depth);
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

VisibilityTable changes_of(const VisibleSets& sets) {
  VisibilityTable table{sets.cells, sets.depth, sets.eye_height, sets.surface, {}, {0}, {}};
  const auto each_bit = [](std::uint64_t word, std::size_t w, std::vector<std::uint32_t>& out) {
    for (; word != 0; word &= word - 1) {
      out.push_back(static_cast<std::uint32_t>(w * 64) + static_cast<std::uint32_t>(std::countr_zero(word)));
    }
  };
  for (std::size_t w = 0; w < sets.words; ++w) each_bit(sets.bits[w], w, table.start);
  const auto step = [&](int from, int to) {
    for (std::size_t w = 0; w < sets.words; ++w) {
      each_bit(sets.bits[from * sets.words + w] ^ sets.bits[to * sets.words + w], w, table.changes);
    }
    table.first.push_back(static_cast<std::uint32_t>(table.changes.size()));
  };
  table.first.reserve(static_cast<std::size_t>(table.steps()) + 1);
  const int columns = sets.cells.columns, rows = sets.cells.rows;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column + 1 < columns; ++column) {
      step(row * columns + column, row * columns + column + 1);
    }
  }
  for (int row = 0; row + 1 < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      step(row * columns + column, (row + 1) * columns + column);
    }
  }
  return table;
}

VisibleSets sets_of(const VisibilityTable& table) {
  VisibleSets sets(table.cells, table.depth, table.eye_height);
  sets.surface = table.surface;
  for (const std::uint32_t element : table.start) sets.add(0, element);
  const auto apply = [&](int from, int to, int step) {
    const auto row = sets.bits.begin();
    const auto words = static_cast<std::ptrdiff_t>(sets.words);
    std::copy(row + from * words, row + (from + 1) * words, row + to * words);
    for (const std::uint32_t e : table.step(step)) {
      sets.bits[to * sets.words + e / 64] ^= std::uint64_t{1} << (e % 64);
    }
  };
  for (int row = 0; row < table.cells.rows; ++row) {
    const int cell = row * table.cells.columns;
    if (row > 0) apply(cell - table.cells.columns, cell, table.step_down(0, row - 1));
    for (int column = 1; column < table.cells.columns; ++column) {
      apply(cell + column - 1, cell + column, table.step_right(column - 1, row));
    }
  }
  return sets;
}

VisibleNodes::VisibleNodes(const VisibilityTable& table)
    : flags_(((std::size_t{2} << table.depth) + 63) / 64) {
  for (const std::uint32_t element : table.start) toggle((NodeNumber{1} << table.depth) + element);
}

void VisibleNodes::toggle(NodeNumber leaf) {
  const auto flip = [&](NodeNumber node) { flags_[node / 64] ^= std::uint64_t{1} << (node % 64); };
  flip(leaf);
  for (NodeNumber node = leaf / 2; node >= 1; node /= 2) {
    const bool visible = (*this)[2 * node] || (*this)[2 * node + 1];
    if (visible == (*this)[node]) return;
    flip(node);
  }
}

std::size_t VisibleNodes::move_to(const VisibilityTable& table, glm::ivec2 cell) {
  const NodeNumber level = NodeNumber{1} << table.depth;
  std::size_t toggled = 0;
  const auto take = [&](int step) {
    for (const std::uint32_t element : table.step(step)) toggle(level + element);
    toggled += table.step(step).size();
  };
  for (; cell_.x < cell.x; ++cell_.x) take(table.step_right(cell_.x, cell_.y));
  for (; cell_.x > cell.x; --cell_.x) take(table.step_right(cell_.x - 1, cell_.y));
  for (; cell_.y < cell.y; ++cell_.y) take(table.step_down(cell_.x, cell_.y));
  for (; cell_.y > cell.y; --cell_.y) take(table.step_down(cell_.x, cell_.y - 1));
  return toggled;
}

}  // namespace terrabench
