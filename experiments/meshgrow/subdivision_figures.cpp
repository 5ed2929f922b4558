// Figures 1 to 5 of "meshgrow": a Catmull–Clark step, fractal steps, the local frame and what it is for.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <set>

#include "experiments/cases.h"
#include "experiments/figures/figure.h"
#include "experiments/figures/projection.h"
#include "experiments/meshgrow/figure_numbers.h"
#include "experiments/meshgrow/growing_pictures.h"
#include "experiments/meshgrow/subdivision_reference.h"
#include "renderers/scene.h"
#include "representations/procedural_mesh/base_mesh.h"
#include "representations/procedural_mesh/subdivision/subdivide.h"
#include "terrain/sources/noise/program.h"

namespace terrabench::meshgrow {
namespace {

using namespace figures;
using namespace subdivision;

// Okabe and Ito's colours.
constexpr Rgb kBlue{0, 90, 178}, kOrange{213, 94, 0}, kGreen{0, 120, 90}, kGrey{150, 150, 155},
    kInk{25, 25, 30}, kClay{222, 206, 182};

Fans drawn(const FaceMesh& mesh) {
  Fans fans = fans_of(mesh);
  compute_normals(fans.mesh);
  return fans;
}

SceneMesh lit(const Fans& from, float wire_width) {
  SceneMesh item;
  item.mesh = &from.mesh;
  item.colors.assign(from.mesh.positions.size(), kClay);
  item.shading_exaggeration = 1;
  item.wire_width = wire_width;
  item.wires = from.wires;
  return item;
}

void add_arrow(Scene& scene, const View& view, glm::vec3 from, glm::vec3 to, Rgb colour, float width) {
  const glm::vec3 along = to - from;
  const glm::vec3 side = glm::normalize(glm::cross(along, view.eye - to)) * glm::length(along);
  scene.lines.push_back({{from, to}, colour, width});
  scene.lines.push_back(
      {{to - 0.22F * along + 0.1F * side, to, to - 0.22F * along - 0.1F * side}, colour, width});
}

// The mesh's edges in plan; returns how many.
std::size_t add_edges(Sheet& sheet, const FaceMesh& mesh, const std::vector<SheetPoint>& at,
                      const Stroke& stroke) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
  for (const auto& face : plain(mesh).faces) {
    for (std::size_t k = 0; k < face.size(); ++k) {
      const auto edge = std::minmax(face[k], face[(k + 1) % face.size()]);
      if (seen.insert(edge).second) sheet.line(std::array{at[edge.first], at[edge.second]}, stroke);
    }
  }
  return seen.size();
}

Sheet draw_step(Drawing& drawing) {
  constexpr double kSide = 380, kGap = 16, kTitle = 30;
  const FaceMesh coarse = shape("patch");
  const FaceMesh linear = subdivide(coarse, std::array{PlacementRule{.base = Base::kLinear}});
  const FaceMesh fine = subdivide(coarse, std::array{PlacementRule{}});
  Sheet sheet(3 * kSide + 4 * kGap, kTitle + kSide + 40);
  const auto place = [&](const FaceMesh& mesh, int panel) {
    std::vector<SheetPoint> at;
    for (const glm::vec3& p : mesh.positions) {
      at.push_back(
          {kGap + panel * (kSide + kGap) + kSide * (0.5 + p.x / 3.7), kTitle + kSide * (0.5 + p.z / 3.7)});
    }
    return at;
  };
  const std::array<std::string_view, 3> titles{"mesh M(n)", "mesh refinement", "vertex placement: M(n+1)"};
  for (int k = 0; k < 3; ++k) {
    sheet.text(kGap + k * (kSide + kGap) + kSide / 2, 20, titles[static_cast<std::size_t>(k)], 16, "middle");
    sheet.panel(kGap + k * (kSide + kGap), kTitle, kSide, kSide);
  }
  const auto dots = [&](const std::vector<SheetPoint>& at, std::size_t count) {
    for (std::size_t v = 0; v < count; ++v) {
      const bool old = v < coarse.positions.size(), face = v < coarse.positions.size() + coarse.faces();
      sheet.dot(at[v], 5, old ? kInk : face ? kOrange : kBlue);
    }
  };
  const auto before = place(coarse, 0), middle = place(linear, 1), after = place(fine, 2);
  const std::size_t edges = add_edges(sheet, coarse, before, {.colour = kInk, .thickness = 2});
  record_step(drawing, coarse, edges, linear, fine);
  dots(before, before.size());
  add_edges(sheet, linear, middle, {.colour = kInk, .thickness = 1.4});
  dots(middle, middle.size());
  add_edges(sheet, coarse, place(coarse, 2), {.colour = kGrey, .thickness = 1.2, .dashes = "5 4"});
  add_edges(sheet, fine, after, {.colour = kInk, .thickness = 1.4});
  dots(after, after.size());
  const double y = kTitle + kSide + 20;
  const std::array<std::pair<Rgb, std::string_view>, 3> keys{
      {{kInk, "of a vertex"}, {kOrange, "of a face"}, {kBlue, "of an edge"}}};
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const double x = 2 * kGap + kSide + static_cast<double>(k) * 130;
    sheet.dot({x, y}, 5, keys[k].first);
    sheet.text(x + 12, y + 5, keys[k].second, 14);
  }
  return sheet;
}

