#include "lod/meters/screen_error.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace terrabench {
namespace {

// In pixels, between two heights of a sample, neither NaN.
double between(const Projector& project, const SeenSamples& seen, int i, int j, float a, float b) {
  const double x = static_cast<float>(i) * seen.cell_x(), z = static_cast<float>(j) * seen.cell_z();
  return a == b ? 0 : project.pixels_between({x, a, z}, {x, b, z});
}

struct Row {
  std::size_t first = 0;  // in `pixels`
  std::size_t samples = 0, undrawn = 0;
  double sum = 0;
};

// `pixels` has room for all samples; its order is unspecified afterwards.
Deviation deviation_of(const std::vector<Row>& rows, std::vector<float>& pixels, Distribution* pool) {
  Deviation all;
  double sum = 0;
  for (const Row& row : rows) {
    std::copy_n(pixels.begin() + static_cast<std::ptrdiff_t>(row.first), row.samples,
                pixels.begin() + static_cast<std::ptrdiff_t>(all.samples));
    all.samples += row.samples;
    all.undrawn += row.undrawn;
    sum += row.sum;
  }
  if (all.samples == 0) return all;
  if (pool != nullptr) pool->add(std::span(pixels).first(all.samples));
  const auto end = pixels.begin() + static_cast<std::ptrdiff_t>(all.samples);
  const auto rank = pixels.begin() + static_cast<std::ptrdiff_t>((99 * all.samples + 99) / 100 - 1);
  std::nth_element(pixels.begin(), rank, end);
  all.mean = sum / static_cast<double>(all.samples);
  all.p99 = *rank;
  all.largest = *std::max_element(rank, end);
  return all;
}

// from(i, j) and to(i, j) are heights; NaN where nothing is drawn.
template <class From, class To>
Deviation measure(const SeenSamples& seen, Seen least, const From& from, const To& to, Distribution* pool) {
  const Projector project(seen.view());
  std::vector<Row> rows(static_cast<std::size_t>(seen.depth()));
  tbb::parallel_for(0, seen.depth(), [&](int j) {
    for (int i = 0; i < seen.width(); ++i)
      rows[static_cast<std::size_t>(j)].samples += seen.at(i, j) >= least;
  });
  std::size_t total = 0;
  for (Row& row : rows) {
    row.first = total;
    total += row.samples;
    row.samples = 0;
  }
  std::vector<float> pixels(total);
  tbb::parallel_for(0, seen.depth(), [&](int j) {
    Row& row = rows[static_cast<std::size_t>(j)];
    for (int i = 0; i < seen.width(); ++i) {
      if (seen.at(i, j) < least) continue;
      const float a = from(i, j), b = to(i, j);
      if (std::isnan(a) || std::isnan(b)) {
        ++row.undrawn;
        continue;
      }
      const double distance = between(project, seen, i, j, a, b);
      pixels[row.first + row.samples++] = static_cast<float>(distance);
      row.sum += distance;
    }
  });
  return deviation_of(rows, pixels, pool);
}

template <class From, class To>
ScreenDeviation measure(const SeenSamples& seen, const From& from, const To& to, Distribution* pool) {
  return {measure(seen, Seen::kVisible, from, to, pool), measure(seen, Seen::kHidden, from, to, nullptr)};
}

}  // namespace

ScreenDeviation screen_error(const SurfaceRaster& drawn, const Heightfield& ground, const SeenSamples& seen,
                             Distribution* pool) {
  assert(drawn.width() == seen.width() && drawn.depth() == seen.depth());
  return measure(
      seen, [&](int i, int j) { return ground.at(i, j); }, [&](int i, int j) { return drawn.at(i, j); },
      pool);
}

std::vector<float> visible_errors(const SurfaceRaster& drawn, const Heightfield& ground,
                                  const SeenSamples& seen) {
  assert(drawn.width() == seen.width() && drawn.depth() == seen.depth());
  const Projector project(seen.view());
  std::vector<float> errors(ground.heights.size(), std::numeric_limits<float>::quiet_NaN());
  tbb::parallel_for(0, seen.depth(), [&](int j) {
    for (int i = 0; i < seen.width(); ++i) {
      if (seen.at(i, j) != Seen::kVisible || !drawn.is_drawn(i, j)) continue;
      errors[static_cast<std::size_t>(j) * static_cast<std::size_t>(seen.width()) +
             static_cast<std::size_t>(i)] =
          static_cast<float>(between(project, seen, i, j, ground.at(i, j), drawn.at(i, j)));
    }
  });
  return errors;
}

ScreenDeviation popping(const SurfaceRaster& before, const SurfaceRaster& after, const SeenSamples& seen,
                        Distribution* pool) {
  assert(before.width() == seen.width() && after.width() == seen.width());
  return measure(
      seen, [&](int i, int j) { return before.at(i, j); }, [&](int i, int j) { return after.at(i, j); },
      pool);
}

void Distribution::add(std::span<const float> pixels) {
  for (const float p : pixels) {
    ++counts_[std::bit_cast<std::uint32_t>(p) >> kShift];
    sum_ += static_cast<double>(p);
    squares_ += static_cast<double>(p) * static_cast<double>(p);
    largest_ = std::max(largest_, p);
  }
  samples_ += pixels.size();
}

double Distribution::quantile(double share) const {
  if (samples_ == 0) return 0;
  const auto rank = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(samples_)));
  std::uint64_t below = 0;
  std::uint32_t bin = 0;
  while ((below += counts_[bin]) < std::max<std::uint64_t>(rank, 1)) ++bin;
  // The top of the bin; 0 for the first bin, which holds practically only zeros.
  const float top = bin == 0 ? 0 : std::bit_cast<float>(((bin + 1) << kShift) - 1);
  return static_cast<double>(std::min(top, largest_));
}

}  // namespace terrabench
