#include "representations/coding/column_codec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "representations/coding/height_codec.h"
#include "representations/coding/range_coder.h"
#include "terrain/memory.h"

namespace terrabench {
namespace {

constexpr int kMostRuns = ColumnGrid::kMaxLevels;

template <class Coder>
class ColumnCoder {
 public:
  explicit ColumnCoder(Coder& coder) : coder_(coder) {}

  // Appends a column whose topmost end is `top`, above 0. `known`: its runs, where an encoder knows them.
  void column(std::span<const Run> known, int top, std::span<const Run> west, std::span<const Run> north,
              std::span<const Run> north_west, std::vector<Run>& out) {
    const auto size = [](std::span<const Run> runs) { return static_cast<std::int32_t>(runs.size()); };
    const auto few = [&](std::span<const Run> runs) { return std::min<std::size_t>(runs.size(), 3); };
    const std::int32_t guess = west.empty() ? size(north) : size(west);
    const std::int32_t difference = count_[4 * few(west) + few(north)].code(coder_, size(known) - guess);
    // Damaged files hold differences of any size.
    const int n = static_cast<int>(
        std::clamp<std::int64_t>(std::int64_t{guess} + difference, 1, std::min(top, kMostRuns)));
    int bottom = 0;
    for (int k = 0; k < n; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const bool knows = at < known.size();
      const std::size_t alike = at < west.size() ? static_cast<std::size_t>(west[at].material) : 0;
      auto& material = material_[std::min<std::size_t>(alike, 3) << 2 | std::min(k, 3)];
      const auto of = static_cast<Material>(
          material.code(coder_, knows ? static_cast<std::uint32_t>(known[at].material) : 0));
      const int last = top - (n - 1 - k);  // room for the runs above
      int end = top;
      if (k + 1 < n) {
        const auto [kind, expected] = expect(at, n, bottom, west, north, north_west);
        const std::int32_t miss = end_[kind].code(coder_, (knows ? known[at].top : 0) - expected);
        end = static_cast<int>(std::clamp<std::int64_t>(std::int64_t{expected} + miss, bottom + 1, last));
      }
      out.push_back({static_cast<std::uint16_t>(bottom), static_cast<std::uint16_t>(end), of});
      bottom = end;
    }
  }

 private:
  // Where run k ends: as its neighbours' runs k do, if they have as many.
  static std::pair<std::size_t, std::int32_t> expect(std::size_t k, int n, int bottom,
                                                     std::span<const Run> west, std::span<const Run> north,
                                                     std::span<const Run> north_west) {
    const auto same = [&](std::span<const Run> runs) { return static_cast<int>(runs.size()) == n; };
    if (same(west) && same(north)) {
      const std::int32_t w = west[k].top, v = north[k].top;
      if (!same(north_west)) return {1, (w + v) / 2};
      return {0, std::clamp(w + v - north_west[k].top, std::min(w, v), std::max(w, v))};
    }
    if (same(west)) return {2, west[k].top};
    if (same(north)) return {3, north[k].top};
    return {4, k < west.size() ? west[k].top : bottom};
  }

  Coder& coder_;
  std::array<NumberModel, 16> count_;
  std::array<NumberModel, 5> end_;
  std::array<SymbolModel<8>, 16> material_;
};

// The neighbours of column (i, j) among those before it.
struct Neighbours {
  std::span<const Run> west, north, north_west;

