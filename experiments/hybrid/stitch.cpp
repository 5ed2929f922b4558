// §3.5 of "hybrid": whether the near surface meets the clipmap without openings, at rest and in motion, and
// how much geometry the combination saves over the implicit surface everywhere.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <random>

#include "experiments/experiment.h"
#include "experiments/near_ground.h"
#include "lod/camera/camera_path.h"
#include "lod/hybrid/hybrid.h"
#include "lod/meters/bare_pixels.h"
#include "lod/meters/openings.h"
#include "terrain/frustum.h"

namespace terrabench::hybrid {
namespace {

constexpr std::array<std::string_view, 2> kMotions{"rest", "walk"};
constexpr std::array<std::string_view, 3> kGrounds{"caves", "canyon", "two-tunnels"};

const std::vector<ParameterSpec>& stitch_specs() {
  static const std::vector<ParameterSpec> kSpecs{
      {"n", std::int64_t{256}, "columns", "along the longer side of the ground", 64, 2048},
      {"finer", std::int64_t{2}, "samples", "of the height map per column", 1, 8},
      {"radius", std::int64_t{1}, "chunks", "near chunks on each side of the eye's", 0, 16},
      choice("motion", kMotions, "random eyes at rest, or frames of the committed walk"),
      {"interpolate", true, "", "move the near surface towards the far heights along its rim"},
      {"views", std::int64_t{100}, "views", "that are measured", 1, 100000},
  };
  return kSpecs;
}

std::vector<Case> stitch_cases(const RunOptions& options) {
  const bool paper = options.profile == Profile::kPaper;
  std::vector<Case> cases;
  const auto add = [&](std::string_view ground, std::string_view motion, bool interpolate, int views) {
    cases.push_back({fmt::format("{}/{}{}", ground, motion, interpolate ? "" : "-cut-alone"),
                     {stitch_specs(),
                      {{"n", std::int64_t{paper ? 256 : 128}},
                       {"motion", std::string(motion)},
                       {"interpolate", interpolate},
                       {"views", std::int64_t{views}}}},
                     std::string(ground)});
  };
  std::vector<std::string> grounds = options.terrains;
  if (grounds.empty()) grounds.assign(kGrounds.begin(), kGrounds.end());
  for (const std::string& ground : grounds) {
    for (const std::string_view motion : kMotions) add(ground, motion, true, paper ? 100 : 10);
    add(ground, "rest", false, paper ? 20 : 4);
  }
  return cases;
}

// Least height of an eye over the ground: as far as a walker's, or a column and a half on coarse ground.
float eye_height(const NearGround& ground) {
  return std::max(1.8F, 1.5F * static_cast<float>(ground.surface->stack().grid().cell_x));
}

// Eyes over the part of the ground around which there is a rim, with a random heading each.
std::vector<View> at_rest(const NearGround& ground, int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<float> share(0, 1);
  std::vector<View> all;
  for (int k = 0; k < count; ++k) {
    const glm::vec2 place(share(random) * ground.heights.extent_x(),
                          share(random) * ground.heights.extent_z());
    all.push_back(standing_on(ground, place, 6.2831853F * share(random), eye_height(ground)));
  }
  return all;
}

std::vector<View> walk(const NearGround& ground) {
  std::vector<View> all;
  for (const View& view : views(camera_path("walk"), ground.heights)) {
    const glm::vec3 ahead = view.target - view.eye;
    all.push_back(
        standing_on(ground, {view.eye.x, view.eye.z}, std::atan2(ahead.z, ahead.x), eye_height(ground)));
  }
  return all;
}

// The angle by which the surface turns at edges of two triangles, radians, weighted by their lengths.
struct Bend {
  double sum = 0, length = 0;
  void add(double angle, double metres) {
    sum += angle * metres;
    length += metres;
  }
  double degrees() const { return sum / std::max(length, 1e-9) * 180 / std::numbers::pi; }
};

// Bends within the near surface, within the far ground, and at the rim, where a triangle of each meet.
struct Bends {
  Bend near, far, rim;
};

void add_bends(const Frame& frame, Bends& bends) {
  struct Side {
    glm::vec3 normal;
    bool near;
  };
  const auto key = [](const glm::vec3& a, const glm::vec3& b) {
    return std::array{a.x, a.y, a.z, b.x, b.y, b.z};
  };
  std::map<std::array<float, 6>, Side> sides;  // by directed edge
  const auto collect = [&](const Frame& part, bool near) {
    triangles(part, [&](std::span<const glm::vec3> corners) {
      for (std::size_t t = 0; t < corners.size(); t += 3) {
        const glm::vec3 cross = glm::cross(corners[t + 1] - corners[t], corners[t + 2] - corners[t]);
        if (!(glm::length(cross) > 0)) continue;
        for (std::size_t k = 0; k < 3; ++k)
          sides.insert({key(corners[t + k], corners[t + (k + 1) % 3]), {glm::normalize(cross), near}});
      }
    });
  };
  Frame near = frame, far = frame;
  near.batches = {};
  far.meshes = {};
  collect(near, true);
  collect(far, false);
  for (const auto& [edge, side] : sides) {
    const glm::vec3 a(edge[0], edge[1], edge[2]), b(edge[3], edge[4], edge[5]);
    const auto other = sides.find(key(b, a));
    if (other == sides.end()) continue;
    const double angle = std::acos(std::clamp(glm::dot(side.normal, other->second.normal), -1.0F, 1.0F));
    Bend& bend = side.near != other->second.near ? bends.rim : side.near ? bends.near : bends.far;
    bend.add(angle, glm::distance(a, b));
  }
}

void measure_stitch(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_terrain(at.terrain, options.seed));
  const NearGround ground = near_ground(source, at.integer("n"), at.integer("finer"), progress);
  const bool walking = at.parameters.text("motion") == "walk";
  const auto wanted = static_cast<std::size_t>(at.integer("views"));
  const std::vector<View> all = walking ? walk(ground) : at_rest(ground, at.integer("views"), options.seed);
  Hybrid lod(ground.lod(),
             {.radius = at.integer("radius"), .interpolate = at.parameters.flag("interpolate")});
  lod.tune(lod.least_window());
  lod.update(all.front());
  const std::size_t late_at_first = lod.late();
  OpenEdges worst;
  BarePixels bare;
  Bends bends;
  std::size_t with_rim = 0, measured = 0;
  progress.begin(fmt::format("openings on {}", at.name), wanted);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Frame& frame = lod.update(all[k]);
    if (measured * all.size() > k * wanted) continue;  // evenly spaced
    ++measured;
    with_rim += frame.meshes.empty() ? 0U : 1U;
    if (measured % 10 == 1) add_bends(frame, bends);
    const OpenEdges open = find_open_edges(frame, ground.heights, all[k]);
    const BarePixels seen = find_bare_pixels(frame, ground.heights, all[k]);
    worst.edges += open.edges;
    worst.largest_gap_m = std::max(worst.largest_gap_m, open.largest_gap_m);
    worst.largest_gap_px = std::max(worst.largest_gap_px, open.largest_gap_px);
    bare.bare += seen.bare;
    bare.covered += seen.covered;
    progress.advance();
  }
  recorder.add("views", "", static_cast<double>(measured));
  recorder.add("views_with_rim", "", static_cast<double>(with_rim));
  recorder.add("open_edges", "", static_cast<double>(worst.edges));
  recorder.add("largest_gap", "m", worst.largest_gap_m);
  recorder.add("largest_gap_on_screen", "pixels", worst.largest_gap_px);
  recorder.add("bend_near", "degrees", bends.near.degrees());
  recorder.add("bend_far", "degrees", bends.far.degrees());
  recorder.add("bend_at_rim", "degrees", bends.rim.degrees());
  recorder.add("rim_length", "m", bends.rim.length / 2);
  recorder.add("bare_pixels", "pixels", static_cast<double>(bare.bare));
  recorder.add("pixels_covered_twice", "pixels", static_cast<double>(bare.covered));
  if (walking) recorder.add("late_chunks", "", static_cast<double>(lod.late() - late_at_first));
}

