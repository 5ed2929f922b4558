#include "experiments/meshgrow/figure_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "experiments/figures/measures.h"
#include "experiments/meshgrow/growing_pictures.h"
#include "experiments/meshgrow/subdivision_reference.h"

namespace terrabench::meshgrow {

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::degrees(figures::angle_between(a, b));
}

void record_step(figures::Drawing& drawing, const FaceMesh& coarse, std::size_t edges, const FaceMesh& linear,
                 const FaceMesh& fine) {
  const auto record = [&](std::string_view metric, std::size_t count) {
    drawing.record(metric, static_cast<double>(count));
  };
  const std::size_t vertices = coarse.positions.size(), faces = coarse.faces();
  std::size_t moved = 0, moved_face_points = 0;
  for (std::size_t v = 0; v < fine.positions.size(); ++v) {
    if (fine.positions[v] == linear.positions[v]) continue;
    ++moved;
    if (v >= vertices && v < vertices + faces) ++moved_face_points;
  }
  record("fine_vertices", fine.positions.size());
  record("vertices_faces_and_edges", vertices + faces + edges);
  record("fine_faces", fine.faces());
  record("corners", coarse.corners.size());
  record("moved_vertices", moved);
  record("moved_face_points", moved_face_points);
  const std::vector<glm::dvec3> points(fine.positions.begin(), fine.positions.end());
  const Comparison difference = compare(fine.corners, points, catmull_clark(plain(coarse)));
  record("without_partner", difference.mismatches);
  drawing.record("from_reference", difference.largest);
}

double last_displacement(const FaceMesh& base, std::vector<subdivision::PlacementRule> rules,
                         const subdivision::RefinementOptions& options, const FaceMesh& displaced) {
  if (rules.empty()) return 0;
  rules.back().displacements.clear();
  const FaceMesh placed = subdivision::subdivide(base, rules, options);
  RootMeanSquare lengths;
  for (std::size_t v = 0; v < placed.positions.size(); ++v) {
    lengths.add(static_cast<double>(glm::distance(placed.positions[v], displaced.positions[v])));
  }
  return lengths.value();
}

glm::dvec3 face_normal(const FaceMesh& mesh, std::uint32_t face) {
  return figures::face_normal(mesh.positions, mesh.face(face));
}

glm::dvec3 mean_normal(const FaceMesh& mesh, std::uint32_t vertex) {
  glm::dvec3 sum(0);
  for (std::uint32_t face = 0; face < mesh.faces(); ++face) {
    const auto corners = mesh.face(face);
    if (std::ranges::find(corners, vertex) != corners.end()) sum += face_normal(mesh, face);
  }
  return glm::normalize(sum);
}

namespace {

double stretch_of(const FaceMesh& mesh, std::span<const std::uint32_t> corners) {
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto length = static_cast<double>(
        glm::distance(mesh.positions[corners[k]], mesh.positions[corners[(k + 1) % corners.size()]]));
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  }
  return longest / shortest;
}

}  // namespace

Stretch stretch_within(const FaceMesh& mesh, float reach) {
  Stretch stretch;
  for (std::size_t face = 0; face < mesh.faces(); ++face) {
    glm::vec2 middle(0);
    for (const std::uint32_t v : mesh.face(face)) middle += 0.25F * mesh.texture[v];
    if (std::max(std::abs(middle.x - 0.5F), std::abs(middle.y - 0.5F)) > reach) continue;
    const double of_face = stretch_of(mesh, mesh.face(face));
    stretch.largest = std::max(stretch.largest, of_face);
    stretch.faces += of_face > 1.01 ? 1 : 0;
  }
  return stretch;
}

Bends bends_of(const FaceMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> first_face;
  Bends bends;
  double edges = 0;
  for (std::uint32_t face = 0; face < mesh.faces(); ++face) {
    const auto corners = mesh.face(face);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto edge = std::minmax(corners[k], corners[(k + 1) % corners.size()]);
      const auto [other, is_first] = first_face.try_emplace(edge, face);
      if (is_first) continue;
      const double bend = degrees_between(face_normal(mesh, face), face_normal(mesh, other->second));
      bends.mean += bend;
      bends.largest = std::max(bends.largest, bend);
      ++edges;
    }
  }
  bends.mean /= edges;
  return bends;
}

