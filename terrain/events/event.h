// Events that change the ground, as data: those of the Grounded Heightmap Tree (Alonso, Joan-Arinyo & Solano,
// §3.2, figures 13 and 15). The paper names the parameters and draws the shapes; the formulas below are our
// reading of it, and hold for every structure.
//
// The ground is a surface, which lies over itself only at an inverse fault, and from which carvings are
// taken. Geotectonic events move the surface; carvings stay where they are. h is the height before the event,
// in metres; y up, x east, z south. An event along a line has the plan coordinates u (along it, 0 … L) and d
// (across it, positive on the left).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "terrain/error.h"
#include "terrain/heightfield.h"

namespace terrabench::events {

// A line in plan and its coordinates (u, d). Points in plan are (x, z).
struct Line {
  glm::dvec2 origin, along, left;  // unit vectors
  double length;

  Line(glm::dvec2 from, glm::dvec2 to)
      : origin(from),
        along(glm::normalize(to - from)),
        left(along.y, -along.x),
        length(glm::length(to - from)) {}
  glm::dvec2 local(glm::dvec2 plan) const {
    return {glm::dot(plan - origin, along), glm::dot(plan - origin, left)};
  }
  glm::dvec2 plan(glm::dvec2 local) const { return origin + local.x * along + local.y * left; }
};

inline double tangent_of_degrees(double angle) { return std::tan(angle * std::numbers::pi / 180); }

// A trench of four planes, two sides and two ends, like a hipped roof upside down. Its bottom edge runs from
// `from` to `to`, `depth` below the ground, whose relief the planes keep. With W = depth / tan(slope) the
// ground sinks by depth · clamp(min(W - |d|, u + W, L + W - u) / W, 0, 1).
struct LinearErosion {
  glm::dvec2 from{0}, to{0};  // plan
  double depth = 0;           // metres
  double slope = 30;          // degrees, of the planes

  Line line() const { return {from, to}; }
  double width() const { return depth / tangent_of_degrees(slope); }  // W
  // How far the ground at (u, d) sinks.
  double drop(glm::dvec2 local) const {
    const double w = width(), along = w + std::fmin(local.x, glm::distance(from, to) - local.x);
    return depth * std::fmin(std::fmax(std::fmin(w - std::abs(local.y), along) / w, 0), 1);
  }
};

// The ground above the lower half of an ellipsoid is removed: h' = min(h, lower half) inside the ellipse.
struct RadialErosion {
  glm::dvec3 centre{0}, radii{0};

  // Height of the lower half; +infinity outside the ellipse.
  double bottom(glm::dvec2 plan) const {
    const double x = (plan.x - centre.x) / radii.x, z = (plan.y - centre.z) / radii.z;
    const double rest = 1 - x * x - z * z;
    return rest > 0 ? centre.y - radii.y * std::sqrt(rest) : HUGE_VAL;
  }
};

// A normal or inverse fault: the left block (0 ≤ d ≤ extent) tilts up and the right one down, most at the
// line and not at all at `extent` from it. A scarp of inclination `dip` joins their lips, which are the edges
// along the line. With o = rise / tan(dip) and σ = +1 for a normal, -1 for an inverse fault, 0 ≤ u ≤ L:
//   left:   d' = d + σ·(o/2)·(1 - d/extent)      y' = h + (rise/2)·(1 - d/extent)
//   right:  d' = d - σ·(o/2)·(1 - |d|/extent)    y' = h - (rise/2)·(1 - |d|/extent)
// The scarp is straight between the lips at equal u. In a normal fault it is an open slope. In an inverse
// fault the left block hangs over it, and what lies between scarp and right block is air: the ground is solid
// where the crossings of the surface above add up to more than 0, +1 where it faces up, -1 where it faces
// down. At u = 0 and u = L the blocks end in cliffs.
struct DipFault {
  bool inverse = false;
  glm::dvec2 from{0}, to{0};  // plan
  double extent = 0;          // metres, from the line to where nothing moves
  double rise = 0;            // metres, of one lip over the other: the throw of the fault
  double dip = 60;            // degrees, of the scarp from the horizontal

