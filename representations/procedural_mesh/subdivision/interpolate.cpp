#include "representations/procedural_mesh/subdivision/interpolate.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cassert>
#include <glm/glm.hpp>

namespace terrabench::subdivision {
namespace {

constexpr std::size_t kGrain = 8192;  // vertices per task

template <class T>
struct ScalarOf {
  using type = T;
};
template <int n, class S>
struct ScalarOf<glm::vec<n, S>> {
  using type = S;
};
template <class T>
using Scalar = typename ScalarOf<T>::type;

template <class Work>
void for_ranges(std::size_t count, const Work& work) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kGrain),
                    [&](const auto& range) { work(range.begin(), range.end()); });
}

template <class T>
void place_faces(const Topology& t, const T* in, T* out) {
  const std::uint32_t* corners = t.corners.data();
  if (t.first_corner.empty()) {
    for_ranges(t.faces(), [&](std::size_t begin, std::size_t end) {
      const std::uint32_t* c = corners + begin * 4;
      for (std::size_t f = begin; f < end; ++f, c += 4) {
        out[f] = ((in[c[0]] + in[c[1]]) + (in[c[2]] + in[c[3]])) * Scalar<T>(0.25);
      }
    });
    return;
  }
  for_ranges(t.faces(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      T sum(0);
      for (std::uint32_t c = t.first_corner[f]; c < t.first_corner[f + 1]; ++c) sum += in[corners[c]];
      out[f] = sum * (1 / static_cast<Scalar<T>>(t.first_corner[f + 1] - t.first_corner[f]));
    }
  });
}

// A ring entry below `vertices` is a vertex of the coarser mesh, one above it a face point.
template <class T>
void place_edges(const Stencils& s, std::uint32_t vertices, const T* in, const T* points, T* out) {
  const std::uint32_t* parents = s.edges.data();
  for_ranges(s.edges.size() / 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const std::uint32_t* p = parents + e * 4;
      const T* from = p[2] < vertices ? in : points;  // a sharp edge has its ends twice
      out[e] = ((in[p[0]] + in[p[1]]) + (from[p[2]] + from[p[3]])) * Scalar<T>(0.25);
    }
  });
}

template <class T>
void place_vertices(const Stencils& s, std::uint32_t vertices, const T* in, const T* points, T* out) {
  struct Weights {
    Scalar<T> own, ring;
  };
  std::vector<Weights> weights(s.longest_ring + 1);
  for (std::uint32_t count = 0; count <= s.longest_ring; ++count) {
    const RingWeights w = ring_weights(count);
    weights[count] = {static_cast<Scalar<T>>(w.own), static_cast<Scalar<T>>(w.ring)};
  }
  const std::uint32_t* rings = s.rings.data();
  for_ranges(vertices, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const std::uint32_t* p = rings + s.first_ring[v];
      const std::uint32_t count = s.first_ring[v + 1] - s.first_ring[v];
      const Weights w = weights[count];
      T sum(0);
      if (count == 8) {
        sum = ((in[p[0]] + in[p[2]]) + (in[p[4]] + in[p[6]])) +
              ((points[p[1]] + points[p[3]]) + (points[p[5]] + points[p[7]]));
      } else if (count == 2) {
        sum = in[p[0]] + in[p[1]];
      } else {
        for (std::uint32_t i = 0; i < count; i += 2) sum += in[p[i]] + points[p[i + 1]];
      }
      out[v] = in[v] * w.own + sum * w.ring;
    }
  });
}

}  // namespace

template <class T>
void place_standard(const Topology& t, const Stencils& s, std::span<const T> in, std::span<T> out) {
  assert(in.size() == t.vertices && out.size() == t.vertices + t.faces() + s.edges.size() / 4);
  place_faces(t, in.data(), out.data() + t.vertices);
  place_edges(s, t.vertices, in.data(), out.data(), out.data() + t.vertices + t.faces());
  place_vertices(s, t.vertices, in.data(), out.data(), out.data());
}

template <class T>
void place_linear(const Topology& t, const Stencils& s, std::span<const T> in, std::span<T> out) {
  assert(in.size() == t.vertices && out.size() == t.vertices + t.faces() + s.edges.size() / 4);
  place_faces(t, in.data(), out.data() + t.vertices);
  std::copy(in.begin(), in.end(), out.begin());
  T* edges = out.data() + t.vertices + t.faces();
  for_ranges(s.edges.size() / 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      edges[e] = (in[s.edges[e * 4]] + in[s.edges[e * 4 + 1]]) * Scalar<T>(0.5);
    }
  });
}

#define TERRABENCH_INSTANTIATE(T)                                                                      \
  template void place_standard<T>(const Topology&, const Stencils&, std::span<const T>, std::span<T>); \
  template void place_linear<T>(const Topology&, const Stencils&, std::span<const T>, std::span<T>)
TERRABENCH_INSTANTIATE(float);
TERRABENCH_INSTANTIATE(double);
TERRABENCH_INSTANTIATE(glm::vec2);
TERRABENCH_INSTANTIATE(glm::vec3);
TERRABENCH_INSTANTIATE(glm::dvec2);
TERRABENCH_INSTANTIATE(glm::dvec3);
#undef TERRABENCH_INSTANTIATE

}  // namespace terrabench::subdivision
