// How far two channel networks lie from each other: averaged Hausdorff distance (Stuetzle & Franklin 2012,
// equation 3). The sets are the channel pixels of the original and of another terrain, both found with the
// same threshold. For each set, the mean distance from its pixels to the nearest pixel of the other; the
// larger of the two means.
//
// The paper does not say in which space the distance is taken. It divides by the distance between the
// terrain's corners, in which "elevation is ignored", and says that values above 1 are possible, which
// suggests distances with elevation and without a common unit. So there are three readings.
//
// Exact: by distance transform in the plane, O(n), and by k-d tree in space, O(c log c) for c channel pixels.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "terrain/heightfield.h"

namespace terrabench {

enum class ChannelReading {
  kPlane,   // along the map, metres
  kSpace,   // with each pixel's elevation on its own terrain, all in metres
  kSample,  // with elevation in metres but positions in samples, as in a program that ignores the cell size
};
std::string_view name(ChannelReading);

struct ChannelDistance {
  double from_original = 0;  // mean distance from the original's channel pixels to the other's
  double from_other = 0;     // and in the other direction
  double corners = 0;        // between the first and the last sample, along the map, in the same unit

  // Equation 3, and normalised as in §3.1. Infinite when one network is empty, 0 when both are.
  double averaged_hausdorff() const { return from_original > from_other ? from_original : from_other; }
  double normalised() const;
};

// Row-major indices of pixels with data, in any order. The terrains must have one size. Parallel, the same
// result for any number of threads.
ChannelDistance channel_distance(const Heightfield& original, std::span<const std::uint32_t> channels,
                                 const Heightfield& other, std::span<const std::uint32_t> other_channels,
                                 ChannelReading reading);

}  // namespace terrabench
