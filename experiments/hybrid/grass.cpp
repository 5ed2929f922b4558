// Grass of "hybrid" (§3.3): Table 3, the slope angle, points by barycentric coordinates, and random numbers.
#include "renderers/grass/grass.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "experiments/cases.h"
#include "experiments/experiment.h"
#include "experiments/hybrid/grounds.h"
#include "renderers/frame_timer.h"
#include "renderers/grass/grass_scene.h"
#include "results/store/statistics.h"
#include "terrain/metrics/image_error.h"

namespace terrabench::hybrid {
namespace {

// The names of kGrassTechniques, in that order.
constexpr std::array<std::string_view, 3> kTechniques = {"geometry-shader", "instancing", "indirect"};

const std::array kTable3Specs{
    choice("technique", kTechniques, "how the billboards are drawn"),
    ParameterSpec{"billboards", std::int64_t{83'920}, "",
                  "grass billboards, two per strand; twice and three times as many are drawn, too", 2,
                  2 * (GrassGrowth::kMostStrands / 3)},
    ParameterSpec{"frames", std::int64_t{20}, "frames", "frames to time, of each number of billboards", 1,
                  100'000},
    ParameterSpec{"warm_up", std::int64_t{2}, "frames", "frames before them, of each number", 0, 100'000},
    ParameterSpec{"width", std::int64_t{800}, "pixels", "of the picture", 16, 8192},
    ParameterSpec{"height", std::int64_t{600}, "pixels", "of the picture", 16, 8192},
    ParameterSpec{"cells", std::int64_t{128}, "cells", "of the ground, along a side", 8, 2048},
};

std::vector<Case> table3_cases(const RunOptions& options) {
  if (options.profile == Profile::kPaper) return cases_by("technique", kTable3Specs);
  return cases_by("technique", kTable3Specs,
                  {{"frames", std::int64_t{kFewestSamples}}, {"warm_up", std::int64_t{1}}});
}

TriangleMesh recorded_ground(Recorder& recorder, const RunOptions& options, int cells) {
  const Heightfield field = grassland(options.seed, cells, 0.7F);
  recorder.terrain("grassland", checksum(field));
  return grassland_mesh(field);
}

// All grass is in view, so that every technique draws every billboard.
View whole(const TriangleMesh& mesh, int width, int height) {
  return overview(bounds_of(mesh), width, height, {0.35F, 0.45F, 1.0F});
}

// Of two pictures of one size.
double share_of_differing_pixels(const Image& a, const Image& b) {
  int differing = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) differing += a.pixel(x, y) != b.pixel(x, y) ? 1 : 0;
  }
  return differing / (static_cast<double>(a.width) * a.height);
}

void measure_table3(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TriangleMesh mesh = recorded_ground(recorder, options, at.integer("cells"));
  const View view = whole(mesh, at.integer("width"), at.integer("height"));
  const auto technique = kGrassTechniques[at.parameters.choice("technique")];
  const auto gl = open_context(options.renderer, view.width, view.height);

  constexpr int kCounts = 3;
  const Image bare = GrassScene(*gl, grass_ground(mesh), {}).picture(view, technique);
  std::vector<std::unique_ptr<GrassScene>> scenes;
  for (int k = 1; k <= kCounts; ++k) {
    const GrassGrowth growth{.strands = k * (at.parameters.integer("billboards") / 2)};
    scenes.push_back(std::make_unique<GrassScene>(*gl, grass_ground(mesh), growth));
    recorder.add(fmt::format("billboards_{}n", k), "",
                 static_cast<double>(scenes.back()->count_billboards(view, technique)));
    recorder.add(fmt::format("covered_{}n", k), "",
                 share_of_differing_pixels(scenes.back()->picture(view, technique), bare));
  }
  recorder.add(
      "ssim_to_geometry_shader", "",
      ssim(scenes[0]->picture(view, technique), scenes[0]->picture(view, GrassTechnique::kGeometryShader)));

  // The numbers take turns frame by frame, so that other work of the machine slows all of them alike.
  const int warm_up = kCounts * at.integer("warm_up"), frames = kCounts * at.integer("frames");
  progress.begin("frames", warm_up + frames);
  const std::vector<double> seconds = time_frames(frame_clock(*gl), warm_up, frames, [&](int frame) {
    GrassScene& scene = *scenes[static_cast<std::size_t>(frame % kCounts)];
    scene.look.seconds = static_cast<float>(frame / kCounts) / 60;
    scene.draw(view, technique);
    progress.advance();
  });
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    const std::size_t k = i % kCounts + 1;
    recorder.add_frame(fmt::format("frame_time_{}n", k), "s", seconds[i]);
    recorder.add_frame(fmt::format("frame_rate_{}n", k), "1/s", 1 / std::max(seconds[i], 1e-9));
  }
  // The three frames of a turn are compared with each other, then all turns by their median.
  for (std::size_t i = 0; i + kCounts <= seconds.size(); i += kCounts) {
    recorder.add_varying("time_growth", "", seconds[i + 2] / std::max(seconds[i], 1e-9));
  }
  recorder.add("bytes_3n", "B", static_cast<double>(scenes[2]->patch().bytes()));
}

constexpr std::array kSlopeSpecs{
    ParameterSpec{"limit", 45.0, "degrees", "steepest ground that grass grows on", 0, 180},
};

std::vector<Case> slope_cases(const RunOptions&) {
  std::vector<Case> cases;
  for (const double limit : {15.0, 30.0, 45.0, 60.0, 75.0}) {
    cases.push_back({fmt::format("limit={:g}", limit), {kSlopeSpecs, {{"limit", limit}}}});
  }
  return cases;
}

// Where the two readings of the angle differ most, over all inclinations from level to upright.
struct Difference {
  double degrees = 0, at = 0;  // the true angle there
};
Difference largest_difference() {
  constexpr int kSteps = 900'000;
  Difference most;
  for (int i = 0; i <= kSteps; ++i) {
    const double y = static_cast<double>(i) / kSteps;
    const double real = slope_angle(y, SlopeAngle::kTrue);
    const double difference = std::abs(real - slope_angle(y, SlopeAngle::kPrinted));
    if (difference > most.degrees) most = {difference, real};
  }
  return most;
}

using Corners = std::array<glm::dvec3, 3>;

// A point's distance from a triangle, in metres.
double distance_to(const glm::dvec3& p, const Corners& corner) {
  const glm::dvec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  bool inside = true;
  double nearest = glm::distance(p, corner[0]);
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3 from = corner[k], along = corner[(k + 1) % 3] - from;
    inside = inside && glm::dot(glm::cross(along, p - from), normal) >= 0;
    const double share = std::clamp(glm::dot(p - from, along) / glm::dot(along, along), 0.0, 1.0);
    nearest = std::min(nearest, glm::distance(p, from + share * along));
  }
  return inside ? std::abs(glm::dot(p - corner[0], normal)) / glm::length(normal) : nearest;
}

// Calls use(number of the strand, its triangle in the plan, the triangle's corners) for every strand.
template <class Use>
void each_strand(const GrassPlan& plan, const TriangleMesh& mesh, const Use& use) {
  for (std::size_t t = 0; t < plan.growing(); ++t) {
    const glm::uvec4& at = plan.triangles[t];
    const Corners corners{mesh.positions[at.x], mesh.positions[at.y], mesh.positions[at.z]};
    for (std::uint32_t k = at.w; k < plan.triangles[t + 1].w; ++k) use(k, at, corners);
  }
}

// The largest angle, as printed, of a triangle on which the GPU grew a strand.
double steepest_with_grass(GlContext& gl, const TriangleMesh& mesh, float limit) {
  GrassGrowth growth{.steepest = limit};
  growth.strands = static_cast<std::int64_t>(plan_grass(grass_ground(mesh), growth).growing());
  const std::vector<GrassStrand> strands = GrassScene(gl, grass_ground(mesh), growth).strands();
  const GrassPlan plan = plan_grass(grass_ground(mesh), growth);
  double steepest = 0;
  each_strand(plan, mesh, [&](std::uint32_t k, const glm::uvec4&, const Corners& corner) {
    if (distance_to(glm::dvec3(strands[k].root), corner) >= 1e-3) return;
    const glm::dvec3 normal = glm::normalize(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
    steepest = std::max(steepest, slope_angle(normal.y, SlopeAngle::kPrinted));
  });
  return steepest;
}

void measure_slope(const Case& at, const RunOptions& options, Recorder& recorder, Progress&) {
  const Difference most = largest_difference();
  recorder.add("largest_difference", "degrees", most.degrees);
  recorder.add("true_angle_there", "degrees", most.at);
  recorder.add("printed_for_level_ground", "degrees", slope_angle(1, SlopeAngle::kPrinted));
  recorder.add("printed_for_a_wall", "degrees", slope_angle(0, SlopeAngle::kPrinted));

  const Heightfield field = grassland(options.seed, 128, 0.9F);
  recorder.terrain("grassland with cliffs", checksum(field));
  const TriangleMesh mesh = grassland_mesh(field);
  const View view = whole(mesh, 320, 240);
  const auto gl = open_context(options.renderer, view.width, view.height);
  const auto limit = static_cast<float>(at.parameters.number("limit"));
  const auto count = [&](SlopeAngle reading) {
    GrassGrowth growth{.steepest = limit, .slope = reading};
    // One strand on every triangle that may have grass.
    growth.strands = static_cast<std::int64_t>(plan_grass(grass_ground(mesh), growth).growing());
    GrassScene scene(*gl, grass_ground(mesh), growth);
    return static_cast<double>(scene.count_billboards(view, GrassTechnique::kGeometryShader));
  };
  recorder.add("billboards_printed", "", count(SlopeAngle::kPrinted));
  recorder.add("billboards_by_true_angle", "", count(SlopeAngle::kTrue));
  recorder.add("billboards_everywhere", "", static_cast<double>(2 * mesh.triangles()));
  recorder.add("steepest_with_grass", "degrees", steepest_with_grass(*gl, mesh, limit));
}

constexpr std::array<std::string_view, 3> kPoints = {"sum", "product", "cross-product"};
const std::array kBarySpecs{
    choice("point", kPoints, "how the weighted corners are combined"),
    ParameterSpec{"strands", std::int64_t{41'960}, "strands", "on all the ground", 1,
                  GrassGrowth::kMostStrands},
};

std::vector<Case> bary_cases(const RunOptions&) { return cases_by("point", kBarySpecs); }

void measure_bary(const Case& at, const RunOptions& options, Recorder& recorder, Progress&) {
  const TriangleMesh mesh = recorded_ground(recorder, options, 64);
  const GrassGrowth growth{.strands = at.parameters.integer("strands"),
                           .point = static_cast<PointReading>(at.parameters.choice("point"))};
  const auto gl = open_context(options.renderer, 16, 16);
  GrassScene scene(*gl, grass_ground(mesh), growth);
  const std::vector<GrassStrand> strands = scene.strands();
  const GrassPlan plan = plan_grass(grass_ground(mesh), growth);

  // Rounding of 32-bit coordinates moves a root by less than this.
  constexpr double kRounding = 1e-3;  // metres
  std::vector<double> distances;
  each_strand(plan, mesh, [&](std::uint32_t k, const glm::uvec4&, const Corners& corners) {
    distances.push_back(distance_to(glm::dvec3(strands[k].root), corners));
  });
  const auto on_triangle = std::ranges::count_if(distances, [](double d) { return d <= kRounding; });
  std::sort(distances.begin(), distances.end());
  recorder.add("share_on_the_triangle", "",
               static_cast<double>(on_triangle) / static_cast<double>(distances.size()));
  recorder.add("median_distance", "m", distances[distances.size() / 2]);
  recorder.add("largest_distance", "m", distances.back());
}

constexpr std::array<std::string_view, 2> kRandoms = {"hash", "printed"};
const std::array kRandomSpecs{
    choice("random", kRandoms, "where the strands' pseudo-random numbers come from"),
    ParameterSpec{"strands", std::int64_t{41'960}, "strands", "on all the ground", 1,
                  GrassGrowth::kMostStrands},
};

std::vector<Case> random_cases(const RunOptions&) { return cases_by("random", kRandomSpecs); }

// The renderer's strands against those of a second growth there, and against the processor's.
void measure_random(const Case& at, const RunOptions& options, Recorder& recorder, Progress&) {
  const TriangleMesh mesh = recorded_ground(recorder, options, 64);
  const GrassGround ground = grass_ground(mesh);
  const GrassGrowth growth{.strands = at.parameters.integer("strands"),
                           .random = static_cast<RandomReading>(at.parameters.choice("random"))};
  const auto gl = open_context(options.renderer, 16, 16);
  const std::vector<GrassStrand> strands = GrassScene(*gl, ground, growth).strands(),
                                 again = GrassScene(*gl, ground, growth).strands();
  const GrassPlan plan = plan_grass(ground, growth);

  constexpr double kMoved = 1e-3;  // metres; rounding moves a root by less
  std::vector<double> moves;
  std::set<std::array<float, 3>> places;
  std::size_t moved = 0, redrawn_elsewhere = 0;
  each_strand(plan, mesh, [&](std::uint32_t k, const glm::uvec4& triangle, const Corners&) {
    const GrassStrand here = grow_strand(ground, growth, triangle, k - triangle.w + 1);
    moves.push_back(glm::distance(glm::dvec3(here.root), glm::dvec3(strands[k].root)));
    moved += moves.back() > kMoved ? 1 : 0;
    redrawn_elsewhere += strands[k].root != again[k].root ? 1 : 0;
    places.insert({strands[k].root.x, strands[k].root.y, strands[k].root.z});
  });
  std::sort(moves.begin(), moves.end());
  const auto all = static_cast<double>(moves.size());
  recorder.add("strands", "", all);
  recorder.add("places", "", static_cast<double>(places.size()));
  recorder.add("redrawn_elsewhere", "", static_cast<double>(redrawn_elsewhere));
  recorder.add("moved_share", "", static_cast<double>(moved) / all);
  recorder.add("median_move", "m", moves[moves.size() / 2]);
  recorder.add("largest_move", "m", moves.back());
}

}  // namespace

extern const Experiment kTable3{"hybrid.table3", "Table 3: frame time of grass billboards",
                                kTable3Specs,    table3_cases,
                                measure_table3,  Experiment::kTimed};
extern const Experiment kSlope{"hybrid.slope", "Grass: the slope angle, as printed and true", kSlopeSpecs,
                               slope_cases, measure_slope};
extern const Experiment kBary{"hybrid.bary", "Grass: points of a triangle, as printed and as a sum",
                              kBarySpecs, bary_cases, measure_bary};
extern const Experiment kRandom{"hybrid.random", "Grass: pseudo-random numbers, as printed and by a hash",
                                kRandomSpecs, random_cases, measure_random};

}  // namespace terrabench::hybrid
