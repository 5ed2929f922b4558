// How far two channel networks lie from each other: averaged Hausdorff distance (Stuetzle & Franklin 2012,
// equation 3). The sets are the channel pixels of the original and of another terrain, both found with the
// same threshold. For each set, the distances from its pixels to the nearest pixel of the other are averaged;
// the larger of the two averages counts.
//
// The paper does not say in which space the distance is taken. It divides by the distance between the
// terrain's corners, in which "elevation is ignored", and says that values above 1 are possible, which
// suggests distances with elevation, or sums. Hence four spaces and, beside equation 3's mean, the largest
// distance (Hausdorff's own) and the sum.
//
// Exact: by distance transform in the plane, O(n), and by k-d tree in space, O(c log c) for c channel pixels.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/heightfield.h"

namespace terrabench {

enum class ChannelSpace {
  kPlane,         // along the map, metres
  kPlaneSamples,  // along the map, in samples
  kSpace,         // with each pixel's elevation on its own terrain, all in metres
  kSpaceSamples,  // with elevation in metres but positions in samples, as in a program without a cell size
};

enum class ChannelAverage { kMean, kLargest, kSum };  // over the pixels of one network

struct ChannelDistance {
  struct Way {
    double mean = 0, largest = 0, sum = 0;
    double of(ChannelAverage average) const {
      return average == ChannelAverage::kMean ? mean : average == ChannelAverage::kLargest ? largest : sum;
    }
  };
  Way from_original;   // over the original's channel pixels, each to the nearest of the other's
  Way from_other;      // and in the other direction
  double corners = 0;  // between the first and the last sample, along the map, in the same unit

  // Equation 3, and normalised as in §3.1. Infinite when one network is empty, 0 when both are.
  double hausdorff(ChannelAverage average = ChannelAverage::kMean) const {
    return std::max(from_original.of(average), from_other.of(average));
  }
  double normalised(ChannelAverage average = ChannelAverage::kMean) const;
};

// Row-major indices of pixels with data, in any order. The terrains must have one size. Parallel, the same
// result for any number of threads.
ChannelDistance channel_distance(const Heightfield& original, std::span<const std::uint32_t> channels,
                                 const Heightfield& other, std::span<const std::uint32_t> other_channels,
                                 ChannelSpace space);

// Exact Euclidean distance transform of a grid (Meijster, Roerdink & Hesselink 2000; Felzenszwalb &
// Huttenlocher 2012): a pass along columns, then along each row the lower envelope of one parabola per
// column. O(n) for any set of points; parallel.

// The squared distance from each of width × depth grid points, spaced cell_x and cell_z, to the nearest of
// `points` (row-major indices, any order). All infinite when there are no points.
std::vector<double> squared_distances(int width, int depth, double cell_x, double cell_z,
                                      std::span<const std::uint32_t> points);

}  // namespace terrabench
