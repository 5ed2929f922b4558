// Figure 24 of "ght": the rain of particles (§4.2), each of which takes a bowl out of the ground.
#include <array>
#include <cmath>
#include <random>

#include "experiments/ght/events.h"
#include "renderers/scene.h"
#include "terrain/events/event.h"
#include "terrain/source.h"

namespace terrabench::ght {
namespace {

constexpr int kParticles = 10000, kDrawn = 250, kSide = 257;
constexpr Rgb kYellow{240, 200, 20};

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(static_cast<std::mt19937::result_type>(seed)) {}
  double between(double low, double high) {
    return low + (high - low) * 0x1p-32 * static_cast<double>(random_());
  }

 private:
  std::mt19937 random_;
};

// Where a particle hits the ground it leaves half an ellipsoid, a third as deep as it is wide from the
// middle.
events::RadialErosion crash(const Ght& ght, Dice& dice) {
  const SampleGrid& grid = ght.model().tree.grid();
  const double radius = dice.between(1.2, 3) * grid.spacing();
  const double x = dice.between(radius, grid.x(grid.width - 1) - radius);
  const double z = dice.between(radius, grid.z(grid.depth - 1) - radius);
  return {{x, ght.model().surface.top(ght.model().tree, {x, z}), z}, {radius, radius / 3, radius}};
}

// Octahedra over the ground, on their way down.
TriangleMesh falling(const Ght& ght, Dice& dice) {
  const Bounds box = ght.bounds();
  const float size = 0.008F * box.size().x;
  TriangleMesh mesh;
  for (int k = 0; k < kDrawn; ++k) {
    const auto x = static_cast<float>(dice.between(0.02, 0.98)) * box.high.x;
    const auto z = static_cast<float>(dice.between(0.02, 0.98)) * box.high.z;
    const float ground = ght.model().surface.top(ght.model().tree, {x, z});
    const glm::vec3 centre(x, ground + static_cast<float>(dice.between(0.01, 0.25)) * box.high.x, z);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::vec3 corner :
         {glm::vec3(1, 0, 0), {0, 0, -1}, {-1, 0, 0}, {0, 0, 1}, {0, 1, 0}, {0, -1, 0}}) {
      mesh.positions.push_back(centre + size * corner);
    }
    for (std::uint32_t side = 0; side < 4; ++side) {
      const std::uint32_t next = (side + 1) % 4;
      mesh.indices.insert(mesh.indices.end(), {first + side, first + next, first + 4});
      mesh.indices.insert(mesh.indices.end(), {first + next, first + side, first + 5});
    }
  }
  return mesh;
}

// A window of the ground's samples, with what happened to it.
TriangleMesh window(const Ght& ght, int first, int last) {
  const SampleGrid& grid = ght.model().tree.grid();
  TriangleMesh mesh = tree_surface(ght.model()).mesh;
  const glm::vec2 low(grid.x(first), grid.z(first)), high(grid.x(last), grid.z(last));
  cut_away(mesh, {low, {-1, 0}});
  cut_away(mesh, {low, {0, -1}});
  cut_away(mesh, {high, {1, 0}});
  cut_away(mesh, {high, {0, 1}});
  // Without the vertices that are in no triangle, so that the view is of the window.
  TriangleMesh kept;
  std::vector<std::uint32_t> at(mesh.positions.size(), kNone);
  for (const std::uint32_t v : mesh.indices) {
    if (at[v] == kNone) {
      at[v] = static_cast<std::uint32_t>(kept.positions.size());
      kept.positions.push_back(mesh.positions[v]);
    }
    kept.indices.push_back(at[v]);
  }
  return kept;
}

Image window_view(GlContext& context, const Ght& ght, const Look& look) {
  const TriangleMesh mesh = window(ght, 96, 160);
  Scene scene;
  SceneMesh& ground = scene.meshes.emplace_back();
  ground.mesh = &mesh;
  ground.shading = Shading::kFlat;
  ground.wire_width = 0.9F;
  ground.wires = quad_wires(mesh);
  return render_scene(context, scene, overview(bounds_of(mesh), look.width, look.height, look.from));
}

Image particles_view(GlContext& context, const Ght& ght, const TriangleMesh& particles, const Look& look) {
  TriangleMesh surface = tree_surface(ght.model()).mesh;
  const TriangleMesh sides = block_sides(ght);
  Scene scene;
  scene.lowest = bounds_of(surface).low.y;
  scene.highest = bounds_of(surface).high.y;
  scene.meshes.emplace_back().mesh = &surface;
  SceneMesh& block = scene.meshes.emplace_back();
  block.mesh = &sides;
  block.colors.assign(sides.positions.size(), {196, 178, 158});
  block.shading_exaggeration = 1;
  if (particles.triangles() > 0) {
    SceneMesh& rain = scene.meshes.emplace_back();
    rain.mesh = &particles;
    rain.shading = Shading::kFlat;
    rain.fill = kYellow;
    rain.wire_width = 0.8F;
    rain.wires.assign(particles.triangles(), 0);  // outlines alone
  }
  return render_scene(context, scene, overview(bounds_of(scene), look.width, look.height, look.from));
}

}  // namespace

void draw_rain(GlContext& context, std::uint64_t seed, Recorder& recorder) {
  const TerrainSource source = open_terrain("hills", 1);
  const Heightfield field = resample(*source.heights, kSide, kSide);
  Ght ght({kSide, kSide, field.cell_x, field.cell_z, 0, 0}, field.heights,
          height_range(field).lowest - 4 * field.cell_x);
  const Look look{{0.45F, 0.7F, 1.0F}, 760, 520, {}};
  Dice dice(seed);
  const TriangleMesh rain = falling(ght, dice);
  std::vector<std::vector<Panel>> rows(2);
  rows[0].push_back({planes_view(context, ght, look), "before: ground plane"});
  rows[0].push_back({window_view(context, ght, look), "wireframe, a window of 65 × 65"});
  rows[0].push_back({particles_view(context, ght, rain, look), "solid, the rain begins"});
  for (int k = 0; k < kParticles; ++k) ght.apply(crash(ght, dice));
  rows[1].push_back({planes_view(context, ght, look), "after 10,000 particles: ground planes"});
  rows[1].push_back({window_view(context, ght, look), "wireframe, the same window"});
  rows[1].push_back({particles_view(context, ght, {}, look), "solid"});
  write_panels(rows,
               recorder.figure("ght.F24", "png",
                               "Figure 24 of the paper: a rain of particles (yellow, some of them drawn), "
                               "each of which erodes the ground where it crashes; 257 × 257 samples"));
}

}  // namespace terrabench::ght
