#include "lod/mrbsp/visibility/change_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "terrain/error.h"

namespace terrabench::mrbsp::visibility {
namespace {

// The words in which the sets of two cells differ: body(word index, bits that differ).
template <class Body>
void each_difference(const Sets& sets, glm::ivec2 from, glm::ivec2 to, const Body& body) {
  const auto words_of = [&](glm::ivec2 cell) {
    return sets.bits.data() + (cell.y * sets.cells.columns + cell.x) * sets.words;
  };
  const std::uint64_t *const a = words_of(from), *const b = words_of(to);
  for (std::size_t w = 0; w < sets.words; ++w) body(w, a[w] ^ b[w]);
}

std::uint64_t count_changes(const Sets& sets) {
  std::uint64_t count = 0;
  each_step(sets.cells, [&](int, glm::ivec2 from, glm::ivec2 to) {
    each_difference(sets, from, to, [&](std::size_t, std::uint64_t bits) {
      count += static_cast<std::uint64_t>(std::popcount(bits));
    });
  });
  return count;
}

}  // namespace

ChangeTable changes_of(const Sets& sets) {
  constexpr std::uint64_t kMostChanges = std::uint64_t{1} << 28;  // 1 GiB
  const std::uint64_t changes = count_changes(sets);
  if (changes > kMostChanges) {
    throw usage_error(fmt::format("{} changes between cells exceed 1 GiB", changes), "cells",
                      "choose fewer cells or coarser triangles");
  }
  ChangeTable table{sets.cells, sets.depth, sets.eye_height, sets.ground, sets.mode, {}, {0}, {}};
  const auto append_bits = [](std::size_t w, std::uint64_t word, std::vector<std::uint32_t>& out) {
    for (; word != 0; word &= word - 1) {
      out.push_back(static_cast<std::uint32_t>(w * 64) + static_cast<std::uint32_t>(std::countr_zero(word)));
    }
  };
  for (std::size_t w = 0; w < sets.words; ++w) append_bits(w, sets.bits[w], table.start);
  table.first.reserve(static_cast<std::size_t>(table.steps()) + 1);
  table.changes.reserve(changes);
  each_step(sets.cells, [&](int, glm::ivec2 from, glm::ivec2 to) {
    each_difference(sets, from, to,
                    [&](std::size_t w, std::uint64_t bits) { append_bits(w, bits, table.changes); });
    table.first.push_back(static_cast<std::uint32_t>(table.changes.size()));
  });
  return table;
}

Sets sets_of(const ChangeTable& table) {
  Sets sets(table.cells, table.depth, table.eye_height);
  sets.ground = table.ground;
  sets.mode = table.mode;
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

std::string_view header_error(const ChangeTable& table) {
  constexpr int kMostCells = 1 << 20, kLargestSide = 1 << 15;
  const CellGrid& c = table.cells;
  if (c.columns < 1 || c.rows < 1 || c.columns > kMostCells || c.rows > kMostCells / c.columns) {
    return "the number of cells must be from 1 to 2^20";
  }
  if (c.side < 1 || c.side > kLargestSide || (c.side & (c.side - 1)) != 0) {
    return "the side of a cell must be a power of two up to 2^15";
  }
  if (table.depth < 1 || table.depth > kDeepestCoarse) return "the depth must be from 1 to 24";
  if (!(table.eye_height >= 0 && table.eye_height <= 1e6F)) return "the eye height must be from 0 to 1e6";
  for (const char c : table.ground) {
    if (!((c >= '0' && c <= '9') || (c >= 'a' && c <= 'f')))
      return "the ground's checksum has an invalid digit";
  }
  return {};
}

bool is_consistent(const ChangeTable& table) {
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

Flags::Flags(const ChangeTable& table)
    : depth_(table.depth), flags_(((std::size_t{2} << table.depth) + 63) / 64) {
  for (const std::uint32_t element : table.start) toggle(first_node(table.depth) + element);
}

void Flags::toggle(NodeNumber coarse_triangle) {
  const auto flip = [&](NodeNumber node) { flags_[node / 64] ^= std::uint64_t{1} << (node % 64); };
  flip(coarse_triangle);
  for (NodeNumber node = coarse_triangle / 2; node >= 1; node /= 2) {
    const bool visible = (*this)[2 * node] || (*this)[2 * node + 1];
    if (visible == (*this)[node]) return;
    flip(node);
  }
}

std::size_t Flags::move_to(const ChangeTable& table, glm::ivec2 cell) {
  std::size_t toggled = 0;
  const auto take = [&](int step) {
    for (const std::uint32_t element : table.step(step)) toggle(first_node(table.depth) + element);
    toggled += table.step(step).size();
  };
  for (; cell_.x < cell.x; ++cell_.x) take(table.step_right(cell_.x, cell_.y));
  for (; cell_.x > cell.x; --cell_.x) take(table.step_right(cell_.x - 1, cell_.y));
  for (; cell_.y < cell.y; ++cell_.y) take(table.step_down(cell_.x, cell_.y));
  for (; cell_.y > cell.y; --cell_.y) take(table.step_down(cell_.x, cell_.y - 1));
  return toggled;
}

}  // namespace terrabench::mrbsp::visibility
