#include "experiments/figures/heightmap_image.h"

#include <cmath>

namespace terrabench::figures {

Image heightmap_image(const Heightfield& field) {
  const HeightRange range = height_range(field);
  const float span = range.highest - range.lowest;
  Image image(field.width, field.depth, {});
  for (int j = 0; j < field.depth; ++j) {
    for (int i = 0; i < field.width; ++i) {
      const float share = span > 0 ? (field.at(i, j) - range.lowest) / span : 0.5F;
      const auto grey = static_cast<std::uint8_t>(std::lround(255 * share));
      image.set(i, j, {grey, grey, grey});
    }
  }
  return image;
}

}  // namespace terrabench::figures
