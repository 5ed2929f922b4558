#include "experiments/hybrid/grass_measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <numbers>

#include "experiments/figures/measures.h"
#include "experiments/figures/projection.h"

namespace terrabench::hybrid {
namespace {

using figures::Drawing;

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
  return figures::angle_between(a, b) * 180 / std::numbers::pi;
}

std::span<const std::uint32_t> corners_of(const TriangleMesh& mesh, std::size_t triangle) {
  return std::span(mesh.indices).subspan(3 * triangle, 3);
}

glm::dvec3 face_normal(const TriangleMesh& mesh, std::size_t triangle) {
  return figures::face_normal(mesh.positions, corners_of(mesh, triangle));
}

// Whether a point of the picture lies in the quadrilateral or at most `margin` pixels outside it.
bool inside(const std::array<glm::dvec2, 4>& corners, glm::dvec2 p, double margin) {
  double least = std::numeric_limits<double>::max(), most = -least;  // distances from the sides, signed
  for (std::size_t k = 0; k < 4; ++k) {
    const glm::dvec2 from = corners[k], along = glm::normalize(corners[(k + 1) % 4] - from);
    const double distance = along.x * (p.y - from.y) - along.y * (p.x - from.x);
    least = std::min(least, distance);
    most = std::max(most, distance);
  }
  return least >= -margin || most <= margin;
}

}  // namespace

double lean_out_of_faces(const TriangleMesh& mesh, std::span<const SceneLine> guides) {
  std::vector<std::vector<glm::dvec3>> faces(mesh.positions.size());
  for (std::size_t k = 0; k < mesh.indices.size(); ++k)
    faces[mesh.indices[k]].push_back(face_normal(mesh, k / 3));
  double most = -180;
  for (std::size_t v = 0; v < faces.size(); ++v) {
    const glm::dvec3 along(guides[v].points[1] - guides[v].points[0]);
    double lean = 0, turn = 0;
    for (const glm::dvec3& a : faces[v]) {
      lean = std::max(lean, degrees_between(a, along));
      for (const glm::dvec3& b : faces[v]) turn = std::max(turn, degrees_between(a, b));
    }
    most = std::max(most, lean - turn);
  }
  return most;
}

Interpolation interpolation_of(const TriangleMesh& triangle, const std::vector<GrassStrand>& strands) {
  const glm::dvec3 a(triangle.positions[0]), b(triangle.positions[1]), c(triangle.positions[2]),
      normal = glm::cross(b - a, c - a);
  glm::dvec3 mean(0);
  Interpolation found;
  for (const GrassStrand& strand : strands) {
    const glm::dvec3 p(strand.root);
    const auto share = [&](const glm::dvec3& from, const glm::dvec3& to) {
      return glm::dot(glm::cross(to - from, p - from), normal) / glm::dot(normal, normal);
    };
    const glm::dvec3 shares(share(b, c), share(c, a), share(a, b));
    glm::dvec3 expected(0);
    for (int k = 0; k < 3; ++k)
      expected += shares[k] * glm::dvec3(triangle.normals[static_cast<std::size_t>(k)]);
    found.off_the_normals = std::max(found.off_the_normals, degrees_between(glm::dvec3(strand.up), expected));
    mean += shares / static_cast<double>(strands.size());
  }
  found.least_coordinate = std::min({mean.x, mean.y, mean.z});
  return found;
}

void record_billboards(Drawing& drawing, const std::vector<ScenePlane>& planes, const TriangleMesh& ground,
                       const View& view, const Image& drawn, const Image& bare) {
  const auto side = [&](std::size_t k) {
    return glm::dvec3(planes[k].corners[1]) - glm::dvec3(planes[k].corners[0]);
  };
  const glm::dvec3 up = glm::dvec3(planes[0].corners[3]) - glm::dvec3(planes[0].corners[0]);
  drawing.record("between_the_planes", degrees_between(side(0), side(1)));
  drawing.record("first_to_the_edge",
                 degrees_between(side(0), glm::dvec3(ground.positions[1] - ground.positions[0])));
  drawing.record("up_to_the_normal", degrees_between(up, face_normal(ground, 0)));
  drawing.record("width", glm::length(side(0)));
  drawing.record("height", glm::length(up));
  std::vector<std::array<glm::dvec2, 4>> outlines;
  for (const ScenePlane& plane : planes) {
    std::array<glm::dvec2, 4>& outline = outlines.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) outline[k] = figures::pixel_of(view, plane.corners[k]);
  }
  double grass = 0, outside = 0, of_planes = 0;
  for (int y = 0; y < drawn.height; ++y) {
    for (int x = 0; x < drawn.width; ++x) {
      const auto within = [&](double margin) {
        return std::ranges::any_of(outlines, [&](const auto& outline) {
          return inside(outline, {x + 0.5, y + 0.5}, margin);
        });
      };
      const bool shows_grass = drawn.pixel(x, y) != bare.pixel(x, y);
      grass += shows_grass;
      outside += shows_grass && !within(1);
      of_planes += within(0);
    }
  }
  drawing.record("grass_pixels", grass);
  drawing.record("grass_outside_the_planes", outside);
  drawing.record("plane_pixels", of_planes);
}

void record_steep_strands(Drawing& drawing, const Heightfield& field, const TriangleMesh& mesh,
                          std::span<const GrassStrand> strands) {
  const int across = field.width - 1;
  std::vector<char> steep;  // by cell
  double area = 0, steep_area = 0, steep_strands = 0;
  for (std::size_t cell = 0; 2 * cell < mesh.triangles(); ++cell) {
    const auto triangle_area = [&](std::size_t t) {
      return 0.5 * glm::length(figures::across_face<glm::dvec3>(mesh.positions, corners_of(mesh, t)));
    };
    const double own = triangle_area(2 * cell) + triangle_area(2 * cell + 1),
                 plan = double{field.cell_x} * field.cell_z;
    steep.push_back(own * std::cos(std::numbers::pi / 6) > plan);
    area += own;
    steep_area += steep.back() != 0 ? own : 0;
  }
  const glm::vec3 low = mesh.positions.front();
  for (const GrassStrand& strand : strands) {
    const int i = std::clamp(static_cast<int>((strand.root.x - low.x) / field.cell_x), 0, across - 1),
              j = std::clamp(static_cast<int>((strand.root.z - low.z) / field.cell_z), 0, field.depth - 2);
    steep_strands +=
        steep[static_cast<std::size_t>(j) * static_cast<std::size_t>(across) + static_cast<std::size_t>(i)];
  }
  drawing.record("steep_strands", steep_strands);
  drawing.record("steep_strands_by_area", static_cast<double>(strands.size()) * steep_area / area);
}

}  // namespace terrabench::hybrid
