// The difference of two images of the same size, such as those of a method and of brute force.
#pragma once

#include <cstddef>

#include "terrain/image.h"

namespace terrabench {

// Peak signal-to-noise ratio over all three channels, decibels; infinite for equal images. O(pixels). Throws
// usage_error for different sizes.
double psnr(const Image&, const Image&);

// Mean structural similarity of the luma (Rec. 601) after Wang, Bovik, Sheikh & Simoncelli (2004): Gaussian
// windows of 11 × 11 with σ = 1.5 that lie wholly inside, K1 = 0.01, K2 = 0.03. 1 for equal images. Along an
// axis of fewer than 11 pixels, the window is the whole axis. O(pixels), with memory for 11 rows of each.
// Throws usage_error for different sizes.
double ssim(const Image&, const Image&);

// How many pixels differ in a channel. O(pixels). Throws usage_error for different sizes.
std::size_t differing_pixels(const Image&, const Image&);

}  // namespace terrabench
