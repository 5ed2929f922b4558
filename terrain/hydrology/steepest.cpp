#include "terrain/hydrology/steepest.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>

#include "terrain/hydrology/accumulate.h"

namespace terrabench {
namespace {

std::uint8_t steepest(const Heightfield& field, int i, int j, const std::array<double, 8>& distance) {
  const float here = field.at(i, j);
  if (Heightfield::is_no_data(here)) return FlowNetwork::kNoData;
  std::uint8_t best = FlowNetwork::kOutlet;
  double most = 0;
  for (std::uint8_t d = 0; d < kFlowSteps.size(); ++d) {
    const int x = i + kFlowSteps[d].x, z = j + kFlowSteps[d].z;
    if (x < 0 || z < 0 || x >= field.width || z >= field.depth) continue;
    const double fall = (static_cast<double>(here) - field.at(x, z)) / distance[d];
    if (!(fall > most)) continue;  // false for no data as well
    most = fall;
    best = d;
  }
  return best;
}

}  // namespace

FlowNetwork route_steepest(const Heightfield& field) {
  FlowNetwork network;
  network.width = field.width;
  network.depth = field.depth;
  network.direction.resize(field.heights.size());
  std::array<double, 8> distance{};
  for (std::size_t d = 0; d < distance.size(); ++d) {
    distance[d] = std::hypot(kFlowSteps[d].x * field.cell_x, kFlowSteps[d].z * field.cell_z);
  }
  tbb::parallel_for(0, field.depth, [&](int j) {
    for (int i = 0; i < field.width; ++i) {
      network.direction[static_cast<std::size_t>(j) * static_cast<std::size_t>(field.width) +
                        static_cast<std::size_t>(i)] = steepest(field, i, j, distance);
    }
  });
  network.accumulation = hydrology::accumulate(network);
  return network;
}

}  // namespace terrabench
