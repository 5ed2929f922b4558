#include "experiments/hybrid/near_ground.h"

#include <algorithm>
#include <cmath>

#include "experiments/build_at.h"

namespace terrabench::hybrid {

NearGround near_ground(const TerrainSource& source, int columns, int finer, Progress& progress) {
  auto built = build_at_resolution("implicit", source, columns, progress);
  NearGround ground;
  ground.surface.reset(&dynamic_cast<ImplicitSurface&>(*built));
  (void)built.release();
  ground.heights = height_map(ground.surface->stack(), ColumnHeight::kTop, finer);
  return ground;
}

View standing_on(const NearGround& ground, glm::vec2 place, float heading, float step) {
  const float x = place.x, z = place.y;
  SpanSink spans;
  ground.surface->spans({{&x, 1}, {&z, 1}}, spans);
  float top = ground.heights.sample(x, z);
  if (!spans.all().empty()) top = std::max(top, spans.all().back().top);
  View view;
  view.eye = {x, top + step, z};
  view.target = view.eye + glm::vec3(std::cos(heading), -0.25F, std::sin(heading));
  view.vertical_fov = 1.0F;
  view.near = 0.05F * step;
  view.far = 4 * (ground.heights.extent_x() + ground.heights.extent_z()) + 4 * view.eye.y;
  return view;
}

}  // namespace terrabench::hybrid
