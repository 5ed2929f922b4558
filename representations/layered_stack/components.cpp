#include "representations/layered_stack/components.h"

#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "terrain/error.h"

namespace terrabench {
namespace {

struct Stretch {
  std::uint16_t bottom, top;
};

// The solid stretches of one row of columns, neighbouring materials joined, numbered on from `first_id`.
struct StretchRow {
  std::vector<Stretch> stretches;
  std::vector<std::uint32_t> starts;  // one per column, and the end
  std::size_t first_id = 0;

  void read(const LayeredStack& stack, int j, std::size_t id) {
    stretches.clear();
    starts.assign(1, 0);
    first_id = id;
    for (int i = 0; i < stack.grid().width; ++i) {
      stack.column(i, j).each_solid([&](std::uint16_t bottom, std::uint16_t top, Material) {
        if (stretches.size() > starts.back() && stretches.back().top == bottom) {
          stretches.back().top = top;
        } else {
          stretches.push_back({bottom, top});
        }
      });
      starts.push_back(static_cast<std::uint32_t>(stretches.size()));
    }
  }
};

// The smaller id becomes the root, so that the result does not depend on the order of unions.
class Forest {
 public:
  void grow(std::size_t size) {
    const std::size_t from = parent_.size();
    parent_.resize(size);
    std::iota(parent_.begin() + static_cast<std::ptrdiff_t>(from), parent_.end(),
              static_cast<std::uint32_t>(from));
  }
  std::size_t size() const { return parent_.size(); }
  std::uint32_t root(std::uint32_t id) {
    while (parent_[id] != id) id = parent_[id] = parent_[parent_[id]];  // path halving
    return id;
  }
  void unite(std::size_t a, std::size_t b) {
    const std::uint32_t p = root(static_cast<std::uint32_t>(a)), q = root(static_cast<std::uint32_t>(b));
    parent_[std::max(p, q)] = std::min(p, q);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

// Unites the stretches of column i of `a` and column k of `b` that share a level.
void join(const StretchRow& a, std::size_t i, const StretchRow& b, std::size_t k, Forest& forest) {
  for (std::size_t p = a.starts[i], q = b.starts[k]; p < a.starts[i + 1] && q < b.starts[k + 1];) {
    const Stretch s = a.stretches[p], t = b.stretches[q];
    if (s.bottom < t.top && t.bottom < s.top) forest.unite(a.first_id + p, b.first_id + q);
    s.top < t.top ? ++p : ++q;
  }
}

Forest connect(const LayeredStack& stack) {
  Forest forest;
  StretchRow north, row;
  for (int j = 0; j < stack.grid().depth; ++j) {
    row.read(stack, j, north.first_id + north.stretches.size());
    const std::size_t end = row.first_id + row.stretches.size();
    if (end > std::numeric_limits<std::uint32_t>::max()) {
      throw usage_error("the stack has more than 2³² solid stretches", "components",
                        "build the stack at a lower resolution");
    }
    forest.grow(end);
    for (std::size_t i = 0; i + 1 < row.starts.size(); ++i) {
      if (i > 0) join(row, i - 1, row, i, forest);
      if (j > 0) join(north, i, row, i, forest);
    }
    std::swap(north, row);
  }
  return forest;
}

}  // namespace

Components find_components(const LayeredStack& stack) {
  Forest forest = connect(stack);
  const ColumnGrid& grid = stack.grid();
  // Second pass, in the same order: first the components on the ground, then the sums over the others.
  std::vector<bool> grounded(forest.size());
  const auto for_each_row = [&](const auto& visit) {
    StretchRow row;
    for (int j = 0; j < grid.depth; ++j) {
      row.read(stack, j, row.first_id + row.stretches.size());
      visit(row);
    }
  };
  for_each_row([&](const StretchRow& row) {
    for (std::size_t s = 0; s < row.stretches.size(); ++s) {
      if (row.stretches[s].bottom == 0)
        grounded[forest.root(static_cast<std::uint32_t>(row.first_id + s))] = true;
    }
  });
  Components result;
  std::uint64_t solid = 0, floating = 0;  // cells
  for_each_row([&](const StretchRow& row) {
    for (std::size_t i = 0; i + 1 < row.starts.size(); ++i) {
      const std::size_t begin = row.starts[i], end = row.starts[i + 1];
      result.solid_columns += end > begin ? 1U : 0U;
      result.overhang_columns +=
          end > begin && (end - begin > 1 || row.stretches[begin].bottom > 0) ? 1U : 0U;
    }
    for (std::size_t s = 0; s < row.stretches.size(); ++s) {
      const auto id = static_cast<std::uint32_t>(row.first_id + s);
      const std::uint32_t root = forest.root(id);
      const int cells = row.stretches[s].top - row.stretches[s].bottom;
      solid += static_cast<std::uint64_t>(cells);
      result.total += root == id ? 1U : 0U;
      if (!grounded[root]) {
        floating += static_cast<std::uint64_t>(cells);
        result.floating += root == id ? 1U : 0U;
      }
    }
  });
  const double cell = grid.cell_x * grid.step * grid.cell_z;
  result.solid_volume = static_cast<double>(solid) * cell;
  result.floating_volume = static_cast<double>(floating) * cell;
  return result;
}

}  // namespace terrabench
