// What a view makes of a wedgie: whether it is seen, how many pixels its error may show as, and how far the
// camera must move before that can have changed (Duchaineau et al. 1997, §§6.2, 6.3 and 7).
#pragma once

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "lod/roam/node.h"
#include "terrain/view.h"

namespace terrabench::roam {

// The corners of a triangle, metres, apex first.
struct Corners {
  std::array<glm::dvec3, 3> at;
};

// A corner, and what the camera makes of it.
struct Spot {
  glm::dvec3 at;
  double depth;  // along the view
  double up;     // N² (see Camera::distortion): that of up × d, less its part along the view
  double away;   // squared
};

// An upper bound of the screen-space error over a triangle, and how long it holds: after motion m (see
// Motion) it lies within a factor g of what it was as long as m ≤ (1 - 1/g) · scale.
struct Distortion {
  double pixels = 0;
  double scale = 0;  // metres
  double reach = 0;  // metres from the eye to the wedgie's farthest point
};

// How far a camera went: a point at distance ρ of the eye moved by no more than moved + ρ·turned in the
// camera's frame.
struct Motion {
  double moved = 0;   // metres
  double turned = 0;  // radians, or a little more
  bool none() const { return moved == 0 && turned == 0; }
};

// A sight, and the motion, of both kinds at once, up to which it stays.
struct Seeing {
  Sight sight = 0;
  Motion slack;
};

class Camera {
 public:
  Camera() = default;
  // `extent` is that of the ground, metres: it sets how much rounding the planes forgive.
  Camera(const View&, double extent);

  // A sample that shows at depth r, d metres off, shows f·d·N / (r·r') pixels off, where r' is the depth of
  // what is drawn in its place and N what the view sees of "up": N is convex over the ground, and N/r no more
  // than some S all over the screen. Hence f·e / R · min(S, max N / R) bounds it for all samples on the
  // screen in a wedgie of thickness e whose nearest corner has depth R; infinite when that is in front of the
  // near plane. Unlike the paper's largest value at the corners this holds inside the triangle too, and it
  // bounds the distance of the drawn point from where it should be rather than the whole projected wedgie,
  // twice that.
  Distortion distortion(const Spot& a, const Spot& b, const Spot& c, double thickness) const;
  Spot spot(const glm::dvec3& at) const {
    const glm::dvec3 d = at - eye_;
    const double flat = d.x * d.x + d.z * d.z, aside = d.z * forward_.x - d.x * forward_.z;
    return {at, glm::dot(forward_, d), flat - aside * aside, flat + d.y * d.y};
  }

  // The sight of a wedgie whose parent is neither outside nor inside of all planes. `spill` is the share of
  // its size by which descendants may stick out of the triangle.
  Seeing sight(const Corners&, double thickness, double spill, Sight parent) const;

  // From another camera to this one. The lens must be the same.
  Motion since(const Camera& before) const;
  // The far plane may differ: distortions do not depend on it, and for sights it moves as a camera does, by
  // so many metres.
  bool same_lens(const Camera& other) const { return lens_ == other.lens_; }
  double far_moved(const Camera& before) const { return std::abs(far_ - before.far_); }
  double near() const { return lens_[2]; }

 private:
  struct Plane {
    glm::dvec3 normal;
    double offset;
  };
  glm::dvec3 eye_{0}, right_{0}, up_{0}, forward_{0};
  std::array<double, 5> lens_{};  // half width and height at depth 1, near, focal length in pixels, extent
  double far_ = 0;
  std::array<Plane, 6> planes_{};
  double largest_up_ = 0;  // S: what the view sees of "up" where on the screen it sees most of it
  double up_rate_ = 0;     // relative change of S a radian, at most
};

}  // namespace terrabench::roam
