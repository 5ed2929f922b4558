#include "experiments/mrbsp/ground.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lod/mrbsp/bisection_tree.h"
#include "terrain/sources/drawing/drawing.h"
#include "terrain/sources/fractal/diamond_square.h"

namespace terrabench::mrbsp {

TerrainSource open_ground(std::string_view name, std::uint64_t seed) {
  if (name == "real-257") {
    return source_of(name, resample(*open_terrain("jacksboro").heights, kSide, kSide));
  }
  if (name == "drawing-257") {
    return source_of(name, land_from_drawing(example_drawing(kSide, seed), {.peak = 1600}));
  }
  if (name == "rough-257") {
    return source_of(name, fractal::diamond_square({.seed = seed, .side = kSide, .hurst = 0.5F}));
  }
  return open_filled_heights(name, seed);
}

std::vector<std::string> grounds(const RunOptions& options, bool rough) {
  if (!rough) return terrabench::grounds(options, {"real-257", "drawing-257"});
  return terrabench::grounds(options, {"real-257", "drawing-257", "rough-257"});
}

int depth_over(const Heightfield& field) { return field.width == kSide && field.depth == kSide ? kDepth : 0; }

glm::ivec2 cell_below(const visibility::CellGrid& cells, const Heightfield& field, const glm::vec3& eye) {
  return {std::min(static_cast<int>(eye.x / field.cell_x) / cells.side, cells.columns - 1),
          std::min(static_cast<int>(eye.z / field.cell_z) / cells.side, cells.rows - 1)};
}

float eye_height(const Heightfield& field, float x, float z) {
  const BisectionTree tree = BisectionTree::over(field.width, field.depth, depth_over(field));
  return std::max(field.sample(x, z), surface_height(tree, grid_of(field), x, z)) + 1.8F;
}

std::vector<View> walk(const Heightfield& field, int views, float reach) {
  std::vector<View> all;
  const auto place = [&](double turn) {
    // A Lissajous curve of frequencies 2 and 3: closed, crosses the middle and itself.
    const double angle = 2 * std::numbers::pi * turn;
    return glm::vec2(
        field.extent_x() * (0.5F + 0.5F * reach * static_cast<float>(std::sin(2 * angle))),
        field.extent_z() * (0.5F + 0.5F * reach * static_cast<float>(std::sin(3 * angle + 0.7))));
  };
  for (int k = 0; k < views; ++k) {
    // Not where the curve crosses itself, so that no two eyes coincide.
    const glm::vec2 here = place((k + 0.4) / views), next = place((k + 0.65) / views);
    View view;
    view.eye = {here.x, eye_height(field, here.x, here.y), here.y};
    view.target = view.eye + glm::vec3(next.x - here.x, 0, next.y - here.y);
    view.vertical_fov = 0.53F;
    view.far = 2 * (field.extent_x() + field.extent_z());
    all.push_back(view);
  }
  return all;
}

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

double mean_triangles(Mrbsp& lod, const std::vector<View>& views) {
  double sum = 0;
  for (const View& view : views) sum += static_cast<double>(lod.update(view).stats.triangles);
  return sum / static_cast<double>(views.size());
}

}  // namespace terrabench::mrbsp
