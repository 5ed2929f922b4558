// Turns a noise graph into Code, for columns or for arbitrary points.
#pragma once

#include "terrain/sources/noise/code.h"
#include "terrain/sources/noise/graph.h"

namespace terrabench::noise {

enum class Mode {
  kColumn,
  kPoints,
  kEverySample  // points, without jumps: every instruction runs for every sample
};

Code compile(const Graph& graph, Node root, Mode mode);

}  // namespace terrabench::noise