  Line line() const { return {from, to}; }
  double offset() const { return rise / tangent_of_degrees(dip); }  // o, the heave; validate(): o/2 < extent
};

// The ground slides along the line, the left block forwards and the right one backwards, each by half the
// slip at the line and by nothing at `extent` from it: h'(u, d) = h(u ∓ (slip/2)·(1 - |d|/extent), d).
struct LateralFault {
  glm::dvec2 from{0}, to{0};  // plan
  double extent = 0;          // metres
  double slip = 0;            // metres, of one block against the other

  Line line() const { return {from, to}; }
  // Where the ground that comes to (u, d) was.
  glm::dvec2 before(glm::dvec2 local) const {
    const double shift = slip / 2 * (1 - std::abs(local.y) / extent);
    return {local.x - (local.y >= 0 ? shift : -shift), local.y};
  }
};

// A tunnel or a cave: a polygonal section is swept along a straight axis, scaled linearly from one end to the
// other, and taken out of the ground. The section is upright, across the axis in plan, with the coordinates
// (a, b): a to the right of the axis, b up. Between `from` and `to` the section must be under ground; beyond
// them the sweep continues, with its scale, until the whole section is in the air. A cave continues only
// beyond `from` and is closed by an upright plane at `to`.
struct Carving {
  bool cave = false;
  glm::dvec3 from{0}, to{0};
  std::vector<glm::dvec2> section{};  // metres before scaling; simple, counter-clockwise as drawn
  double scale_from = 1, scale_to = 1;
  double roughness = 0;    // metres, the most by which walls bulge in or out
  std::uint64_t seed = 0;  // of the bulges

  Line line() const { return {{from.x, from.z}, {to.x, to.z}}; }
  // Height of the axis and scale of the section at u metres in plan from `from`, also beyond the ends.
  double height(double u) const { return from.y + (to.y - from.y) * u / line().length; }
  double scale(double u) const { return scale_from + (scale_to - scale_from) * u / line().length; }
  // How far the wall bulges outwards, in metres, at the share `across` ∈ [0, 1] of the section's side from
  // corner `side` to the next: smooth noise in [-roughness, roughness], zero at the corners.
  double bulge(std::size_t side, double u, double across) const;
  // The point of the wall there, in section coordinates, scaled and with its bulge.
  glm::dvec2 wall(std::size_t side, double u, double across) const;
};

inline constexpr std::size_t kMostCorners = 64;  // of a section

using Event = std::variant<LinearErosion, RadialErosion, DipFault, LateralFault, Carving>;

enum class Kind : std::uint8_t {
  kLinearErosion,
  kRadialErosion,
  kNormalFault,
  kInverseFault,
  kLateralFault,
  kTunnel,
  kCave
};
inline constexpr int kKinds = 7;
Kind kind(const Event&);
std::string_view name(Kind);  // as in files: "linear-erosion"

// The corners of the rectangle in plan outside which the event changes nothing, counter-clockwise seen from
// above. For a carving it holds the part between `from` and `to`; how far that continues depends on the
// ground.
std::array<glm::dvec2, 4> outline(const Event&);

struct PlanBox {
  glm::dvec2 low{HUGE_VAL}, high{-HUGE_VAL};
  bool contains(glm::dvec2 p) const { return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y; }
  bool meets(const PlanBox& other) const {
    return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y && other.low.y <= high.y;
  }
};
PlanBox plan_box(const Event&);  // around the outline
// Around all ground on which the result depends: larger than plan_box() for a lateral fault, which takes
// ground from up to half the slip beyond its ends.
PlanBox source_box(const Event&);

// Throws EventError, with the event's number (counted from 1), the field and what to do, when a value is
// invalid (not finite, zero length, radius not positive, an angle outside 1 … 89 degrees, a section of fewer
// than three points, self-crossing or clockwise …) or when source_box() is not inside the terrain
// [0, extent.x] × [0, extent.y]. Does not check whether a carving starts and stays under ground, which
// depends on the ground: Evaluation and the tree check that when they carve.
void validate(const Event&, glm::dvec2 extent, std::size_t number);

// "event 3 (tunnel)": the `where` of errors about an event.
std::string where(const Event&, std::size_t number);

// A bad_input error about an event, with the event's number.
class EventError : public Error {
 public:
  EventError(const Event& event, std::size_t number, std::string_view what, std::string_view advice);
  std::size_t number() const { return number_; }  // counted from 1

 private:
  std::size_t number_;
};

// A ground and the events on it, in order.
struct Sculpture {
  Heightfield ground;
  std::vector<Event> events;
};

}  // namespace terrabench::events
