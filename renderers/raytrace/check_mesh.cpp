#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>

#include "renderers/raytrace/ray_index.h"
#include "terrain/error.h"

namespace terrabench {
namespace {

// The first i < n for which `bad` holds, or n.
template <class Bad>
std::size_t first_bad(std::size_t n, const Bad& bad) {
  constexpr std::size_t kGrain = 1U << 16;
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, n, kGrain), n,
      [&](const tbb::blocked_range<std::size_t>& range, std::size_t found) {
        for (std::size_t i = range.begin(); i < std::min(range.end(), found); ++i) {
          if (bad(i)) return i;
        }
        return found;
      },
      [](std::size_t a, std::size_t b) { return std::min(a, b); });
}

}  // namespace

void check_mesh(const TriangleMesh& mesh, std::string_view where) {
  const std::size_t n = mesh.positions.size();
  if (!mesh.normals.empty() && mesh.normals.size() != n) {
    throw bad_input(fmt::format("{} normals for {} positions", mesh.normals.size(), n), where,
                    "give one normal per position, or none");
  }
  if (mesh.indices.size() % 3 != 0) {
    throw bad_input(fmt::format("{} indices are not a multiple of 3", mesh.indices.size()), where,
                    "give three indices per triangle");
  }
  if (mesh.triangles() >= RayHit::kNone) {
    throw bad_input(fmt::format("{} triangles are too many for one mesh", mesh.triangles()), where,
                    "split it into meshes of fewer than 2^32 triangles");
  }
  const std::size_t position = first_bad(n, [&](std::size_t i) { return !is_finite(mesh.positions[i]); });
  if (position < n) {
    const glm::vec3 p = mesh.positions[position];
    throw bad_input(fmt::format("position {} ({}, {}, {}) is not finite", position, p.x, p.y, p.z), where,
                    "remove the triangles that use it, or correct what computed it");
  }
  const std::size_t normals = mesh.normals.size();
  const std::size_t normal = first_bad(normals, [&](std::size_t i) { return !is_finite(mesh.normals[i]); });
  if (normal < normals) {
    throw bad_input(fmt::format("normal {} is not finite", normal), where,
                    "recompute the normals with compute_normals()");
  }
  const std::size_t indices = mesh.indices.size();
  const std::size_t index = first_bad(indices, [&](std::size_t i) { return mesh.indices[i] >= n; });
  if (index < indices) {
    throw bad_input(fmt::format("triangle {} names position {} of {}", index / 3, mesh.indices[index], n),
                    where, "correct its indices");
  }
}

}  // namespace terrabench
