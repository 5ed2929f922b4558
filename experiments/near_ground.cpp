#include "experiments/near_ground.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "experiments/scene.h"

namespace terrabench {

namespace {

// Fills the lowest level: tunnels of a cave terrain may reach its floor, below which the ground continues.
void add_bedrock(LayeredStack& stack) {
  const ColumnGrid& grid = stack.grid();
  std::vector<float> x, z;
  for (int j = 0; j < grid.depth; ++j) {
    for (int i = 0; i < grid.width; ++i) {
      x.push_back(grid.centre_x(i));
      z.push_back(grid.centre_z(j));
    }
  }
  const std::vector<Span> lowest(x.size(), {grid.edge_y(0), grid.edge_y(1), Material::kBedrock});
  stack.edit({x, z}, lowest);
}

}  // namespace

NearGround near_ground(const TerrainSource& source, int columns, int finer, Progress& progress) {
  Parameters parameters(representation("layered_stack").parameters);
  parameters.set("resolution", std::int64_t{columns});
  auto stack = LayeredStack::build_stack(source, parameters, progress);
  add_bedrock(*stack);
  NearGround ground;
  ground.surface =
      std::make_unique<ImplicitSurface>(std::move(stack), Kernel::kCube, 0, 0, Extractor::kMarchingCubes);
  ground.heights = height_map(ground.surface->stack(), ColumnHeight::kTop, finer);
  return ground;
}

NearGround ground_for(const TerrainSource& source, bool near_surface, int samples, Progress& progress) {
  if (source.solid && near_surface) return near_ground(source, samples - 1, 1, progress);
  return {nullptr, scene_heights(source, samples, progress)};
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

}  // namespace terrabench
