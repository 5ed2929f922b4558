#include "experiments/ght/site.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <map>
#include <numbers>

#include "terrain/error.h"
#include "terrain/events/evaluate.h"
#include "terrain/events/section.h"
#include "terrain/sources/fractal/diamond_square.h"

namespace terrabench::ght {
namespace {

using namespace events;

// Whole metres keep event files short.
template <class T>
T rounded(const T& metres) {
  return glm::round(metres);
}

glm::dvec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

double height(const Site& site, glm::dvec2 plan) {
  return site.ground.sample(static_cast<float>(plan.x), static_cast<float>(plan.y));
}

// The lowest of nine places: what an event raises there stays below the peaks, above which stacks and voxels
// hold nothing.
glm::dvec2 low_place(const Site& site) {
  constexpr std::array kShares = {0.35, 0.5, 0.65};
  glm::dvec2 best{0};
  double lowest = HUGE_VAL;
  for (const double z : kShares) {
    for (const double x : kShares) {
      const glm::dvec2 at = site.corner + site.extent() * glm::dvec2(x, z);
      if (height(site, at) >= lowest) continue;
      lowest = height(site, at);
      best = at;
    }
  }
  return best;
}

// Applies the event if the tree accepts it. A carving must pass the exact evaluation too: the two can differ
// by a cell in how far a carving reaches.
bool try_apply(Ght& tree, const Site& site, const Event& event) {
  try {
    if (std::holds_alternative<Carving>(event)) {
      Ght trial = tree;
      trial.apply(event);
      Evaluation(std::make_shared<Sculpture>(Sculpture{site.ground, {event}}));
    }
    tree.apply(event);
    return true;
  } catch (const Error& error) {
    if (error.code() != ExitCode::kBadInput) throw;
    return false;
  }
}

// Places for carvings, the highest first.
std::vector<glm::dvec2> high_places(const Site& site) {
  constexpr int kPlaces = 24;
  std::vector<glm::dvec2> places;
  for (int j = 4; j <= kPlaces - 4; ++j) {
    for (int i = 4; i <= kPlaces - 4; ++i) {
      places.push_back(site.corner + site.extent() / kPlaces * glm::dvec2(i, j));
    }
  }
  std::stable_sort(places.begin(), places.end(),
                   [&](glm::dvec2 a, glm::dvec2 b) { return height(site, a) > height(site, b); });
  return places;
}

// The coarsest site that has room for carvings, where the search for their places is quick.
constexpr int kLeastSize = 32;

// The quickest questions come first: a search for a carving that finds none takes about a second.
bool takes_all_events(const Site& site) {
  for (int k = 0; k < kKinds; ++k) {
    if (is_carving(static_cast<Kind>(k))) continue;
    Ght tree = plain_tree(site.ground);
    if (!try_apply(tree, site, single_event(site, static_cast<Kind>(k)))) return false;
  }
  Ght fresh = plain_tree(site.ground);
  return carve(fresh, site, true, 8) && two_tunnels(site).size() == 2 &&
         overlapping_events(site).size() == kPlannedEvents;
}

}  // namespace

bool comes_out_once(const HeightAt& height, double cell, const Carving& carving, double u, double outwards) {
  constexpr int kAcross = 8;
  const Line line = carving.line();
  const double radius = section_reach(carving, u).high;
  std::array<bool, kAcross + 1> open{};
  for (;; u += outwards * cell / 2) {
    bool all_out = true;
    for (int k = 0; k <= kAcross; ++k) {
      const double a = radius * (2.0 * k / kAcross - 1);
      const glm::dvec2 plan = line.plan({u, -a});
      const double over = height(plan) - carving.height(u);
      if (std::isnan(over)) return false;
      if (open[k] && over > radius + cell / 2) return false;
      open[k] = open[k] || over < radius;
      all_out = all_out && over < -radius;
    }
    if (all_out) return true;
  }
}

Site make_site(int side, int size, std::uint64_t seed) {
  fractal::DiamondSquareOptions options{.seed = seed, .side = kEventsAlong * size + 1};
  // The cell shrinks as samples grow: the same mountains in metres, as event files have them.
  options.cell *=
      static_cast<float>(fractal::DiamondSquareOptions{}.side - 1) / static_cast<float>(options.side - 1);
  Site site;
  site.seed = seed;
  site.ground = fractal::diamond_square(options);
  const int period = options.side - 1;
  site.size = static_cast<double>(size) * options.cell;
  if (side > period) {
    Heightfield whole{side + 1, side + 1, options.cell, options.cell, {}, {}};
    whole.heights.reserve(static_cast<std::size_t>(side + 1) * (side + 1));
    for (int j = 0; j <= side; ++j) {
      for (int i = 0; i <= side; ++i) whole.heights.push_back(site.ground.at(i % period, j % period));
    }
    site.ground = std::move(whole);
    site.corner = glm::dvec2(side / period / 2 * site.extent());
  }
  site.middle = low_place(site);
  return site;
}

Site first_site(int side, int size, std::uint64_t seed, const std::function<bool(const Site&)>& fits) {
  constexpr std::uint64_t kTries = 100;
  for (std::uint64_t k = 0; k < kTries; ++k) {
    Site site = make_site(side, size, seed + k);
    if (fits(site)) return site;
  }
  throw environment_error(
      fmt::format("the mountains of seeds {} to {} have no place for it", seed, seed + kTries - 1), "ght",
      "choose a larger size or another seed");
}

Site event_site(int side, int size, std::uint64_t seed) {
  // The mountains found for each seed: the search takes about a second, and every case asks for them.
  static std::map<std::uint64_t, std::uint64_t> found;
  auto known = found.find(seed);
  if (known == found.end()) {
    const Site site = first_site(kEventsAlong * kLeastSize, kLeastSize, seed, takes_all_events);
    known = found.emplace(seed, site.seed).first;
  }
  return make_site(side, size, known->second);
}

void record_site(const Site& site, std::uint64_t asked, Recorder& recorder) {
  recorder.terrain("diamond-square", checksum(site.ground));
  if (site.seed != asked) recorder.add("site_seed", "", site.seed);
}

Site recorded_site(int side, int size, std::uint64_t seed, Recorder& recorder) {
  Site site = event_site(side, size, seed);
  record_site(site, seed, recorder);
  return site;
}

Ght plain_tree(const Heightfield& ground) {
  return Ght({ground.width, ground.depth, ground.cell_x, ground.cell_z, 0, 0}, ground.heights,
             height_range(ground).lowest - ground.cell_x);
}

// Oblique, so that no event runs along rows or columns.
Event geotectonic_event(const Site& site, Kind kind, glm::dvec2 centre, double length) {
  const glm::dvec2 half = 0.5 * length * direction(0.4), from = rounded(centre - half),
                   to = rounded(centre + half);
  const auto share = [&](double of) { return rounded(of * length); };
  switch (kind) {
    case Kind::kLinearErosion:
      return LinearErosion{from, to, share(0.08), 30};
    case Kind::kRadialErosion:
      return RadialErosion{rounded(glm::dvec3(centre.x, height(site, centre), centre.y)),
                           {share(0.5), share(0.12), share(0.5)}};
    case Kind::kLateralFault:
      return LateralFault{from, to, share(0.5), share(0.3)};
    default:
      return DipFault{kind == Kind::kInverseFault, from, to, share(0.5), share(0.1), 60};
  }
}

std::optional<Event> carve(Ght& tree, const Site& site, bool cave, int sides) {
  constexpr double kRadius = 0.05;  // of the section, in sizes
  constexpr int kDirections = 8;
  Carving carving;
  carving.cave = cave;
  for (int k = 0; k < sides; ++k) {
    const double turn = 2 * std::numbers::pi * (k + 0.5) / sides - std::numbers::pi / 2;
    carving.section.push_back(rounded(kRadius * site.size * direction(turn)));
  }
  carving.roughness = rounded(0.02 * kRadius * site.size);
  carving.seed = 1;
  const HeightAt ground = [&](glm::dvec2 plan) { return height(site, plan); };
  const double cell = site.ground.cell_x;
  int tries = 2000;  // about a second
  for (const glm::dvec2 top : high_places(site)) {
    for (const double drop : {0.08, 0.1, 0.12, 0.15}) {
      for (int d = 0; d < (cave ? 2 : 1) * kDirections; ++d) {
        const glm::dvec2 along = 0.15 * site.size * direction((d + 0.3) * std::numbers::pi / kDirections);
        const double y = height(site, top) - drop * site.size;
        carving.from = rounded(glm::dvec3(top.x - along.x, y, top.y - along.y));
        carving.to = rounded(glm::dvec3(top.x + along.x, y, top.y + along.y));
        if (!comes_out_once(ground, cell, carving, 0, -1)) continue;
        if (!cave && !comes_out_once(ground, cell, carving, carving.line().length, 1)) continue;
        if (try_apply(tree, site, carving)) return carving;
        if (--tries == 0) return std::nullopt;
      }
    }
  }
  return std::nullopt;
}

Event single_event(const Site& site, Kind kind) {
  if (!is_carving(kind)) return geotectonic_event(site, kind, site.middle, site.size);
  const Site coarse = make_site(kEventsAlong * kLeastSize, kLeastSize, site.seed);
  Ght tree = plain_tree(coarse.ground);
  auto found = carve(tree, coarse, kind == Kind::kCave, 8);
  if (!found) {
    throw environment_error("the mountains have no place for a " + std::string(name(kind)), "ght",
                            "take another seed");
  }
  auto& carving = std::get<Carving>(*found);
  for (glm::dvec3* const end : {&carving.from, &carving.to}) {
    end->x += site.corner.x;
    end->z += site.corner.y;
  }
  return carving;
}

std::vector<Event> two_tunnels(const Site& site) {
  Ght tree = plain_tree(site.ground);
  std::vector<Event> all;
  for (const int sides : {8, 5}) {
    if (const auto tunnel = carve(tree, site, false, sides)) all.push_back(*tunnel);
  }
  return all;
}

Event Rain::next(const Ght& tree) {
  const double radius = dice_.between(1.5, 4) * cell_;
  const double far = 8 * cell_;  // from the border
  const double x = dice_.between(far, extent_.x - far);
  const glm::dvec2 at{x, dice_.between(far, extent_.y - far)};
  return RadialErosion{{at.x, tree.model().surface.top(tree.model().tree, at), at.y},
                       {radius, radius / 3, radius}};
}

std::vector<Event> overlapping_events(const Site& site) {
  struct Planned {
    Kind kind;
    glm::dvec2 at;
    double length;
  };
  constexpr std::array<Planned, kPlannedEvents - 2> kPlan = {{
      {Kind::kNormalFault, {0.32, 0.34}, 1.3},
      {Kind::kLinearErosion, {0.3, 0.3}, 0.9},
      {Kind::kRadialErosion, {0.4, 0.36}, 0.5},
      {Kind::kLateralFault, {0.62, 0.34}, 1.1},
      {Kind::kLinearErosion, {0.6, 0.34}, 1.1},
      {Kind::kInverseFault, {0.34, 0.72}, 1.2},
      {Kind::kRadialErosion, {0.3, 0.33}, 0.25},
      {Kind::kRadialErosion, {0.66, 0.4}, 0.6},
      {Kind::kNormalFault, {0.68, 0.68}, 0.9},
      {Kind::kLinearErosion, {0.72, 0.64}, 0.7},
  }};
  Ght tree = plain_tree(site.ground);
  std::vector<Event> all;
  for (const Planned& p : kPlan) {
    const Event event =
        geotectonic_event(site, p.kind, site.corner + site.extent() * p.at, p.length * site.size);
    if (try_apply(tree, site, event)) all.push_back(event);
  }
  for (const bool cave : {false, true}) {
    if (const auto carving = carve(tree, site, cave, cave ? 6 : 8)) all.push_back(*carving);
  }
  return all;
}

std::span<const std::string_view> event_names() {
  static const auto names = [] {
    std::array<std::string_view, kKinds> all;
    for (int k = 0; k < kKinds; ++k) all[k] = name(static_cast<Kind>(k));
    return all;
  }();
  return names;
}

std::string metric_of(std::string_view metric, Kind kind) {
  std::string all = fmt::format("{}_{}", metric, name(kind));
  std::ranges::replace(all, '-', '_');
  return all;
}

}  // namespace terrabench::ght