const std::vector<ParameterSpec>& geometry_specs() {
  static const std::vector<ParameterSpec> kSpecs{
      {"n", std::int64_t{512}, "columns", "along the longer side of the ground", 64, 2048},
      {"finer", std::int64_t{1}, "samples", "of the height map per column", 1, 8},
      {"radius", std::int64_t{1}, "chunks", "near chunks on each side of the eye's", 0, 16},
      {"views", std::int64_t{30}, "views", "of the committed walk that are measured", 1, 100000},
  };
  return kSpecs;
}

std::vector<Case> geometry_cases(const RunOptions& options) {
  const bool paper = options.profile == Profile::kPaper;
  std::vector<Case> cases;
  for (const int finer : {1, 2}) {
    for (const int radius : {0, 1, 2, 3}) {
      cases.push_back({fmt::format("finer={}/radius={}", finer, radius),
                       {geometry_specs(),
                        {{"n", std::int64_t{paper ? 512 : 256}},
                         {"finer", std::int64_t{finer}},
                         {"radius", std::int64_t{radius}}}},
                       std::string(kGrounds[0])});
    }
  }
  return cases;
}

// What a renderer of the implicit surface alone draws: its chunks in view.
struct ChunkSize {
  Bounds box;
  std::size_t triangles;
};

