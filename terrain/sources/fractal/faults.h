// Fault formation (Alonso et al., §2.3.2, figures 8 and 9): a random line cuts flat ground in two; one side
// rises, the other sinks; again and again.
//
// A line crosses each row of the field once, so that a row's heights are sums over the crossings before them:
// O(faults · depth + width · depth) instead of the O(faults · width · depth) of the method as printed. Which
// side a sample is on is decided in whole numbers and steps are counted: the result does not depend on
// threads or machines.
#pragma once

#include <cstdint>
#include <vector>

#include "terrain/heightfield.h"

namespace terrabench::fractal {

struct FaultOptions {
  std::uint64_t seed = 1;
  int width = 513, depth = 513;  // samples
  float cell = 30;               // metres between samples
  int faults = 400;              // 0 to 1,000,000
  float step = 20;               // metres by which a fault moves each side
};

// Sample (i, j) rises when a·i + b·j > c and sinks otherwise.
struct FaultLine {
  std::int64_t a, b, c;
  bool rises(int i, int j) const { return a * i + b * j > c; }
};

// The lines, each a function of (seed, its number, width, depth) alone: directions are uniform, and so are
// the places at which a line of one direction cuts the field. With fewer faults the terrain is the earlier
// stage. Both throw usage_error, and environment_error when the field does not fit the memory.
std::vector<FaultLine> fault_lines(const FaultOptions&);
Heightfield fault_terrain(const FaultOptions&);

// Fault formation on a sphere, as §2.3.2 mentions: planes through the ball move the caps on their two sides.
// Heights are above the sphere, on a grid of equal angles: rows from the north pole to the south pole,
// columns from 180° west to 180° east, the first and the last being one meridian. Cells are as wide as at the
// equator. O(faults · depth + width · depth).
struct PlanetFaultOptions {
  std::uint64_t seed = 1;
  int width = 1025, depth = 513;  // samples, both borders included
  float radius = 100'000;         // metres, of the sphere
  int faults = 1000;              // 0 to 1,000,000
  float step = 50;                // metres
};

// A point p of the unit sphere rises when x·px + y·py + z·pz > offset; y points to the north pole.
struct FaultPlane {
  double x, y, z, offset;
};

std::vector<FaultPlane> fault_planes(const PlanetFaultOptions&);
Heightfield planet_faults(const PlanetFaultOptions&);

}  // namespace terrabench::fractal
