#include "experiments/ght/event_views.h"

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "renderers/scene.h"

namespace terrabench::ght {
namespace {

constexpr Rgb kRoot{110, 110, 115}, kGroundWire{120, 120, 124}, kRock{196, 178, 158};
constexpr int kPlaneGrid = 8;  // lines across the root's plane

// Okabe & Ito's colours, but for black and yellow, which is not seen on white.
constexpr std::array<Rgb, 6> kColours{
    {{213, 94, 0}, {0, 114, 178}, {0, 158, 115}, {204, 121, 167}, {230, 159, 0}, {86, 180, 233}}};

// The same box for all views of a tree, so that they show it in one place and size. Planes lie around 0,
// which need not be where the ground is.
View view_of(const Bounds& bounds, const Look& look) {
  return overview(bounds, look.width, look.height, look.from);
}

Bounds surface_bounds(const Ght& ght, const TriangleMesh& mesh) {
  Bounds box{glm::vec3(HUGE_VALF), glm::vec3(-HUGE_VALF)};
  for (const std::uint32_t v : mesh.indices) {  // a cut leaves vertices of no triangle
    box.low = glm::min(box.low, mesh.positions[v]);
    box.high = glm::max(box.high, mesh.positions[v]);
  }
  box.low.y = ght.bounds().low.y;
  return box;
}

SceneMesh wired(const TriangleMesh& mesh, Rgb colour, float width, std::vector<std::uint8_t> wires) {
  SceneMesh item;
  item.mesh = &mesh;
  item.shading = Shading::kFlat;
  item.wire_width = width;
  item.wire_color = colour;
  item.wires = std::move(wires);
  return item;
}

}  // namespace

Image planes_view(GlContext& context, const Ght& ght, const Look& look) {
  const Tree& tree = ght.model().tree;
  const SampleGrid& grid = tree.grid();
  Scene scene;
  scene.planes.push_back({plane_outline(tree, 0), kRoot, 0.06F, 2});
  const float x1 = grid.x(grid.width - 1), z1 = grid.z(grid.depth - 1);
  for (int k = 1; k < kPlaneGrid; ++k) {
    const float share = static_cast<float>(k) / kPlaneGrid;
    scene.lines.push_back({{{share * x1, 0, 0}, {share * x1, 0, z1}}, {200, 200, 204}, 1});
    scene.lines.push_back({{{0, 0, share * z1}, {x1, 0, share * z1}}, {200, 200, 204}, 1});
  }
  const float line = tree.nodes().size() > 1000 ? 0.7F : 2.5F;
  for (NodeId n = 1; n < tree.nodes().size(); ++n) {
    std::vector<glm::vec3> outline = plane_outline(tree, n);
    if (outline.size() >= 3)
      scene.planes.push_back({std::move(outline), kColours[(n - 1) % kColours.size()], 0.3F, line});
  }
  return render_scene(context, scene, view_of(bounds_of(scene), look));
}

Image wires_view(GlContext& context, const Ght& ght, const Look& look) {
  TreeSurface surface = tree_surface(ght.model());
  for (const CutPlane& cut : look.cuts) cut_away(surface.mesh, cut, &surface.nodes);
  const std::vector<std::uint8_t> wires = quad_wires(surface.mesh);
  const auto part = [&](bool of_events) {
    const auto keep = [&](std::size_t t) { return (surface.nodes[t] != 0) == of_events; };
    std::vector<std::uint8_t> kept;
    for (std::size_t t = 0; t < wires.size(); ++t) {
      if (keep(t)) kept.push_back(wires[t]);
    }
    return std::pair(part_of(surface.mesh, keep), std::move(kept));
  };
  const auto [ground, ground_wires] = part(false);
  const auto [made, made_wires] = part(true);
  Scene scene;
  scene.meshes.push_back(wired(ground, kGroundWire, 0.9F, ground_wires));
  scene.meshes.push_back(wired(made, kColours[1], 1.1F, made_wires));
  return render_scene(context, scene, view_of(surface_bounds(ght, surface.mesh), look));
}

Image solid_view(GlContext& context, const Ght& ght, const Look& look) {
  TreeSurface surface = tree_surface(ght.model());
  TriangleMesh sides = block_sides(ght);
  std::vector<TriangleMesh> faces;
  for (const CutPlane& cut : look.cuts) {
    cut_away(surface.mesh, cut);
    cut_away(sides, cut);
    faces.push_back(section_face(ght, cut, ght.bounds().size().x / 2000));
    for (const CutPlane& other : look.cuts) {
      if (&other != &cut) cut_away(faces.back(), other);
    }
  }
  Scene scene;
  scene.lowest = bounds_of(surface.mesh).low.y;
  scene.highest = bounds_of(surface.mesh).high.y;
  scene.meshes.reserve(2 + faces.size());
  SceneMesh& ground = scene.meshes.emplace_back();
  ground.mesh = &surface.mesh;
  SceneMesh& block = scene.meshes.emplace_back();
  block.mesh = &sides;
  block.colors.assign(sides.positions.size(), kRock);
  block.shading_exaggeration = 1;
  for (const TriangleMesh& face : faces) {
    SceneMesh& section = scene.meshes.emplace_back();
    section.mesh = &face;
    section.colors.assign(face.positions.size(), kRock);
    section.shading_exaggeration = 1;
  }
  return render_scene(context, scene, view_of(surface_bounds(ght, surface.mesh), look));
}

}  // namespace terrabench::ght
