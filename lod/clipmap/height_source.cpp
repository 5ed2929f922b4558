#include "lod/clipmap/height_source.h"

#include <algorithm>

#include "terrain/memory.h"

namespace terrabench {
namespace {

class FieldSource : public HeightSource {
 public:
  explicit FieldSource(const Heightfield& field) : field_(field) {}
  glm::ivec2 last() const override { return {field_.width - 1, field_.depth - 1}; }
  float cell_x() const override { return field_.cell_x; }
  float cell_z() const override { return field_.cell_z; }
  std::size_t bytes() const override { return heap_bytes(this); }

  void read(int level, int a, int b, int columns, int rows, float* out, int stride) override {
    for (int row = 0; row < rows; ++row, out += stride) {
      const float* line = &field_.heights[at(b + row, level, field_.depth) * field_.width];
      for (int column = 0; column < columns; ++column)
        out[column] = line[at(a + column, level, field_.width)];
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

}  // namespace

std::unique_ptr<HeightSource> heights_on_disk(std::unique_ptr<HeightPyramid> pyramid) {
  return std::make_unique<PyramidSource>(std::move(pyramid));
}

std::unique_ptr<HeightSource> heights_in_memory(const Heightfield& field) {
  return std::make_unique<FieldSource>(field);
}

}  // namespace terrabench
