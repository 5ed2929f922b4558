#include "representations/procedural_mesh/subdivision/placement.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/glm.hpp>

#include "terrain/error.h"
#include "terrain/splitmix.h"

namespace terrabench::subdivision {
namespace {

constexpr std::uint32_t kBatch = 1024;

glm::vec3 axis_of(const Displacement& d, const LocalSurface& surface, std::uint32_t v) {
  switch (d.axis) {
    case Axis::kNormal:
      return surface.normals[v];
    case Axis::kTangent:
      return surface.tangents[v];
    case Axis::kBitangent:
      return glm::cross(surface.normals[v], surface.tangents[v]);
    case Axis::kFixed:
      break;
  }
  return d.direction;
}

// The sum of all displacements of the batch's vertices.
void add_displacements(std::span<const Displacement> displacements, const LocalSurface& surface,
                       const VertexBatch& batch, std::uint32_t old_vertices, std::span<glm::vec3> sums) {
  float amounts[kBatch];
  for (const Displacement& d : displacements) {
    d.amount(batch, {amounts, sums.size()});
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const std::uint32_t v = batch.first + static_cast<std::uint32_t>(i);
      if (d.where == Where::kNewVertices && v < old_vertices) continue;
      sums[i] += axis_of(d, surface, v) * (d.by_scale ? amounts[i] * batch.scales[i] : amounts[i]);
    }
  }
}

void bound_lengths(float bound, std::span<const float> scales, std::span<glm::vec3> sums) {
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const float length = glm::length(sums[i]), most = bound * scales[i];
    if (length > most) sums[i] *= most / length;
  }
}

}  // namespace

Signal uniform_signal(float amplitude, std::uint64_t seed) {
  return [amplitude, key = scramble(seed)](const VertexBatch& batch, std::span<float> out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
      const std::uint64_t hash =
          mixed(key + kGolden * ((std::uint64_t{batch.level} << 32 | (batch.first + i)) + 1));
      // Of the upper 24 bits, in [-1, 1).
      out[i] = amplitude * (static_cast<float>(static_cast<std::int32_t>(hash >> 40) - (1 << 23)) * 0x1p-23F);
    }
  };
}

PlacementRule fractal_rule(float amplitude, std::uint64_t seed) {
  return {.displacements = {{.amount = uniform_signal(amplitude, seed)}}};
}

void displace(const PlacementRule& rule, const Topology& t, std::uint32_t level, std::uint32_t old_vertices,
              std::span<const glm::vec2> texture, std::span<glm::vec3> positions) {
  if (!displaces(rule)) return;
  const bool tangents = std::ranges::any_of(rule.displacements, [](const Displacement& d) {
    return d.axis == Axis::kTangent || d.axis == Axis::kBitangent;
  });
  const LocalSurface surface = local_surface(t, positions, texture, tangents);
  std::atomic<std::uint32_t> bad{kNone};
  const std::uint32_t batches = (t.vertices + kBatch - 1) / kBatch;
  tbb::parallel_for(0U, batches, [&](std::uint32_t b) {
    const std::uint32_t first = b * kBatch, count = std::min(kBatch, t.vertices - first);
    const VertexBatch batch{level,
                            first,
                            positions.subspan(first, count),
                            texture.empty() ? texture : texture.subspan(first, count),
                            {surface.normals.data() + first, count},
                            {surface.scales.data() + first, count}};
    glm::vec3 storage[kBatch]{};
    const std::span<glm::vec3> sums(storage, count);
    add_displacements(rule.displacements, surface, batch, old_vertices, sums);
    bound_lengths(rule.bound, batch.scales, sums);
    for (std::uint32_t i = 0; i < count; ++i) {
      glm::vec3& p = positions[first + i];
      p += sums[i];
      if (is_finite(p)) continue;
      std::uint32_t least = bad;  // the first bad vertex, whichever thread finds it
      while (first + i < least && !bad.compare_exchange_weak(least, first + i)) {
      }
    }
  });
  if (bad != kNone) {
    throw bad_input(fmt::format("vertex {} of level {} moves to infinity", bad.load(), level),
                    "placement rule", "make the displacements smaller or set a bound");
  }
}

}  // namespace terrabench::subdivision
