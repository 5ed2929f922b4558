// How fast Catmull–Clark subdivision contracts the ring of a vertex: eigenvalues of its subdivision matrix.
#pragma once

#include <cstddef>

namespace terrabench::meshgrow {

// Of a vertex with n ≥ 3 faces: the largest eigenvalue below 1 among vectors that are constant around the
// vertex (turns = 0), or that turn once around it (turns = 1), by the power method. O(n).
double ring_eigenvalue(std::size_t n, int turns);

}  // namespace terrabench::meshgrow
