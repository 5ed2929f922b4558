// The eye that the user moves: on foot, in flight, around a place, or over a plan. Headings are degrees
// clockwise from north and pitches degrees upwards, as in camera paths (docs/paths.md). All functions are
// O(1), but to begin an orbit is O(width + depth).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "terrain/heightfield.h"
#include "terrain/solid.h"
#include "terrain/view.h"

namespace terrabench::viewer {

enum class Motion : std::uint8_t {
  kFly,    // at any height above the ground
  kWalk,   // 1.8 m above the ground
  kOrbit,  // around a place, at which it looks
  kPlan,   // looks straight down
};

class Camera {
 public:
  // Stands where home() puts it. Ground and bounds must outlive it, or the next call of these two.
  void stand_on(const Heightfield&, const Bounds&);
  // The same, but stays where it is, and above the ground.
  void keep_on(const Heightfield&, const Bounds&);
  void home();  // in the south, above the ground, with most of it in view

  Motion motion() const { return motion_; }
  void set_motion(Motion);

  // Moves for that many seconds. `way`: right, up and forward, in units of speed(); up is ignored on foot and
  // in orbit; in orbit, the place moves; over a plan, forward is to the picture's top.
  void move(const glm::dvec3& way, double seconds);
  // In orbit the eye goes round; over a plan only the heading changes. Degrees.
  void turn(double right, double up);
  // In flight and on foot changes the speed, otherwise the distance. Positive: faster, nearer.
  void zoom(double steps);
  void place(const glm::dvec3& eye, double heading, double pitch);  // metres, degrees
  // Stands where that view does; on foot, at its height above the ground.
  void take(const View&);

  double speed() const { return speed_; }  // metres per second
  void set_speed(double metres_per_second);
  double field_of_view = 60;  // degrees, vertical, 1 to 170

  const glm::dvec3& eye() const { return eye_; }
  double heading() const { return heading_; }  // not wrapped: a full turn more is 360 more
  double pitch() const { return pitch_; }
  // With depth planes for the ground alone, as `render` chooses them.
  View view(int width, int height) const;

 private:
  glm::dvec3 direction() const;
  double extent() const;  // the longer side, metres
  void keep_above();
  void look_at(const glm::dvec3& place);
  void set_orbit();

  const Heightfield* ground_ = nullptr;
  const Bounds* bounds_ = nullptr;
  Motion motion_ = Motion::kFly;
  glm::dvec3 eye_{0}, place_{0};  // place_: in the middle of an orbit
  double heading_ = 0, pitch_ = 0;
  double away_ = 1;   // of the eye from that place, metres
  double speed_ = 1;  // metres per second
};

}  // namespace terrabench::viewer
