// How far a picture is from another of the same size, such as a method's from brute force's.
#pragma once

#include "terrain/image.h"

namespace terrabench {

// Peak signal-to-noise ratio over all three channels, decibels; infinite for equal pictures. O(pixels).
double psnr(const Image&, const Image&);

// Mean structural similarity of the luma (Rec. 601) after Wang, Bovik, Sheikh & Simoncelli (2004): Gaussian
// windows of 11 × 11 and σ = 1.5 that lie wholly inside, K1 = 0.01, K2 = 0.03. 1 for equal pictures; pictures
// under 11 pixels either way are one window. O(pixels).
double ssim(const Image&, const Image&);

}  // namespace terrabench
