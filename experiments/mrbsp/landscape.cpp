// §1: the effect of each adjustment on the ground made from a drawing.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/experiment.h"
#include "experiments/figures/ground.h"
#include "experiments/figures/maps.h"
#include "experiments/mrbsp/ground.h"
#include "renderers/ramp.h"
#include "renderers/scene.h"
#include "terrain/sources/drawing/drawing.h"

namespace terrabench::mrbsp {
namespace {

constexpr std::array kSpecs{
    ParameterSpec{"n", std::int64_t{kSide}, "pixels", "side of the drawing", 16, 4096},
};
constexpr float kBeach = 25;  // metres; samples within this height of sea level are beach

// All greys from black to white.
Heightfield ramp(const DrawingOptions& options) {
  Image picture(256, 1, {});
  for (int x = 0; x < 256; ++x) {
    const auto grey = static_cast<std::uint8_t>(x);
    picture.set(x, 0, {grey, grey, grey});
  }
  return land_from_drawing(picture, options);
}

template <class Test>
double share_where(const Heightfield& field, const Test& test) {
  return static_cast<double>(std::count_if(field.heights.begin(), field.heights.end(), test)) /
         static_cast<double>(field.heights.size());
}

// Number of samples that break a rule that the text states for single greys.
std::size_t broken_greys() {
  std::size_t broken = 0;
  for (const float peak : {500.0F, 1000.0F, 2000.0F}) {
    for (const float bed : {0.05F, 0.3F}) {
      for (const int shore : {0, 51, 102}) {
        const Heightfield field =
            ramp({.sea_level = static_cast<float>(shore) / 255, .peak = peak, .seabed = bed, .smoothing = 0});
        broken += field.at(255, 0) != peak;
        broken += field.at(shore, 0) != 0;
        if (shore > 0) broken += field.at(0, 0) != -bed * peak;
        for (int x = 1; x < 256; ++x) broken += !(field.at(x, 0) > field.at(x - 1, 0));
      }
    }
  }
  return broken;
}

// Mean absolute Laplacian of the low land, and the number of mountain samples that moved.
struct Smoothed {
  double bend = 0;  // metres
  std::size_t moved = 0, mountains = 0;
};
Smoothed compare(const Heightfield& field, const Heightfield& drawn, const DrawingOptions& options) {
  Smoothed result;
  std::size_t low = 0;
  for (int j = 1; j + 1 < field.depth; ++j) {
    for (int i = 1; i + 1 < field.width; ++i) {
      if (drawn.at(i, j) >= options.mountains * options.peak) {
        ++result.mountains;
        result.moved += field.at(i, j) != drawn.at(i, j);
      } else if (drawn.at(i, j) > 0 && drawn.at(i, j) < 0.5F * options.mountains * options.peak) {
        result.bend += std::abs(4 * field.at(i, j) - field.at(i - 1, j) - field.at(i + 1, j) -
                                field.at(i, j - 1) - field.at(i, j + 1));
        ++low;
      }
    }
  }
  if (low > 0) result.bend /= static_cast<double>(low);
  return result;
}

Rgb ramp_rgb(double t) { return srgb_bytes(ramp_color(static_cast<float>(t))); }

std::vector<Case> cases(const RunOptions&) { return {Case{"drawing", Parameters(kSpecs), ""}}; }

// A drawing and the land made from it.
figures::Sheet landscape_sheet(const Image& picture, const Heightfield& field, const RunOptions& options) {
  constexpr double kPicture = 340, kWide = 620, kMargin = 20;
  const HeightRange range = height_range(field);
  const auto surface = [&](int i, int j) {
    return glm::vec3(static_cast<float>(i) * field.cell_x, field.at(i, j),
                     static_cast<float>(j) * field.cell_z);
  };
  const TriangleMesh walls = figures::block_sides(field.width, field.depth, surface, range.lowest);
  TriangleMesh mesh = figures::ground_mesh(field);
  compute_normals(mesh);
  const auto context = open_context(options.renderer, 64, 64);
  Scene scene;
  scene.lowest = 0;
  scene.highest = range.highest;
  scene.meshes = {{.mesh = &mesh},
                  {.mesh = &walls, .colors = std::vector<Rgb>(walls.positions.size(), {196, 180, 158})}};
  const float east = field.extent_x(), south = field.extent_z();
  scene.planes = {{.corners = {{0, 0, 0}, {0, 0, south}, {east, 0, south}, {east, 0, 0}},
                   .fill_opacity = 0.75F,
                   .line_width = 1}};
  const View view = overview(bounds_of(mesh), static_cast<int>(2 * kWide), static_cast<int>(2 * kPicture));
  figures::Sheet sheet(kPicture + kWide + 3 * kMargin, kPicture + 2 * kMargin + 40);
  sheet.picture(kMargin, kMargin, kPicture, kPicture, picture);
  sheet.picture(kPicture + 2 * kMargin, kMargin, kWide, kPicture, render_scene(*context, scene, view));
  sheet.text(kMargin + kPicture / 2, kPicture + kMargin + 24, "drawing: black is sea, white a peak", 15,
             "middle");
  const double land = kPicture + 2 * kMargin, below = kPicture + kMargin + 24;
  sheet.text(land + 20, below, fmt::format("land, {:.1f} km across, with the sea", field.extent_x() / 1000),
             15);
  figures::add_colour_key(
      sheet, land + kWide - 250, below - 11, "height, m", 70, 160, ramp_rgb,
      {"0", fmt::format("{:.0f}", range.highest / 2), fmt::format("{:.0f}", range.highest)});
  return sheet;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress&) {
  const Image picture = example_drawing(at.integer("n"), options.seed);
  DrawingOptions adjust;
  const Heightfield land = land_from_drawing(picture, adjust);
  recorder.terrain("drawing", checksum(land));
  recorder.add("broken_greys", "", broken_greys());
  for (const int percent : {10, 30, 40, 50}) {
    adjust.sea_level = static_cast<float>(percent) / 100;
    recorder.add(fmt::format("land_share_at_sea_level_{}", percent), "",
                 share_where(land_from_drawing(picture, adjust), [](float h) { return h > 0; }));
  }
  adjust = {};
  for (const int percent : {60, 30, 10, 3}) {
    adjust.seabed = static_cast<float>(percent) / 100;
    recorder.add(
        fmt::format("beach_share_at_seabed_{}", percent), "",
        share_where(land_from_drawing(picture, adjust), [](float h) { return std::abs(h) < kBeach; }));
  }
  adjust = {};
  adjust.smoothing = 0;
  const Heightfield drawn = land_from_drawing(picture, adjust);
  std::size_t moved = 0;
  for (const int passes : {0, 2, 8, 32}) {
    adjust.smoothing = passes;
    const Smoothed smoothed = compare(land_from_drawing(picture, adjust), drawn, adjust);
    recorder.add(fmt::format("hill_bend_after_{}", passes), "m", smoothed.bend);
    moved += smoothed.moved;
    if (passes == 0) recorder.add("mountain_samples", "", smoothed.mountains);
  }
  recorder.add("mountain_samples_moved", "", moved);
  landscape_sheet(picture, land, options)
      .write(recorder.figure("mrbsp.landscape",
                             "The paper's section 1: a drawing of grey clouds with lightened ridges "
                             "and a river and a lake in black, and the ground made from it."));
}

}  // namespace

extern const Experiment kDrawing{"mrbsp.drawing", "§1: land from drawings", kSpecs, cases, measure};

}  // namespace terrabench::mrbsp
