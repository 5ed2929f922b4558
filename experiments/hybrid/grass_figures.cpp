// Figures 15 to 19 of "hybrid": from guide strands to grass that is limited by the slope.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "experiments/figures/figure.h"
#include "experiments/figures/ground.h"
#include "experiments/figures/projection.h"
#include "experiments/hybrid/grass_measures.h"
#include "experiments/hybrid/grounds.h"
#include "renderers/grass/grass_scene.h"
#include "renderers/scene.h"
#include "results/store/format.h"

namespace terrabench::hybrid {
namespace {

using figures::Drawing;
using figures::Figure;
using figures::Panel;
using figures::panel_sheet;
using figures::Sheet;

constexpr Rgb kStrand{0, 110, 60}, kGuide{213, 94, 0}, kWire{120, 120, 128}, kSoil{236, 231, 220},
    kSides{205, 198, 184}, kInk{32, 32, 32};
constexpr double kMargin = 14;                             // of panel_sheet
constexpr glm::vec3 kPaper{1}, kSky{0.76F, 0.84F, 0.93F};  // backgrounds, sRGB

SceneLine line(const glm::vec3& from, const glm::vec3& to, Rgb colour, float width) {
  return {.points = {from, to}, .color = colour, .width = width};
}

// The triangles' edges in grey over soil, which hides what lies behind.
SceneMesh wires(const TriangleMesh& mesh) {
  SceneMesh item;
  item.mesh = &mesh;
  item.shading = Shading::kFlat;
  item.fill = kSoil;
  item.wire_width = 1.5F;
  item.wire_color = kWire;
  return item;
}

// Ground as a block: its surface, and its sides down to a level floor.
struct Block {
  TriangleMesh surface, sides;
  glm::vec3 low{0}, high{0};  // of the front side's lower edge, from west to east
  Bounds box() const {
    Bounds all = bounds_of(surface);
    all.low.y = low.y;
    return all;
  }
};

Block block_of(const Heightfield& field) {
  constexpr float kDeeper = 0.06F;  // of its width below the lowest place
  Block block{grassland_mesh(field), {}};
  const float floor = height_range(field).lowest - kDeeper * field.extent_x();
  block.sides = figures::block_sides(
      field.width, field.depth,
      [&](int i, int j) { return block.surface.positions[static_cast<std::size_t>(j * field.width + i)]; },
      floor);
  compute_normals(block.sides);
  block.low = block.surface.positions[static_cast<std::size_t>((field.depth - 1) * field.width)];
  block.high = block.surface.positions.back();
  block.low.y = block.high.y = floor;
  return block;
}

void add_block(Scene& scene, const Block& block) {
  scene.meshes.push_back(wires(block.surface));
  scene.meshes.push_back({.mesh = &block.sides, .shading = Shading::kFlat, .fill = kSides});
}

// A part of the grassland, `cells` cells along a side.
Block patch_of_ground(std::uint64_t seed, int cells) {
  const Heightfield whole = grassland(seed, 48, 0.0F);
  return block_of(crop(whole, 12, 20, cells + 1, cells + 1));
}

constexpr int kWide = 1000, kHigh = 640, kLow = 500;  // pixels of a panel
constexpr glm::vec3 kFromSouth{0.12F, 0.6F, 1.0F};

// The view of the whole box, enlarged `zoom` times; the picture's middle moves down by `lift` metres.
View view_of(const Bounds& box, int width, int height, glm::vec3 from, float zoom, float lift = 0) {
  View view = overview(box, width, height, from);
  view.vertical_fov = 2 * std::atan(std::tan(view.vertical_fov / 2) / zoom);
  view.target.y += lift;
  view.eye.y += lift;
  return view;
}

// The length of the block's front side, below it. `left`, `top`: of the picture on the sheet.
void label_length(Sheet& sheet, const View& view, const Block& block, double left, double top) {
  const figures::SheetPoint low = figures::project(view, block.low).at,
                            high = figures::project(view, block.high).at;
  sheet.stroke({left + low.x, top + low.y + 7}, {left + high.x, top + high.y + 7}, kInk, 1.5);
  sheet.text(left + (low.x + high.x) / 2, top + (low.y + high.y) / 2 + 26,
             fmt::format("{:.0f} m", block.high.x - block.low.x), 14, "middle");
}

Sheet draw_guides(Drawing& drawing) {
  const Block block = patch_of_ground(drawing.seed(), 9);
  Scene scene;
  add_block(scene, block);
  for (std::size_t v = 0; v < block.surface.positions.size(); ++v) {
    const glm::vec3 root = block.surface.positions[v];
    scene.lines.push_back(line(root, root + 1.2F * block.surface.normals[v], kGuide, 4));
  }
  drawing.record("guides", static_cast<double>(scene.lines.size()));
  drawing.record("vertices", static_cast<double>(block.surface.positions.size()));
  drawing.record("lean_out_of_faces", lean_out_of_faces(block.surface, scene.lines));
  const View view = view_of(block.box(), 1600, 800, kFromSouth, 0.93F, 0.2F);
  Sheet sheet = panel_sheet({{{render_scene(drawing.gl(), scene, view),
                               "A guide strand of 1.2 m at every vertex, along its normal"}}});
  label_length(sheet, view, block, kMargin, kMargin);
  return sheet;
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
  const Block block = patch_of_ground(drawing.seed(), 9);
  const TriangleMesh& mesh = block.surface;
  TriangleMesh one;
  one.positions = {{100, 0, 104}, {105, 0.6F, 103}, {101.5F, 1.2F, 100}};
  one.normals = {glm::normalize(glm::vec3(-0.5F, 1, 0.4F)), glm::normalize(glm::vec3(0.5F, 1, 0.1F)),
                 glm::normalize(glm::vec3(0, 1, -0.5F))};
  one.indices = {0, 1, 2};
  Scene single, many;
  single.meshes.push_back(wires(one));
  const std::vector<GrassStrand> between = grow(drawing, one, 90);
  const Interpolation found = interpolation_of(one, between);
  drawing.record("strands", static_cast<double>(between.size()));
  drawing.record("off_the_normals", found.off_the_normals);
  drawing.record("least_coordinate", found.least_coordinate);
  add_strands(single, between, 2);
  for (std::size_t v = 0; v < 3; ++v) {
    single.lines.push_back(line(one.positions[v], one.positions[v] + 1.2F * one.normals[v], kGuide, 6));
  }
  add_block(many, block);
  const std::vector<GrassStrand> all = grow(drawing, mesh, 12 * static_cast<std::int64_t>(mesh.triangles()));
  drawing.record("strands_per_triangle",
                 static_cast<double>(all.size()) / static_cast<double>(mesh.triangles()));
  add_strands(many, all, 1.5F);
  const View near = view_of(bounds_of(one), kWide, kHigh, {0.1F, 0.75F, 1.0F}, 0.8F, 0.4F);
  const View far = view_of(block.box(), kWide, kHigh, kFromSouth, 0.93F, 0.2F);
  Sheet sheet = panel_sheet(
      {{{render_scene(drawing.gl(), single, near),
         "One triangle: 3 guides (orange) of 1.2 m, 90 strands (green)"},
        {render_scene(drawing.gl(), many, far), "12 strands on each triangle of the ground of figure 15"}}});
  label_length(sheet, far, block, 2 * kMargin + kWide / 2.0, kMargin);
  return sheet;
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
  View view = view_of(bounds_of(ground), kWide, kHigh + 60, {0.55F, 0.62F, 1.0F}, 0.85F, 0.35F);
  const Image planes = render_scene(drawing.gl(), scene, view);
  grass.background = kPaper;
  const Image drawn = grass.picture(view, GrassTechnique::kGeometryShader);
  GrassScene no_grass(drawing.gl(), grass_ground(ground), {});
  no_grass.background = kPaper;
  record_billboards(drawing, scene.planes, ground, view, drawn,
                    no_grass.picture(view, GrassTechnique::kGeometryShader));

  const std::string words = fmt::format("The quadrilaterals, {:.2f} m × {:.2f} m, on the triangle A B C",
                                        strand.width * glm::length(strand.side), glm::length(up));
  Sheet sheet = panel_sheet({{{planes, words}, {drawn, "The same strand with its texture"}}});
  const auto label = [&](const glm::vec3& p, double dx, double dy, std::string_view words,
                         Rgb colour = kInk) {
    const figures::SheetPoint at = figures::project(view, p).at;
    sheet.text(kMargin + at.x + dx, kMargin + at.y + dy, words, 15, "start", colour);
  };
  label(strand.root + 1.25F * up, 8, 4, "normal N");
  label(strand.root + 0.85F * strand.width * strand.side, 8, 12, "along AB", kFirst);
  label(strand.root + 0.85F * strand.width * across, 46, -22, "N × AB", kSecond);
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

// Grass on a block, and its sides without any, over white.
std::unique_ptr<GrassScene> planted(Drawing& drawing, const Block& block, const GrassGrowth& growth) {
  auto scene = std::make_unique<GrassScene>(drawing.gl(), grass_ground(block.surface), growth);
  scene->add_bare(grass_ground(block.sides));
  scene->background = kPaper;
  return scene;
}

Sheet draw_billboards(Drawing& drawing) {
  const Heightfield field = grassland(drawing.seed(), 256, 0.3F);
  const Block block = block_of(field);
  constexpr std::int64_t kStrands = 3 * 41'960;
  const auto scene =
      planted(drawing, block,
              {.strands = kStrands, .steepest = 180, .by_area = true, .height = 0.45F, .width = 0.5F});
  const View all = view_of(block.box(), kWide, kLow, kFromSouth, 0.97F, -1.5F);
  drawing.record("billboards",
                 static_cast<double>(scene->count_billboards(all, GrassTechnique::kGeometryShader)));
  record_steep_strands(drawing, field, block.surface, scene->strands());
  const Image whole = scene->picture(all, GrassTechnique::kGeometryShader);
  scene->look.fog_density = 0.006F;
  scene->background = kSky;
  const Image near =
      scene->picture(standing(field, {34, 60}, {28, 30}, kWide, kLow), GrassTechnique::kGeometryShader);
  Sheet sheet = panel_sheet({{{whole, fmt::format("{} billboards, evenly over the area",
                                                  format_number(static_cast<double>(2 * kStrands)))},
                              {near, "The same, 2.2 m above the ground; strands are 0.45 m high"}}});
  label_length(sheet, all, block, kMargin, kMargin);
  return sheet;
}

double area_of(const TriangleMesh& mesh, std::span<const glm::uvec4> triangles) {
  double area = 0;
  for (const glm::uvec4& t : triangles) {
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return area;
}

Sheet draw_limit(Drawing& drawing) {
  const Block block = block_of(grassland(drawing.seed(), 160, 0.95F));
  const TriangleMesh& mesh = block.surface;
  const View view = view_of(block.box(), kWide, kLow, kFromSouth, 0.97F, -1.5F);
  double everywhere = 0;  // m²
  const auto panel = [&](float limit, SlopeAngle slope, std::string_view metric, std::string_view words) {
    constexpr double kPerArea = 14;  // strands per square metre
    GrassGrowth growth{.steepest = limit, .slope = slope, .by_area = true, .height = 0.5F, .width = 0.5F};
    const GrassPlan plan = plan_grass(grass_ground(mesh), growth);
    const double area = area_of(mesh, std::span(plan.triangles).first(plan.growing()));
    everywhere = std::max(everywhere, area);
    const double share = std::round(1000 * area / everywhere) / 10;
    drawing.record(metric, share);
    growth.strands = std::llround(kPerArea * area);
    return Panel{planted(drawing, block, growth)->picture(view, GrassTechnique::kGeometryShader),
                 fmt::format("{}: {:.1f} % of the area", words, share)};
  };
  const Panel bare = panel(180, SlopeAngle::kPrinted, "area_everywhere", "No limit");
  Sheet sheet = panel_sheet(
      {{bare, panel(60, SlopeAngle::kPrinted, "area_printed_60", "Limit 60°, (1 − n) · 90° as printed")},
       {panel(30, SlopeAngle::kPrinted, "area_printed_30", "Limit 30°, (1 − n) · 90° as printed"),
        panel(30, SlopeAngle::kTrue, "area_true_30", "Limit 30°, true angle")}});
  label_length(sheet, view, block, kMargin, kMargin);
  return sheet;
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
     "grass limited by the angle of the ground, on a block with terraces; n is the y component of the "
     "normal. Strands are even over the area that is not too steep; the rest is bare rock. At the same "
     "limit, "
     "the printed formula lets grass grow on steeper ground than the true angle does",
     draw_limit},
}};

}  // namespace

extern const Experiment kGrassFigures =
    figures::figure_experiment<kFigures>("hybrid.grass-figures", "Figures 15-19: grass, step by step");

}  // namespace terrabench::hybrid
