#include "experiments/meshgrow/subdivision_reference.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <utility>

#include "representations/procedural_mesh/base_mesh.h"

namespace terrabench::meshgrow {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;
Pair ordered(std::uint32_t a, std::uint32_t b) { return a < b ? Pair(a, b) : Pair(b, a); }

glm::dvec3 mean(const std::vector<glm::dvec3>& points) {
  glm::dvec3 sum(0);
  for (const glm::dvec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

FaceMesh face_mesh(const std::vector<glm::vec3>& points,
                   const std::vector<std::vector<std::uint32_t>>& faces) {
  FaceMesh mesh;
  mesh.positions = points;
  for (const auto& face : faces) mesh.add_face(face);
  return mesh;
}

glm::vec3 on_circle(double turn, double radius, double height) {
  const double angle = 2 * std::numbers::pi * turn;
  return {radius * std::cos(angle), height, -radius * std::sin(angle)};  // counter-clockwise from above
}

// Without the vertices that only the top has.
FaceMesh without_top(const growing::Primitive& box) {
  FaceMesh mesh;
  std::map<std::uint32_t, std::uint32_t> kept;
  for (std::size_t f = 0; f < box.mesh.faces(); ++f) {
    if (box.parts[f] == growing::Part::kTop) continue;
    std::vector<std::uint32_t> face;
    for (const std::uint32_t v : box.mesh.face(f)) {
      const auto [at, added] = kept.try_emplace(v, static_cast<std::uint32_t>(mesh.positions.size()));
      if (added) mesh.positions.push_back(box.mesh.positions[v]);
      face.push_back(at->second);
    }
    mesh.add_face(face);
  }
  return mesh;
}

FaceMesh fan() {
  std::vector<glm::vec3> points{{0, 0.5, 0}};
  std::vector<std::vector<std::uint32_t>> faces;
  for (std::uint32_t k = 0; k < 6; ++k) {
    points.push_back(on_circle(k / 6.0, 1, 0.3 * (k % 2)));
    points.push_back(on_circle((k + 0.5) / 6, 1.8, -0.1 * k));
    faces.push_back({0, 1 + 2 * k, 2 + 2 * k, 1 + 2 * ((k + 1) % 6)});
  }
  return face_mesh(points, faces);
}

FaceMesh patch() {
  std::vector<glm::vec3> points{{0, 0.35, 0}};
  for (std::uint32_t k = 0; k < 5; ++k) points.push_back(on_circle(0.2 * k + 0.25, 1, 0.1 * (k % 3)));
  const double outer[] = {0.35, 0.75, 0.90, 0.99, 0.15};  // turns
  for (const double turn : outer) points.push_back(on_circle(turn, 1.75, 0.2 * std::sin(9 * turn)));
  return face_mesh(points, {{0, 1, 6, 2}, {0, 2, 3}, {0, 3, 7, 4}, {0, 4, 8, 9, 5}, {0, 5, 10, 1}});
}

// The edges of a face, with these sharpnesses, cyclically; 0 gives none.
void crease_face(FaceMesh& mesh, std::size_t face, std::initializer_list<int> sharpness) {
  const auto corners = mesh.face(face);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const int s = sharpness.begin()[i % sharpness.size()];
    if (s > 0) mesh.creases.push_back({corners[i], corners[(i + 1) % corners.size()], s});
  }
}

FaceMesh creased(std::string_view name) {
  FaceMesh mesh = shape(name == "creased-cube"  ? "cube"
                        : name == "darts"       ? "sphere"
                        : name == "creased-box" ? "box"
                                                : "patch");
  if (name == "creased-cube") {
    crease_face(mesh, 0, {1, 2, 3, 10});
  } else if (name == "darts") {
    crease_face(mesh, 0, {2, 0, 0, 0});
    crease_face(mesh, mesh.faces() / 2, {10, 3, 0, 0});
    mesh.sharp_vertices = {{mesh.corners[mesh.first_corner[mesh.faces() - 1]], 2}};
  } else if (name == "creased-box") {
    crease_face(mesh, 0, {2, 10, 1, 0});
    crease_face(mesh, mesh.faces() - 1, {0, 3, 0, 10});
    mesh.sharp_vertices = {{mesh.corners[0], 1}};
  } else {
    mesh.creases = {{0, 2, 2}, {0, 3, 10}, {0, 5, 1}, {4, 0, 3}};
    mesh.sharp_vertices = {{1, 3}};
  }
  return mesh;
}

}  // namespace

PlainMesh plain(const FaceMesh& mesh) {
  PlainMesh result;
  for (const glm::vec3& p : mesh.positions) result.points.emplace_back(p);
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    result.faces.emplace_back(mesh.face(f).begin(), mesh.face(f).end());
  }
  return result;
}