constexpr RefinementOptions kCornersStay{.boundary = Boundary::kEdgeAndCorner};

Sheet draw_fractal(Drawing& drawing) {
  PanelRows rows(2);
  for (const bool sphere : {false, true}) {
    const FaceMesh base = sphere ? growing::sphere(1, 2).mesh : growing::plane({4, 4}, 4, 4).mesh;
    for (const int steps : {0, 1, 2, 6}) {
      const std::vector rules(static_cast<std::size_t>(steps),
                              fractal_rule(sphere ? 0.14F : 0.16F, drawing.seed() + 3));
      const FaceMesh displaced = subdivide(base, rules, kCornersStay);
      const std::string_view name = sphere ? "sphere" : "plane";
      if (steps == 0 || steps == 6) {
        drawing.record(fmt::format("{}_faces_{}", name, steps), static_cast<double>(displaced.faces()));
      }
      if (steps > 0) {
        drawing.record(fmt::format("{}_displacement_{}", name, steps),
                       last_displacement(base, rules, kCornersStay, displaced));
      }
      const Fans mesh = drawn(displaced);
      Scene scene;
      scene.meshes.push_back(lit(mesh, steps < 3 ? 1.6F : 0));
      if (sphere) scene.sun = {-0.5F, 0.7F, 0.6F};  // seen from the south, it shows the lit side
      const Bounds box =
          sphere ? Bounds{glm::vec3(-0.95F), glm::vec3(0.95F)} : Bounds{{-2, -0.5F, -2}, {2, 0.6F, 2}};
      const View view = overview(box, 560, sphere ? 480 : 360, {0.35F, 0.6F, 1.0F});
      rows[sphere ? 1 : 0].push_back(
          {render_scene(drawing.gl(), scene, view), steps == 0   ? std::string("base mesh")
                                                    : steps == 1 ? std::string("after 1 step")
                                                                 : fmt::format("after {} steps", steps)});
    }
  }
  return panel_sheet(rows);
}

// A curved patch with texture coordinates.
FaceMesh hill(std::uint32_t cells) {
  FaceMesh mesh = growing::plane({4, 4}, cells, cells).mesh;
  for (glm::vec3& p : mesh.positions) p.y = 1.1F * std::exp(-0.35F * (p.x * p.x + p.z * p.z));
  return mesh;
}

// The vertex nearest to a point.
std::uint32_t nearest(const FaceMesh& mesh, const glm::vec3& at) {
  const auto closer = [&](const glm::vec3& a, const glm::vec3& b) {
    return glm::length(a - at) < glm::length(b - at);
  };
  return static_cast<std::uint32_t>(std::min_element(mesh.positions.begin(), mesh.positions.end(), closer) -
                                    mesh.positions.begin());
}

