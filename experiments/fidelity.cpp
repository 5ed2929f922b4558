#include "experiments/fidelity.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace terrabench {
namespace {

struct RowSum {
  double squares = 0, largest = 0;
  std::size_t columns = 0, lost = 0;
};

RowSum compare_row(const Representation& built, const Heightfield& field, int j) {
  thread_local std::vector<float> x, z;
  thread_local SpanSink sink;
  x.resize(field.width);
  z.assign(field.width, static_cast<float>(j) * field.cell_z);
  for (int i = 0; i < field.width; ++i) x[i] = static_cast<float>(i) * field.cell_x;
  sink.clear();
  built.spans({x, z}, sink);
  RowSum sum;
  for (int i = 0; i < field.width; ++i) {
    const float height = field.at(i, j);
    const auto column = sink.column(i);
    if (Heightfield::is_no_data(height) != column.empty()) {
      ++sum.lost;
    } else if (!column.empty()) {
      const double error = static_cast<double>(column.back().top) - height;
      sum.squares += error * error;
      sum.largest = std::max(sum.largest, std::abs(error));
      ++sum.columns;
    }
  }
  return sum;
}

Fidelity against_heights(const Representation& built, const Heightfield& field, Progress& progress) {
  std::vector<RowSum> rows(field.depth);
  progress.begin("comparing with the heights", rows.size());
  tbb::parallel_for(0, field.depth, [&](int j) {
    rows[j] = compare_row(built, field, j);
    progress.advance();
  });
  Fidelity result;
  double squares = 0;
  for (const RowSum& row : rows) {  // in order: the same sum for any thread count
    squares += row.squares;
    result.largest_error = std::max(result.largest_error, row.largest);
    result.columns += row.columns;
    result.lost += row.lost;
  }
  result.rmse = result.columns == 0 ? 0 : std::sqrt(squares / static_cast<double>(result.columns));
  result.compared = result.columns > 0;
  return result;
}

Fidelity against_solid(const Representation& built, const Solid& solid, Progress& progress) {
  const glm::vec3 size = solid.bounds.size();
  const float step = std::max({size.x, size.y, size.z}) / static_cast<float>(kFidelitySamples);
  const int nx = std::max(1, static_cast<int>(std::lround(size.x / step))),
            nz = std::max(1, static_cast<int>(std::lround(size.z / step)));
  const int ny = std::max(1, static_cast<int>(std::lround(size.y / step)));
  std::vector<std::size_t> both(nz), either(nz);  // solid samples per row
  progress.begin("comparing with the solid", both.size());
  tbb::parallel_for(0, nz, [&](int k) {
    std::vector<Material> expected(ny), got(ny);
    std::vector<float> x(ny), y(ny), z(ny, solid.bounds.low.z + (static_cast<float>(k) + 0.5F) * step);
    for (int j = 0; j < ny; ++j) y[j] = solid.bounds.low.y + (static_cast<float>(j) + 0.5F) * step;
    for (int i = 0; i < nx; ++i) {
      std::fill(x.begin(), x.end(), solid.bounds.low.x + (static_cast<float>(i) + 0.5F) * step);
      solid.column({x[0], z[0], y[0], step}, expected);
      built.materials({x, y, z}, got);
      for (int j = 0; j < ny; ++j) {
        both[k] += expected[j] != Material::kAir && got[j] != Material::kAir;
        either[k] += expected[j] != Material::kAir || got[j] != Material::kAir;
      }
    }
    progress.advance();
  });
  const auto sum = [](const std::vector<std::size_t>& counts) {
    return static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::size_t{0}));
  };
  const double solid_samples = sum(either);
  return {.volume_iou = solid_samples == 0 ? 0 : sum(both) / solid_samples,
          .samples = static_cast<std::size_t>(nx) * ny * nz,
          .from_heights = false,
          .compared = solid_samples > 0};
}

}  // namespace

Fidelity measure_fidelity(const Representation& built, const TerrainSource& source, Progress& progress) {
  return source.heights ? against_heights(built, *source.heights, progress)
                        : against_solid(built, *source.solid, progress);
}

}  // namespace terrabench
