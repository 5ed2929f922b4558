// What a view says about a wedgie: its culling label, a bound on its screen-space error in pixels, and how
// far the camera may move before either can have changed (Duchaineau et al. 1997, §§6.2, 6.3 and 7). O(1) per
// wedgie.
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

// A corner in camera coordinates.
struct ViewedCorner {
  glm::dvec3 at;
  double depth;             // along the line of sight
  double up_squared;        // N² of WedgieView::distortion()
  double distance_squared;  // from the eye
};

// An upper bound of the screen-space error over a triangle, and how long it holds: after motion m (see
// Motion) the bound has changed by at most a factor g as long as m ≤ (1 - 1/g) · scale.
struct Distortion {
  double pixels = 0;
  double scale = 0;  // metres
  double reach = 0;  // metres from the eye to the farthest point of the wedgie
};

// How far a camera moved: in camera coordinates, a point at distance ρ from the eye moved by at most
// moved + ρ·turned.
struct Motion {
  double moved = 0;   // metres
  double turned = 0;  // radians, rounded up
  bool none() const { return moved == 0 && turned == 0; }
};

// A culling label, which stays right while the camera moves by less than both parts of `valid_for`.
struct Culling {
  CullLabel label = 0;
  Motion valid_for;
};

class WedgieView {
 public:
  WedgieView() = default;
  // `extent`: size of the ground, metres. The tolerance for rounding of the culling planes is proportional.
  WedgieView(const View&, double extent);

  // A visible sample at depth r that is drawn d metres off is displaced by f·d·N / (r·r') pixels, where f is
  // the focal length in pixels, r' the depth of the drawn point, and N the length of the component of up ×
  // (sample - eye) across the line of sight. N is convex over the ground, and N/r is at most S on the screen.
  // Hence f·e / R · min(S, max N / R), the maximum over the corners, bounds the displacement of all samples
  // on the screen in a wedgie of thickness e whose nearest corner has depth R. The bound is infinite when the
  // wedgie reaches in front of the near plane. Unlike the paper's maximum over the corners, this holds inside
  // the triangle as well; and it bounds the displacement of the drawn point, which is half the projected
  // length of the wedgie.
  Distortion distortion(const ViewedCorner& a, const ViewedCorner& b, const ViewedCorner& c,
                        double thickness) const;
  ViewedCorner corner(const glm::dvec3& at) const {
    const glm::dvec3 d = at - eye_;
    const double flat = d.x * d.x + d.z * d.z, aside = d.z * forward_.x - d.x * forward_.z;
    return {at, glm::dot(forward_, d), flat - aside * aside, flat + d.y * d.y};
  }

  // For a wedgie whose parent's label is not inherited. `spill`: the share of the triangle's size by which
  // its descendants may extend beyond it.
  Culling cull(const Corners&, double thickness, double spill, CullLabel parent) const;

  // The motion from an earlier view with the same lens.
  Motion since(const WedgieView& before) const;
  // All but the far plane: distortions do not depend on it, and to culling labels it is a motion of the
  // camera by far_moved() metres.
  bool same_lens(const WedgieView& other) const { return lens_ == other.lens_; }
  double far_moved(const WedgieView& before) const { return std::abs(far_ - before.far_); }
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
  double largest_up_ = 0;  // S of distortion()
  double up_rate_ = 0;     // largest relative change of S per radian
};

}  // namespace terrabench::roam
