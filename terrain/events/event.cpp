#include "terrain/events/event.h"

#include <fmt/format.h>

#include <algorithm>

namespace terrabench::events {
namespace {

// Metres. With longer lengths, products lose the precision of a metre.
constexpr double kFarthest = 1e9;
// Walls bulge by at most this share of the section's shortest side, so that neighbouring walls do not meet.
constexpr double kRoughestShare = 1.0 / 16;
// The width of a bulge over its height.
constexpr double kBulgeWidth = 8;

class Checks {
 public:
  Checks(const Event& event, std::size_t number) : event_(event), number_(number) {}

  [[noreturn]] void refuse(std::string_view what, std::string_view advice) const {
    throw EventError(event_, number_, what, advice);
  }
  void finite(double value, std::string_view field) const {
    if (!(std::abs(value) <= kFarthest)) {
      refuse(fmt::format("'{}' must be at most 1e9 m, got {}", field, value),
             "give a finite number of metres");
    }
  }
  void finite(glm::dvec2 point, std::string_view field) const {
    finite(point.x, field), finite(point.y, field);
  }
  void positive(double value, std::string_view field) const {
    finite(value, field);
    if (!(value > 0))
      refuse(fmt::format("'{}' must be above 0, got {}", field, value), "give a larger number");
  }
  void angle(double value, std::string_view field) const {
    if (!(value >= 1 && value <= 89)) {
      refuse(fmt::format("'{}' must be from 1 to 89 degrees, got {}", field, value), "give another angle");
    }
  }
  void line(glm::dvec2 from, glm::dvec2 to) const {
    finite(from, "from"), finite(to, "to");
    if (!(glm::length(to - from) > 1e-6)) refuse("'from' and 'to' are one point", "move them apart");
  }

