// What the maps of figure 1 show, read back from their pixels: whether they are channel networks of their
// thresholds. Networks drawn at random, or of another ground, are told from them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "experiments/recorder.h"
#include "terrain/heightfield.h"
#include "terrain/image.h"

namespace terrabench::drill {

struct DrawnChannels {
  std::vector<std::size_t> pixels;  // channel pixels of each map
  // Channel pixels that are none in the map before, which has a lower threshold: 0, since flow that exceeds a
  // threshold exceeds the lower ones.
  std::size_t outside_denser = 0;
  // Networks of neighbouring channel pixels that reach neither the border nor a sample without data: 0, since
  // all flow of a pixel goes to one neighbour and no pit stops it.
  std::size_t inland = 0;
  // Of the first map's channel pixels, and of all samples, the share that lies below the mean of the samples
  // around. About equal for pixels at random.
  double low_share = 0, low_share_of_ground = 0;
};

// The place of cell k of `cells` among `others` over the same length, by its middle. At least as many others:
// at_middle(at_middle(k, cells, others), others, cells) == k.
inline int at_middle(int k, int cells, int others) {
  return static_cast<int>((2 * static_cast<std::int64_t>(k) + 1) * others / (2 * cells));
}

// `maps` show all of the ground, channels in kChannel; those with a lower threshold come first. A map is read
// at the middle of each sample. O(samples)
DrawnChannels read_channels(const std::vector<Image>& maps, const Heightfield& ground);

}  // namespace terrabench::drill
