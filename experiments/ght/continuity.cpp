// Whether the tree stays sound: its invariants after every event, and counts made here after every sequence.
#include <algorithm>
#include <array>

#include "experiments/cases.h"
#include "experiments/ght/random_events.h"
#include "representations/ght/invariants.h"
#include "terrain/error.h"

namespace terrabench::ght {
namespace {

using namespace events;

constexpr std::array<std::string_view, 6> kSequences{"single-events", "two-tunnels", "sequence",
                                                     "rain",          "random",      "random-wild"};
const std::array kSpecs{
    choice("events", kSequences, "the events that are played"),
    ParameterSpec{"particles", std::int64_t{200}, "", "in the rain", 1, 100000},
    ParameterSpec{"sequences", std::int64_t{100}, "", "random sequences of 12 attempted events", 1, 100000},
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
      error_ = error.what();
      return false;
    }
    ++applied_;
    broken_ += broken_invariants(tree.model()).size();
    unlinked_ += unlinked_boundary_cells(tree.model());
    return true;
  }
  // Tries a random event after those that the tree took; appends it to them if the tree takes it too.
  void try_random(Ght& tree, const Site& site, const Event& event, std::vector<Event>& before) {
    const bool meets = meets_fold(site, tree, event, before);
    meeting_ += meets;
    if (play(tree, event)) {
      tunnels_ += kind(event) == Kind::kTunnel;
      before.push_back(event);
      return;
    }
    const Refusal why = why_refused(site, event, before, error_);
    ++why_[static_cast<std::size_t>(why)];
    const bool explained = why == Refusal::kImpossible || why == Refusal::kBorder || meets;
    unexplained_ += !explained;
  }
  // Once per sequence: the counts made here, and the edges of the closed mesh.
  void finish(const Ght& tree) {
    const Breaks breaks = count_breaks(tree.model());
    dangling_ += breaks.dangling;
    voids_seen_ += breaks.voids_seen;
    const EdgeReport edges = check_edges(tree.mesh({}));
    open_ += edges.open + edges.non_manifold + edges.misoriented;
    const Census all = census(tree.model());
    const LinkReport links = check_boundary_links(tree.model());
    boundary_links_ += links.stored;
    derived_links_ += links.derived;
    wrong_links_ += links.wrong;
    deepest_ = std::max(deepest_, all.deepest);
  }
  void write() const {
    using Count = std::pair<const char*, std::size_t>;
    for (const auto& [name, count] :
         {Count{"events", applied_}, Count{"refused_events", refused_},
          Count{"boundary_links", boundary_links_}, Count{"derived_links", derived_links_},
          Count{"wrong_links", wrong_links_}, Count{"deepest_node", deepest_},
          Count{"dangling_links", dangling_}, Count{"unlinked_boundary_cells", unlinked_},
          Count{"voids_seen", voids_seen_}, Count{"open_edges", open_},
          Count{"broken_invariants", broken_}}) {
      recorder_.add(name, "", count);
    }
  }

  // Of random events: the reasons of those that were refused.
  void write_refusals() const {
    recorder_.add("taken_tunnel", "", tunnels_);
    std::size_t refused = 0;
    for (std::size_t k = 0; k < why_.size(); ++k) {
      recorder_.add("refused_" + std::string(kRefusals[k]), "", why_[k]);
      refused += why_[k];
    }
    const std::size_t by_tree = refused - why_[static_cast<std::size_t>(Refusal::kImpossible)];
    const auto possible = static_cast<double>(applied_ + by_tree);
    recorder_.add("refused_share", "", static_cast<double>(by_tree) / possible);
    recorder_.add("meeting_share", "",
                  static_cast<double>(meeting_) / static_cast<double>(applied_ + refused));
    recorder_.add("unexplained_refusals", "", unexplained_);
    recorder_.add("unexplained_share", "", static_cast<double>(unexplained_) / possible);
  }

 private:
  Recorder& recorder_;
  std::size_t applied_ = 0, refused_ = 0, broken_ = 0, unlinked_ = 0, open_ = 0, boundary_links_ = 0,
              dangling_ = 0, voids_seen_ = 0, derived_links_ = 0, wrong_links_ = 0;
  std::string error_;  // of the last refusal
  std::array<std::size_t, std::size(kRefusals)> why_{};
  std::size_t tunnels_ = 0, unexplained_ = 0;
  std::size_t meeting_ = 0;  // events near an overhang or carving, taken or not
  std::uint32_t deepest_ = 0;
};

// How many kinds of event a sequence has, and how many pairs of its events touch the same ground.
void write_overlaps(std::span<const Event> events, Recorder& recorder) {
  std::array<bool, kKinds> seen{};
  std::size_t overlaps = 0;
  for (auto event = events.begin(); event != events.end(); ++event) {
    seen[static_cast<std::size_t>(kind(*event))] = true;
    overlaps += static_cast<std::size_t>(std::count_if(event + 1, events.end(), [&](const Event& later) {
      return plan_box(*event).meets(plan_box(later));
    }));
  }
  recorder.add("kinds", "", std::count(seen.begin(), seen.end(), true));
  recorder.add("overlapping_pairs", "", overlaps);
}

// Twelve attempts per terrain: as many events as in the planned sequence, if none is refused.
void play_random(int sequences, std::uint64_t seed, bool wild, Inspection& inspection, Progress& progress) {
  constexpr int kAttempts = 12;
  progress.begin("random sequences", static_cast<std::size_t>(sequences));
  for (int s = 0; s < sequences; ++s) {
    const std::uint64_t each = seed * 1000003 + static_cast<std::uint64_t>(s);
    Dice dice(each);
    const Site site = make_site(kEventsAlong * kRandomSize, kRandomSize, each);
    Ght tree = plain_tree(site.ground);
    std::vector<Event> taken;
    for (int k = 0; k < kAttempts; ++k) {
      const Event event = wild ? wild_event(dice, site) : sane_event(dice, site, tree, taken);
      inspection.try_random(tree, site, event, taken);
    }
    inspection.finish(tree);
    progress.advance();
  }
}

std::vector<Case> cases(const RunOptions& options) {
  const bool paper = options.profile == Profile::kPaper;
  return cases_by(
      "events", kSpecs,
      {{"sequences", std::int64_t{paper ? 300 : 30}}, {"particles", std::int64_t{paper ? 1000 : 200}}});
}

void measure(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const std::string& what = test_case.parameters.text("events");
  const Site site = recorded_site(kEventsAlong * kSize, kSize, options.seed, recorder);
  Inspection inspection(recorder);
  if (what == "single-events") {
    for (int k = 0; k < kKinds; ++k) {
      const Event event = single_event(site, static_cast<Kind>(k));
      inspection.play(site, {&event, 1});
    }
  } else if (what == "two-tunnels") {
    inspection.play(site, two_tunnels(site));
  } else if (what == "sequence") {
    const std::vector<Event> events = overlapping_events(site);
    inspection.play(site, events);
    write_overlaps(events, recorder);
  } else if (what == "rain") {
    Ght tree = plain_tree(site.ground);
    Rain rain(site.ground, options.seed);
    for (int k = test_case.integer("particles"); k > 0; --k) inspection.play(tree, rain.next(tree));
    inspection.finish(tree);
  } else {
    play_random(test_case.integer("sequences"), options.seed, what == "random-wild", inspection, progress);
    inspection.write_refusals();
  }
  inspection.write();
}

}  // namespace

extern const Experiment kContinuity{
    "ght.continuity", "§3.2: dangling links, unlinked boundary cells and open edges", kSpecs, cases, measure};

}  // namespace terrabench::ght
