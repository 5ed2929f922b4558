// Figures 14 and 22 of "hybrid": the rings of a clipmap, and the height map interpolated from the stacks.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>
#include <set>
#include <tuple>

#include "experiments/build_at.h"
#include "experiments/figures/figure.h"
#include "experiments/figures/ground.h"
#include "experiments/figures/maps.h"
#include "experiments/figures/projection.h"
#include "experiments/hybrid/grounds.h"
#include "lod/clipmap/clipmap.h"
#include "renderers/scene.h"
#include "representations/layered_stack/height_map.h"
#include "results/store/format.h"

namespace terrabench::hybrid {
namespace {

using namespace figures;

constexpr int kWindow = 23;                 // samples
constexpr double kSide = 480, kLong = 640;  // of the pictures, units
// Okabe and Ito's colours, which readers with colour blindness can tell apart; light, so that wires show.
constexpr std::array<Rgb, 5> kLevelColours{
    {{235, 160, 40}, {125, 195, 240}, {70, 185, 150}, {245, 235, 120}, {215, 160, 190}}};

// The triangles that a clipmap draws in all directions, one mesh per level, finest first.
std::vector<TriangleMesh> rings(const Heightfield& field) {
  Clipmap clipmap(heights_in_memory(field), kWindow);
  View view;
  view.eye = {0.5F * field.extent_x(), 0, 0.5F * field.extent_z()};
  view.eye.y = field.sample(view.eye.x, view.eye.z) + 2;
  view.vertical_fov = 2;
  view.width = view.height = 100;
  view.far = 10 * field.extent_x();
  std::vector<TriangleMesh> levels(static_cast<std::size_t>(clipmap.levels()));
  std::set<std::tuple<int, std::uint32_t>> drawn;
  for (int k = 0; k < 16; ++k) {  // a block may be culled in all but one direction
    const float heading = 6.2831853F * static_cast<float>(k) / 16;
    view.target = view.eye + glm::vec3(std::cos(heading), -0.3F, std::sin(heading));
    const Frame& frame = clipmap.update(view);
    for (const Batch& batch : frame.batches) {
      if (!drawn.insert({batch.level, batch.first_index}).second) continue;
      TriangleMesh& mesh = levels[batch.level];
      for (std::uint32_t i = 0; i < batch.index_count; ++i) {
        mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
        mesh.positions.push_back(
            vertex_position(frame, batch, batch.base_vertex + frame.indices[batch.first_index + i]));
      }
    }
  }
  std::erase_if(levels, [](const TriangleMesh& mesh) { return mesh.indices.empty(); });
  for (TriangleMesh& mesh : levels) compute_normals(mesh);
  return levels;
}

// In plan, metres: a level's side, the distance of its vertices, and the area that its triangles cover.
struct RingSize {
  float side = 0, spacing = std::numeric_limits<float>::max();
  double area = 0;
};

RingSize size_of(const TriangleMesh& ring) {
  RingSize size;
  float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
  for (std::size_t t = 0; t < ring.indices.size(); t += 3) {
    std::array<glm::dvec2, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec3 corner = ring.positions[ring.indices[t + k]],
                      next = ring.positions[ring.indices[t + (k + 1) % 3]];
      p[k] = {corner.x, corner.z};
      low = std::min(low, corner.x);
      high = std::max(high, corner.x);
      if (corner.x != next.x) size.spacing = std::min(size.spacing, std::abs(corner.x - next.x));
    }
    size.area +=
        0.5 * std::abs((p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x));
  }
  size.side = high - low;
  return size;
}

void record_sizes(Drawing& drawing, const std::vector<TriangleMesh>& levels, const Heightfield& field) {
  double area = 0;
  for (std::size_t l = 0; l < levels.size(); ++l) {
    const RingSize size = size_of(levels[l]);
    drawing.record(fmt::format("side_{}", l), size.side);
    drawing.record(fmt::format("spacing_{}", l), size.spacing);
    area += size.area;
  }
  drawing.record("levels", static_cast<double>(levels.size()));
  drawing.record("ground_side", field.extent_x());
  drawing.record("area_to_ground", area / (double{field.extent_x()} * field.extent_z()));
}

// Upright sides below the border of the outermost level.
TriangleMesh sides_below(const TriangleMesh& outer, const Heightfield& field, float floor) {
  TriangleMesh sides;
  for (std::size_t k = 0; k < outer.indices.size(); ++k) {
    const glm::vec3 a = outer.positions[outer.indices[k]],
                    b = outer.positions[outer.indices[k % 3 == 2 ? k - 2 : k + 1]];
    const bool on_border = std::max(a.x, b.x) <= 0 || std::min(a.x, b.x) >= field.extent_x() ||
                           std::max(a.z, b.z) <= 0 || std::min(a.z, b.z) >= field.extent_z();
    if (on_border) add_quad(sides, {glm::vec3(a.x, floor, a.z), glm::vec3(b.x, floor, b.z), b, a});
  }
  compute_normals(sides);
  return sides;
}

Scene scene_of(const std::vector<TriangleMesh>& levels, bool lit) {
  Scene scene;
  for (std::size_t l = 0; l < levels.size(); ++l) {
    const Rgb colour = kLevelColours[l % kLevelColours.size()];
    SceneMesh mesh{.mesh = &levels[l],
                   .shading = lit ? Shading::kLit : Shading::kFlat,
                   .fill = colour,
                   .wire_width = 1.0F,
                   .wire_color = {50, 50, 55},
                   // Wires of fine levels lie so close that they would hide the colour.
                   .wire_opacity = std::min(0.3F + 0.2F * static_cast<float>(l), 0.8F)};
    if (lit) mesh.colors.assign(levels[l].positions.size(), colour);
    scene.meshes.push_back(std::move(mesh));
  }
  return scene;
}

Sheet draw_rings(Drawing& drawing) {
  constexpr double kMargin = 16, kTitle = 28, kKey = 44;
  const TerrainSource source = open_terrain("hills", drawing.seed());
  const Heightfield field = crop(*source.heights, 100, 100, 161, 161);
  const std::vector<TriangleMesh> levels = rings(field);
  record_sizes(drawing, levels, field);
  GlContext& gl = drawing.gl();
  const auto pixels = [](double units) { return static_cast<int>(Sheet::kPixels * units); };

  View plan;  // from so far that it is nearly parallel
  plan.target = {0.5F * field.extent_x(), 0, 0.5F * field.extent_z()};
  plan.eye = plan.target + glm::vec3(0, 60 * field.extent_x(), 0);
  plan.up = {0, 0, -1};
  plan.vertical_fov = 2 * std::atan(0.5F * field.extent_x() / plan.eye.y) * 1.02F;
  plan.width = plan.height = pixels(kSide);
  const Scene flat = scene_of(levels, false);
  Scene lit = scene_of(levels, true);
  const Bounds ground = bounds_of(lit);
  const float floor = ground.low.y - 0.15F * ground.size().y;
  const TriangleMesh sides = sides_below(levels.back(), field, floor);
  lit.meshes.push_back({.mesh = &sides, .shading = Shading::kLit});
  lit.meshes.back().colors.assign(sides.positions.size(), Rgb{205, 200, 190});
  const View aslant = overview(bounds_of(lit), pixels(kLong), pixels(kSide), {0.35F, 0.6F, 1.0F});

  Sheet sheet(3 * kMargin + kSide + kLong, kTitle + kSide + kKey + kMargin);
  sheet.text(kMargin, kTitle - 8, "in plan", 16);
  sheet.picture(kMargin, kTitle, kSide, kSide, render_scene(gl, flat, plan));
  sheet.text(2 * kMargin + kSide, kTitle - 8, "aslant", 16);
  sheet.picture(2 * kMargin + kSide, kTitle, kLong, kSide, render_scene(gl, lit, aslant));
  sheet.dot({kMargin + kSide / 2, kTitle + kSide / 2}, 5, {0, 0, 0});
  const SheetPoint front = project(aslant, {0.5F * field.extent_x(), floor, field.extent_z()}).at;
  sheet.text(2 * kMargin + kSide + front.x, kTitle + front.y + 26, format_number(field.extent_x()) + " m", 15,
             "middle");
  double x = kMargin;
  const double y = kTitle + kSide + 18;
  for (std::size_t l = 0; l < levels.size(); ++l) {
    sheet.box(x, y, 22, 16, kLevelColours[l % kLevelColours.size()]);
    sheet.text(
        x + 28, y + 13,
        fmt::format("level {}, vertices {:.0f} m apart", l, std::ldexp(field.cell_x, static_cast<int>(l))),
        14);
    x += 246;
  }
  sheet.dot({x + 8, y + 8}, 5, {0, 0, 0});
  sheet.text(x + 20, y + 13, "eye", 14);
  return sheet;
}

Sheet draw_height_map(Drawing& drawing) {
  constexpr int kColumns = 64, kFiner = 10;
  constexpr double kPicture = 0.5 * kColumns * kFiner;  // units: every sample a whole number of pixels
  Progress silent;
  const TerrainSource source = open_terrain("caves", drawing.seed());
  const std::unique_ptr<LayeredStack> built = stack_at_resolution(source, kColumns, silent);
  const LayeredStack& stack = *built;
  const Heightfield columns = column_heights(stack, ColumnHeight::kTop);
  const Heightfield whole = height_map(stack, ColumnHeight::kTop, kFiner);
  const Heightfield map = crop(whole, 0, 0, kColumns * kFiner, kColumns * kFiner);
  float off = 0;  // of the interpolated map over the middles of the stacks
  for (int j = 0; j < kColumns; ++j) {
    for (int i = 0; i < kColumns; ++i)
      off = std::max(off,
                     std::abs(map.at(kFiner * i + kFiner / 2, kFiner * j + kFiner / 2) - columns.at(i, j)));
  }
  drawing.record("largest_step_of_stacks", largest_step(columns));
  drawing.record("largest_step_interpolated", largest_step(map));
  drawing.record("off_the_stacks", off);
  const auto window = [](const Heightfield& field, int scale) {
    return crop(field, 28 * scale, 20 * scale, 16 * scale, 16 * scale);
  };
  const auto size = [](const Heightfield& field) {
    return fmt::format("{} × {}, {:g} m apart", field.width, field.depth, field.cell_x);
  };
  const std::array<std::pair<Heightfield, std::string>, 4> panels{
      {{columns, "stacks: " + size(columns)},
       {map, "interpolated: " + size(map)},
       {window(columns, 1), "stacks: a window of 16 × 16"},
       {window(map, kFiner), "interpolated: the same window"}}};
  const PanelGrid grid{.columns = 2,
                       .rows = 2,
                       .width = kPicture,
                       .height = kPicture,
                       .below = 30,
                       .title = 30,
                       .text_size = 16};
  Sheet sheet(grid.sheet_width(), grid.bottom());
  for (int k = 0; k < 4; ++k) {
    const auto& [field, words] = panels[static_cast<std::size_t>(k)];
    grid.place(sheet, k, words, heightmap_image(field));
    const HeightRange range = height_range(field);
    sheet.text(grid.x(k), grid.y(k) + kPicture + 20,
               fmt::format("black: {:.1f} m, white: {:.1f} m", range.lowest, range.highest), grid.text_size);
  }
  return sheet;
}

constexpr std::array<figures::Figure, 2> kFigures{{
    {14, "F14",
     "the rings of a geometry clipmap with windows of 23 × 23 vertices around the eye; each level has half "
     "as many vertices per metre as the next inner one, and is drawn outside of it",
     draw_rings},
    {22, "F22",
     "the height map made from the stacks of a cave terrain, in metres: one sample per "
     "stack, and bilinearly interpolated at ten samples per stack; the windows below have greys of their own",
     draw_height_map},
}};

}  // namespace

extern const Experiment kClipmapFigures = figures::figure_experiment<kFigures>(
    "hybrid.clipmap-figures", "Figures 14 and 22: the clipmap and its height map");

}  // namespace terrabench::hybrid
