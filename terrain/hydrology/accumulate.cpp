// Threads follow the flow from every head and stop where a tributary is missing; whoever brings the last one
// carries on. No order of all pixels is needed, and walks keep to one part of the grid.
#include "terrain/hydrology/accumulate.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <atomic>

namespace terrabench::hydrology {
namespace {

// In the array of missing tributaries: a pixel that had none from the start.
constexpr std::uint8_t kHead = 255;

// Tributaries of every pixel of row j; kHead for pixels with data and without any.
void count_tributaries(const FlowNetwork& network, int j, std::uint8_t* counts) {
  const int width = network.width;
  const std::uint8_t* const directions = network.direction.data() + static_cast<std::size_t>(j) * width;
  std::fill_n(counts, width, std::uint8_t{0});
  for (unsigned d = 0; d < 8; ++d) {
    const FlowStep step = kFlowSteps[d];
    if (j + step.z < 0 || j + step.z >= network.depth) continue;
    const std::uint8_t* const from = directions + static_cast<std::ptrdiff_t>(step.z) * width + step.x;
    const int first = step.x < 0 ? 1 : 0, last = step.x > 0 ? width - 1 : width;
    const auto toward = static_cast<std::uint8_t>(d ^ 4U);
    for (int i = first; i < last; ++i) counts[i] += from[i] == toward;
  }
  for (int i = 0; i < width; ++i) {
    if (counts[i] == 0 && directions[i] != FlowNetwork::kNoData) counts[i] = kHead;
  }
}

void follow(const FlowNetwork& network, std::size_t pixel, std::uint8_t* missing, std::uint32_t* flow) {
  using Count = std::atomic_ref<std::uint8_t>;
  using Flow = std::atomic_ref<std::uint32_t>;
  std::uint32_t carried = 1;
  flow[pixel] = carried;
  while (network.flows(pixel)) {
    pixel = network.receiver(pixel);
    if (Count(missing[pixel]).load(std::memory_order_acquire) == 1) {
      // The only one left: nobody else writes here any more.
      carried += flow[pixel] + 1;
      flow[pixel] = carried;
      continue;
    }
    Flow(flow[pixel]).fetch_add(carried, std::memory_order_relaxed);
    if (Count(missing[pixel]).fetch_sub(1, std::memory_order_acq_rel) != 1) return;
    carried = ++flow[pixel];
  }
}

}  // namespace

std::vector<std::uint32_t> accumulate(const FlowNetwork& network) {
  std::vector<std::uint32_t> flow(network.size());
  std::vector<std::uint8_t> missing(network.size());
  const auto width = static_cast<std::size_t>(network.width);
  tbb::parallel_for(0, network.depth,
                    [&](int j) { count_tributaries(network, j, missing.data() + j * width); });
  tbb::parallel_for(tbb::blocked_range<int>(0, network.depth, 16), [&](const tbb::blocked_range<int>& rows) {
    for (std::size_t i = rows.begin() * width; i < rows.end() * width; ++i) {
      if (std::atomic_ref(missing[i]).load(std::memory_order_relaxed) == kHead) {
        follow(network, i, missing.data(), flow.data());
      }
    }
  });
  return flow;
}

}  // namespace terrabench::hydrology
