#include "experiments/ght/tree_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <unordered_map>
#include <utility>

#include "experiments/figures/ground.h"
#include "experiments/figures/mesh_frame.h"
#include "renderers/landscape/landscape.h"

namespace terrabench::ght {
namespace {

using figures::CutPlane;
using figures::Look;

constexpr Rgb kRoot{110, 110, 115}, kGroundWire{120, 120, 124};
constexpr int kPlaneGrid = 8;  // lines across the root's plane

// Okabe & Ito's colours, without black and without yellow, which is too pale on white.
constexpr std::array<Rgb, 6> kColours{
    {{213, 94, 0}, {0, 114, 178}, {0, 158, 115}, {204, 121, 167}, {230, 159, 0}, {86, 180, 233}}};

// The same box for wires and solid, so that both show the tree in one place and size.
Bounds surface_bounds(const Ght& ght, const TriangleMesh& mesh) {
  Bounds box{glm::vec3(HUGE_VALF), glm::vec3(-HUGE_VALF)};
  for (const std::uint32_t v : mesh.indices) {  // a cut leaves vertices that no triangle uses
    box.low = glm::min(box.low, mesh.positions[v]);
    box.high = glm::max(box.high, mesh.positions[v]);
  }
  box.low.y = ght.bounds().low.y;
  return box;
}

double turn(glm::ivec2 a, glm::ivec2 b, glm::ivec2 c) {
  return static_cast<double>(b.x - a.x) * (c.y - a.y) - static_cast<double>(b.y - a.y) * (c.x - a.x);
}

// Of points sorted by x and then y (Andrew 1979).
std::vector<glm::ivec2> convex_hull(const std::vector<glm::ivec2>& points) {
  std::vector<glm::ivec2> hull;
  const auto add = [&](glm::ivec2 p, std::size_t fixed) {
    while (hull.size() >= fixed + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
    hull.push_back(p);
  };
  for (const glm::ivec2 p : points) add(p, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto p = points.rbegin(); p != points.rend(); ++p) add(*p, lower);
  hull.pop_back();
  return hull;
}

}  // namespace

TriangleMesh sides_of(const Ght& ght) {
  const Tree& tree = ght.model().tree;
  return figures::block_sides(
      tree.grid().width, tree.grid().depth, [&](int i, int j) { return tree.position(tree.at_sample(i, j)); },
      ght.bounds().low.y);
}

TreeSurface tree_surface(const Model& model) {
  const Tree& tree = model.tree;
  TreeSurface surface;
  std::unordered_map<std::uint64_t, std::uint32_t> vertices;  // of a cell in a node's triangles
  model.surface.each_triangle(tree, [&](const Face& face) {
    NodeId node = 0;
    for (const CellId c : face) node = std::max(node, tree.node_of(c));
    for (const CellId c : face) {
      const auto [at, added] = vertices.try_emplace(static_cast<std::uint64_t>(node) << 32 | c,
                                                    static_cast<std::uint32_t>(vertices.size()));
      if (added) surface.mesh.positions.push_back(tree.position(c));
      surface.mesh.indices.push_back(at->second);
    }
    surface.nodes.push_back(node);
  });
  compute_normals(surface.mesh);
  return surface;
}

std::vector<glm::vec3> plane_outline(const Tree& tree, NodeId n) {
  const GroundedHeightmap& node = tree.nodes()[n];
  std::vector<glm::ivec2> cells;
  for (int i = 0; i < node.columns; ++i) {
    int first = node.rows, last = -1;
    for (int j = 0; j < node.rows; ++j) {
      if (tree.kind(node.cell(i, j)) == CellKind::kVoid) continue;
      first = std::min(first, j);
      last = j;
    }
    if (last < 0) continue;
    cells.emplace_back(i, first);
    if (last > first) cells.emplace_back(i, last);
  }
  std::vector<glm::ivec2> hull;
  if (cells.size() >= 3) hull = convex_hull(cells);
  if (hull.size() < 3)
    hull = {{0, 0}, {node.columns - 1, 0}, {node.columns - 1, node.rows - 1}, {0, node.rows - 1}};
  std::vector<glm::vec3> corners;
  for (const glm::ivec2 c : hull) {
    corners.push_back(node.aligned ? glm::vec3(tree.grid().x(node.i0 + c.x), 0, tree.grid().z(node.j0 + c.y))
                                   : glm::vec3(node.plane.at(c.x, c.y, 0)));
  }
  return corners;
}

std::vector<ScenePlane> ground_planes(const Tree& tree) {
  std::vector<ScenePlane> planes{{plane_outline(tree, 0), kRoot, 0.06F, 2}};
  const float line = tree.nodes().size() > 1000 ? 0.7F : 2.5F;
  for (NodeId n = 1; n < tree.nodes().size(); ++n) {
    planes.push_back({plane_outline(tree, n), kColours[(n - 1) % kColours.size()], 0.3F, line});
  }
  return planes;
}

Image planes_view(GlContext& gl, const Ght& ght, const Look& look) {
  const SampleGrid& grid = ght.model().tree.grid();
  Scene scene;
  scene.planes = ground_planes(ght.model().tree);
  const float x1 = grid.x(grid.width - 1), z1 = grid.z(grid.depth - 1);
  for (int k = 1; k < kPlaneGrid; ++k) {
    const float share = static_cast<float>(k) / kPlaneGrid;
    scene.lines.push_back({{{share * x1, 0, 0}, {share * x1, 0, z1}}, {200, 200, 204}, 1});
    scene.lines.push_back({{{0, 0, share * z1}, {x1, 0, share * z1}}, {200, 200, 204}, 1});
  }
  return render_scene(gl, scene, look.at(bounds_of(scene)));  // planes need not be where the ground is
}

namespace {

Image draw_wires(GlContext& gl, const TreeSurface& surface, const View& view) {
  const std::vector<std::uint8_t> wires = quad_wires(surface.mesh);
  const auto part = [&](bool of_events) {
    const auto keep = [&](std::size_t t) { return (surface.nodes[t] != 0) == of_events; };
    std::vector<std::uint8_t> kept;
    for (std::size_t t = 0; t < wires.size(); ++t) {
      if (keep(t)) kept.push_back(wires[t]);
    }
    return std::pair(figures::part_of(surface.mesh, keep), std::move(kept));
  };
  const auto [ground, ground_wires] = part(false);
  const auto [made, made_wires] = part(true);
  Scene scene;
  scene.meshes.push_back(figures::wired(ground, ground_wires, 0.9F, kGroundWire));
  scene.meshes.push_back(figures::wired(made, made_wires, 1.1F, kColours[1]));
  return render_scene(gl, scene, view);
}

}  // namespace

Image wires_view(GlContext& gl, const Ght& ght, const Look& look) {
  TreeSurface surface = tree_surface(ght.model());
  for (const CutPlane& cut : look.cuts) figures::cut_away(surface.mesh, cut, &surface.nodes);
  return draw_wires(gl, surface, look.at(surface_bounds(ght, surface.mesh)));
}

Image wires_view(GlContext& gl, const Ght& ght, const View& view) {
  return draw_wires(gl, tree_surface(ght.model()), view);
}

Image solid_view(GlContext& gl, const Ght& ght, const Look& look) {
  TreeSurface surface = tree_surface(ght.model());
  std::vector<TriangleMesh> rocks{sides_of(ght)};
  for (const CutPlane& cut : look.cuts) {
    figures::cut_away(surface.mesh, cut);
    figures::cut_away(rocks[0], cut);
  }
  for (const CutPlane& cut : look.cuts) {
    TriangleMesh& face = rocks.emplace_back(figures::section_face(ght, cut, ght.bounds().size().x / 2000));
    for (const CutPlane& other : look.cuts) {
      if (&other != &cut) figures::cut_away(face, other);
    }
  }
  Scene scene;
  scene.lowest = bounds_of(surface.mesh).low.y;
  scene.highest = bounds_of(surface.mesh).high.y;
  scene.meshes.emplace_back().mesh = &surface.mesh;
  for (const TriangleMesh& mesh : rocks) scene.meshes.push_back(figures::rock(mesh));
  return render_scene(gl, scene, look.at(surface_bounds(ght, surface.mesh)));
}

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

std::vector<CutPlane> around(const Ght& ght, glm::ivec2 low, glm::ivec2 high) {
  const SampleGrid& grid = ght.model().tree.grid();
  return {{{grid.x(low.x), 0}, {-1, 0}},
          {{grid.x(high.x), 0}, {1, 0}},
          {{0, grid.z(low.y)}, {0, -1}},
          {{0, grid.z(high.y)}, {0, 1}}};
}

}  // namespace terrabench::ght
