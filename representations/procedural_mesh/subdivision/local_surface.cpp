#include <cassert>
#include <glm/glm.hpp>

#include "representations/procedural_mesh/subdivision/corner_walk.h"
#include "representations/procedural_mesh/subdivision/placement.h"

namespace terrabench::subdivision {
namespace {

struct FaceSurface {
  glm::vec3 normal;
  float diagonal;
};

glm::vec3 unit_or(glm::vec3 v, glm::vec3 otherwise) {
  const float length = glm::length(v);
  return length > 0 && std::isfinite(length) ? v / length : otherwise;
}

// Twice the area times the normal (Newell): for a quadrilateral the cross product of its diagonals.
template <class Point>
glm::vec3 area_normal(std::uint32_t n, const Point& point) {
  if (n == 4) return glm::cross(point(2) - point(0), point(3) - point(1));
  glm::vec3 sum(0);
  for (std::uint32_t i = 1; i + 1 < n; ++i) sum += glm::cross(point(i) - point(0), point(i + 1) - point(0));
  return sum;
}

template <class Point>
float diagonal_length(std::uint32_t n, const Point& point) {
  const std::uint32_t step = n / 2, pairs = n % 2 == 0 ? step : n;
  float sum = 0;
  for (std::uint32_t i = 0; i < pairs; ++i) sum += glm::distance(point(i), point((i + step) % n));
  return sum / static_cast<float>(pairs);
}

// The derivative of the position by u, from the corners' differences to the first; zero where u and v do not
// span the face.
template <class Point, class Texture>
glm::vec3 along_u(std::uint32_t n, const Point& point, const Texture& texture) {
  const std::uint32_t m = n == 3 ? 0 : 1;  // a triangle's second difference starts at its first corner
  const glm::vec3 d = point(2) - point(0), e = n == 3 ? point(1) - point(0) : point(3) - point(m);
  const glm::vec2 s = texture(2) - texture(0), t = n == 3 ? texture(1) - texture(0) : texture(3) - texture(m);
  const float determinant = s.x * t.y - s.y * t.x;
  return determinant == 0 ? glm::vec3(0) : (d * t.y - e * s.y) / determinant;
}

// Projects `wish` onto the plane of the normal; when it is zero or (nearly) along the normal, x or z instead.
glm::vec3 tangent_of(glm::vec3 normal, glm::vec3 wish) {
  const auto project = [&](glm::vec3 v) { return v - normal * glm::dot(v, normal); };
  const float length = glm::length(wish);
  if (length > 0 && std::isfinite(length)) {
    const glm::vec3 flat = project(wish / length);
    if (glm::dot(flat, flat) > 1e-8F) return glm::normalize(flat);
  }
  return glm::normalize(project(std::abs(normal.x) < 0.7F ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1)));
}

}  // namespace

LocalSurface local_surface(const Topology& t, std::span<const glm::vec3> positions,
                           std::span<const glm::vec2> texture, bool with_tangents) {
  assert(t.uses.size() == t.corners.size() && positions.size() == t.vertices);
  const bool by_texture = with_tangents && !texture.empty();
  Array<FaceSurface> faces(t.faces());
  Array<glm::vec3> along(by_texture ? t.faces() : 0);
  LocalSurface out;
  out.normals.resize(t.vertices);
  out.scales.resize(t.vertices);
  if (with_tangents) out.tangents.resize(t.vertices);
  with_corners(t, [&](const auto& walk) {
    for_all(t.faces(), [&](std::uint32_t f) {
      const std::uint32_t first = walk.first(f), n = walk.first(f + 1) - first;
      const auto point = [&](std::uint32_t i) { return positions[t.corners[first + i]]; };
      faces[f] = {unit_or(area_normal(n, point), glm::vec3(0)), diagonal_length(n, point)};
      if (by_texture) {
        along[f] = along_u(n, point, [&](std::uint32_t i) { return texture[t.corners[first + i]]; });
      }
    });
    for_all(t.vertices, [&](std::uint32_t v) {
      glm::vec3 normal(0), wish(0);
      float diagonals = 0;
      const auto uses = t.uses_of(v);
      for (const std::uint32_t c : uses) {
        const FaceSurface& face = faces[walk.face(c)];
        normal += face.normal;
        diagonals += face.diagonal;
        if (by_texture) wish += along[walk.face(c)];
      }
      out.normals[v] = unit_or(normal, glm::vec3(0, 1, 0));
      out.scales[v] = uses.empty() ? 0 : diagonals / static_cast<float>(uses.size());
      if (with_tangents) out.tangents[v] = tangent_of(out.normals[v], wish);
    });
  });
  return out;
}

}  // namespace terrabench::subdivision
