#include "lod/meters/triangle_set.h"

#include <tbb/parallel_sort.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <glm/vec3.hpp>
#include <tuple>

namespace terrabench {
namespace {

bool before(const glm::vec3& a, const glm::vec3& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

// Begins at the least corner, so that it is the same wherever the triangle begins, but not when it is turned.
// + 0 makes -0 the same as 0.
std::uint64_t hash(const glm::vec3* corners) {
  const int first = before(corners[0], corners[1]) ? (before(corners[0], corners[2]) ? 0 : 2)
                                                   : (before(corners[1], corners[2]) ? 1 : 2);
  std::array<float, 9> words;
  for (int k = 0; k < 3; ++k) {
    const glm::vec3& corner = corners[(first + k) % 3];
    for (int axis = 0; axis < 3; ++axis) words[static_cast<std::size_t>(3 * k + axis)] = corner[axis] + 0.0F;
  }
  return XXH3_64bits(words.data(), sizeof(words));
}

}  // namespace

TriangleSet::TriangleSet(const Frame& frame) {
  hashes_.reserve(frame.stats.triangles);
  triangles(frame, [&](std::span<const glm::vec3> corners) {
    for (std::size_t k = 0; k < corners.size(); k += 3) {
      const glm::vec3* const t = &corners[k];
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) hashes_.push_back(hash(t));
    }
  });
  tbb::parallel_sort(hashes_.begin(), hashes_.end());
}

std::size_t TriangleSet::missing_in(const TriangleSet& other) const {
  std::size_t missing = 0;
  auto theirs = other.hashes_.begin();
  for (const std::uint64_t mine : hashes_) {
    while (theirs != other.hashes_.end() && *theirs < mine) ++theirs;
    if (theirs != other.hashes_.end() && *theirs == mine) {
      ++theirs;
    } else {
      ++missing;
    }
  }
  return missing;
}

}  // namespace terrabench