PlainMesh catmull_clark(const PlainMesh& mesh) {
  std::vector<glm::dvec3> face_points;
  std::map<Pair, std::vector<std::size_t>> faces_at_edge;
  std::vector<std::vector<std::size_t>> faces_at_vertex(mesh.points.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& face = mesh.faces[f];
    std::vector<glm::dvec3> corners;
    for (std::size_t k = 0; k < face.size(); ++k) {
      corners.push_back(mesh.points[face[k]]);
      faces_at_edge[ordered(face[k], face[(k + 1) % face.size()])].push_back(f);
      faces_at_vertex[face[k]].push_back(f);
    }
    face_points.push_back(mean(corners));
  }
  std::vector<std::vector<glm::dvec3>> middles(mesh.points.size()), boundary_ends(mesh.points.size());
  std::map<Pair, std::uint32_t> edge_vertex;
  std::vector<glm::dvec3> edge_points;
  const auto first_edge = static_cast<std::uint32_t>(mesh.points.size() + mesh.faces.size());
  for (const auto& [edge, faces] : faces_at_edge) {
    const glm::dvec3 a = mesh.points[edge.first], b = mesh.points[edge.second];
    for (const std::uint32_t v : {edge.first, edge.second}) middles[v].push_back(0.5 * (a + b));
    if (faces.size() == 1) {
      boundary_ends[edge.first].push_back(b);
      boundary_ends[edge.second].push_back(a);
    }
    edge_vertex[edge] = first_edge + static_cast<std::uint32_t>(edge_points.size());
    edge_points.push_back(faces.size() == 1 ? 0.5 * (a + b)
                                            : mean({a, b, face_points[faces[0]], face_points[faces[1]]}));
  }
  PlainMesh finer;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const glm::dvec3 s = mesh.points[v];
    if (!boundary_ends[v].empty()) {
      finer.points.push_back(0.75 * s + 0.25 * mean(boundary_ends[v]));
      continue;
    }
    std::vector<glm::dvec3> around;
    for (const std::size_t f : faces_at_vertex[v]) around.push_back(face_points[f]);
    const auto n = static_cast<double>(around.size());
    finer.points.push_back((mean(around) + 2.0 * mean(middles[v]) + (n - 3) * s) / n);
  }
  finer.points.insert(finer.points.end(), face_points.begin(), face_points.end());
  finer.points.insert(finer.points.end(), edge_points.begin(), edge_points.end());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& face = mesh.faces[f];
    const auto face_vertex = static_cast<std::uint32_t>(mesh.points.size() + f);
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::uint32_t v = face[k], next = face[(k + 1) % face.size()],
                          before = face[(k + face.size() - 1) % face.size()];
      finer.faces.push_back({v, edge_vertex[ordered(v, next)], face_vertex, edge_vertex[ordered(before, v)]});
    }
  }
  return finer;
}

FaceMesh shape(std::string_view name) {
  if (name == "cube") return growing::cube({2, 2, 2}, {1, 1, 1}).mesh;
  if (name == "tetrahedron") {
    return face_mesh({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
                     {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}});
  }
  if (name == "prism") return growing::prism(5, 1.2, 0.7, 2, 2).mesh;
  if (name == "sphere") return growing::sphere(1, 2).mesh;
  if (name == "box") return without_top(growing::cube({2, 1, 3}, {2, 1, 2}));
  if (name == "fan") return fan();
  return name == "patch" ? patch() : creased(name);
}

bool has_creases(const FaceMesh& mesh) { return !mesh.creases.empty() || !mesh.sharp_vertices.empty(); }

Comparison compare(std::span<const std::uint32_t> quads, std::span<const glm::dvec3> points,
                   const PlainMesh& reference) {
  Comparison result;
  if (quads.size() != 4 * reference.faces.size() || points.size() != reference.points.size()) {
    result.mismatches = 1;
    return result;
  }
  glm::dvec3 low(reference.points[0]), high(low);
  for (const glm::dvec3& p : reference.points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const double diagonal = glm::length(high - low);
  std::map<std::uint32_t, std::uint32_t> partner, back;
  for (std::size_t c = 0; c < quads.size(); ++c) {
    const std::uint32_t ours = quads[c], theirs = reference.faces[c / 4][c % 4];
    const bool same = partner.try_emplace(ours, theirs).first->second == theirs &&
                      back.try_emplace(theirs, ours).first->second == ours;
    result.mismatches += same ? 0 : 1;
    result.largest =
        std::max(result.largest, glm::length(points[ours] - reference.points[theirs]) / diagonal);
  }
  result.mismatches += points.size() - partner.size();
  return result;
}

namespace {

// One step of a vertex with n faces and its ring: values[0] is the vertex, then the ends of its edges, then
// the far corners of its faces, face k between edges k and k + 1.
std::vector<double> step_of_ring(const std::vector<double>& values) {
  const std::size_t n = (values.size() - 1) / 2;
  const double v = values[0];
  std::vector<double> next(values.size());
  const auto edge = [&](std::size_t k) { return values[1 + k % n]; };
  const auto face_point = [&](std::size_t k) {
    return (v + edge(k) + edge(k + 1) + values[1 + n + k % n]) / 4;
  };
  double edges = 0, faces = 0;
  for (std::size_t k = 0; k < n; ++k) {
    edges += (v + edge(k)) / 2;
    faces += face_point(k);
    next[1 + k] = (v + edge(k) + face_point(k + n - 1) + face_point(k)) / 4;
    next[1 + n + k] = face_point(k);
  }
  const auto count = static_cast<double>(n);
  next[0] = (faces / count + 2 * edges / count + (count - 3) * v) / count;
  return next;
}

// Takes the constant vector out, whose eigenvalue is 1. Rounding brings it back at each step.
void remove_constant(std::vector<double>& values) {
  for (std::size_t k = values.size(); k-- > 0;) values[k] -= values[0];
}

}  // namespace

double ring_eigenvalue(std::size_t n, int turns) {
  std::vector<double> x(1 + 2 * n);
  x[0] = turns == 0 ? 1 : 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * turns / static_cast<double>(n);
    x[1 + k] = turns == 0 ? 0.3 : std::cos(angle * static_cast<double>(k));
    x[1 + n + k] = turns == 0 ? -0.2 : 1.5 * std::cos(angle * (static_cast<double>(k) + 0.5));
  }
  remove_constant(x);
  double factor = 0;
  for (int i = 0; i < 100; ++i) {
    std::vector<double> y = step_of_ring(x);
    remove_constant(y);
    factor = y[1] / x[1];
    const double scale = y[1];
    for (double& value : y) value /= scale;
    x = std::move(y);
  }
  return factor;
}

}  // namespace terrabench::meshgrow
