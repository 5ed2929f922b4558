#include "experiments/ght/textured.h"

#include <utility>

#include "experiments/figures/mesh_frame.h"
#include "experiments/figures/views.h"
#include "experiments/ght/tree_view.h"
#include "renderers/landscape/landscape.h"
#include "renderers/scene.h"

namespace terrabench::ght {

Image textured_view(GlContext& gl, const Ght& ght, const View& view, const Parameters& style) {
  TriangleMesh mesh = tree_surface(ght.model()).mesh;
  LandscapeRenderer renderer(gl, make_style(style, bounds_of(mesh)));
  const figures::MeshFrame ground(std::move(mesh));
  renderer.draw(ground.frame(), view);
  return renderer.image();
}

// All that is not ground is drawn as a scene, in which the ground has one colour; its pixels are then
// replaced by textured ones. At its outline that colour is mixed with what lies behind.
Image textured_block(GlContext& gl, const Ght& ght, const View& view, const Parameters& style,
                     const TriangleMesh& particles) {
  constexpr Rgb kGround{118, 112, 88}, kYellow{240, 200, 20};
  const TriangleMesh surface = tree_surface(ght.model()).mesh, sides = sides_of(ght);
  Scene scene;
  SceneMesh& ground = scene.meshes.emplace_back();
  ground.mesh = &surface;
  ground.shading = Shading::kFlat;
  ground.fill = kGround;
  scene.meshes.push_back(figures::rock(sides));
  if (particles.triangles() > 0) {
    scene.meshes.push_back(
        figures::wired(particles, std::vector<std::uint8_t>(particles.triangles(), 0), 0.8F));
    scene.meshes.back().fill = kYellow;
  }
  Image picture = render_scene(gl, scene, view);
  const Image textured = textured_view(gl, ght, view, style);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (picture.pixel(x, y) == kGround) picture.set(x, y, textured.pixel(x, y));
    }
  }
  return picture;
}

}  // namespace terrabench::ght