int parts_in_row(const Image& image, double height) {
  const int y = static_cast<int>(height * (image.height - 1));
  int parts = 0, width = 0;
  for (int x = 0; x < image.width; ++x) {
    width = image.pixel(x, y) == Rgb{255, 255, 255} ? 0 : width + 1;
    if (width == 4) ++parts;
  }
  return parts;
}

void record_frame(figures::Drawing& drawing, const growing::GrownMesh& before,
                  const growing::GrownMesh& after, std::uint32_t base) {
  constexpr double kMove = 0.9;
  const growing::Frame& frame = before.states.front().shape.frame;
  const glm::dvec3 normal = face_normal(before.mesh, base);
  const auto corners = before.mesh.face(base);
  double cube_off = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const glm::dvec3 made(after.mesh.positions[before.mesh.positions.size() + k]);
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t corner : corners) {
      nearest =
          std::min(nearest, glm::distance(made, glm::dvec3(before.mesh.positions[corner]) + kMove * normal));
    }
    cube_off = std::max(cube_off, nearest);
  }
  drawing.record("origin_off_centre", glm::distance(frame.origin, glm::dvec3(middle_of(before.mesh, base))));
  drawing.record("z_off_normal", degrees_between(frame.z, normal));
  drawing.record("slope", degrees_between(frame.z, {0, 1, 0}));
  drawing.record("cube_off", cube_off);
  drawing.record("largest_cosine",
                 std::max({std::abs(glm::dot(frame.x, frame.y)), std::abs(glm::dot(frame.y, frame.z)),
                           std::abs(glm::dot(frame.z, frame.x))}));
}

namespace {

double cycles_around(const FaceMesh& mesh, std::uint32_t face) {
  const auto corners = mesh.face(face);
  double way = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    way += std::abs(static_cast<double>(mesh.texture[corners[k]].x) -
                    static_cast<double>(mesh.texture[corners[(k + 1) % corners.size()]].x));
  }
  return way;
}

}  // namespace

void record_coordinates(figures::Drawing& drawing, const growing::Model& model, const Fork& fork) {
  const FaceMesh& mesh = fork.after.mesh;
  std::uint32_t foot = 0;
  std::vector<double> ends;
  for (std::uint32_t face = 0; face < mesh.faces(); ++face) {
    if (middle_of(mesh, face).y < middle_of(mesh, foot).y) foot = face;
    if (model.system.symbols[mesh.symbols[face]].name == "branch") ends.push_back(cycles_around(mesh, face));
  }
  drawing.record("trunk_cycles", cycles_around(mesh, foot));
  drawing.record("branches", static_cast<double>(ends.size()));
  for (std::size_t k = 0; k < ends.size(); ++k) {
    drawing.record(fmt::format("branch_{}_cycles", k + 1), ends[k]);
  }
  for (std::size_t k = 0; k < fork.shared.size(); ++k) {
    drawing.record(fmt::format("u{}", k + 1), fork.shared[k].u);
  }
}

growing::GrownMesh without_displacements(growing::Model model, std::string_view step) {
  for (growing::Step& each : model.steps) {
    if (each.name != step) continue;
    each.placement.displacements.clear();
    each.amounts.clear();
  }
  return growing::expand(model);
}

std::vector<double> heights_over(const FaceMesh& mesh, const FaceMesh& other) {
  const subdivision::LocalSurface surface =
      subdivision::local_surface(subdivision::make_topology(other), other.positions, {}, false);
  std::vector<double> heights;
  for (std::size_t v = 0; v < other.positions.size(); ++v) {
    const glm::vec3 by = mesh.positions[v] - other.positions[v];
    heights.push_back(static_cast<double>(glm::dot(by, surface.normals[v])));
  }
  return heights;
}

namespace {

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const auto n = static_cast<double>(a.size());
  double sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    sum_a += a[k];
    sum_b += b[k];
    aa += a[k] * a[k];
    bb += b[k] * b[k];
    ab += a[k] * b[k];
  }
  return (ab - sum_a * sum_b / n) / std::sqrt((aa - sum_a * sum_a / n) * (bb - sum_b * sum_b / n));
}

}  // namespace

double ridges_along_u(const growing::Model& model, const FaceMesh& mesh) {
  std::vector<double> waves;
  for (const glm::vec2& at : mesh.texture) {
    waves.push_back(std::cos(16 * std::numbers::pi * static_cast<double>(at.x)));
  }
  return correlation(heights_over(mesh, without_displacements(model, "ridges").mesh), waves);
}

}  // namespace terrabench::meshgrow
