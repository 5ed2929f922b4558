// Turns a noise graph into Code, for columns or for arbitrary points.
#pragma once

#include "terrain/sources/noise/code.h"
#include "terrain/sources/noise/graph.h"

namespace terrabench::noise {

enum class Mode { kColumn, kPoints };

Code compile(const Graph& graph, Node root, Mode mode);

}  // namespace terrabench::noise
