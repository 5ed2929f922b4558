#include "lod/mrbsp/visibility_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "terrain/error.h"

namespace terrabench {
namespace {

// Calls body(from, to) for the cells of every step, in the table's order.
template <class Body>
void each_step(const CellGrid& cells, const Body& body) {
  for (int row = 0; row < cells.rows; ++row) {
    for (int column = 0; column + 1 < cells.columns; ++column) {
      body(row * cells.columns + column, row * cells.columns + column + 1);
    }
  }
  for (int row = 0; row + 1 < cells.rows; ++row) {
    for (int column = 0; column < cells.columns; ++column) {
      body(row * cells.columns + column, (row + 1) * cells.columns + column);
    }
  }
}

std::uint64_t count_changes(const VisibleSets& sets) {
  std::uint64_t count = 0;
  each_step(sets.cells, [&](int from, int to) {
    for (std::size_t w = 0; w < sets.words; ++w) {
      count += static_cast<std::uint64_t>(
          std::popcount(sets.bits[from * sets.words + w] ^ sets.bits[to * sets.words + w]));
    }
  });
  return count;
}

}  // namespace

VisibilityTable changes_of(const VisibleSets& sets) {
  constexpr std::uint64_t kMostChanges = std::uint64_t{1} << 28;  // 1 GiB
  const std::uint64_t changes = count_changes(sets);
  if (changes > kMostChanges) {
    throw usage_error(fmt::format("the {} changes between cells do not fit 1 GiB", changes), "cells",
                      "choose fewer cells or coarser triangles");
  }
  VisibilityTable table{sets.cells, sets.depth, sets.eye_height, sets.surface, sets.conservative, {},
                        {0},        {}};
  const auto each_bit = [](std::uint64_t word, std::size_t w, std::vector<std::uint32_t>& out) {
    for (; word != 0; word &= word - 1) {
      out.push_back(static_cast<std::uint32_t>(w * 64) + static_cast<std::uint32_t>(std::countr_zero(word)));
    }
  };
  for (std::size_t w = 0; w < sets.words; ++w) each_bit(sets.bits[w], w, table.start);
  table.first.reserve(static_cast<std::size_t>(table.steps()) + 1);
  table.changes.reserve(changes);
  each_step(sets.cells, [&](int from, int to) {
    for (std::size_t w = 0; w < sets.words; ++w) {
      each_bit(sets.bits[from * sets.words + w] ^ sets.bits[to * sets.words + w], w, table.changes);
    }
    table.first.push_back(static_cast<std::uint32_t>(table.changes.size()));
  });
  return table;
}

VisibleSets sets_of(const VisibilityTable& table) {
  VisibleSets sets(table.cells, table.depth, table.eye_height);
  sets.surface = table.surface;
  sets.conservative = table.conservative;
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

std::string_view head_fault(const VisibilityTable& table) {
  constexpr int kMostCells = 1 << 20, kLargestSide = 1 << 15;
  const CellGrid& c = table.cells;
  if (c.columns < 1 || c.rows < 1 || c.columns > kMostCells || c.rows > kMostCells / c.columns) {
    return "the number of cells cannot be";
  }
  if (c.side < 1 || c.side > kLargestSide || (c.side & (c.side - 1)) != 0) {
    return "the side of a cell is not a power of two";
  }
  if (table.depth < 1 || table.depth > kDeepestCoarse) return "the depth cannot be";
  if (!(table.eye_height >= 0 && table.eye_height <= 1e6F)) return "the eye height cannot be";
  for (const char c : table.surface) {
    if (!((c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'))) return "the surface's checksum is none";
  }
  return {};
}

bool is_consistent(const VisibilityTable& table) {
  std::vector<std::uint32_t> around;
  for (int row = 0; row + 1 < table.cells.rows; ++row) {
    for (int column = 0; column + 1 < table.cells.columns; ++column) {
      around.clear();
      for (const int step : {table.step_right(column, row), table.step_down(column + 1, row),
                             table.step_right(column, row + 1), table.step_down(column, row)}) {
        around.insert(around.end(), table.step(step).begin(), table.step(step).end());
      }
      std::sort(around.begin(), around.end());
      for (std::size_t k = 0; k < around.size(); k += 2) {
        if (k + 1 == around.size() || around[k] != around[k + 1]) return false;
      }
    }
  }
  return true;
}

}  // namespace terrabench