 private:
  const Event& event_;
  std::size_t number_;
};

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

// Twice the signed area of a, b, c.
double turn(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) { return cross(b - a, c - a); }

bool on_segment(glm::dvec2 a, glm::dvec2 b, glm::dvec2 p) {
  return turn(a, b, p) == 0 && glm::dot(p - a, p - b) <= 0;
}

bool segments_meet(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d) {
  const auto sides = [](double s, double t) { return (s > 0 && t < 0) || (s < 0 && t > 0); };
  if (sides(turn(a, b, c), turn(a, b, d)) && sides(turn(c, d, a), turn(c, d, b))) return true;
  return on_segment(a, b, c) || on_segment(a, b, d) || on_segment(c, d, a) || on_segment(c, d, b);
}

double shortest_side(const std::vector<glm::dvec2>& section) {
  double shortest = HUGE_VAL;
  for (std::size_t i = 0; i < section.size(); ++i) {
    shortest = std::min(shortest, glm::distance(section[i], section[(i + 1) % section.size()]));
  }
  return shortest;
}

void check_section(const Checks& checks, const std::vector<glm::dvec2>& section) {
  const std::size_t n = section.size();
  if (n < 3 || n > kMostCorners) {
    checks.refuse(fmt::format("'section' must have 3 to {} points, got {}", kMostCorners, n),
                  "give another polygon");
  }
  for (const glm::dvec2 corner : section) checks.finite(corner, "section");
  if (!(shortest_side(section) > 1e-6)) {
    checks.refuse("'section' has two equal points in a row", "remove one of them");
  }
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec2 a = section[i], b = section[(i + 1) % n], c = section[(i + 2) % n];
    // Neighbouring sides share a corner, but must not fold back on each other.
    bool crosses = turn(a, b, c) == 0 && glm::dot(a - b, c - b) > 0;
    for (std::size_t k = i + 2; k < n && !crosses; ++k) {
      if ((k + 1) % n != i) crosses = segments_meet(a, b, section[k], section[(k + 1) % n]);
    }
    if (crosses) checks.refuse("'section' crosses itself", "give the corners of a simple polygon in order");
  }
  double area = 0;
  for (std::size_t i = 0; i < n; ++i) area += cross(section[i], section[(i + 1) % n]);
  if (!(area > 0)) {
    checks.refuse("'section' is clockwise",
                  "give its corners counter-clockwise, seen in the direction of the axis");
  }
}

void check_values(const Checks& checks, const LinearErosion& e) {
  checks.line(e.from, e.to);
  checks.positive(e.depth, "depth");
  checks.angle(e.slope, "slope");
}

void check_values(const Checks& checks, const RadialErosion& e) {
  for (int axis = 0; axis < 3; ++axis) {
    checks.finite(e.centre[axis], "centre");
    checks.positive(e.radii[axis], "radii");
  }
}

void check_values(const Checks& checks, const DipFault& e) {
  checks.line(e.from, e.to);
  checks.positive(e.extent, "extent");
  checks.positive(e.rise, "throw");
  checks.angle(e.dip, "dip");
  if (!(e.offset() / 2 < e.extent)) {
    checks.refuse(fmt::format("the scarp is {:.6g} m wide, which leaves no ground of the blocks", e.offset()),
                  "give a smaller 'throw', a steeper 'dip' or a larger 'extent'");
  }
}

void check_values(const Checks& checks, const LateralFault& e) {
  checks.line(e.from, e.to);
  checks.positive(e.extent, "extent");
  checks.positive(e.slip, "slip");
}

void check_values(const Checks& checks, const Carving& e) {
  checks.finite(e.from.y, "from"), checks.finite(e.to.y, "to");
  checks.line({e.from.x, e.from.z}, {e.to.x, e.to.z});
  check_section(checks, e.section);
  checks.positive(e.scale_from, "scale_from");
  checks.positive(e.scale_to, "scale_to");
  const double most = kRoughestShare * shortest_side(e.section) * std::min(e.scale_from, e.scale_to);
  if (!(e.roughness >= 0 && e.roughness <= most)) {
    checks.refuse(fmt::format("'roughness' must be from 0 to {:.6g} m, got {}", most, e.roughness),
                  "give at most a sixteenth of the section's shortest side");
  }
}

std::array<glm::dvec2, 4> rectangle(const Line& line, double u0, double u1, double d0, double d1) {
  return {line.plan({u0, d0}), line.plan({u1, d0}), line.plan({u1, d1}), line.plan({u0, d1})};
}

std::array<glm::dvec2, 4> outline_of(const LinearErosion& e) {
  const double w = e.width();
  const Line line = e.line();
  return rectangle(line, -w, line.length + w, -w, w);
}

std::array<glm::dvec2, 4> outline_of(const RadialErosion& e) {
  const Line east({e.centre.x, e.centre.z}, {e.centre.x + 1, e.centre.z});
  return rectangle(east, -e.radii.x, e.radii.x, -e.radii.z, e.radii.z);
}

template <class Fault>
std::array<glm::dvec2, 4> outline_of(const Fault& e) {
  const Line line = e.line();
  return rectangle(line, 0, line.length, -e.extent, e.extent);
}

std::array<glm::dvec2, 4> outline_of(const Carving& e) {
  double left = HUGE_VAL, right = -HUGE_VAL;
  for (const glm::dvec2 corner : e.section) {
    for (const double scale : {e.scale_from, e.scale_to}) {
      left = std::min(left, corner.x * scale);
      right = std::max(right, corner.x * scale);
    }
  }
  const Line line = e.line();
  return rectangle(line, 0, line.length, -right - e.roughness, -left + e.roughness);
}

// A random number in [-1, 1] per lattice point.
double lattice_value(std::uint64_t seed, std::size_t side, std::int64_t i, std::int64_t j) {
  std::uint64_t hash = seed + 0x9E3779B97F4A7C15U * (side + 1);
  for (const std::int64_t step : {i, j}) {
    hash = (hash ^ static_cast<std::uint64_t>(step)) * 0xBF58476D1CE4E5B9U;
    hash = (hash ^ (hash >> 27)) * 0x94D049BB133111EBU;
    hash ^= hash >> 31;
  }
  return static_cast<double>(hash >> 11) * 0x1p-52 - 1;
}

double smooth_step(double t) { return t * t * t * (t * (6 * t - 15) + 10); }

double lattice_noise(std::uint64_t seed, std::size_t side, double x, double y) {
  const double x0 = std::floor(x), y0 = std::floor(y);
  const auto i = static_cast<std::int64_t>(x0), j = static_cast<std::int64_t>(y0);
  const double s = smooth_step(x - x0), t = smooth_step(y - y0);
  return std::lerp(std::lerp(lattice_value(seed, side, i, j), lattice_value(seed, side, i + 1, j), s),
                   std::lerp(lattice_value(seed, side, i, j + 1), lattice_value(seed, side, i + 1, j + 1), s),
                   t);
}

}  // namespace

