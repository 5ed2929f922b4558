// Whether the tree stays sound: its invariants after every event, and counts made here after every sequence.
#include <algorithm>
#include <array>

#include "experiments/cases.h"
#include "experiments/ght/site.h"
#include "representations/ght/invariants.h"
#include "terrain/error.h"

namespace terrabench::ght {
namespace {

using namespace events;

constexpr std::array<std::string_view, 5> kSequences{"single-events", "two-tunnels", "sequence", "rain",
                                                     "random"};
const std::array kSpecs{
    choice("events", kSequences, "the events that are played"),
    ParameterSpec{"particles", std::int64_t{200}, "", "in the rain", 1, 100000},
    ParameterSpec{"sequences", std::int64_t{100}, "", "random sequences of up to 12 events", 1, 100000},
};

// Squares per event. Random sequences have smaller terrains: more sequences in the time, and crowded events.
constexpr int kSize = 32, kRandomSize = 16;

// Plays events on trees and adds up what is wrong.
class Inspection {
 public:
  explicit Inspection(Recorder& recorder) : recorder_(recorder) {}

  void play(const Site& site, std::span<const Event> events) {
    Ght tree = plain_tree(site.ground);
    for (const Event& event : events) play(tree, event);
    finish(tree);
  }
  bool play(Ght& tree, const Event& event) {
    try {
      tree.apply(event);
    } catch (const Error& error) {
      if (error.code() != ExitCode::kBadInput) throw;
      ++refused_;
      return false;
    }
    ++applied_;
    broken_ += broken_invariants(tree.model()).size();
    unlinked_ += unlinked_boundary_cells(tree.model());
    return true;
  }
  // Once per sequence: the counts made here, and the edges of the closed mesh.
  void finish(const Ght& tree) {
    const Breaks breaks = count_breaks(tree.model());
    dangling_ += breaks.dangling;
    voids_seen_ += breaks.voids_seen;
    const EdgeReport edges = check_edges(tree.mesh({}));
    open_ += edges.open + edges.non_manifold + edges.misoriented;
    const Census all = census(tree.model());
    boundary_links_ += all.boundary_links;
    deepest_ = std::max(deepest_, all.deepest);
  }
  void write() const {
    using Count = std::pair<const char*, std::size_t>;
    for (const auto& [name, count] :
         {Count{"events", applied_}, Count{"refused_events", refused_},
          Count{"boundary_links", boundary_links_}, Count{"deepest_node", deepest_},
          Count{"dangling_links", dangling_}, Count{"unlinked_boundary_cells", unlinked_},
          Count{"voids_seen", voids_seen_}, Count{"open_edges", open_},
          Count{"broken_invariants", broken_}}) {
      recorder_.add(name, "", count);
    }
  }

