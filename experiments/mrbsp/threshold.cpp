// §3 says that depth M - log2(D/S) makes distant triangles look as large as near ones. Measured on level
// ground: the short side of triangles, in pixels, against the distance of their furthest corner.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "experiments/experiment.h"
#include "experiments/figures/sheet.h"
#include "experiments/mrbsp/ground.h"
#include "lod/mrbsp/mrbsp.h"
#include "results/plot/plot.h"

namespace terrabench::mrbsp {
namespace {

constexpr std::array kSpecs{
    ParameterSpec{"n", std::int64_t{1025}, "samples", "side of the level ground", 65, 4097},
};
constexpr int kFirstBin = 10, kBins = 10;  // two per doubling of distance, from 32 short sides
constexpr double kSize = 16;
constexpr int kPictureWidth = 1760;
// At 800 × 600 pixels and 40° across.
const double kPixelsPerRadian = 400 / std::tan(std::numbers::pi / 9);

struct Bin {
  double log_legs = 0;
  std::size_t triangles = 0;
};

// Geometric means of the apparent short side, per bin of distance.
std::vector<PlotPoint> apparent_sizes(const Heightfield& ground, bool area, Progress& progress) {
  Mrbsp lod(ground, {.area_consistent = area, .holes = HoleRule::kPrinted, .cull = false}, progress);
  lod.tune(kSize);
  View view;
  view.eye = {0, 1.8F, 0};
  view.target = {ground.extent_x(), 1.8F, ground.extent_z()};
  view.far = 4 * ground.extent_x();
  std::array<Bin, kBins> bins{};
  triangles(lod.update(view), [&](std::span<const glm::vec3> corners) {
    for (std::size_t k = 0; k < corners.size(); k += 3) {
      double furthest = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        furthest = std::max<double>(furthest, glm::distance(corners[k + c], view.eye));
      }
      const double side = std::sqrt(
          glm::length(glm::cross(corners[k + 1] - corners[k], corners[k + 2] - corners[k])));  // √(2·area)
      const int bin = static_cast<int>(std::floor(2 * std::log2(furthest / lod.short_side()))) - kFirstBin;
      if (bin < 0 || bin >= kBins) continue;
      bins[static_cast<std::size_t>(bin)].log_legs += std::log(side / furthest * kPixelsPerRadian);
      ++bins[static_cast<std::size_t>(bin)].triangles;
    }
  });
  std::vector<PlotPoint> points;
  for (int k = 0; k < kBins; ++k) {
    const Bin& bin = bins[static_cast<std::size_t>(k)];
    if (bin.triangles == 0) continue;
    const double size = std::exp(bin.log_legs / static_cast<double>(bin.triangles));
    points.push_back({std::exp2((kFirstBin + k + 0.5) / 2), size, size, size});
  }
  return points;
}

std::string slope_text(double slope) {
  return fmt::format("{}{:.2f}", slope < -0.005 ? "−" : "", std::abs(slope));
}

// The formula as printed, then the one for areas. Labels give the slopes.
Plot threshold_plot(const Heightfield& level, Progress& progress) {
  Plot plot{
      .title = "Apparent size of triangles against distance",
      .x = {.label = "distance of the furthest corner", .unit = "short sides of the finest", .log = true},
      .y = {.label = "apparent short side", .unit = "pixels", .log = true},
      .series = {}};
  for (const bool area : {false, true}) {
    std::vector<PlotPoint> points = apparent_sizes(level, area, progress);
    const std::optional<double> slope = power_law(points);
    plot.series.push_back(
        {.label = fmt::format("{}, slope {}", area ? "M − 2 log₂(D/S)" : "M − log₂(D/S), as printed",
                              slope ? slope_text(*slope) : "–"),
         .points = std::move(points)});
  }
  return plot;
}

std::vector<Case> cases(const RunOptions&) { return {Case{"level", Parameters(kSpecs), ""}}; }

void measure(const Case& at, const RunOptions&, Recorder& recorder, Progress& progress) {
  const int n = at.integer("n");
  const Heightfield ground = Heightfield::zeros(n, n, 30, 30);
  recorder.terrain("level", checksum(ground));
  const Plot plot = threshold_plot(ground, progress);
  for (std::size_t k = 0; k < plot.series.size(); ++k) {
    const std::vector<PlotPoint>& points = plot.series[k].points;
    const std::string name = k == 0 ? "printed" : "area";
    if (const auto slope = power_law(points)) recorder.add("slope_" + name, "", *slope);
    recorder.add("size_near_" + name, "pixels", points.front().y);
    recorder.add("size_far_" + name, "pixels", points.back().y);
  }
  figures::write_chart(
      recorder.figure("mrbsp.threshold",
                      "The paper's section 3: apparent size of triangles against distance, on level ground, "
                      "by the printed formula, which is to keep it, and by the one for halved areas. "
                      "S is 16 short sides of the finest triangles; 800 × 600 pixels, 40° wide. "
                      "Steps come from whole levels and two bins per doubling of distance."),
      plot, kPictureWidth);
}

}  // namespace

extern const Experiment kThreshold{"mrbsp.threshold", "§3: apparent size of triangles against distance",
                                   kSpecs, cases, measure};

}  // namespace terrabench::mrbsp
