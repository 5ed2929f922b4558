#include "lod/clipmap/height_source.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "terrain/error.h"
#include "terrain/memory.h"
#include "terrain/sources/noise/lattice_noise.h"

namespace terrabench {
namespace {

class FieldSource : public HeightSource {
 public:
  explicit FieldSource(const Heightfield& field) : field_(field) {}
  glm::ivec2 last() const override { return {field_.width - 1, field_.depth - 1}; }
  float cell_x() const override { return field_.cell_x; }
  float cell_z() const override { return field_.cell_z; }
  std::size_t bytes() const override { return heap_bytes(this); }

  // Rows lie pages apart, so that a strip of few columns waits for memory at each, unless they are fetched
  // ahead.
  void read(int level, int a, int b, int columns, int rows, float* out, int stride) override {
    constexpr int kAhead = 32;  // rows
    const auto line = [&](int row) {
      return &field_.heights[at(b + row, level, field_.depth) * field_.width];
    };
    const std::size_t first = at(a, level, field_.width);
    for (int row = 0; row < rows; ++row, out += stride) {
      __builtin_prefetch(line(row + kAhead) + first);
      __builtin_prefetch(out + static_cast<std::ptrdiff_t>(kAhead) * stride, 1);
      const float* const from = line(row);
      for (int column = 0; column < columns; ++column)
        out[column] = from[at(a + column, level, field_.width)];
    }
  }

 private:
  static std::size_t at(int lattice, int level, int samples) {
    return static_cast<std::size_t>(
        std::clamp<std::int64_t>(static_cast<std::int64_t>(lattice) * (1 << level), 0, samples - 1));
  }
  const Heightfield& field_;
};

class PyramidSource : public HeightSource {
 public:
  explicit PyramidSource(std::unique_ptr<HeightPyramid> pyramid) : pyramid_(std::move(pyramid)) {}
  glm::ivec2 last() const override { return {pyramid_->width() - 1, pyramid_->depth() - 1}; }
  float cell_x() const override { return pyramid_->cell_x(); }
  float cell_z() const override { return pyramid_->cell_z(); }
  std::size_t bytes() const override { return heap_bytes(this) + pyramid_->bytes(); }

  void read(int level, int a, int b, int columns, int rows, float* out, int stride) override {
    pyramid_->read(level, a, b, columns, rows, out, stride);
  }

 private:
  std::unique_ptr<HeightPyramid> pyramid_;
};

constexpr int kBatch = 256;             // samples evaluated at once
constexpr int kBatchesOfOneThread = 8;  // fewer are not worth another thread

class NoiseSource : public HeightSource {
 public:
  explicit NoiseSource(const EndlessGround& ground)
      : ground_(ground),
        noise_({.seed = ground.seed, .cell_bits = ground.cell_bits, .octaves = ground.octaves}) {}

  glm::ivec2 first() const override { return glm::ivec2(-kEndlessReach); }
  glm::ivec2 last() const override { return glm::ivec2(kEndlessReach); }
  bool bounded() const override { return false; }
  float cell_x() const override { return ground_.cell; }
  float cell_z() const override { return ground_.cell; }
  std::size_t bytes() const override { return heap_bytes(this) + noise_.heap_bytes(); }

  // Batches run across the rectangle's rows, because strips may be only two samples wide.
  void read(int level, int a, int b, int columns, int rows, float* out, int stride) override {
    const int samples = columns * rows, batches = (samples + kBatch - 1) / kBatch;
    const auto run = [&](int batch) {
      const int begin = batch * kBatch, n = std::min(kBatch, samples - begin);
      std::array<std::int32_t, kBatch> x, z;
      std::array<float, kBatch> heights;
      const int row = begin / columns, column = begin % columns;
      const auto each = [&](auto use) {
        for (int k = 0, j = row, i = column; k < n; ++k) {
          use(k, j, i);
          if (++i == columns) ++j, i = 0;
        }
      };
      each([&](int k, int j, int i) {
        x[k] = sample(a + i, level);
        z[k] = sample(b + j, level);
      });
      const auto count = static_cast<std::size_t>(n);
      noise_.points({x.data(), count}, {z.data(), count}, {heights.data(), count});
      each([&](int k, int j, int i) {
        out[static_cast<std::ptrdiff_t>(j) * stride + i] = ground_.relief * heights[k];
      });
    };
    if (batches <= kBatchesOfOneThread) {
      for (int batch = 0; batch < batches; ++batch) run(batch);
    } else {
      tbb::parallel_for(tbb::blocked_range<int>(0, batches, kBatchesOfOneThread),
                        [&](const tbb::blocked_range<int>& part) {
                          for (int batch = part.begin(); batch < part.end(); ++batch) run(batch);
                        });
    }
  }

 private:
  static std::int32_t sample(int lattice, int level) {
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(
        static_cast<std::int64_t>(lattice) * (1 << level), -kEndlessReach, kEndlessReach));
  }

  EndlessGround ground_;
  noise::LatticeNoise noise_;
};

}  // namespace

std::unique_ptr<HeightSource> heights_on_disk(std::unique_ptr<HeightPyramid> pyramid) {
  return std::make_unique<PyramidSource>(std::move(pyramid));
}

std::unique_ptr<HeightSource> heights_in_memory(const Heightfield& field) {
  return std::make_unique<FieldSource>(field);
}

std::unique_ptr<HeightSource> endless_heights(const EndlessGround& ground) {
  if (!(ground.cell > 0 && std::isfinite(ground.cell) && std::isfinite(ground.relief))) {
    throw usage_error(
        fmt::format("cell must be positive and relief finite, got {} and {}", ground.cell, ground.relief),
        "endless ground", "give both in metres");
  }
  return std::make_unique<NoiseSource>(ground);
}

}  // namespace terrabench
