// Flow is followed downstream from every head and stops at a pixel with a tributary not yet followed; the
// walk that brings the last tributary continues. No order of all pixels is needed, and walks stay in one part
// of the grid. Bands of rows are walked in parallel, each writing its own rows only; flow that leaves a band
// is followed last, by one thread.
#include "terrain/hydrology/accumulate.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace terrabench::hydrology {
namespace {

// Tall enough that few walks leave their band: on mountains a tenth of all pixels lies downstream of a
// crossing.
constexpr int kBandRows = 256;

// In the array of missing tributaries: a pixel that had none from the start.
constexpr std::uint8_t kHead = 255;

// Flow on its way into a pixel.
struct Arrival {
  std::size_t pixel;
  std::uint32_t flow;
};

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

struct Walker {
  const FlowNetwork& network;
  std::uint32_t* flow;
  std::uint8_t* missing;

  // Follows what flows out of a pixel, complete with all its tributaries, as far as it goes within
  // [begin, end). Returns the arrival outside; flow 0 when there is none.
  Arrival follow(std::size_t pixel, std::size_t begin, std::size_t end) const {
    while (network.flows(pixel)) {
      const std::uint32_t carried = flow[pixel];
      pixel = network.receiver(pixel);
      if (pixel < begin || pixel >= end) return {pixel, carried};
      flow[pixel] += carried;
      if (--missing[pixel] > 0) break;
      ++flow[pixel];
    }
    return {0, 0};
  }

  void walk_band(std::size_t begin, std::size_t end, std::vector<Arrival>& leaving) const {
    for (std::size_t i = begin; i < end; ++i) {
      if (missing[i] != kHead) continue;
      flow[i] = 1;
      if (const Arrival out = follow(i, begin, end); out.flow > 0) leaving.push_back(out);
    }
  }

  void arrive(const Arrival& from) const {
    flow[from.pixel] += from.flow;
    if (--missing[from.pixel] > 0) return;
    ++flow[from.pixel];
    follow(from.pixel, 0, network.size());
  }
};

}  // namespace

std::vector<std::uint32_t> accumulate(const FlowNetwork& network) {
  std::vector<std::uint32_t> flow(network.size());
  std::vector<std::uint8_t> missing(network.size());
  const auto width = static_cast<std::size_t>(network.width);
  const int bands = (network.depth + kBandRows - 1) / kBandRows;
  std::vector<std::vector<Arrival>> leaving(bands);
  const Walker walker{network, flow.data(), missing.data()};
  tbb::parallel_for(0, bands, [&](int band) {
    const int first = band * kBandRows, last = std::min(first + kBandRows, network.depth);
    for (int j = first; j < last; ++j) count_tributaries(network, j, missing.data() + j * width);
    walker.walk_band(first * width, last * width, leaving[band]);
  });
  for (const std::vector<Arrival>& band : leaving) {
    for (const Arrival& arrival : band) walker.arrive(arrival);
  }
  return flow;
}

}  // namespace terrabench::hydrology