Sheet draw_frame(Drawing& drawing) {
  const FaceMesh mesh = hill(13);
  const LocalSurface surface = local_surface(make_topology(mesh), mesh.positions, mesh.texture, true);
  const std::uint32_t v = nearest(mesh, {0.6F, 0.9F, 0.3F});
  const glm::vec3 p = mesh.positions[v], n = surface.normals[v], t = surface.tangents[v],
                  b = glm::cross(n, t);
  drawing.record("off_mean_normal", degrees_between(n, mean_normal(mesh, v)));
  drawing.record("tilt", degrees_between(n, {0, 1, 0}));
  drawing.record("largest_cosine",
                 static_cast<double>(std::max(
                     {std::abs(glm::dot(n, t)), std::abs(glm::dot(t, b)), std::abs(glm::dot(b, n))})));
  const Fans hill_mesh = drawn(mesh);
  Scene scene;
  scene.meshes.push_back(lit(hill_mesh, 1.8F));
  const View view = overview({{-2, 0, -2}, {2, 1.3F, 2}}, 1600, 1060, {1.0F, 0.75F, 0.25F});
  const float s = 2.2F * surface.scales[v];
  const glm::vec3 foot = p + 0.02F * n;
  const std::array<std::tuple<glm::vec3, Rgb, std::string_view>, 3> axes{
      {{n, kBlue, "normal n"}, {t, kOrange, "tangent t"}, {b, kGreen, "bitangent b = n × t"}}};
  scene.planes.push_back({{foot - 0.8F * s * (t + b), foot + 0.8F * s * (t - b), foot + 0.8F * s * (t + b),
                           foot - 0.8F * s * (t - b)}});
  const Image image = render_scene(drawing.gl(), scene, view);
  Sheet sheet(image.width / 2.0, image.height / 2.0);
  sheet.picture(0, 0, image.width / 2.0, image.height / 2.0, image);
  for (const auto& [axis, colour, words] : axes) {
    const SheetPoint from = project(view, foot).at, to = project(view, foot + s * axis).at;
    sheet.stroke(from, to, {255, 255, 255}, 6);
    meshgrow::add_arrow(sheet, from, to, colour, 3.4, 13);
    const double length = std::hypot(to.x - from.x, to.y - from.y), away = 16;
    const SheetPoint words_at{to.x + away * (to.x - from.x) / length, to.y + away * (to.y - from.y) / length};
    // On a white plate, beside the arrow's head or over and under it.
    const double half_width = 5.6 * static_cast<double>(words.size()) + 4;
    const bool beside = std::abs(to.x - from.x) > std::abs(to.y - from.y);
    const double x = words_at.x + (!beside ? 0 : to.x > from.x ? half_width : -half_width);
    add_label(sheet, {x, words_at.y}, words, 20, colour, half_width);
  }
  sheet.dot(project(view, foot).at, 5, kInk);
  return sheet;
}

// Noise over the texture coordinates, of three cells per unit.
Signal smooth_noise(float amplitude, std::uint64_t seed) {
  noise::Graph graph;
  const noise::Node node = graph.fbm({.seed = seed, .frequency = 1, .octaves = 1});
  return [amplitude, program = std::make_shared<noise::Program>(graph, node)](const VertexBatch& batch,
                                                                              std::span<float> out) {
    std::vector<float> x, y;
    for (const glm::vec2& at : batch.texture) {
      x.push_back(3 * at.x);
      y.push_back(3 * at.y);
    }
    program->points(x, y, std::vector<float>(out.size()), out);
    for (float& value : out) value *= amplitude;
  };
}

Sheet draw_shift(Drawing& drawing) {
  const FaceMesh base = hill(9);
  const PlacementRule shifting{
      .displacements = {{.axis = Axis::kTangent, .amount = smooth_noise(1.6F, drawing.seed() + 1)},
                        {.axis = Axis::kBitangent, .amount = smooth_noise(1.6F, drawing.seed() + 2)}}};
  const FaceMesh smooth = subdivide(base, std::array{PlacementRule{}}, kCornersStay),
                 shifted = subdivide(base, std::array{shifting}, kCornersStay);
  const LocalSurface surface = local_surface(make_topology(smooth), smooth.positions, smooth.texture, false);
  double moved = 0, out_of_plane = 0;
  const View view = overview({{-2, 0, -2}, {2, 1, 2}}, 1000, 760, {0.25F, 1.1F, 1.0F});
  PanelRows rows(1);
  for (const bool after : {false, true}) {
    const Fans mesh = drawn(after ? shifted : smooth);
    Scene scene;
    scene.meshes.push_back(lit(mesh, 1.4F));
    for (std::size_t v = 0; !after && v < smooth.positions.size(); ++v) {
      const glm::vec3 by = shifted.positions[v] - smooth.positions[v], up{0, 0.02F, 0};
      if (glm::length(by) < 0.08F) continue;
      ++moved;
      const float along_normal = std::abs(glm::dot(by, surface.normals[v])) / glm::length(by);
      out_of_plane = std::max(out_of_plane, static_cast<double>(along_normal));
      add_arrow(scene, view, smooth.positions[v] + up, shifted.positions[v] + up, kOrange, 2.5F);
    }
    rows[0].push_back({render_scene(drawing.gl(), scene, view),
                       after ? "the vertices after the shift" : "standard placement, and the shifts"});
  }
  drawing.record("arrows_per_vertex", moved / static_cast<double>(smooth.positions.size()));
  drawing.record("out_of_plane", out_of_plane);
  return panel_sheet(rows);
}

