#include "terrain/sources/drawing/drawing.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "terrain/error.h"
#include "terrain/memory.h"

namespace terrabench {
namespace {

void check(const GreyImage& picture, const DrawingOptions& options) {
  const auto within = [](float value, float lowest, float highest, std::string_view name,
                         std::string_view advice) {
    if (!(value >= lowest && value <= highest)) {
      throw usage_error("a drawing's adjustment is out of range", name, advice);
    }
  };
  if (picture.width < 1 || picture.height < 1) {
    throw usage_error("the drawing has no pixels", "picture", "give a picture of at least one pixel");
  }
  within(options.cell, 1e-3F, 1e6F, "cell", "choose 0.001 to 1e6 m");
  within(options.sea_level, 0, 0.999F, "sea_level", "choose 0 to 0.999");
  within(options.peak, 0, 1e6F, "peak", "choose 0 to 1e6 m");
  within(options.seabed, 0, 1, "seabed", "choose 0 to 1");
  within(options.mountains, 0, 1, "mountains", "choose 0 to 1");
  if (options.smoothing < 0 || options.smoothing > 1000) {
    throw usage_error("the number of smoothing passes is out of range", "smoothing", "choose 0 to 1000");
  }
}

float height_of(std::uint16_t grey, const DrawingOptions& options) {
  const float g = static_cast<float>(grey) / 65535, s = options.sea_level;
  return g >= s ? options.peak * ((g - s) / (1 - s)) : -options.seabed * options.peak * ((s - g) / s);
}

// The share by which each pass moves a sample: 1 for hills, 0 for mountains. It depends on the drawn height,
// so that smoothing cannot turn one into the other.
float softness(float height, const DrawingOptions& options) {
  const float foot = 0.75F * options.mountains * options.peak, top = options.mountains * options.peak;
  if (height >= top) return 0;
  return height <= foot ? 1 : (top - height) / (top - foot);
}

void smooth(Heightfield& field, const std::vector<float>& soft, std::vector<float>& next) {
  const int width = field.width, depth = field.depth;
  tbb::parallel_for(0, depth, [&](int j) {
    const int above = std::max(j - 1, 0), below = std::min(j + 1, depth - 1);
    const auto column = [&](int i) {
      return 0.25F * field.at(i, above) + 0.5F * field.at(i, j) + 0.25F * field.at(i, below);
    };
    for (int i = 0; i < width; ++i) {
      const std::size_t at = static_cast<std::size_t>(j) * width + i;
      const float mean =
          0.25F * column(std::max(i - 1, 0)) + 0.5F * column(i) + 0.25F * column(std::min(i + 1, width - 1));
      next[at] = field.heights[at] + soft[at] * (mean - field.heights[at]);
    }
  });
  field.heights.swap(next);
}

}  // namespace

Heightfield land_from_drawing(const GreyImage& picture, const DrawingOptions& options) {
  check(picture, options);
  const std::size_t fields = options.smoothing == 0 ? 1 : 3;
  require_memory(fields * sizeof(float) * picture.width * static_cast<std::size_t>(picture.height),
                 "land from a drawing", "give a smaller picture");
  Heightfield field = Heightfield::zeros(picture.width, picture.height, options.cell, options.cell);
  for (std::size_t k = 0; k < field.heights.size(); ++k) {
    field.heights[k] = height_of(picture.values[k], options);
  }
  if (options.smoothing == 0) return field;
  std::vector<float> soft(field.heights.size()), next(field.heights.size());
  for (std::size_t k = 0; k < soft.size(); ++k) soft[k] = softness(field.heights[k], options);
  for (int pass = 0; pass < options.smoothing; ++pass) smooth(field, soft, next);
  return field;
}

}  // namespace terrabench
