// Turns a noise graph into Code, for columns or for arbitrary points.
#pragma once

#include <vector>

#include "terrain/sources/noise/code.h"
#include "terrain/sources/noise/graph.h"

namespace terrabench::noise {

enum class Mode { kColumn, kPoints };

// What the octaves of a fractal are: seeds, offsets and weights drawn from its parameters.
std::vector<Octave> compile_octaves(const Fractal& fractal);

Code compile(const Graph& graph, Node root, Mode mode);

}  // namespace terrabench::noise
