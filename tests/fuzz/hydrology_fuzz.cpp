// Flow over grids of any floats, including infinite, denormal and no-data ones: the rule of flow.h with a
// plain priority queue gives the same directions, and all flow arrives in outlets. The first byte is the
// width, the rest are heights.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <queue>
#include <tuple>

#include "terrain/hydrology/channels.h"
#include "terrain/hydrology/flow.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace terrabench;

constexpr std::size_t kMostSamples = 1 << 12;

// `visit` is called with each neighbour's direction and index; returns whether one is missing or a hole.
template <class Visit>
bool neighbours(const Heightfield& field, std::size_t pixel, const Visit& visit) {
  const int x = static_cast<int>(pixel) % field.width, z = static_cast<int>(pixel) / field.width;
  bool border = false;
  for (unsigned d = 0; d < 8; ++d) {
    const int i = x + kFlowSteps[d].x, j = z + kFlowSteps[d].z;
    if (i < 0 || j < 0 || i >= field.width || j >= field.depth || Heightfield::is_no_data(field.at(i, j))) {
      border = true;
    } else {
      visit(d, static_cast<std::size_t>(j * field.width + i));
    }
  }
  return border;
}

std::vector<std::uint8_t> directions(const Heightfield& field) {
  using Waiting = std::tuple<float, std::size_t, std::size_t>;  // height, turn, pixel
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> queue;
  std::vector<std::uint8_t> direction(field.heights.size(), FlowNetwork::kNoData);
  std::vector<bool> taken(field.heights.size());
  std::size_t turn = 0;
  for (std::size_t pixel = 0; pixel < direction.size(); ++pixel) {
    if (Heightfield::is_no_data(field.heights[pixel])) continue;
    if (!neighbours(field, pixel, [](unsigned, std::size_t) {})) continue;
    direction[pixel] = FlowNetwork::kOutlet;
    queue.emplace(field.heights[pixel], turn++, pixel);
  }
  while (!queue.empty()) {
    const std::size_t pixel = std::get<2>(queue.top());
    queue.pop();
    taken[pixel] = true;
    neighbours(field, pixel, [&](unsigned d, std::size_t to) {
      const bool unmet = direction[to] == FlowNetwork::kNoData;
      const bool waits_at_border = direction[to] == FlowNetwork::kOutlet && !taken[to];
      if (!unmet && !(waits_at_border && field.heights[to] > field.heights[pixel])) return;
      direction[to] = static_cast<std::uint8_t>((d + 4) % 8);
      if (unmet) queue.emplace(field.heights[to], turn++, to);
    });
  }
  return direction;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1 + sizeof(float)) return 0;
  const std::size_t samples = std::min((size - 1) / sizeof(float), kMostSamples);
  Heightfield field;
  field.width = static_cast<int>(std::min<std::size_t>(data[0] + std::size_t{1}, samples));
  field.depth = static_cast<int>(samples) / field.width;
  field.heights.resize(static_cast<std::size_t>(field.width) * field.depth);
  std::memcpy(field.heights.data(), data + 1, field.heights.size() * sizeof(float));
  const FlowNetwork network = route_flow(field);
  if (network.direction != directions(field)) std::abort();
  std::size_t with_data = 0, drained = 0;
  for (std::size_t i = 0; i < network.size(); ++i) {
    with_data += Heightfield::is_no_data(field.heights[i]) ? 0 : 1;
    if (network.direction[i] == FlowNetwork::kOutlet) drained += network.accumulation[i];
  }
  if (drained != with_data) std::abort();
  const std::vector<std::uint32_t> channels = channel_pixels(network, 1);
  if (channels.size() != with_data) std::abort();
  return 0;
}

FuzzSeeds fuzz_seeds() {
  FuzzSeeds seeds;
  for (const float scale : {1.0F, 0.3F, 1e-42F, 1e36F}) {
    std::vector<std::uint8_t> seed{23};
    for (unsigned i = 0; i < 24 * 20; ++i) {
      const float height = i % 61 == 17 ? Heightfield::kNoData : scale * static_cast<float>(i * 7919 % 97);
      const auto* const bytes = reinterpret_cast<const std::uint8_t*>(&height);
      seed.insert(seed.end(), bytes, bytes + sizeof height);
    }
    seeds.push_back(std::move(seed));
  }
  return seeds;
}
