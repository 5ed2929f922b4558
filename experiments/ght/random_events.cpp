#include "experiments/ght/random_events.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "terrain/error.h"
#include "terrain/events/evaluate.h"
#include "terrain/events/section.h"

namespace terrabench::ght {
namespace {

using namespace events;

constexpr double kMargin = 2.5;  // cells between a sane event and the terrain's border
constexpr double kCover = 1.5;   // cells of ground over both ends of a sane cave

double within(double low, double high, double share) { return low + (high - low) * share; }

glm::dvec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

double height(const Site& site, glm::dvec2 p) {
  return site.ground.sample(static_cast<float>(p.x), static_cast<float>(p.y));
}

// A place from `low` to `high` of the terrain. One number per statement: compilers differ in the order in
// which they evaluate arguments.
glm::dvec2 place(Dice& dice, const Site& site, double low, double high) {
  const double x = dice.between(low, high);
  return site.extent() * glm::dvec2(x, dice.between(low, high));
}

// What earlier events have left.
HeightAt current_ground(const Ght& tree) {
  return [&tree](glm::dvec2 p) { return tree.model().surface.top(tree.model().tree, p); };
}

// The highest of `tries` places.
glm::dvec2 high_place(Dice& dice, const Site& site, const HeightAt& ground, int tries) {
  glm::dvec2 top = place(dice, site, 0.1, 0.9);
  double highest = ground(top);
  for (int k = 1; k < tries; ++k) {
    const glm::dvec2 other = place(dice, site, 0.1, 0.9);
    const double here = ground(other);
    if (!(here > highest)) continue;
    top = other;
    highest = here;
  }
  return top;
}

std::vector<glm::dvec2> regular_section(int sides, double radius) {
  std::vector<glm::dvec2> section;
  for (int k = 0; k < sides; ++k) {
    const double turn = 2 * std::numbers::pi * (k + 0.5) / sides;
    section.push_back(radius * glm::dvec2(std::cos(turn), std::sin(turn)));
  }
  return section;
}

Event wild_carving(Dice& dice, const Site& site, bool cave, glm::dvec3 shares) {
  const double cell = site.ground.cell_x;
  const glm::dvec2 top = high_place(
      dice, site, [&](glm::dvec2 p) { return height(site, p); }, 21);
  const double angle = 2 * std::numbers::pi * shares.x, radius = within(1.3, 2, shares.y) * cell,
               y = height(site, top) - within(1.2, 2.5, shares.z) * radius - cell;
  const glm::dvec2 along = dice.between(1, 4) * cell * direction(angle);
  Carving carving;
  carving.cave = cave;
  carving.from = {top.x - along.x, y, top.y - along.y};
  carving.to = {top.x + along.x, y, top.y + along.y};
  carving.section = regular_section(3 + static_cast<int>(dice.next() % 8), 1.3 * radius);
  carving.roughness = 0.03 * radius;
  carving.seed = dice.next();
  return carving;
}

bool is_defined(const Site& site, std::span<const Event> before, const Event& event) {
  std::vector<Event> all(before.begin(), before.end());
  all.push_back(event);
  try {
    Evaluation(std::make_shared<Sculpture>(Sculpture{site.ground, std::move(all)}));
    return true;
  } catch (const EventError&) {
    return false;
  }
}

// A cave under high ground that earlier events have left. Its axis falls inwards, so that it comes out of
// more slopes.
std::optional<Event> sane_cave(Dice& dice, const Site& site, const Ght& tree, std::span<const Event> before) {
  constexpr int kTries = 60;
  const double cell = site.ground.cell_x;
  const HeightAt ground = current_ground(tree);
  for (int attempt = 0; attempt < kTries; ++attempt) {
    const glm::dvec2 top = high_place(dice, site, ground, 8);
    const double radius = dice.between(1.2, 1.6) * cell, drop = dice.between(1.5, 3) * radius + cell;
    const double angle = dice.between(0, 2 * std::numbers::pi);
    const glm::dvec2 along = dice.between(2, 4) * cell * direction(angle);
    Carving carving;
    carving.cave = true;
    const double y = ground(top) - drop;
    const double fall = dice.between(0, 0.5) * glm::length(along);  // from `from` to the middle
    carving.from = {top.x - along.x, y + fall, top.y - along.y};
    carving.to = {top.x + along.x, y - fall, top.y + along.y};
    const int sides = 4 + static_cast<int>(dice.next() % 5);
    carving.section = regular_section(sides, radius / std::cos(std::numbers::pi / sides));
    carving.roughness = 0.03 * radius;
    carving.seed = dice.next();
    const auto covered = [&](glm::dvec3 end) {
      return ground({end.x, end.z}) - end.y > 1.4 * radius + kCover * cell;
    };
    if (!covered(carving.from) || !covered(carving.to)) continue;
    if (!comes_out_once(ground, cell, carving, 0, -1)) continue;
    if (is_defined(site, before, carving)) return carving;
  }
  return std::nullopt;
}

// A level tunnel through a ridge that earlier events have left. The relief is only some six cells high, so
// that few ridges have room: the section is just larger than the tree's least one, and there are many quick
// tries. They have their own dice, so that the events after a tunnel do not depend on how many it took.
std::optional<Event> sane_tunnel(Dice tries, const Site& site, const Ght& tree,
                                 std::span<const Event> before) {
  constexpr int kTries = 4000;
  constexpr double kTunnelCover = 1.3;  // radii of ground over both ends
  const double cell = site.ground.cell_x, lowest = height_range(site.ground).lowest;
  const HeightAt ground = current_ground(tree);
  Carving carving;
  for (int attempt = 0; attempt < kTries; ++attempt) {
    const glm::dvec2 top = high_place(tries, site, ground, 4);
    const double radius = tries.between(1.05, 1.2) * cell;
    const double y = ground(top) - radius - tries.between(kTunnelCover, 1.8) * radius;
    const double angle = tries.between(0, 2 * std::numbers::pi);
    const glm::dvec2 along = tries.between(0.5, 2) * cell * direction(angle);
    carving.from = {top.x - along.x, y, top.y - along.y};
    carving.to = {top.x + along.x, y, top.y + along.y};
    const int sides = 4 + static_cast<int>(tries.next() % 5);
    carving.seed = tries.next();
    const auto covered = [&](glm::dvec3 end) {
      return ground({end.x, end.z}) - y > (1 + kTunnelCover) * radius;
    };
    if (!(y - radius > lowest) || !covered(carving.from) || !covered(carving.to)) continue;
    carving.section = regular_section(sides, radius / std::cos(std::numbers::pi / sides));
    if (!comes_out_once(ground, cell, carving, 0, -1)) continue;
    if (!comes_out_once(ground, cell, carving, carving.line().length, 1)) continue;
    if (is_defined(site, before, carving)) return carving;
  }
  return std::nullopt;
}

Event sane_geotectonic(Dice& dice, const Site& site, const Ght& tree, Kind kind) {
  const double cell = site.ground.cell_x, extent = site.extent();
  for (;;) {
    const double length = dice.between(0.5, 1.25) * site.size;
    const glm::dvec2 middle = place(dice, site, 0, 1),
                     half = 0.5 * length * direction(dice.between(0, 2 * std::numbers::pi));
    const glm::dvec2 from = middle - half, to = middle + half;
    const double first = dice.between(0, 1), second = dice.between(0, 1), third = dice.between(0, 1);
    Event event;
    switch (kind) {
      case Kind::kLinearErosion:
        event = LinearErosion{from, to, within(0.04, 0.1, first) * length, within(25, 50, second)};
        break;
      case Kind::kLateralFault:
        event = LateralFault{from, to, within(0.25, 0.5, first) * length, within(0.1, 0.4, second) * length};
        break;
      case Kind::kNormalFault:
      case Kind::kInverseFault:
        event = DipFault{kind == Kind::kInverseFault,
                         from,
                         to,
                         within(0.25, 0.5, first) * length,
                         within(0.05, 0.15, second) * length,
                         within(40, 80, third)};
        break;
      default:
        event = RadialErosion{
            {middle.x, tree.model().surface.top(tree.model().tree, middle), middle.y},
            glm::dvec3(within(2, 8, first), within(0.7, 2.5, second), within(2, 8, third)) * cell};
    }
    const PlanBox box = source_box(event);
    const double low = std::min(box.low.x, box.low.y), high = std::max(box.high.x, box.high.y);
    if (low >= kMargin * cell && high <= extent - kMargin * cell) return event;
  }
}

// Convex polygons in plan, by their separating axes.
bool meet(std::span<const glm::dvec2> a, std::span<const glm::dvec2> b) {
  const auto apart = [](std::span<const glm::dvec2> from, std::span<const glm::dvec2> p,
                        std::span<const glm::dvec2> q) {
    for (std::size_t k = 0; k < from.size(); ++k) {
      const glm::dvec2 edge = from[(k + 1) % from.size()] - from[k], axis(edge.y, -edge.x);
      const auto range = [&](std::span<const glm::dvec2> points) {
        glm::dvec2 found(HUGE_VAL, -HUGE_VAL);
        for (const glm::dvec2 at : points) {
          found = {std::min(found.x, glm::dot(at, axis)), std::max(found.y, glm::dot(at, axis))};
        }
        return found;
      };
      const glm::dvec2 u = range(p), v = range(q);
      if (u.y < v.x || v.y < u.x) return true;
    }
    return false;
  };
  return !apart(a, a, b) && !apart(b, a, b);
}

using Quad = std::array<glm::dvec2, 4>;

Quad rectangle(const Line& line, glm::dvec2 u, glm::dvec2 d) {
  return {line.plan({u.x, d.x}), line.plan({u.y, d.x}), line.plan({u.y, d.y}), line.plan({u.x, d.y})};
}

// All ground that the event reads or changes, in plan, and `more` metres around it.
Quad needed(const Site& site, const Ght& tree, const Event& event, double more) {
  const auto along = [&](const auto& e, double beyond, double width) {
    const Line line = e.line();
    return rectangle(line, {-beyond - more, line.length + beyond + more}, {-width - more, width + more});
  };
  if (const auto* const e = std::get_if<LinearErosion>(&event)) return along(*e, e->width(), e->width());
  if (const auto* const e = std::get_if<DipFault>(&event)) return along(*e, 0, e->extent);
  if (const auto* const e = std::get_if<LateralFault>(&event)) return along(*e, e->slip / 2, e->extent);
  if (const auto* const e = std::get_if<Carving>(&event)) {
    // Until both ends are certainly out of the ground, as far as the terrain goes.
    double beyond = 0;
    const Line line = e->line();
    const SectionRange reach = section_reach(*e, 0);
    const double width = std::max(-reach.low, reach.high), step = site.ground.cell_x;
    const auto buried = [&](double u) {
      const glm::dvec2 p = line.plan({u, 0});
      if (std::min(p.x, p.y) < 0 || std::max(p.x, p.y) > site.extent()) return false;
      return tree.model().surface.top(tree.model().tree, p) > e->height(u) - width;
    };
    while (buried(-beyond) || buried(line.length + beyond)) beyond += step;
    return along(*e, beyond, width);
  }
  const PlanBox box = plan_box(event);
  const Line east(box.low, {box.high.x, box.low.y});
  return rectangle(east, {-more, box.high.x - box.low.x + more}, {box.low.y - box.high.y - more, more});
}

}  // namespace

Event wild_event(Dice& dice, const Site& site) {
  const double cell = site.ground.cell_x;
  const auto kind = static_cast<Kind>(dice.next() % kKinds);
  const glm::dvec2 from = place(dice, site, 0.1, 0.9), to = place(dice, site, 0.1, 0.9);
  const double first = dice.between(0, 1), second = dice.between(0, 1), third = dice.between(0, 1);
  switch (kind) {
    case Kind::kLinearErosion:
      return LinearErosion{from, to, within(0.5, 4, first) * cell, within(20, 50, second)};
    case Kind::kRadialErosion:
      return RadialErosion{{from.x, height(site, from), from.y},
                           glm::dvec3(within(2, 9, first), within(1, 5, second), within(2, 9, third)) * cell};
    case Kind::kLateralFault:
      return LateralFault{from, to, within(3, 12, first) * cell, within(0.5, 8, second) * cell};
    case Kind::kNormalFault:
    case Kind::kInverseFault:
      return DipFault{
          kind == Kind::kInverseFault, from, to, within(4, 14, first) * cell, within(0.5, 4, second) * cell,
          within(40, 85, third)};
    default:
      return wild_carving(dice, site, kind == Kind::kCave, {first, second, third});
  }
}

Event sane_event(Dice& dice, const Site& site, const Ght& tree, std::span<const Event> before) {
  const auto kind = static_cast<Kind>(dice.next() % kKinds);
  if (!is_carving(kind)) return sane_geotectonic(dice, site, tree, kind);
  const auto carving = kind == Kind::kCave ? sane_cave(dice, site, tree, before)
                                           : sane_tunnel(Dice(dice.next()), site, tree, before);
  if (carving) return *carving;
  return sane_geotectonic(dice, site, tree, Kind::kRadialErosion);
}

Refusal why_refused(const Site& site, const Event& event, std::span<const Event> before,
                    std::string_view error) {
  const auto says = [&](std::string_view text) { return error.find(text) != std::string_view::npos; };
  if (!is_defined(site, before, event)) return Refusal::kImpossible;
  if (says("border")) return Refusal::kBorder;
  if (says("lies over itself") || says("overhang")) return Refusal::kOverhang;
  if (says("mouth of a tunnel") || says("breaks into") || says("another tunnel")) return Refusal::kCarving;
  if (says("two sample spacings wide") || says("one sample spacing under") ||
      says("one sample spacing of it")) {
    return Refusal::kThin;
  }
  if (says("a mouth that is not") || says("two mouths")) return Refusal::kMouth;
  return Refusal::kOther;
}

bool meets_fold(const Site& site, const Ght& tree, const Event& event, std::span<const Event> before) {
  const double near = 2 * site.ground.cell_x;
  const Quad region = needed(site, tree, event, near);
  return std::any_of(before.begin(), before.end(), [&](const Event& earlier) {
    if (std::holds_alternative<Carving>(earlier)) return meet(region, needed(site, tree, earlier, near));
    const auto* const fault = std::get_if<DipFault>(&earlier);
    if (fault == nullptr || !fault->inverse) return false;
    const double half = fault->offset() / 2 + near;
    return meet(region, rectangle(fault->line(), {-near, fault->line().length + near}, {-half, half}));
  });
}

}  // namespace terrabench::ght