  Neighbours(const ColumnsOfRuns& columns, int width, std::size_t c) {
    const auto w = static_cast<std::size_t>(width);
    if (c % w != 0) west = columns.column(c - 1);
    if (c >= w) north = columns.column(c - w);
    if (c % w != 0 && c >= w) north_west = columns.column(c - w - 1);
  }
};

}  // namespace

ColumnsOfRuns columns_of(const Representation& built, const ColumnGrid& grid) {
  ColumnsOfRuns columns;
  std::vector<float> x, z(static_cast<std::size_t>(grid.width));
  for (int i = 0; i < grid.width; ++i) x.push_back(grid.centre_x(i));
  SpanSink sink;
  RunList runs;
  for (int j = 0; j < grid.depth; ++j) {
    std::ranges::fill(z, grid.centre_z(j));
    sink.clear();
    built.spans({x, z}, sink);
    for (std::size_t i = 0; i < x.size(); ++i) {
      runs.clear();
      for (const Span& span : sink.column(i)) {
        const auto [begin, end] = grid.quantise(span.bottom, span.top);
        runs.add(begin, Material::kAir);
        runs.add(end, span.material);
      }
      columns.runs.insert(columns.runs.end(), runs.runs().begin(), runs.runs().end());
      columns.first.push_back(static_cast<std::uint32_t>(columns.runs.size()));
    }
  }
  return columns;
}

void fill(Representation& empty, const ColumnGrid& grid, const ColumnsOfRuns& columns) {
  std::vector<float> x, z;
  std::vector<Span> what;
  for (int j = 0; j < grid.depth; ++j) {
    x.clear(), z.clear(), what.clear();
    for (int i = 0; i < grid.width; ++i) {
      for (const Run& run : columns.column(grid.index(i, j))) {
        if (run.material == Material::kAir) continue;
        x.push_back(grid.centre_x(i));
        z.push_back(grid.centre_z(j));
        what.push_back({grid.edge_y(run.bottom), grid.edge_y(run.top), run.material});
      }
    }
    empty.edit({x, z}, what);
  }
}

void encode_columns(const ColumnGrid& grid, const ColumnsOfRuns& columns, ByteSink& out) {
  grid.save(out);
  std::vector<float> tops;
  for (std::size_t c = 0; c < grid.columns(); ++c) {
    const auto runs = columns.column(c);
    tops.push_back(runs.empty() ? std::numeric_limits<float>::quiet_NaN() : runs.back().top);
  }
  encode_heights(tops, grid.width, 1, out);
  RangeEncoder coder;
  ColumnCoder<RangeEncoder> code(coder);
  std::vector<Run> same;
  for (std::size_t c = 0; c < grid.columns(); ++c) {
    const auto runs = columns.column(c);
    if (runs.empty()) continue;
    const Neighbours near(columns, grid.width, c);
    same.clear();
    code.column(runs, runs.back().top, near.west, near.north, near.north_west, same);
  }
  const std::vector<std::byte> bytes = coder.finish();
  out.put(static_cast<std::uint64_t>(bytes.size()));
  out.put_array(std::span<const std::byte>(bytes));
}

ColumnsOfRuns decode_columns(ByteSource& in, ColumnGrid& grid) {
  grid = ColumnGrid::load(in);
  if (!(grid.edge_y(0) < grid.edge_y(1) && grid.edge_y(grid.levels - 1) < grid.edge_y(grid.levels)))
    in.fail("levels thinner than floats tell apart");
  const std::vector<float> tops = decode_heights(in, grid.width, grid.depth);
  const std::vector<std::byte> bytes = in.get_array<std::byte>(in.get<std::uint64_t>());
  RangeDecoder coder(bytes, in);
  ColumnCoder<RangeDecoder> code(coder);
  ColumnsOfRuns columns;
  const std::size_t most = std::min<std::size_t>(available_memory() / (2 * sizeof(Run)), UINT32_MAX);
  for (std::size_t c = 0; c < grid.columns(); ++c) {
    if (columns.runs.size() > most) in.fail("more runs than fit the memory");
    if (!std::isnan(tops[c])) {
      if (!(tops[c] >= 1 && tops[c] <= static_cast<float>(grid.levels)))
        in.fail("a column's height is impossible");
      const Neighbours near(columns, grid.width, c);
      std::vector<Run> runs;
      code.column({}, static_cast<int>(tops[c]), near.west, near.north, near.north_west, runs);
      columns.runs.insert(columns.runs.end(), runs.begin(), runs.end());
    }
    columns.first.push_back(static_cast<std::uint32_t>(columns.runs.size()));
  }
  if (!coder.at_end()) in.fail("bytes follow the last column");
  return columns;
}

}  // namespace terrabench
