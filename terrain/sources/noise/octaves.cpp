#include "terrain/sources/noise/octaves.h"

#include "terrain/splitmix.h"

namespace terrabench::noise {
namespace {

// In [0, 256), in steps of 1/256: far apart, and so coarse that adding one loses few bits of a coordinate.
float lattice_offset(SplitMix& random) { return static_cast<float>(random.next() >> 48) / 256.0F; }

}  // namespace

std::vector<Octave> octaves(const Fractal& f) {
  std::vector<Octave> drawn;
  SplitMix random(f.seed);
  Octave octave{.frequency = f.frequency};
  float total = 0;
  for (int i = 0; i < f.octaves; ++i) {
    octave.seed = static_cast<std::uint32_t>(random.next());
    octave.offset_x = lattice_offset(random);
    octave.offset_y = lattice_offset(random);
    octave.offset_z = lattice_offset(random);
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
