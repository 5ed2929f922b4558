#include "representations/procedural_mesh/subdivision/placement.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <optional>

#include "representations/procedural_mesh/subdivision/hashed_random.h"
#include "terrain/error.h"
#include "terrain/sources/noise/program.h"

namespace terrabench::subdivision {
namespace {

constexpr std::uint32_t kBatch = 1024;

bool uses_texture(Signal::Kind kind) {
  return kind == Signal::Kind::kTextureNoise || kind == Signal::Kind::kTextureWave;
}
bool uses_noise(Signal::Kind kind) {
  return kind == Signal::Kind::kNoise || kind == Signal::Kind::kTextureNoise;
}

std::optional<noise::Program> noise_of(const Signal& signal) {
  if (!uses_noise(signal.kind)) return std::nullopt;
  noise::Graph graph;
  const noise::Node node = graph.fbm({signal.seed, 1.0F, signal.octaves, 2.0F, signal.gain});
  return noise::Program(graph, node);
}

// A displacement made ready: its noise compiled.
struct Term {
  const Displacement& displacement;
  std::optional<noise::Program> noise;
};

void noise_values(const Term& term, const VertexBatch& batch, std::span<float> out) {
  const Signal& signal = term.displacement.amount;
  float x[kBatch], y[kBatch], z[kBatch];
  for (std::size_t i = 0; i < out.size(); ++i) {
    const glm::vec3 at = signal.kind == Signal::Kind::kNoise
                             ? batch.positions[i] * signal.frequency
                             : glm::vec3(batch.texture[i], 0) * glm::vec3(glm::vec2(signal.frequency), 0);
    x[i] = at.x;
    y[i] = at.y;
    z[i] = at.z;
  }
  const std::size_t n = out.size();
  term.noise->points({x, n}, {y, n}, {z, n}, out);
}

void signal_values(const Term& term, const VertexBatch& batch, std::span<float> out) {
  const Signal& signal = term.displacement.amount;
  const auto hash = [&](std::size_t i) {
    return vertex_hash(signal.seed, batch.level, batch.first + static_cast<std::uint32_t>(i));
  };
  switch (signal.kind) {
    case Signal::Kind::kConstant:
      std::fill(out.begin(), out.end(), 1.0F);
      break;
    case Signal::Kind::kUniform:
      for (std::size_t i = 0; i < out.size(); ++i) out[i] = uniform_of(hash(i));
      break;
    case Signal::Kind::kNormal:
      for (std::size_t i = 0; i < out.size(); ++i) out[i] = normal_of(hash(i));
      break;
    case Signal::Kind::kNoise:
    case Signal::Kind::kTextureNoise:
      noise_values(term, batch, out);
      break;
    case Signal::Kind::kTextureWave:
      for (std::size_t i = 0; i < out.size(); ++i) {
        const double phase = glm::dot(glm::dvec2(glm::vec2(signal.frequency)), glm::dvec2(batch.texture[i]));
        out[i] = static_cast<float>(std::cos(2 * std::numbers::pi * phase));
      }
      break;
    case Signal::Kind::kFunction:
      signal.function(batch, out);
      break;
  }
  for (float& value : out) value = signal.offset + signal.amplitude * value;
}

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
void sum_terms(std::span<const Term> terms, const LocalSurface& surface, const VertexBatch& batch,
               std::uint32_t old_vertices, std::span<glm::vec3> sums) {
  float amounts[kBatch];
  for (const Term& term : terms) {
    const Displacement& d = term.displacement;
    signal_values(term, batch, {amounts, sums.size()});
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

bool needs_tangents(const PlacementRule& rule) {
  for (const Displacement& d : rule.displacements) {
    if (d.axis == Axis::kTangent || d.axis == Axis::kBitangent) return true;
  }
  return false;
}

}  // namespace

void check_rule(const PlacementRule& rule, bool has_texture) {
  if (!(rule.bound >= 0))
    throw usage_error(fmt::format("bound {}", rule.bound), "placement rule", "use 0 or more");
  for (std::size_t i = 0; i < rule.displacements.size(); ++i) {
    const Displacement& d = rule.displacements[i];
    const Signal& s = d.amount;
    const std::string where = fmt::format("displacement {}", i);
    for (const float x : {d.direction.x, d.direction.y, d.direction.z, s.amplitude, s.offset, s.frequency.x,
                          s.frequency.y, s.frequency.z, s.gain}) {
      if (!std::isfinite(x)) throw usage_error("a number is not finite", where, "check the rule's numbers");
    }
    if (uses_noise(s.kind) && (s.octaves < 1 || s.octaves > 24)) {
      throw usage_error(fmt::format("{} octaves of noise", s.octaves), where, "use 1 to 24");
    }
    if (uses_texture(s.kind) && !has_texture) {
      throw usage_error("the mesh has no texture coordinates", where, "give its vertices coordinates");
    }
    if (s.kind == Signal::Kind::kFunction && !s.function) {
      throw usage_error("a function signal without function", where, "set Signal::function");
    }
  }
}

void displace(const PlacementRule& rule, const Topology& t, std::uint32_t level, std::uint32_t old_vertices,
              std::span<const glm::vec2> texture, std::span<glm::vec3> positions) {
  if (!displaces(rule)) return;
  const LocalSurface surface = local_surface(t, positions, texture, rule.frame, needs_tangents(rule));
  std::vector<Term> terms;
  for (const Displacement& d : rule.displacements) terms.push_back({d, noise_of(d.amount)});
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
    sum_terms(terms, surface, batch, old_vertices, sums);
    bound_lengths(rule.bound, batch.scales, sums);
    for (std::uint32_t i = 0; i < count; ++i) {
      glm::vec3& p = positions[first + i];
      p += sums[i];
      if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
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
