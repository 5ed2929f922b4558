// What the maps of figure 1 show, read back from their pixels: whether they are channel networks of their
// thresholds. Networks drawn at random, or of another ground, are told from them.
#pragma once

#include <cstddef>
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

// `maps` have one pixel per sample of `ground`, channels in kChannel; those with a lower threshold come
// first. O(pixels)
DrawnChannels read_channels(const std::vector<Image>& maps, const Heightfield& ground);

}  // namespace terrabench::drill
