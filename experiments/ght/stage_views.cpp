// Figures 1, 7 and 10 of "ght": terrains in space as wireframes, and the dispatch of all figures of §2.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include "experiments/experiment.h"
#include "experiments/figures/sheet.h"
#include "experiments/ght/heightmap_image.h"
#include "experiments/ght/stages.h"
#include "renderers/scene.h"
#include "terrain/error.h"
#include "terrain/sources/fractal/diamond_square.h"
#include "terrain/sources/fractal/hills.h"

namespace terrabench::ght {
namespace {

using figures::Sheet;

constexpr double kMargin = 20, kLabel = 28;
constexpr int kPixels = 2;  // of a picture, for each unit of the sheet

constexpr std::array kSpecs{
    ParameterSpec{"figure", std::int64_t{1}, "", "number of the figure in the paper", 1, 10},
};
constexpr std::array<std::int64_t, 9> kFigures{1, 3, 4, 5, 6, 7, 8, 9, 10};

// Samples as vertices, the ground alone: no sides, no floor.
TriangleMesh ground_mesh(const Heightfield& field) {
  TriangleMesh mesh;
  for (int j = 0; j < field.depth; ++j) {
    for (int i = 0; i < field.width; ++i) {
      mesh.positions.emplace_back(static_cast<float>(i) * field.cell_x, field.at(i, j),
                                  static_cast<float>(j) * field.cell_z);
    }
  }
  for (int j = 0; j + 1 < field.depth; ++j) {
    for (int i = 0; i + 1 < field.width; ++i) {
      const auto a = static_cast<std::uint32_t>(j * field.width + i), b = a + 1;
      const auto c = a + static_cast<std::uint32_t>(field.width), d = c + 1;
      mesh.indices.insert(mesh.indices.end(), {a, c, b, b, c, d});
    }
  }
  return mesh;
}

// The cells' borders over white ground, in a picture that fills width × height units of a sheet.
Image wire_view(GlContext& context, const Heightfield& field, double width, double height, float wire_width) {
  const TriangleMesh mesh = ground_mesh(field);
  Scene scene;
  SceneMesh& ground = scene.meshes.emplace_back();
  ground.mesh = &mesh;
  ground.shading = Shading::kFlat;
  ground.wire_width = wire_width;
  ground.wires = quad_wires(mesh);
  return render_scene(
      context, scene,
      overview(bounds_of(mesh), static_cast<int>(kPixels * width), static_cast<int>(kPixels * height)));
}

}  // namespace

void draw_heightmap_and_wireframe(GlContext& context, std::uint64_t seed, Recorder& recorder) {
  constexpr double kSize = 387, kWide = 560;  // three units a sample
  const Heightfield field =
      fractal::diamond_square({.seed = seed, .side = 129, .cell = 30, .amplitude = 800, .hurst = 0.9F});
  Sheet sheet(static_cast<int>(kSize + kWide + 3 * kMargin), static_cast<int>(kSize + kLabel + 2 * kMargin));
  sheet.picture(kMargin, kMargin, kSize, kSize, heightmap_image(field));
  sheet.picture(2 * kMargin + kSize, kMargin, kWide, kSize,
                wire_view(context, resample(field, 65, 65), kWide, kSize, 1.2F));
  sheet.text(kMargin + kSize / 2, kMargin + kSize + 20, "heightmap, 129 × 129", 15, "middle");
  sheet.text(2 * kMargin + kSize + kWide / 2, kMargin + kSize + 20, "wireframe, every other sample", 15,
             "middle");
  sheet.write(recorder.figure(
      "ght.F1", "png",
      "Figure 1 of the paper: a terrain as heightmap (black low, white high) and as wireframe "
      "seen from the south-east"));
}

void draw_diamond_square_terrains(GlContext& context, std::uint64_t seed, Recorder& recorder) {
  constexpr double kWide = 330, kHigh = 230;
  Sheet sheet(static_cast<int>(3 * kWide + 4 * kMargin),
              static_cast<int>(2 * (kHigh + kLabel) + 3 * kMargin));
  for (int n = 1; n <= 6; ++n) {
    const int side = (1 << n) + 1;
    const Heightfield field = fractal::diamond_square({.seed = seed,
                                                       .side = side,
                                                       .cell = 3840.0F / static_cast<float>(side - 1),
                                                       .amplitude = 900,
                                                       .hurst = 0.9F});
    const double x = kMargin + (n - 1) % 3 * (kWide + kMargin);
    const double y = kMargin + (n - 1) / 3 * (kHigh + kLabel + kMargin);
    sheet.picture(x, y, kWide, kHigh, wire_view(context, field, kWide, kHigh, n < 5 ? 2 : 1.2F));
    sheet.text(x + kWide / 2, y + kHigh + 20,
               fmt::format("{} iteration{}: {} × {}", n, n == 1 ? "" : "s", side, side), 15, "middle");
  }
  sheet.write(recorder.figure(
      "ght.F7", "png", "Figure 7 of the paper: one terrain after 1 to 6 iterations of diamond-square"));
}

void draw_hills_one_and_many(GlContext& context, std::uint64_t seed, Recorder& recorder) {
  constexpr double kWide = 500, kHigh = 330;
  fractal::HillOptions options{
      .seed = seed, .width = 65, .depth = 65, .cell = 1, .hills = 60, .scale = 0.05F};
  options.least_radius = 5;
  options.most_radius = 17;
  const Heightfield one = fractal::raise_hills(options, {{32, 32, 19}});
  const Heightfield many = fractal::hill_terrain(options);
  Sheet sheet(static_cast<int>(2 * kWide + 3 * kMargin), static_cast<int>(kHigh + kLabel + 2 * kMargin));
  int panel = 0;
  for (const Heightfield* const field : {&one, &many}) {
    const double x = kMargin + panel * (kWide + kMargin);
    sheet.picture(x, kMargin, kWide, kHigh, wire_view(context, *field, kWide, kHigh, 1.4F));
    sheet.text(x + kWide / 2, kMargin + kHigh + 20, panel == 0 ? "one hill" : "60 hills", 15, "middle");
    ++panel;
  }
  sheet.write(recorder.figure(
      "ght.F10", "png",
      "Figure 10 of the paper: an isolated hill, and the terrain after 60 of them; heights are "
      "(r² − d²) / 20"));
}

namespace {

std::vector<Case> cases(const RunOptions&) {
  std::vector<Case> cases;
  for (const std::int64_t figure : kFigures) {
    cases.push_back({fmt::format("F{}", figure), {kSpecs, {{"figure", figure}}}, ""});
  }
  return cases;
}

void draw(const Case& at, const RunOptions& options, Recorder& recorder, Progress&) {
  const std::int64_t figure = at.parameters.integer("figure");
  if (figure == 2) {
    throw usage_error("figure 2 shows a triangulated network, which nothing here makes", "figure",
                      "figures 1 and 3 to 10 are there");
  }
  const auto context = [&] { return open_context(options.renderer, 64, 64); };
  recorder.add("figure", "", static_cast<double>(figure));
  switch (figure) {
    case 1:
      return draw_heightmap_and_wireframe(*context(), options.seed, recorder);
    case 3:
      return draw_midpoints(options.seed, recorder);
    case 4:
      return draw_neighbourhoods(recorder);
    case 5:
      return draw_diamond_square_steps(options.seed, recorder);
    case 6:
      return draw_straddling_diamond(options.seed, recorder);
    case 7:
      return draw_diamond_square_terrains(*context(), options.seed, recorder);
    case 8:
      return draw_first_fault(options.seed, recorder);
    case 9:
      return draw_fault_maps(options.seed, recorder);
    default:
      return draw_hills_one_and_many(*context(), options.seed, recorder);
  }
}

}  // namespace

extern const Experiment kStages{"ght.stages", "Figures 1 and 3-10: the generators, step by step", kSpecs,
                                cases, draw};

}  // namespace terrabench::ght
