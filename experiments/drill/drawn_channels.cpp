// Reads back what the maps of figure 1 show.
#include <algorithm>
#include <cstdint>

#include "experiments/drill/figures.h"
#include "experiments/figures/maps.h"

namespace terrabench::drill {
namespace {

constexpr int kAround = 10;  // samples on each side: 21 × 21 in all

// Calls visit(neighbour) for those of the eight neighbours that lie in the field.
template <class Visit>
void for_neighbours(std::size_t at, const Heightfield& ground, const Visit& visit) {
  const int i = static_cast<int>(at % ground.width), j = static_cast<int>(at / ground.width);
  for (int z = std::max(j - 1, 0); z <= std::min(j + 1, ground.depth - 1); ++z) {
    for (int x = std::max(i - 1, 0); x <= std::min(i + 1, ground.width - 1); ++x) {
      const std::size_t there = static_cast<std::size_t>(z) * ground.width + x;
      if (there != at) visit(there);
    }
  }
}

bool is_outlet(std::size_t at, const Heightfield& ground) {
  std::size_t neighbours = 0, holes = 0;
  for_neighbours(at, ground, [&](std::size_t there) {
    ++neighbours;
    holes += Heightfield::is_no_data(ground.heights[there]);
  });
  return neighbours < 8 || holes > 0;
}

std::size_t count_inland(std::vector<bool> is_channel, const Heightfield& ground) {
  std::size_t inland = 0;
  std::vector<std::size_t> open;
  for (std::size_t first = 0; first < is_channel.size(); ++first) {
    if (!is_channel[first]) continue;
    bool drains = false;
    open = {first};
    is_channel[first] = false;
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      drains = drains || is_outlet(at, ground);
      for_neighbours(at, ground, [&](std::size_t there) {
        if (!is_channel[there]) return;
        is_channel[there] = false;
        open.push_back(there);
      });
    }
    inland += !drains;
  }
  return inland;
}

// Whether each sample lies below the mean of those around, by sums over all samples to the north-west.
std::vector<bool> find_low(const Heightfield& ground) {
  const std::size_t row = static_cast<std::size_t>(ground.width) + 1;
  std::vector<double> sums(row * (static_cast<std::size_t>(ground.depth) + 1)), counts(sums.size());
  for (int j = 0; j < ground.depth; ++j) {
    for (int i = 0; i < ground.width; ++i) {
      const std::size_t at = (static_cast<std::size_t>(j) + 1) * row + i + 1;
      const bool known = !Heightfield::is_no_data(ground.at(i, j));
      const auto add = [&](std::vector<double>& to, double value) {
        to[at] = value + to[at - 1] + to[at - row] - to[at - row - 1];
      };
      add(sums, known ? ground.at(i, j) : 0);
      add(counts, known);
    }
  }
  std::vector<bool> low(ground.heights.size());
  for (int j = 0; j < ground.depth; ++j) {
    for (int i = 0; i < ground.width; ++i) {
      const std::size_t north = std::max(j - kAround, 0) * row, west = std::max(i - kAround, 0),
                        south = std::min(j + kAround + 1, ground.depth) * row,
                        east = std::min(i + kAround + 1, ground.width);
      const auto total = [&](const std::vector<double>& of) {
        return of[south + east] - of[north + east] - of[south + west] + of[north + west];
      };
      low[static_cast<std::size_t>(j) * ground.width + i] = ground.at(i, j) < total(sums) / total(counts);
    }
  }
  return low;
}

}  // namespace

DrawnChannels read_channels(const std::vector<Image>& maps, const Heightfield& ground) {
  DrawnChannels drawn;
  const std::vector<bool> is_low = find_low(ground);
  std::vector<bool> before(ground.heights.size(), true);
  for (const Image& map : maps) {
    std::vector<bool> is_channel(before.size());
    std::size_t pixels = 0, low = 0;
    for (std::size_t at = 0; at < is_channel.size(); ++at) {
      const int i = static_cast<int>(at % ground.width), j = static_cast<int>(at / ground.width);
      is_channel[at] = map.pixel(at_middle(i, ground.width, map.width),
                                 at_middle(j, ground.depth, map.height)) == figures::kChannel;
      pixels += is_channel[at];
      low += is_channel[at] && is_low[at];
      drawn.outside_denser += is_channel[at] && !before[at];
    }
    drawn.inland += count_inland(is_channel, ground);
    if (drawn.pixels.empty() && pixels > 0) {
      drawn.low_share = static_cast<double>(low) / static_cast<double>(pixels);
    }
    drawn.pixels.push_back(pixels);
    before = std::move(is_channel);
  }
  std::size_t known = 0;
  for (const float height : ground.heights) known += !Heightfield::is_no_data(height);
  const auto low = static_cast<double>(std::count(is_low.begin(), is_low.end(), true));
  if (known > 0) drawn.low_share_of_ground = low / static_cast<double>(known);
  return drawn;
}

}  // namespace terrabench::drill
