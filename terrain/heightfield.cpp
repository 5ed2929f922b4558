#include "terrain/heightfield.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <xxhash.h>

#include <algorithm>
#include <memory>

#include "terrain/error.h"

namespace terrabench {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

HeightRange range_of(const float* heights, std::size_t count) {
  HeightRange range{kInfinity, -kInfinity, 0};
  for (std::size_t i = 0; i < count; ++i) {
    const float h = heights[i];
    // Comparisons with NaN are false: a hole changes neither bound.
    range.lowest = h < range.lowest ? h : range.lowest;
    range.highest = h > range.highest ? h : range.highest;
    range.no_data += h != h;
  }
  return range;
}

HeightRange join(const HeightRange& a, const HeightRange& b) {
  return {std::min(a.lowest, b.lowest), std::max(a.highest, b.highest), a.no_data + b.no_data};
}

}  // namespace

float Heightfield::sample(float x, float z) const {
  const float u = x / cell_x, v = z / cell_z;
  if (!(u >= 0 && v >= 0 && u <= static_cast<float>(width - 1) && v <= static_cast<float>(depth - 1))) {
    return kNoData;
  }
  const int i = std::min(static_cast<int>(u), std::max(width - 2, 0));
  const int j = std::min(static_cast<int>(v), std::max(depth - 2, 0));
  const int i1 = std::min(i + 1, width - 1), j1 = std::min(j + 1, depth - 1);
  const float s = u - static_cast<float>(i), t = v - static_cast<float>(j);
  // Written so that each grid point gives its own height to the last bit, at the far borders (s or t = 1)
  // too.
  const float north = at(i, j) * (1 - s) + at(i1, j) * s;
  const float south = at(i, j1) * (1 - s) + at(i1, j1) * s;
  return north * (1 - t) + south * t;
}

HeightRange height_range(const Heightfield& field) {
  using Range = tbb::blocked_range<std::size_t>;
  constexpr std::size_t kGrain = std::size_t{1} << 16;
  return tbb::parallel_reduce(
      Range(0, field.heights.size(), kGrain), HeightRange{kInfinity, -kInfinity, 0},
      [&](const Range& range, const HeightRange& before) {
        return join(before, range_of(field.heights.data() + range.begin(), range.size()));
      },
      join);
}

Heightfield crop(const Heightfield& field, int i0, int j0, int width, int depth) {
  // Written without i0 + width, which could overflow.
  if (i0 < 0 || j0 < 0 || width < 1 || depth < 1 || width > field.width - i0 || depth > field.depth - j0) {
    throw usage_error(fmt::format("{}×{} samples from ({}, {}) do not lie inside the terrain of {}×{}", width,
                                  depth, i0, j0, field.width, field.depth),
                      "crop", "give a rectangle of at least one sample inside the terrain");
  }
  Heightfield out = Heightfield::zeros(width, depth, field.cell_x, field.cell_z);
  out.georeference = field.georeference;
  std::array<double, 6>& t = out.georeference.transform;
  t[0] += i0 * t[1] + j0 * t[2];
  t[3] += i0 * t[4] + j0 * t[5];
  tbb::parallel_for(0, depth, [&](int j) {
    const float* const from = field.heights.data() + static_cast<std::size_t>(j0 + j) * field.width + i0;
    std::copy_n(from, width, out.heights.data() + static_cast<std::size_t>(j) * width);
  });
  return out;
}

std::string checksum(const Heightfield& field) {
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
  if (state == nullptr) throw std::bad_alloc();
  const std::array<int, 2> size{field.width, field.depth};
  const std::array<float, 2> cell{field.cell_x, field.cell_z};
  XXH3_128bits_reset(state.get());
  XXH3_128bits_update(state.get(), size.data(), sizeof size);
  XXH3_128bits_update(state.get(), cell.data(), sizeof cell);
  XXH3_128bits_update(state.get(), field.heights.data(), field.heights.size() * sizeof(float));
  const XXH128_hash_t hash = XXH3_128bits_digest(state.get());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace terrabench
