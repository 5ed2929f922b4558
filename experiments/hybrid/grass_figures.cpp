// Figures 15 to 19 of "hybrid": from guide strands to grass that is limited by the slope.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "experiments/cases.h"
#include "experiments/figures/figure.h"
#include "experiments/hybrid/grassland.h"
#include "renderers/grass/grass_scene.h"
#include "renderers/scene.h"
#include "results/format.h"

namespace terrabench::hybrid {
namespace {

using figures::Drawing;
using figures::Figure;
using figures::Panel;
using figures::panel_sheet;
using figures::Sheet;

constexpr Rgb kStrand{0, 110, 60}, kGuide{213, 94, 0}, kWire{120, 120, 128};

SceneLine line(const glm::vec3& from, const glm::vec3& to, Rgb colour, float width) {
  return {.points = {from, to}, .color = colour, .width = width};
}

// The triangles' edges in grey over white, which hides what lies behind.
SceneMesh wires(const TriangleMesh& mesh) {
  SceneMesh item;
  item.mesh = &mesh;
  item.shading = Shading::kFlat;
  item.wire_width = 1.5F;
  item.wire_color = kWire;
  return item;
}

// A part of the grassland, `cells` cells along a side.
TriangleMesh patch_of_ground(std::uint64_t seed, int cells) {
  const Heightfield whole = grassland(seed, 48, 0.0F);
  return grassland_mesh(crop(whole, 12, 20, cells + 1, cells + 1));
}

constexpr int kWide = 1000, kHigh = 640, kLow = 460;  // pixels of a panel

// The view of the whole mesh, enlarged `zoom` times; the picture's middle moves down by `lift` metres.
View view_of(const TriangleMesh& mesh, int width, int height, glm::vec3 from, float zoom, float lift = 0) {
  View view = overview(bounds_of(mesh), width, height, from);
  view.vertical_fov = 2 * std::atan(std::tan(view.vertical_fov / 2) / zoom);
  view.target.y += lift;
  view.eye.y += lift;
  return view;
}

Sheet draw_guides(Drawing& drawing) {
  const TriangleMesh mesh = patch_of_ground(drawing.seed(), 9);
  Scene scene;
  scene.meshes.push_back(wires(mesh));
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    scene.lines.push_back(line(mesh.positions[v], mesh.positions[v] + 1.2F * mesh.normals[v], kGuide, 4));
  }
  const Image image =
      render_scene(drawing.gl(), scene, view_of(mesh, 1600, 760, {0.4F, 0.6F, 1.0F}, 1.25F, 0.4F));
  return panel_sheet({{{image, "A guide strand of 1.2 m at every vertex, along its normal"}}});
}

void add_strands(Scene& scene, const std::vector<GrassStrand>& strands, float width) {
  for (const GrassStrand& strand : strands) {
    scene.lines.push_back(line(strand.root, strand.root + strand.height * strand.up, kStrand, width));
  }
}

std::vector<GrassStrand> grow(Drawing& drawing, const TriangleMesh& mesh, std::int64_t strands) {
  GrassScene scene(drawing.gl(), grass_ground(mesh),
                   {.strands = strands, .steepest = 180, .height = 1.2F, .height_variation = 0});
  return scene.strands();
}

Sheet draw_interpolated(Drawing& drawing) {
  const TriangleMesh mesh = patch_of_ground(drawing.seed(), 9);
  TriangleMesh one;
  one.positions = {{100, 0, 104}, {105, 0.6F, 103}, {101.5F, 1.2F, 100}};
  one.normals = {glm::normalize(glm::vec3(-0.5F, 1, 0.4F)), glm::normalize(glm::vec3(0.5F, 1, 0.1F)),
                 glm::normalize(glm::vec3(0, 1, -0.5F))};
  one.indices = {0, 1, 2};
  Scene single, many;
  single.meshes.push_back(wires(one));
  add_strands(single, grow(drawing, one, 90), 2);
  for (std::size_t v = 0; v < 3; ++v) {
    single.lines.push_back(line(one.positions[v], one.positions[v] + 1.2F * one.normals[v], kGuide, 6));
  }
  many.meshes.push_back(wires(mesh));
  add_strands(many, grow(drawing, mesh, 12 * static_cast<std::int64_t>(mesh.triangles())), 1.5F);
  const View near = view_of(one, kWide, kHigh, {0.1F, 0.75F, 1.0F}, 0.8F, 0.4F);
  const View far = view_of(mesh, kWide, kHigh, {0.4F, 0.6F, 1.0F}, 1.1F, 0.4F);
  return panel_sheet(
      {{{render_scene(drawing.gl(), single, near), "One triangle: 3 guides (orange), 90 strands (green)"},
        {render_scene(drawing.gl(), many, far), "12 strands on each triangle of the ground of figure 15"}}});
}

// Where a point appears, in units of the sheet from the picture's corner.
figures::SheetPoint on_picture(const View& view, const glm::vec3& p) {
  const glm::vec4 clip = world_to_clip(view) * glm::vec4(p, 1);
  return {(0.5 + 0.5 * clip.x / clip.w) * view.width / Sheet::kPixels,
          (0.5 - 0.5 * clip.y / clip.w) * view.height / Sheet::kPixels};
}

// A strand's two billboards as planes, with the three directions that span them.
Sheet draw_diagram(Drawing& drawing) {
  TriangleMesh ground;
  ground.positions = {{99.2F, 0, 100.9F}, {101.0F, 0, 100.6F}, {100, 0.12F, 99.1F}};
  ground.indices = {0, 1, 2};
  compute_normals(ground);
  const GrassGrowth growth{
      .strands = 1, .height = 0.9F, .width = 0.8F, .height_variation = 0, .texture_metres = 8};
  GrassScene grass(drawing.gl(), grass_ground(ground), growth);
  const GrassStrand strand = grass.strands().front();
  const glm::vec3 across = glm::normalize(glm::cross(strand.up, strand.side)), up = strand.height * strand.up;

  Scene scene;
  scene.meshes.push_back(wires(ground));
  constexpr Rgb kFirst{0, 114, 178}, kSecond{213, 94, 0};
  for (const auto& [side, colour] : {std::pair{strand.side, kFirst}, std::pair{across, kSecond}}) {
    const glm::vec3 half = 0.5F * strand.width * side, root = strand.root;
    scene.planes.push_back({.corners = {root - half, root + half, root + half + up, root - half + up},
                            .color = colour,
                            .fill_opacity = 0.25F,
                            .line_width = 3});
    scene.lines.push_back(line(root, root + 1.7F * half, colour, 5));
  }
  scene.lines.push_back(line(strand.root, strand.root + 1.25F * up, {13, 13, 15}, 5));
  View view = view_of(ground, kWide, kHigh + 60, {0.55F, 0.62F, 1.0F}, 0.85F, 0.35F);
  const Image planes = render_scene(drawing.gl(), scene, view);
  const Image drawn = grass.picture(view, GrassTechnique::kGeometryShader);

  Sheet sheet = panel_sheet(
      {{{planes, "The quadrilaterals, on the triangle A B C"}, {drawn, "The same strand with its texture"}}});
  constexpr double kMargin = 14;  // of panel_sheet
  const auto label = [&](const glm::vec3& p, double dx, double dy, std::string_view words) {
    const figures::SheetPoint at = on_picture(view, p);
    sheet.text(kMargin + at.x + dx, kMargin + at.y + dy, words, 15);
  };
  label(strand.root + 1.25F * up, 8, 4, "normal N");
  label(strand.root + 0.85F * strand.width * strand.side, 8, 12, "along AB");
  label(strand.root + 0.85F * strand.width * across, 6, -10, "N × AB");
  const char* const corners[] = {"A", "B", "C"};
  for (std::size_t v = 0; v < 3; ++v) label(ground.positions[v], v == 0 ? -18 : 10, 6, corners[v]);
  return sheet;
}

// Standing on the ground, 2 m above it.
View standing(const Heightfield& field, glm::vec2 eye, glm::vec2 target, int width, int height) {
  const auto above = [&](glm::vec2 p, float by) {
    return glm::vec3(100 + p.x, field.sample(p.x, p.y) + by, 100 + p.y);
  };
  View view;
  view.eye = above(eye, 2.2F);
  view.target = above(target, 0.5F);
  view.width = width;
  view.height = height;
  view.near = 0.2F;
  view.far = 200;
  return view;
}

Sheet draw_billboards(Drawing& drawing) {
  const Heightfield field = grassland(drawing.seed(), 256, 0.3F);
  const TriangleMesh mesh = grassland_mesh(field);
  constexpr std::int64_t kStrands = 3 * 41'960;
  GrassScene scene(drawing.gl(), grass_ground(mesh),
                   {.strands = kStrands, .steepest = 40, .height = 0.45F, .width = 0.5F});
  const auto draw = [&](const View& view) { return scene.picture(view, GrassTechnique::kGeometryShader); };
  const Image whole = draw(view_of(mesh, kWide, kLow, {0.4F, 0.45F, 1.0F}, 1));
  scene.look.fog_density = 0.006F;
  const Image near = draw(standing(field, {34, 60}, {28, 30}, kWide, kLow));
  return panel_sheet({{{whole, fmt::format("{} billboards on 64 m × 64 m",
                                           format_number(static_cast<double>(2 * kStrands)))},
                       {near, "The same, 2.2 m above the ground"}}});
}

Sheet draw_limit(Drawing& drawing) {
  const Heightfield field = grassland(drawing.seed(), 160, 0.95F);
  const TriangleMesh mesh = grassland_mesh(field);
  const View view = view_of(mesh, kWide, kLow, {0.45F, 0.5F, 1.0F}, 1);
  const auto panel = [&](float limit, SlopeAngle slope, std::string_view words) {
    GrassGrowth growth{.steepest = limit, .slope = slope, .height = 0.5F, .width = 0.5F};
    const std::size_t growing = plan_grass(grass_ground(mesh), growth).growing();
    growth.strands = static_cast<std::int64_t>(2 * growing);
    GrassScene scene(drawing.gl(), grass_ground(mesh), growth);
    return Panel{scene.picture(view, GrassTechnique::kGeometryShader),
                 fmt::format("{}: {:.1f} % of the triangles", words,
                             100.0 * static_cast<double>(growing) / static_cast<double>(mesh.triangles()))};
  };
  return panel_sheet({{panel(180, SlopeAngle::kPrinted, "No limit"),
                       panel(60, SlopeAngle::kPrinted, "Limit 60°, (1 − n) · 90° as printed")},
                      {panel(30, SlopeAngle::kPrinted, "Limit 30°, (1 − n) · 90° as printed"),
                       panel(30, SlopeAngle::kTrue, "Limit 30°, true angle")}});
}

constexpr std::array<Figure, 5> kFigures{{
    {15, "F15", "guide strands of grass at the points of the mesh, along their normals", draw_guides},
    {16, "F16", "strands interpolated between the guides, across one triangle and across ground",
     draw_interpolated},
    {17, "F17",
     "the two crossed billboards of a strand: up along the normal, one along the triangle's edge AB, one "
     "perpendicular to it",
     draw_diagram},
    {18, "F18", "grass as billboards, interpolated over the ground", draw_billboards},
    {19, "F19",
     "grass limited by the angle of the ground; n is the y component of the normal. At the same limit, the "
     "printed formula lets grass grow on steeper ground than the true angle does",
     draw_limit},
}};
constexpr std::array kNames = names_of(kFigures);
const std::array kSpecs{choice("figure", kNames, "figure of the paper")};

std::vector<Case> cases(const RunOptions&) { return cases_by("figure", kSpecs); }

void draw(const Case& at, const RunOptions& options, Recorder& recorder, Progress&) {
  draw_figure(kFigures, "hybrid", at, options, recorder);
}

}  // namespace

extern const Experiment kGrassFigures{"hybrid.grass-figures", "Figures 15-19: grass, step by step", kSpecs,
                                      cases, draw};

}  // namespace terrabench::hybrid
