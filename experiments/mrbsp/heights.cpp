// §2: whether every level of the tree covers the whole ground, and the heights that the printed recursion
// gives its vertices: it passes to each half of a triangle only the points on that half's side of the cut.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "experiments/experiment.h"
#include "experiments/mrbsp/ground.h"
#include "lod/mrbsp/bisection_tree.h"
#include "lod/mrbsp/nearest_three.h"
#include "lod/mrbsp/subset_triangles.h"

namespace terrabench::mrbsp {
namespace {

constexpr std::array kSpecs{
    ParameterSpec{"points", std::int64_t{kSide}, "points",
                  "per side; where this is a power of two plus one, vertices coincide with points", 2, 4097},
    ParameterSpec{"depth", std::int64_t{kDepth}, "levels", "bisections", 1, 24},
};

// Whether the frame consists of 2^depth triangles of equal size in plan that cover the ground.
bool is_whole_level(const Frame& frame, const Heightfield& ground, int depth) {
  const double land = static_cast<double>(ground.extent_x()) * ground.extent_z();
  const double each = land / std::exp2(depth);
  double sum = 0;
  bool even = frame.stats.triangles == std::size_t{1} << depth;
  triangles(frame, [&](std::span<const glm::vec3> corners) {
    for (std::size_t k = 0; k < corners.size(); k += 3) {
      const glm::dvec3 u = corners[k + 1] - corners[k], v = corners[k + 2] - corners[k];
      const double area = 0.5 * (u.z * v.x - u.x * v.z);
      even = even && std::abs(area - each) <= 1e-4 * each;
      sum += area;
    }
  });
  return even && std::abs(sum - land) <= 1e-4 * land;
}

std::vector<Case> cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const std::string& ground : grounds(options, true)) {
    for (const int points : {kSide, kSide - 1}) {
      cases.push_back({fmt::format("{}/points={}", ground, points),
                       {kSpecs, {{"points", std::int64_t{points}}}},
                       ground});
    }
  }
  return cases;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(at.terrain, options.seed));
  const int side = at.integer("points");
  const int depth = at.integer("depth");
  const Heightfield ground = resample(*source.heights, side, side);
  const BisectionTree tree(depth / 2, depth);
  const std::vector<glm::vec3> points = height_points(ground);

  const Heightfield lattice = interpolate_heights(points, tree, progress);
  int whole = 0;
  View view;
  view.eye = {0, 10 * (lattice.extent_x() + lattice.extent_z()), 0};
  view.target = {0, 0, 0};
  view.up = {0, 0, -1};
  for (int level = 1; level <= depth; ++level) {
    Mrbsp lod(lattice, {.depth = level, .cull = false}, progress);
    lod.tune(kFinest);
    whole += is_whole_level(lod.update(view), lattice, level);
  }
  recorder.add("levels", "", depth);
  recorder.add("levels_not_whole", "", depth - whole);

  double squares = 0;
  for (const glm::vec3& p : points) {
    const double off = surface_height(tree, grid_of(lattice), p.x, p.z) - p.y;
    squares += off * off;
  }
  recorder.add("rmse", "m", std::sqrt(squares / static_cast<double>(points.size())));
  for (const bool shared : {false, true}) {
    const SubsetTriangles subsets = interpolate_subsets(points, tree, shared);
    const VertexGaps gaps = vertex_gaps(subsets);
    const std::string_view suffix = shared ? "_shared" : "";
    recorder.add(fmt::format("vertices{}", suffix), "", gaps.vertices);
    recorder.add(fmt::format("torn{}", suffix), "", gaps.torn);
    recorder.add(fmt::format("torn_share{}", suffix), "", share(gaps.torn, gaps.vertices));
    recorder.add(fmt::format("mean_gap{}", suffix), "m", gaps.mean);
    recorder.add(fmt::format("largest_gap{}", suffix), "m", gaps.largest);
    if (!shared) recorder.add("starved_share", "", share(subsets.starved, tree.triangles()));
  }
}

}  // namespace

extern const Experiment kHeights{"mrbsp.heights", "§2: levels of the tree, and heights of its vertices",
                                 kSpecs, cases, measure};

}  // namespace terrabench::mrbsp
