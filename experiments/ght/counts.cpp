// How many heightmaps each event adds, on the root and on another node: the difference between the trees
// before and after it. And what each of them is: its ground plane, its heights and its links, so that empty
// heightmaps do not count for anything.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "experiments/cases.h"
#include "experiments/ght/site.h"
#include "representations/ght/invariants.h"
#include "terrain/error.h"

namespace terrabench::ght {
namespace {

using events::Kind;

const std::array kSpecs{
    choice("event", event_names(), "the event that is counted"),
    ParameterSpec{"size", std::int64_t{32}, "cells", "length of an event; the terrain is 4 times as long", 32,
                  512},
};

constexpr int kFewestSides = 3, kMostSides = 12;

struct Plane {
  glm::dvec3 point, normal;
};

Plane plane_of(const GroundedHeightmap& map) {
  if (map.aligned) return {{0, 0, 0}, {0, 1, 0}};
  return {map.plane.origin, glm::normalize(glm::cross(glm::dvec3(map.plane.u), glm::dvec3(map.plane.v)))};
}

// How many different ground planes the heightmaps have.
std::size_t planes_of(std::span<const GroundedHeightmap> maps, double spacing) {
  std::vector<Plane> planes;
  for (const GroundedHeightmap& map : maps) {
    const Plane plane = plane_of(map);
    const bool known = std::ranges::any_of(planes, [&](const Plane& other) {
      return std::abs(glm::dot(plane.normal, other.normal)) > 1 - 1e-6 &&
             std::abs(glm::dot(plane.normal, other.point - plane.point)) < 0.01 * spacing;
    });
    if (!known) planes.push_back(plane);
  }
  return planes.size();
}

bool is_linked(const Model& model, const GroundedHeightmap& map) {
  for (CellId c = map.first; c < map.first + map.cells(); ++c) {
    if (model.tree.kind(c) == CellKind::kLink) return true;
    const CellId neighbour = model.links.of(c);
    if (neighbour != kNone && model.tree.node_of(neighbour) != model.tree.node_of(c)) return true;
  }
  return false;
}

// The heightmaps that the last event added.
struct Added {
  std::size_t empty = 0;     // that hold neither a height nor a link to one
  std::size_t unlinked = 0;  // none of whose cells links to a cell of another heightmap
  std::size_t planes = 0;    // different ground planes
  double largest_share = 0;  // of the heights of all, those of the largest
};

Added added_by_last(const Model& model) {
  const Tree& tree = model.tree;
  const Applied& last = tree.events().back();
  const auto maps = std::span(tree.nodes()).subspan(last.first, last.nodes);
  Added added;
  added.planes = planes_of(maps, tree.grid().spacing());
  double all = 0, most = 0;
  for (const GroundedHeightmap& map : maps) {
    double heights = 0;
    bool empty = true;
    for (CellId c = map.first; c < map.first + map.cells(); ++c) {
      heights += tree.kind(c) == CellKind::kHeight;
      empty = empty && tree.kind(tree.resolve(c)) == CellKind::kVoid;
    }
    added.empty += empty;
    added.unlinked += !is_linked(model, map);
    all += heights;
    most = std::max(most, heights);
  }
  added.largest_share = most / all;
  return added;
}

// Of the last event, from the tree's nodes and its list of events.
void record_host(const Tree& tree, std::string_view where, Recorder& recorder) {
  recorder.add(fmt::format("host_depth_{}", where), "", tree.nodes()[tree.events().back().host].depth);
}

Added record_added(const Model& model, std::size_t nodes_before, std::string_view where, Recorder& recorder) {
  recorder.add(fmt::format("added_{}", where), "", model.tree.nodes().size() - nodes_before);
  const Added added = added_by_last(model);
  recorder.add(fmt::format("empty_{}", where), "", added.empty);
  recorder.add(fmt::format("unlinked_{}", where), "", added.unlinked);
  recorder.add(fmt::format("planes_{}", where), "", added.planes);
  return added;
}

// On the root. Also, which the paper does not count, on a block of a fault so large that a smaller event lies
// wholly in it.
void measure_geotectonic(const Site& site, Kind kind, Recorder& recorder) {
  const auto record = [&](const Ght& tree, std::size_t nodes_before, std::string_view where) {
    const Added added = record_added(tree.model(), nodes_before, where, recorder);
    recorder.add(fmt::format("largest_share_{}", where), "", added.largest_share);
    record_host(tree.model().tree, where, recorder);
  };
  Ght fresh = plain_tree(site.ground);
  fresh.apply(single_event(site, kind));
  record(fresh, 1, "on_root");

  Ght faulted = plain_tree(site.ground);
  const events::Event fault = geotectonic_event(site, Kind::kNormalFault, site.middle, 1.2 * site.size);
  faulted.apply(fault);
  const events::Line line = std::get<events::DipFault>(fault).line();
  const glm::dvec2 block = line.plan({0.5 * line.length, 0.3 * site.size});
  const std::size_t before = faulted.model().tree.nodes().size();
  faulted.apply(geotectonic_event(site, kind, block, 0.3 * site.size));
  record(faulted, before, "on_block");
}

// Trees of one carving with sections of 3 to 12 sides, each in fresh ground; fewer if the mountains have no
// place for the next.
std::vector<Ght> carved(const Site& site, bool cave) {
  std::vector<Ght> trees;
  for (int sides = kFewestSides; sides <= kMostSides; ++sides) {
    Ght tree = plain_tree(site.ground);
    if (!carve(tree, site, cave, sides)) break;
    trees.push_back(std::move(tree));
  }
  return trees;
}

void measure_carvings(const std::vector<Ght>& trees, Recorder& recorder) {
  int sides = kFewestSides;
  for (const Ght& tree : trees) {
    const auto& nodes = tree.model().tree.nodes();
    const auto count = [&](Area area) {
      return static_cast<double>(std::count_if(nodes.begin(), nodes.end(),
                                               [&](const GroundedHeightmap& n) { return n.area == area; }));
    };
    record_added(tree.model(), 1, fmt::format("sides_{}", sides), recorder);
    recorder.add(fmt::format("borders_sides_{}", sides), "", count(Area::kBorder));
    recorder.add(fmt::format("indoor_sides_{}", sides), "", count(Area::kIndoor));
    ++sides;
  }
}

// A cave of four sides.
events::Carving square_cave(glm::dvec3 from, glm::dvec3 to) {
  events::Carving cave;
  cave.cave = true;
  cave.from = from;
  cave.to = to;
  cave.section = {{-1.3, -1.3}, {1.3, -1.3}, {1.3, 1.3}, {-1.3, 1.3}};
  return cave;
}

// On a plain with a fault 14 m high, a metre per sample: a cave in the fault's wall, and one down from the
// floor of that cave, whose error must name what is in its way.
void measure_hosts(Recorder& recorder) {
  constexpr int kSide = 65;
  const Heightfield plain{kSide, kSide, 1, 1, std::vector<float>(kSide * kSide, 20.0F), {}};
  Ght tree = plain_tree(plain);
  tree.apply(events::DipFault{false, {12, 32}, {52, 32}, 24, 14, 55});
  const std::size_t before = tree.model().tree.nodes().size();
  tree.apply(square_cave({32, 20, 28}, {32, 20, 18}));
  recorder.add("added_in_wall", "", tree.model().tree.nodes().size() - before);
  record_host(tree.model().tree, "in_wall", recorder);
  recorder.add("broken_in_wall", "", broken_invariants(tree.model()).size());
  bool named = false;
  try {
    tree.apply(square_cave({32, 17, 23}, {32, 14, 17}));
  } catch (const Error& error) {
    named = std::string_view(error.what()).find("another tunnel or cave") != std::string_view::npos;
  }
  recorder.add("cave_floor_refused_by_name", "", named ? 1 : 0);
}

std::vector<Case> cases(const RunOptions&) { return cases_by("event", kSpecs); }

void measure(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress&) {
  const int size = test_case.integer("size");
  const auto kind = static_cast<Kind>(test_case.parameters.choice("event"));
  std::vector<Ght> trees;
  // Not all mountains have a place for every carving.
  const Site site = first_site(kEventsAlong * size, size, options.seed, [&](const Site& tried) {
    if (is_carving(kind)) trees = carved(tried, kind == Kind::kCave);
    return !is_carving(kind) || trees.size() == kMostSides - kFewestSides + 1;
  });
  record_site(site, options.seed, recorder);
  if (is_carving(kind)) {
    measure_carvings(trees, recorder);
    if (kind == Kind::kCave) measure_hosts(recorder);
  } else {
    measure_geotectonic(site, kind, recorder);
  }
}

}  // namespace

extern const Experiment kCounts{"ght.counts", "§3.2: heightmaps that each event adds", kSpecs, cases,
                                measure};

}  // namespace terrabench::ght
