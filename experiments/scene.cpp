#include "experiments/scene.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "terrain/error.h"
#include "terrain/framing.h"

namespace terrabench {
namespace {

constexpr int kSteps = 64;      // samples of a column
constexpr int kFineSteps = 16;  // and again of the step that holds its surface

// The highest sample that is solid, or -1.
int highest_solid(std::span<const Material> column) {
  for (int k = static_cast<int>(column.size()) - 1; k >= 0; --k) {
    if (column[k] != Material::kAir) return k;
  }
  return -1;
}

float surface_height(const Solid& solid, float x, float z) {
  const float low = solid.bounds.low.y, tall = solid.bounds.size().y;
  const float step = tall / kSteps, fine = step / kFineSteps;
  std::array<Material, kSteps> column{};
  solid.column({x, z, low + 0.5F * step, step}, column);
  const int highest = highest_solid(column);
  const float from = low + (static_cast<float>(highest) + 0.5F) * step;  // solid, or below the ground
  const std::span<Material> above = std::span(column).first(kFineSteps);
  solid.column({x, z, from + fine, fine}, above);
  return std::clamp(from + (static_cast<float>(highest_solid(above)) + 1.5F) * fine, low, low + tall);
}

// The median of each sample's neighbourhood of 3 × 3. Where an overhang ends, single samples can stand far
// above all around them: as heights they would be needles and thin walls.
Heightfield without_spikes(const Heightfield& field) {
  Heightfield smooth = field;
  tbb::parallel_for(0, field.depth, [&](int j) {
    for (int i = 0; i < field.width; ++i) {
      std::array<float, 9> around{};
      std::size_t count = 0;
      for (int z = std::max(j - 1, 0); z <= std::min(j + 1, field.depth - 1); ++z) {
        for (int x = std::max(i - 1, 0); x <= std::min(i + 1, field.width - 1); ++x)
          around[count++] = field.at(x, z);
      }
      const auto middle = around.begin() + static_cast<std::ptrdiff_t>(count / 2);
      std::nth_element(around.begin(), middle, around.begin() + static_cast<std::ptrdiff_t>(count));
      smooth.at(i, j) = *middle;
    }
  });
  return smooth;
}

// Where ground overhangs, its heights jump, along borders that follow the samples in steps: drawn as it is,
// each step is a column on the cliff, lit and textured apart from its neighbours. Binomial means over a few
// samples round these steps off; hills are far wider.
Heightfield without_steps(Heightfield field) {
  constexpr int kRounds = 3;
  constexpr std::array kShares{1 / 16.0F, 4 / 16.0F, 6 / 16.0F, 4 / 16.0F, 1 / 16.0F};
  const auto mean = [&](const Heightfield& from, Heightfield& to, glm::ivec2 along) {
    tbb::parallel_for(0, field.depth, [&](int j) {
      for (int i = 0; i < field.width; ++i) {
        float sum = 0;
        for (int k = -2; k <= 2; ++k) {
          sum += kShares[static_cast<std::size_t>(k + 2)] *
                 from.at(std::clamp(i + k * along.x, 0, field.width - 1),
                         std::clamp(j + k * along.y, 0, field.depth - 1));
        }
        to.at(i, j) = sum;
      }
    });
  };
  Heightfield rows = field;
  for (int round = 0; round < kRounds; ++round) {
    mean(field, rows, {1, 0});
    mean(rows, field, {0, 1});
  }
  return field;
}

}  // namespace

Heightfield surface_heights(const Solid& solid, int samples, Progress& progress) {
  const glm::vec3 size = solid.bounds.size();
  const auto cells = static_cast<float>(samples - 1);
  Heightfield field = Heightfield::zeros(samples, samples, size.x / cells, size.z / cells);
  progress.begin("surface", samples);
  tbb::parallel_for(0, samples, [&](int j) {
    for (int i = 0; i < samples; ++i) {
      field.at(i, j) = surface_height(solid, solid.bounds.low.x + static_cast<float>(i) * field.cell_x,
                                      solid.bounds.low.z + static_cast<float>(j) * field.cell_z);
    }
    progress.advance();
  });
  progress.end();
  return field;
}

Heightfield scene_heights(const TerrainSource& source, int samples, Progress& progress) {
  Heightfield field = source.solid
                          ? without_steps(without_spikes(surface_heights(*source.solid, samples, progress)))
                          : fill_no_data(*source.heights);
  check_ground(field);
  return field;
}

View scene_view(const LandscapeStyle& style, const Heightfield& field, int width, int height) {
  const glm::vec3 size = style.ground.size();
  const float extent = std::max(size.x, size.z);
  View view;
  view.width = width;
  view.height = height;
  view.vertical_fov = 0.75F;
  view.eye = {0.5F * size.x, 0, 0.82F * size.z};
  const float ground = field.sample(view.eye.x, view.eye.z);
  const float base = style.has_water ? std::max(ground, style.water_level) : ground;
  view.eye.y = base + 0.03F * extent + 0.15F * size.y;
  view.target = {0.47F * size.x, base + 0.1F * size.y, 0.3F * size.z};
  view.near = 2e-4F * extent;
  view.far = std::max(kFarSides * extent, static_cast<float>(far_plane(view.eye, style.ground)));
  return view;
}

void refuse_empty(const View& view, const Bounds& ground) {
  const glm::vec3 middle = 0.5F * (ground.low + ground.high);
  throw usage_error(
      fmt::format("no ground is in view from ({:.6g}, {:.6g}, {:.6g}) towards ({:.6g}, {:.6g}, {:.6g})",
                  view.eye.x, view.eye.y, view.eye.z, view.target.x, view.target.y, view.target.z),
      "render",
      fmt::format(
          "look at the ground, which lies at x = 0 to {:.6g}, y = {:.6g} to {:.6g} and z = 0 to {:.6g}: "
          "--look-at {:.6g} {:.6g} {:.6g} is its middle",
          ground.high.x, ground.low.y, ground.high.y, ground.high.z, middle.x, middle.y, middle.z));
}

void check_eye(const View& view, const Frame& frame, const TerrainSource& source, const Heightfield& field) {
  const glm::vec3 eye = view.eye;
  const char* const advice = "raise the eye, or move it into the open";
  if (source.solid && !frame.meshes.empty()) {
    std::array<Material, 1> here{Material::kAir};
    const Bounds& box = source.solid->bounds;
    const bool inside =
        glm::all(glm::lessThanEqual(box.low, eye)) && glm::all(glm::lessThanEqual(eye, box.high));
    if (inside) source.solid->column({eye.x, eye.z, eye.y, 1}, here);
    const bool over_plan =
        eye.x >= box.low.x && eye.x <= box.high.x && eye.z >= box.low.z && eye.z <= box.high.z;
    if (over_plan && eye.y < box.low.y) here[0] = Material::kBedrock;  // ground continues below
    if (here[0] != Material::kAir) {
      throw usage_error(fmt::format("the eye ({:.6g}, {:.6g}, {:.6g}) is inside rock", eye.x, eye.y, eye.z),
                        "render", advice);
    }
    return;
  }
  const float ground = field.sample(eye.x, eye.z);
  if (eye.y <= ground) {
    throw usage_error(
        fmt::format(
            "the eye ({:.6g}, {:.6g}, {:.6g}) is {:.4g} m under the ground, whose surface is at {:.6g} m "
            "there",
            eye.x, eye.y, eye.z, ground - eye.y, ground),
        "render", advice);
  }
}

ScenePainter::ScenePainter(GlContext& context, Lod& lod, const LandscapeStyle& style)
    : context_(context), lod_(lod), renderer_(context, style) {}

void ScenePainter::grow(const Parameters& grass, const LandscapeStyle& style) {
  grass_.emplace(grass, style);
  renderer_.also = [this](const PassView& pass) { grass_->draw(pass); };
}

const Frame& ScenePainter::update(const View& view) {
  frame_ = &lod_.update(surroundings(view));
  if (grass_) grass_->update(*frame_, view);
  return *frame_;
}

Image ScenePainter::draw(const View& view, double seconds) {
  renderer_.draw(*frame_, view, seconds);
  return renderer_.image();
}

void ScenePainter::skip() { renderer_.skip(*frame_); }

}  // namespace terrabench