 private:
  Recorder& recorder_;
  std::size_t applied_ = 0, refused_ = 0, broken_ = 0, unlinked_ = 0, open_ = 0, boundary_links_ = 0,
              dangling_ = 0, voids_seen_ = 0;
  std::uint32_t deepest_ = 0;
};

// An event of any kind anywhere; carvings go through the higher ground.
Event random_event(Dice& dice, const Site& site) {
  // One number per statement: compilers differ in the order in which they evaluate arguments.
  const auto point = [&] {
    const double x = dice.between(0.1, 0.9);
    return site.extent() * glm::dvec2(x, dice.between(0.1, 0.9));
  };
  const auto height = [&](glm::dvec2 p) {
    return site.ground.sample(static_cast<float>(p.x), static_cast<float>(p.y));
  };
  const double cell = site.ground.cell_x;
  const auto kind = static_cast<Kind>(dice.next() % kKinds);
  const glm::dvec2 from = point(), to = point();
  const double first = dice.between(0, 1), second = dice.between(0, 1), third = dice.between(0, 1);
  const auto within = [](double low, double high, double share) { return low + (high - low) * share; };
  switch (kind) {
    case Kind::kLinearErosion:
      return LinearErosion{from, to, within(0.5, 4, first) * cell, within(20, 50, second)};
    case Kind::kRadialErosion:
      return RadialErosion{{from.x, height(from), from.y},
                           glm::dvec3(within(2, 9, first), within(1, 5, second), within(2, 9, third)) * cell};
    case Kind::kLateralFault:
      return LateralFault{from, to, within(3, 12, first) * cell, within(0.5, 8, second) * cell};
    case Kind::kNormalFault:
    case Kind::kInverseFault:
      return DipFault{
          kind == Kind::kInverseFault, from, to, within(4, 14, first) * cell, within(0.5, 4, second) * cell,
          within(40, 85, third)};
    default:
      break;
  }
  glm::dvec2 top = from;
  for (int k = 0; k < 20; ++k) {
    const glm::dvec2 other = point();
    if (height(other) > height(top)) top = other;
  }
  const double angle = 2 * std::numbers::pi * first, radius = within(1.3, 2, second) * cell,
               y = height(top) - within(1.2, 2.5, third) * radius - cell;
  const glm::dvec2 along = dice.between(1, 4) * cell * glm::dvec2(std::cos(angle), std::sin(angle));
  Carving carving;
  carving.cave = kind == Kind::kCave;
  carving.from = {top.x - along.x, y, top.y - along.y};
  carving.to = {top.x + along.x, y, top.y + along.y};
  const auto sides = 3 + static_cast<int>(dice.next() % 8);
  for (int k = 0; k < sides; ++k) {
    const double turn = 2 * std::numbers::pi * (k + 0.5) / sides;
    carving.section.push_back(1.3 * radius * glm::dvec2(std::cos(turn), std::sin(turn)));
  }
  carving.roughness = 0.03 * radius;
  carving.seed = dice.next();
  return carving;
}

void play_random(int sequences, std::uint64_t seed, Inspection& inspection, Progress& progress) {
  progress.begin("random sequences", static_cast<std::size_t>(sequences));
  for (int s = 0; s < sequences; ++s) {
    const std::uint64_t each = seed * 1000003 + static_cast<std::uint64_t>(s);
    Dice dice(each);
    const Site site = make_site(kEventsAlong * kRandomSize, kRandomSize, each);
    Ght tree = plain_tree(site.ground);
    constexpr int kEvents = 12, kAttempts = 40;
    int done = 0;
    for (int k = 0; k < kAttempts && done < kEvents; ++k)
      done += inspection.play(tree, random_event(dice, site));
    inspection.finish(tree);
    progress.advance();
  }
}

}  // namespace

Breaks count_breaks(const Model& model) {
  const Tree& tree = model.tree;
  Breaks found;
  std::vector<char> seen(tree.cells(), 0);
  const auto see = [&](CellId c) {
    seen[c] = 1;
    found.voids_seen += tree.kind(c) != CellKind::kHeight;
  };
  for (int j = 0; j + 1 < tree.grid().depth; ++j) {
    for (int i = 0; i + 1 < tree.grid().width; ++i) {
      if (!model.surface.plain(tree, {i, j})) continue;
      for (const CellId c : ComposedSurface::corners(tree, {i, j})) see(c);
    }
  }
  model.surface.each_face([&](FaceId f) {
    for (const CellId c : model.surface.face(f)) see(c);
  });
  for (CellId c = 0; c < tree.cells(); ++c) {
    if (tree.kind(c) != CellKind::kLink) continue;
    const CellId end = tree.resolve(c);
    // The paper's null links, over the mouth of a carving, end in a void cell of its border.
    const bool null =
        tree.kind(end) == CellKind::kVoid && tree.nodes()[tree.node_of(end)].area == Area::kBorder;
    found.dangling += !null && seen[end] == 0;
  }
  return found;
}

namespace {

std::vector<Case> cases(const RunOptions& options) {
  const bool paper = options.profile == Profile::kPaper;
  return cases_by(
      "events", kSpecs,
      {{"sequences", std::int64_t{paper ? 300 : 30}}, {"particles", std::int64_t{paper ? 1000 : 200}}});
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const std::string& what = at.parameters.text("events");
  const Site site = make_site(kEventsAlong * kSize, kSize, options.seed);
  recorder.terrain("diamond-square", checksum(site.ground));
  Inspection inspection(recorder);
  if (what == "single-events") {
    for (int k = 0; k < kKinds; ++k) {
      const Event event = single_event(site, static_cast<Kind>(k));
      inspection.play(site, {&event, 1});
    }
  } else if (what == "two-tunnels") {
    inspection.play(site, two_tunnels(site));
  } else if (what == "sequence") {
    inspection.play(site, overlapping_events(site));
  } else if (what == "rain") {
    Ght tree = plain_tree(site.ground);
    Rain rain(site.ground, options.seed);
    for (int k = at.integer("particles"); k > 0; --k) inspection.play(tree, rain.next(tree));
    inspection.finish(tree);
  } else {
    play_random(at.integer("sequences"), options.seed, inspection, progress);
  }
  inspection.write();
}

}  // namespace

extern const Experiment kContinuity{
    "ght.continuity", "§3.2: dangling links, unlinked boundary cells and open edges", kSpecs, cases, measure};

}  // namespace terrabench::ght