std::vector<ChunkSize> sizes_of(const ImplicitSurface& surface, Progress& progress) {
  const glm::ivec2 chunks = surface.chunks();
  std::vector<ChunkSize> sizes;
  progress.begin("implicit surface everywhere", static_cast<std::size_t>(chunks.x) * chunks.y);
  for (int b = 0; b < chunks.y; ++b) {
    for (int a = 0; a < chunks.x; ++a) {
      const TriangleMesh mesh = surface.chunk({a, b}, 0);
      sizes.push_back({bounds_of(mesh), mesh.triangles()});
      progress.advance();
    }
  }
  return sizes;
}

void measure_geometry(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_terrain(at.terrain, options.seed));
  const NearGround ground = near_ground(source, at.integer("n"), at.integer("finer"), progress);
  const std::vector<ChunkSize> everywhere = sizes_of(*ground.surface, progress);
  Hybrid lod(ground.lod(), {.radius = at.integer("radius")});
  lod.tune(lod.least_window());
  const std::vector<View> all = walk(ground);
  const std::size_t every =
      std::max<std::size_t>(all.size() / static_cast<std::size_t>(at.integer("views")), 1);
  double hybrid = 0, near = 0, implicit = 0, frames = 0;
  for (std::size_t k = 0; k < all.size(); k += every, ++frames) {
    const Frame& frame = lod.update(all[k]);
    hybrid += static_cast<double>(frame.stats.triangles);
    for (const FrameMesh& mesh : frame.meshes) near += mesh.drawn ? static_cast<double>(mesh.triangles()) : 0;
    const Frustum frustum(all[k]);
    for (const ChunkSize& chunk : everywhere) {
      const bool seen = chunk.triangles > 0 && frustum.see(chunk.box) != Sight::kOutside;
      implicit += seen ? static_cast<double>(chunk.triangles) : 0;
    }
  }
  recorder.add("triangles", "", hybrid / frames);
  recorder.add("near_triangles", "", near / frames);
  recorder.add("implicit_triangles", "", implicit / frames);
  recorder.add("ratio", "", hybrid / implicit);
  recorder.add(
      "near_reach", "m",
      (static_cast<double>(at.integer("radius")) + 0.5) * ground.surface->cells() * ground.surface->cell());
}

}  // namespace

extern const Experiment kStitch{"hybrid.stitch", "§3.5: the rim of the near surface", stitch_specs(),
                                stitch_cases, measure_stitch};
extern const Experiment kLessGeometry{"hybrid.less-geometry",
                                      "§3.5: triangles against the implicit surface everywhere",
                                      geometry_specs(), geometry_cases, measure_geometry};

}  // namespace terrabench::hybrid
