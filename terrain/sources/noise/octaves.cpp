#include "terrain/sources/noise/octaves.h"

#include <cstdint>

namespace terrabench::noise {
namespace {

// SplitMix64 (Steele et al. 2014): spreads a seed over the octaves.
std::uint64_t next_random(std::uint64_t& state) {
  std::uint64_t z = (state += 0x9E3779B97F4A7C15U);
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31);
}

// In [0, 256), in steps of 1/256: far apart, and so coarse that adding one loses few bits of a coordinate.
float lattice_offset(std::uint64_t& state) { return static_cast<float>(next_random(state) >> 48) / 256.0F; }

}  // namespace

std::vector<Octave> octaves(const Fractal& f) {
  std::vector<Octave> drawn;
  std::uint64_t state = f.seed;
  Octave octave{.frequency = f.frequency};
  float total = 0;
  for (int i = 0; i < f.octaves; ++i) {
    octave.seed = static_cast<std::uint32_t>(next_random(state));
    octave.offset_x = lattice_offset(state);
    octave.offset_y = lattice_offset(state);
    octave.offset_z = lattice_offset(state);
    drawn.push_back(octave);
    total += octave.weight;
    octave.frequency *= f.lacunarity;
    octave.weight *= f.gain;
  }
  // A sum of rounded weights may exceed 1 by half an ulp per octave; the range that graph.h promises, and
  // that bounds rely on, must hold exactly.
  constexpr float kRoom = 1.0F - 2e-6F;
  for (Octave& each : drawn) each.weight = each.weight / total * kRoom;
  return drawn;
}

}  // namespace terrabench::noise