Sheet draw_stretched(Drawing& drawing) {
  constexpr std::uint32_t kCells = 8;
  const FaceMesh flat = growing::plane({4, 4}, kCells, kCells).mesh;
  const std::uint32_t centre = nearest(flat, glm::vec3(0));
  const LocalSurface surface = local_surface(make_topology(flat), flat.positions, {}, false);
  const float times = 4;
  FaceMesh moved = flat;
  moved.positions[centre] += times * surface.scales[centre] * surface.normals[centre];
  const View view = overview({{-2, 0, -2}, {2, 2.6F, 2}}, 760, 760, {0.45F, 0.6F, 1.0F});
  PanelRows rows(1);
  const auto panel = [&](const FaceMesh& mesh, int steps, std::string words) {
    // A checkerboard of 16 × 16 fields in the texture coordinates, over the four quadrilaterals at the vertex
    // alone in orange.
    const std::array rule{PlacementRule{.base = Base::kLinear, .texture = Base::kLinear}};
    FaceMesh shown = mesh;
    for (int k = steps; k < 4; ++k) shown = subdivide(shown, rule);  // fields are faces, and stay in place
    const PlainMesh faces = plain(shown);
    TriangleMesh parts[4];
    for (const auto& face : faces.faces) {
      glm::vec2 uv(0);
      for (const std::uint32_t v : face) uv += 0.25F * shown.texture[v];
      const bool odd = (static_cast<int>(uv.x * 32) + static_cast<int>(uv.y * 32)) % 2 != 0;
      const bool four = std::max(std::abs(uv.x - 0.5F), std::abs(uv.y - 0.5F)) < 1.0F / kCells;
      TriangleMesh& part = parts[(odd ? 1 : 0) + (four ? 2 : 0)];
      const auto first = static_cast<std::uint32_t>(part.positions.size());
      for (const std::uint32_t v : face) part.positions.push_back(shown.positions[v]);
      for (const std::uint32_t k : {0U, 1U, 2U, 0U, 2U, 3U}) part.indices.push_back(first + k);
    }
    constexpr std::array<Rgb, 4> kColours{
        {{245, 245, 245}, {188, 190, 196}, {250, 205, 140}, {226, 130, 40}}};
    Scene scene;
    for (std::size_t k = 0; k < 4; ++k) {
      SceneMesh item;
      item.mesh = &parts[k];
      item.colors.assign(parts[k].positions.size(), kColours[k]);
      item.shading_exaggeration = 1;
      scene.meshes.push_back(std::move(item));
    }
    for (const auto& face : plain(mesh).faces) {
      if (steps > 0) break;
      SceneLine line{.points = {}, .color = kInk, .width = 1.8F};
      for (std::size_t k = 0; k <= face.size(); ++k) {
        line.points.push_back(mesh.positions[face[k % face.size()]] + glm::vec3(0, 0.006F, 0));
      }
      scene.lines.push_back(std::move(line));
    }
    if (&mesh == &flat) {
      add_arrow(scene, view, flat.positions[centre], moved.positions[centre], kBlue, 4);
    }
    rows[0].push_back({render_scene(drawing.gl(), scene, view), std::move(words)});
  };
  panel(flat, 0, "one vertex is shifted by 4 scale factors");
  panel(moved, 0, "its four quadrilaterals are stretched");
  PlacementRule smooth;
  smooth.texture = Base::kLinear;
  const FaceMesh smoothed = subdivide(moved, std::vector(3, smooth));
  panel(smoothed, 3, "after three standard steps");
  const Stretch after = stretch_within(moved, 1);
  drawing.record("stretched_faces_before", stretch_within(flat, 1).faces);
  drawing.record("stretched_faces_after", after.faces);
  drawing.record("stretch_after", after.largest);
  drawing.record("stretch_smoothed", stretch_within(smoothed, 1.0F / kCells).largest);
  return panel_sheet(rows);
}

constexpr std::array<figures::Figure, 5> kFigures{{
    {1, "F1",
     "a Catmull–Clark step: the mesh, the vertices that refinement adds, and their places by the standard "
     "rule; "
     "every face becomes quadrilaterals",
     draw_step},
    {2, "F2",
     "subdivision steps with random displacements along the local normal, in proportion to the local scale "
     "factor, of a plane and of a sphere",
     draw_fractal},
    {3, "F3", "the local frame at a vertex: its normal and two tangents, with the tangent plane", draw_frame},
    {4, "F4", "vertices shifted inside their tangent planes by smooth noise over the texture coordinates",
     draw_shift},
    {5, "F5",
     "a vertex shifted by four local scale factors stretches its four quadrilaterals, and with them the "
     "texture, here a checkerboard",
     draw_stretched},
}};

}  // namespace

extern const Experiment kSubdivisionFigures = figures::figure_experiment<kFigures>(
    "meshgrow.subdivision-figures", "Figures 1 to 5: generalised subdivision");

}  // namespace terrabench::meshgrow
