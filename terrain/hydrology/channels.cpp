#include "terrain/hydrology/channels.h"

#include <tbb/parallel_for.h>

#include <cassert>

namespace terrabench {
namespace {

template <class ValueOf>
Heightfield raster(const FlowNetwork& network, const Heightfield& ground, const ValueOf& value) {
  assert(ground.width == network.width && ground.depth == network.depth);
  Heightfield out{ground.width, ground.depth, ground.cell_x, ground.cell_z, {}, ground.georeference};
  out.heights.resize(network.size());
  tbb::parallel_for(std::size_t{0}, static_cast<std::size_t>(network.depth), [&](std::size_t j) {
    const std::size_t first = j * network.width;
    for (std::size_t i = first; i < first + network.width; ++i) {
      out.heights[i] = network.direction[i] == FlowNetwork::kNoData ? Heightfield::kNoData : value(i);
    }
  });
  return out;
}

}  // namespace

std::vector<std::uint32_t> channel_pixels(const FlowNetwork& network, std::uint32_t tau) {
  assert(tau >= 1);
  std::vector<std::uint32_t> channels;
  for (std::size_t i = 0; i < network.size(); ++i) {
    if (network.accumulation[i] >= tau) channels.push_back(static_cast<std::uint32_t>(i));
  }
  // A channel pixel drains to a channel pixel: accumulation never falls downstream.
  std::vector<std::uint8_t> missing(network.size());
  for (const std::uint32_t pixel : channels) {
    if (network.flows(pixel)) ++missing[network.receiver(pixel)];
  }
  std::vector<std::uint32_t> heads;
  for (const std::uint32_t pixel : channels) {
    if (missing[pixel] == 0) heads.push_back(pixel);
  }
  channels.clear();
  for (std::size_t pixel : heads) {
    channels.push_back(static_cast<std::uint32_t>(pixel));
    while (network.flows(pixel)) {
      pixel = network.receiver(pixel);
      if (--missing[pixel] > 0) break;
      channels.push_back(static_cast<std::uint32_t>(pixel));
    }
  }
  return channels;
}

Heightfield accumulation_raster(const FlowNetwork& network, const Heightfield& ground) {
  return raster(network, ground, [&](std::size_t i) { return static_cast<float>(network.accumulation[i]); });
}

Heightfield direction_raster(const FlowNetwork& network, const Heightfield& ground) {
  return raster(network, ground, [&](std::size_t i) {
    const std::uint8_t direction = network.direction[i];
    return direction == FlowNetwork::kOutlet ? 0.0F : static_cast<float>(1U << direction);
  });
}

}  // namespace terrabench
