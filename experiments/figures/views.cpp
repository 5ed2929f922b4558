#include "experiments/figures/views.h"

#include <utility>

namespace terrabench::figures {

SceneMesh wired(const TriangleMesh& mesh, std::vector<std::uint8_t> wires, float wire_width,
                Rgb wire_colour) {
  SceneMesh item;
  item.mesh = &mesh;
  item.shading = Shading::kFlat;
  item.wire_width = wire_width;
  item.wire_color = wire_colour;
  item.wires = std::move(wires);
  return item;
}

SceneMesh rock(const TriangleMesh& mesh) {
  SceneMesh item;
  item.mesh = &mesh;
  item.colors.assign(mesh.positions.size(), {196, 178, 158});
  item.shading_exaggeration = 1;
  return item;
}

Image wire_view(GlContext& gl, const TriangleMesh& mesh, const Look& look, float wire_width) {
  Scene scene;
  scene.meshes.push_back(wired(mesh, quad_wires(mesh), wire_width));
  return render_scene(gl, scene, look.at(bounds_of(mesh)));
}

}  // namespace terrabench::figures
