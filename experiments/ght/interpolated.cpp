// §3.2: the heights of a heightmap at an angle with its host are interpolated linearly between the host's.
// The events' definitions (terrain/events/event.h) say from which place of the ground each cell took its
// height; the interpolation there is repeated here from the ground alone.
#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "experiments/ght/cells.h"
#include "experiments/ght/site.h"

namespace terrabench::ght {
namespace {

using namespace events;

// Linear between the corners of the triangle that holds the place; squares are divided from north-east to
// south-west.
double between_samples(const Heightfield& ground, glm::dvec2 plan) {
  const double x = plan.x / ground.cell_x, z = plan.y / ground.cell_z;
  const int i = std::clamp(static_cast<int>(x), 0, ground.width - 2),
            j = std::clamp(static_cast<int>(z), 0, ground.depth - 2);
  const double a = x - i, b = z - j, north_east = ground.at(i + 1, j), south_west = ground.at(i, j + 1);
  if (a + b <= 1) {
    const double corner = ground.at(i, j);
    return corner + a * (north_east - corner) + b * (south_west - corner);
  }
  const double corner = ground.at(i + 1, j + 1);
  return corner + (1 - a) * (south_west - corner) + (1 - b) * (north_east - corner);
}

double nearest_sample(const Heightfield& ground, glm::dvec2 plan) {
  return ground.at(static_cast<int>(std::lround(plan.x / ground.cell_x)),
                   static_cast<int>(std::lround(plan.y / ground.cell_z)));
}

// What a cell took from the ground, its event undone: the place in plan and the height.
struct Taken {
  glm::dvec2 plan;
  double height;
};

// `part`: the number of the cell's heightmap among those of its event.
std::optional<Taken> undone(const LinearErosion& e, glm::dvec3 cell, NodeId) {
  const glm::dvec2 plan(cell.x, cell.z);
  return Taken{plan, cell.y + e.drop(e.line().local(plan))};
}

// Nothing for the cells at the two ends of the line, which stay on the ground as it was.
std::optional<Taken> undone(const DipFault& e, glm::dvec3 cell, NodeId part) {
  constexpr double kEnd = 1;  // metres
  const Line line = e.line();
  const glm::dvec2 local = line.local({cell.x, cell.z});
  if (local.x < kEnd || local.x > line.length - kEnd) return std::nullopt;
  const double lip = (e.inverse ? -0.5 : 0.5) * e.offset();
  if (part == 2) return Taken{line.plan({local.x, 0}), cell.y - e.rise / 2 * local.y / lip};  // the scarp
  const double side = part == 0 ? 1 : -1, before = (side * local.y - lip) / (1 - lip / e.extent);
  return Taken{line.plan({local.x, side * before}), cell.y - side * e.rise / 2 * (1 - before / e.extent)};
}

struct Interpolation {
  std::size_t cells = 0;           // with heights that they took from a place between samples
  std::size_t wrong = 0;           // of them, heights other than the linear interpolation
  std::size_t unlike_nearest = 0;  // of them, heights other than the nearest sample's

  void add(const Heightfield& ground, const Taken& taken) {
    constexpr double kSame = 0.01;  // metres; places are rounded to floats
    const double linear = between_samples(ground, taken.plan), nearest = nearest_sample(ground, taken.plan);
    ++cells;
    wrong += std::abs(taken.height - linear) > kSame;
    unlike_nearest += std::abs(taken.height - nearest) > kSame;
  }
};

}  // namespace

void measure_interpolated(const RunOptions& options, Recorder& recorder) {
  const Site site = recorded_site(128, 32, options.seed, recorder);
  Interpolation all;
  for (const Kind kind : {Kind::kLinearErosion, Kind::kNormalFault, Kind::kInverseFault}) {
    Ght ght = plain_tree(site.ground);
    const Event event = single_event(site, kind);
    ght.apply(event);
    const Tree& tree = ght.model().tree;
    for (NodeId n = 1; n < tree.nodes().size(); ++n) {
      const GroundedHeightmap& node = tree.nodes()[n];
      for (CellId c = node.first; c < node.first + node.cells(); ++c) {
        if (tree.kind(c) != CellKind::kHeight) continue;
        const glm::dvec3 cell(tree.position(c));
        const std::optional<Taken> taken = kind == Kind::kLinearErosion
                                               ? undone(std::get<LinearErosion>(event), cell, n - 1)
                                               : undone(std::get<DipFault>(event), cell, n - 1);
        if (taken) all.add(site.ground, *taken);
      }
    }
  }
  recorder.add("interpolated_cells", "", all.cells);
  recorder.add("wrong_interpolated", "", all.wrong);
  recorder.add("unlike_nearest", "", all.unlike_nearest);
}

}  // namespace terrabench::ght
