// Constants of the gradient noise lattice, apart from the SIMD code so that a scalar reference can share
// them.
#pragma once

#include <cstdint>

namespace terrabench::noise {

// Odd multipliers that spread the three lattice coordinates over 32 bits before they are combined.
inline constexpr std::uint32_t kLatticeX = 0x9E3779B1U, kLatticeY = 0x85EBCA77U, kLatticeZ = 0xC2B2AE3DU;
// Multipliers after each of the two xor-shifts of the lattice hash.
inline constexpr std::uint32_t kMixXz = 0x7FEB352DU, kMixY = 0x846CA68BU;
// A third of the 29 hash bits that choose a gradient's zero component.
inline constexpr std::int32_t kThird = 0x0AAAAAAA;

// Coordinates of at least this magnitude count as 0: their cell would not fit 32 bits.
inline constexpr float kLatticeLimit = 1073741824.0F;  // 2^30

// 1 / (the largest value of the sum of corner weights times the best gradient's product, 1.0363538), rounded
// down so that float rounding cannot leave [-1, 1].
inline constexpr float kNormalise = 0.96492F;

// Shared lattice planes are used where y fits exactly and a batch has at least this many samples per cell:
// making a plane costs half a sample's noise, and finding a sample's plane costs more the more planes a
// vector spans.
inline constexpr float kPlaneLimit = 4194304.0F;  // 2^22
inline constexpr float kPlaneCost = 1.5F;

}  // namespace terrabench::noise
