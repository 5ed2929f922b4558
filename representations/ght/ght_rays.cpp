#include "representations/ght/ght_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec3.hpp>
#include <limits>

#include "representations/plan_square.h"

namespace terrabench {
namespace {

using namespace ght;

constexpr double kNoHit = std::numeric_limits<double>::infinity();
constexpr float kNothing = -std::numeric_limits<float>::infinity();

// A ray against triangles whose corners are shared, after Woop, Benthin & Wald ("Watertight Ray/Triangle
// Intersection", 2013): no ray passes between two triangles with a common edge, because both compute the
// same number for it, up to the sign. In double precision; both sides count.
class TriangleRay {
 public:
  explicit TriangleRay(const RayPath& path) : origin_(path.origin) {
    const glm::dvec3 d = path.direction, size{std::abs(d.x), std::abs(d.y), std::abs(d.z)};
    along_ = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    a_ = (along_ + 1) % 3;
    b_ = (along_ + 2) % 3;
    per_ = 1 / d[along_];
    shear_a_ = d[a_] * per_;
    shear_b_ = d[b_] * per_;
  }

  // Where the ray's whole line meets the triangle, in lengths of the direction; infinite for nowhere, and for
  // a triangle that the line lies in.
  double meets(const std::array<glm::vec3, 3>& corners) const {
    std::array<double, 3> a, b, c;  // with the ray along c
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 p = glm::dvec3(corners[k]) - origin_;
      a[k] = p[a_] - shear_a_ * p[along_];
      b[k] = p[b_] - shear_b_ * p[along_];
      c[k] = per_ * p[along_];
    }
    const double u = a[2] * b[1] - b[2] * a[1], v = a[0] * b[2] - b[0] * a[2], w = a[1] * b[0] - b[1] * a[0];
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return kNoHit;
    const double sum = u + v + w;
    return sum == 0 ? kNoHit : (u * c[0] + v * c[1] + w * c[2]) / sum;
  }

 private:
  glm::dvec3 origin_;
  int along_ = 0, a_ = 1, b_ = 2;  // the direction's largest component, and the others
  double per_, shear_a_, shear_b_;
};

// A Ground of ray_walk.h. `inside` alone tells the ray's state in simple squares; over others, every triangle
// on the way is a hit, as it is on mesh().
struct GhtGround {
  explicit GhtGround(const Ght& of)
      : tree(of.model().tree),
        surface(of.model().surface),
        x{tree.grid().origin_x, tree.grid().spacing_x, of.bounds().low.x, of.bounds().high.x,
          tree.grid().width - 1},
        z{tree.grid().origin_z, tree.grid().spacing_z, of.bounds().low.z, of.bounds().high.z,
          tree.grid().depth - 1},
        floor(of.model().floor),
        tops(x.cells, z.cells, [&](int i, int j) {
          return top({i, j});
        }) {
    highest = tops.levels() == 0 ? top({0, 0}) : tops.at(tops.levels(), 0, 0);
  }

  // Of a square that is no hole.
  CornerHeights corners(Square s) const {
    const auto height = [&](int i, int j) { return tree.height(tree.at_sample(i, j)); };
    return {height(s.i, s.j), height(s.i + 1, s.j), height(s.i, s.j + 1), height(s.i + 1, s.j + 1)};
  }
  std::array<glm::vec3, 3> positions(const Face& face) const {
    return {tree.position(face[0]), tree.position(face[1]), tree.position(face[2])};
  }
  PlanSquare square(Square s, const CornerHeights& c, const RayPath& path) const {
    return {x, z, s.i, s.j, c, path};
  }

  float top(Square s) const {
    float highest_corner = surface.plain(tree, s) ? corners(s).highest() : kNothing;
    surface.over(s, [&](FaceId f) {
      for (const CellId c : surface.face(f)) highest_corner = std::max(highest_corner, tree.position(c).y);
    });
    return highest_corner;
  }

  bool solid(int i, int j, const RayPath& path, double t) const {
    const Square s{i, j};
    if (ComposedSurface::hole(tree, s)) return false;
    if (surface.simple(s)) return square(s, corners(s), path).below(t);
    thread_local std::vector<Crossing> crossings;
    crossings.clear();
    surface.crossings(tree, static_cast<float>(path.x(t)), static_cast<float>(path.z(t)), s, crossings);
    int depth = 0;
    for (const Crossing& c : crossings) depth += c.y > path.y(t) ? c.weight : 0;
    return depth > 0;
  }

  double change(int i, int j, const RayPath& path, Stretch at, double lowest, bool inside) const {
    const Square s{i, j};
    if (ComposedSurface::hole(tree, s)) return inside ? at.begin : kNoHit;
    if (!surface.simple(s)) return change_among_faces(s, path, at, inside);
    const CornerHeights c = corners(s);
    if (!inside && lowest > c.highest()) return kNoHit;
    return square(s, c, path).change(at, inside);
  }

  double change_among_faces(Square s, const RayPath& path, Stretch at, bool inside) const {
    if (!inside && beside_hole(s) && solid(s.i, s.j, path, at.begin)) return at.begin;
    const TriangleRay ray(path);
    // Rounding may put a hit on the border between two squares beyond both.
    const double slip = 1e-9 * (at.end - at.begin) + 1e-12 * std::abs(at.end);
    double nearest = kNoHit;
    const auto test = [&](const Face& face) {
      const double t = ray.meets(positions(face));
      if (t >= at.begin - slip && t <= at.end + slip) {
        nearest = std::min(nearest, std::clamp(t, at.begin, at.end));
      }
    };
    if (surface.plain(tree, s)) {
      // As planes, so that it fits to simple squares, and as triangles, so that it fits to faces.
      const PlanSquare ground = square(s, corners(s), path);
      const double above = ground.above(at.begin);
      if ((above < 0) != inside && std::abs(above) < within_rounding()) return at.begin;
      nearest = ground.change(at, above < 0);
      for (const Face& face : ComposedSurface::plain_faces(ComposedSurface::corners(tree, s))) test(face);
    }
    surface.along(s, {path.x(at.begin), path.z(at.begin)}, {path.x(at.end), path.z(at.end)},
                  [&](FaceId f) { test(surface.face(f)); });
    return nearest;
  }

  // Metres; a millionth of a cell. Where a ray crosses the ground exactly on the border of two squares, the
  // planes of one square may put it below the ground and those of the other above, by less than this.
  double within_rounding() const { return 1e-6 * static_cast<double>(tree.grid().spacing()); }

  // Between a hole and ground there is a wall.
  bool beside_hole(Square s) const {
    if (!tree.has_holes()) return false;
    const auto hole = [&](int i, int j) {
      return i >= 0 && j >= 0 && i < x.cells && j < z.cells && ComposedSurface::hole(tree, {i, j});
    };
    return hole(s.i - 1, s.j) || hole(s.i + 1, s.j) || hole(s.i, s.j - 1) || hole(s.i, s.j + 1);
  }

  double closest(const Ray& ray) const { return RayWalk(*this, ray).closest(); }
  std::size_t bytes() const { return tops.bytes(); }

  const Tree& tree;
  const ComposedSurface& surface;
  PlanAxis x, z;
  double floor, highest = 0;
  TopPyramid tops;
};

}  // namespace

std::unique_ptr<RayCaster> ght_ray_caster(const Ght& of) {
  const SampleGrid& grid = of.model().tree.grid();
  if (grid.width < 2 || grid.depth < 2) return nullptr;
  return std::make_unique<GroundCaster<GhtGround>>(of);
}

}  // namespace terrabench