double Carving::bulge(std::size_t side, double u, double across) const {
  if (roughness == 0) return 0;
  const double length = glm::distance(section[side], section[(side + 1) % section.size()]) * scale_from;
  const double width = kBulgeWidth * roughness;
  const double taper = 4 * across * (1 - across);
  return roughness * taper * lattice_noise(seed, side, u / width, across * length / width);
}

glm::dvec2 Carving::wall(std::size_t side, double u, double across) const {
  const glm::dvec2 a = section[side], b = section[(side + 1) % section.size()];
  const glm::dvec2 outwards = glm::normalize(glm::dvec2(b.y - a.y, a.x - b.x));
  return scale(u) * glm::mix(a, b, across) + bulge(side, u, across) * outwards;
}

Kind kind(const Event& event) {
  if (const auto* const e = std::get_if<DipFault>(&event)) {
    return e->inverse ? Kind::kInverseFault : Kind::kNormalFault;
  }
  if (const auto* const e = std::get_if<Carving>(&event)) return e->cave ? Kind::kCave : Kind::kTunnel;
  if (std::holds_alternative<LateralFault>(event)) return Kind::kLateralFault;
  return std::holds_alternative<LinearErosion>(event) ? Kind::kLinearErosion : Kind::kRadialErosion;
}

std::string_view name(Kind kind) {
  constexpr std::string_view kNames[kKinds] = {
      "linear-erosion", "radial-erosion", "normal-fault", "inverse-fault", "lateral-fault", "tunnel", "cave"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::array<glm::dvec2, 4> outline(const Event& event) {
  return std::visit([](const auto& e) { return outline_of(e); }, event);
}

PlanBox plan_box(const Event& event) {
  PlanBox box;
  for (const glm::dvec2 corner : outline(event)) {
    box.low = glm::min(box.low, corner);
    box.high = glm::max(box.high, corner);
  }
  return box;
}

PlanBox source_box(const Event& event) {
  PlanBox box = plan_box(event);
  if (const auto* const fault = std::get_if<LateralFault>(&event)) {
    const Line line = fault->line();
    for (const double u : {-fault->slip / 2, line.length + fault->slip / 2}) {
      box.low = glm::min(box.low, line.plan({u, 0}));
      box.high = glm::max(box.high, line.plan({u, 0}));
    }
  }
  return box;
}

void validate(const Event& event, glm::dvec2 extent, std::size_t number) {
  const Checks checks(event, number);
  std::visit([&](const auto& e) { check_values(checks, e); }, event);
  const PlanBox box = source_box(event);
  if (!(box.low.x >= 0 && box.low.y >= 0 && box.high.x <= extent.x && box.high.y <= extent.y)) {
    checks.refuse(fmt::format("reaches x {:.6g} … {:.6g} m, z {:.6g} … {:.6g} m, outside the terrain",
                              box.low.x, box.high.x, box.low.y, box.high.y),
                  fmt::format("keep it on x 0 … {:.6g} m, z 0 … {:.6g} m", extent.x, extent.y));
  }
}

std::string where(const Event& event, std::size_t number) {
  return fmt::format("event {} ({})", number, name(kind(event)));
}

EventError::EventError(const Event& event, std::size_t number, std::string_view what, std::string_view advice)
    : Error(bad_input(what, where(event, number), advice)), number_(number) {}

}  // namespace terrabench::events
