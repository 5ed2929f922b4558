// The cost of an event, compared with layered stacks and OpenVDB's voxels doing the same edit. The tree gets
// the event. Stacks and voxels get its result, column by column: for erosions and carvings the new air, so
// that the edit is a subtraction; for faults, which move ground sideways, the air and the ground of every
// column that changes. Computing that result is part of the tree's times. For stacks and voxels it is timed
// too: their "whole" times add the evaluation of the columns that change. Finding out which these are is not
// in any time of stacks and voxels.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/experiment.h"
#include "experiments/ght/site.h"
#include "experiments/samples.h"
#include "experiments/stopwatch.h"
#include "terrain/events/evaluate.h"

namespace terrabench::ght {
namespace {

using namespace events;

const std::array kEditSpecs{
    choice("event", event_names(), "the event that is measured"),
    ParameterSpec{"n", std::int64_t{128}, "cells", "along each side of the terrain", 128, 16384},
    ParameterSpec{"size", std::int64_t{32}, "cells", "length of the event", 32, 4096},
};
const std::array kReachSpecs{
    ParameterSpec{"n", std::int64_t{1024}, "cells", "along each side of the terrain", 128, 16384},
    ParameterSpec{"size", std::int64_t{32}, "cells", "length of the events", 32, 4096},
};

double used(const Memory& memory) { return static_cast<double>(memory.payload + memory.index); }

// The edit of the columns that change, and the edit that undoes it.
struct Strokes {
  struct List {
    std::vector<float> x, z;
    std::vector<Span> spans;
    void add(float at_x, float at_z, double bottom, double top, Material material) {
      if (!(bottom < top)) return;
      x.push_back(at_x);
      z.push_back(at_z);
      spans.push_back({static_cast<float>(bottom), static_cast<float>(top), material});
    }
    void paint(Representation& on) const { on.edit({x, z}, spans); }
  };
  List edit, undo;
  std::vector<float> x, z;  // of the columns that change
  std::shared_ptr<const Evaluation> after;

  // Processor seconds to evaluate them.
  double time_columns() const {
    std::vector<Stretch> stretches;
    return processor_seconds([&] {
      for (std::size_t c = 0; c < x.size(); ++c) after->column({x[c], z[c]}, stretches);
    });
  }
};

// Columns stand at the samples, as those of the structures do.
Strokes strokes_of(const Site& site, const Event& event) {
  const Heightfield& ground = site.ground;
  Strokes strokes;
  strokes.after = std::make_shared<Evaluation>(std::make_shared<Sculpture>(Sculpture{ground, {event}}));
  PlanBox box = plan_box(event);
  const bool moves = std::holds_alternative<DipFault>(event) || std::holds_alternative<LateralFault>(event);
  if (std::holds_alternative<Carving>(event)) {  // how far it reaches depends on the ground
    box.low -= site.size;
    box.high += site.size;
  }
  const auto index = [&](double metres, int samples) {
    return std::clamp(static_cast<int>(std::lround(metres / ground.cell_x)), 0, samples - 1);
  };
  std::vector<Stretch> stretches;
  for (int j = index(box.low.y, ground.depth); j <= index(box.high.y, ground.depth); ++j) {
    for (int i = index(box.low.x, ground.width); i <= index(box.high.x, ground.width); ++i) {
      const float x = static_cast<float>(i) * ground.cell_x, z = static_cast<float>(j) * ground.cell_z;
      strokes.after->column({x, z}, stretches);
      const float before = ground.at(i, j);
      if (stretches.size() == 1 && std::abs(stretches[0].top - before) < 1e-3) continue;
      strokes.x.push_back(x);
      strokes.z.push_back(z);
      double air_top = HUGE_VAL;
      for (const Stretch& s : stretches) {  // from the top down
        strokes.edit.add(x, z, s.top, air_top, Material::kAir);
        if (moves) strokes.edit.add(x, z, s.bottom, s.top, Material::kBedrock);
        air_top = s.bottom;
      }
      strokes.undo.add(x, z, -HUGE_VAL, before, Material::kBedrock);
      strokes.undo.add(x, z, before, HUGE_VAL, Material::kAir);
    }
  }
  return strokes;
}

// Solid metres in each of the columns that change.
std::vector<double> solid_lengths(const Representation& structure, const Strokes& strokes) {
  SpanSink sink;
  structure.spans({strokes.x, strokes.z}, sink);
  std::vector<double> lengths;
  const double floor = structure.bounds().low.y;
  for (std::size_t c = 0; c < strokes.x.size(); ++c) {
    double length = floor;  // so that different floors cancel out
    for (const Span& s : sink.column(c)) length += static_cast<double>(s.top) - s.bottom;
    lengths.push_back(length);
  }
  return lengths;
}

class Peer {
 public:
  Peer(std::string_view type, std::string_view name, const TerrainSource& source, Progress& progress)
      : name_(name) {
    const RepresentationType& method = representation(type);
    structure_ = method.build(source, Parameters(method.parameters), progress);
  }

  // Takes one sample, `first` on the untouched structure: an undone edit leaves nodes behind. Records the
  // whole time as a metric with this suffix; without one, all else too. `tree_time`: of the same round.
  void sample(const Strokes& strokes, std::span<const double> tree_lengths, double tree_time, double cell,
              bool first, std::string_view suffix, Recorder& recorder) {
    const double before = used(structure_->memory()), columns_time = strokes.time_columns();
    const double time = processor_seconds([&] { strokes.edit.paint(*structure_); });
    const double whole = columns_time + time;
    recorder.add(fmt::format("{}_whole_time{}", name_, suffix), "s", whole);
    if (suffix.empty()) {
      recorder.add(fmt::format("{}_time", name_), "s", time);
      recorder.add_varying(fmt::format("ght_per_{}_time", name_), "", tree_time / whole);
      if (first) {
        recorder.add(fmt::format("{}_bytes", name_), "B", used(structure_->memory()) - before);
        record_difference(solid_lengths(*structure_, strokes), tree_lengths, cell, recorder);
      }
    }
    strokes.undo.paint(*structure_);
  }

 private:
  void record_difference(std::span<const double> lengths, std::span<const double> tree_lengths, double cell,
                         Recorder& recorder) const {
    double differences = 0;
    for (std::size_t c = 0; c < lengths.size(); ++c) differences += std::abs(lengths[c] - tree_lengths[c]);
    recorder.add(fmt::format("{}_difference", name_), "cells",
                 differences / static_cast<double>(lengths.size()) / cell);
  }

  std::string_view name_;
  std::unique_ptr<Representation> structure_;
};

class Comparison {
 public:
  Comparison(const Site& site, Recorder& recorder, Progress& progress)
      : site_(site), recorder_(recorder), tree_(plain_tree(site.ground)) {
    const TerrainSource source = source_of("diamond-square", site.ground);
    peers_.emplace_back("layered_stack", "stack", source, progress);
    peers_.emplace_back("voxel", "voxel", source, progress);
  }

  // Records times as metrics with this suffix, those of the peers if asked for; without a suffix, all else
  // too. All structures take turns.
  void measure(Kind kind, std::string_view suffix, bool peers) {
    const Event event = single_event(site_, kind);
    Strokes strokes;
    if (peers) strokes = strokes_of(site_, event);
    if (suffix.empty()) recorder_.add("columns", "", strokes.x.size());
    std::vector<double> lengths;
    for (int k = 0; k < kSamples; ++k) {
      const double tree_time = sample_tree(event, strokes, suffix, lengths);
      if (!peers) continue;
      for (Peer& peer : peers_)
        peer.sample(strokes, lengths, tree_time, site_.ground.cell_x, k == 0, suffix, recorder_);
    }
  }

 private:
  // Returns its seconds. `lengths`: those of the first sample.
  double sample_tree(const Event& event, const Strokes& strokes, std::string_view suffix,
                     std::vector<double>& lengths) {
    const bool alone = suffix.empty();
    const auto held = std::make_unique<Ght>(tree_);  // on the heap, as memory() counts the tree's own block
    Ght& tree = *held;
    // The tree's arrays start without spare capacity. The first event pays for their growth, so it is timed
    // separately.
    const double first = processor_seconds([&] { tree.apply(pebble()); });
    if (alone) recorder_.add("first_event_time", "s", first);
    const double before = used(tree.memory());
    const std::uint32_t cells = tree.model().tree.cells();
    const double time = processor_seconds([&] { tree.apply(event); });
    recorder_.add(fmt::format("ght_time{}", suffix), "s", time);
    if (alone && lengths.empty()) {
      recorder_.add("ght_bytes", "B", used(tree.memory()) - before);
      recorder_.add("ght_cells", "", tree.model().tree.cells() - cells);
      lengths = solid_lengths(tree, strokes);
    }
    return time;
  }

  // A crater of a few cells, away from the measured event.
  Event pebble() const {
    const double cell = site_.ground.cell_x, at = 6 * cell;
    return RadialErosion{{at, site_.ground.at(6, 6), at}, {2 * cell, cell, 2 * cell}};
  }

  const Site& site_;
  Recorder& recorder_;
  Ght tree_;
  std::vector<Peer> peers_;
};

Site site_of(const Case& test_case, const RunOptions& options, Recorder& recorder) {
  return recorded_site(test_case.integer("n"), test_case.integer("size"), options.seed, recorder);
}

std::vector<Case> edit_cases(const RunOptions& options) {
  std::vector<Case> cases;
  const std::int64_t largest = options.profile == Profile::kPaper ? 4096 : 1024;
  for (std::int64_t n = 128; n <= largest; n *= 2) {
    for (const std::string_view event : event_names()) {
      cases.push_back(
          {fmt::format("n={}/{}", n, event), {kEditSpecs, {{"event", std::string(event)}, {"n", n}}}});
    }
  }
  return cases;
}

void measure_edit(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const Site site = site_of(test_case, options, recorder);
  Comparison(site, recorder, progress)
      .measure(static_cast<Kind>(test_case.parameters.choice("event")), "", true);
}

std::vector<Case> reach_cases(const RunOptions&) {
  std::vector<Case> cases;
  // At twice that size the tree refuses the inverse fault: its end would be a gap that cannot be closed.
  constexpr std::int64_t kLargest = 256;
  for (std::int64_t size = 32; size <= kLargest; size *= 2) {
    cases.push_back({fmt::format("size={}", size), {kReachSpecs, {{"size", size}}}});
  }
  return cases;
}

void measure_reach(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const Site site = site_of(test_case, options, recorder);
  Comparison comparison(site, recorder, progress);
  progress.begin(test_case.name, kKinds);
  for (int k = 0; k < kKinds; ++k) {
    progress.advance();
    const auto kind = static_cast<Kind>(k);
    // Finer mountains are rougher around a mouth, and the tree refuses the carving.
    if (is_carving(kind)) continue;
    // The plot shows two of the events in all structures.
    comparison.measure(kind, metric_of("", kind), kind == Kind::kRadialErosion || kind == Kind::kNormalFault);
  }
}

}  // namespace

extern const Experiment kEdits{"ght.edits",  "§4: an event on ever larger terrains, beside stacks and voxels",
                               kEditSpecs,   edit_cases,
                               measure_edit, Experiment::kTimed};
extern const Experiment kReach{"ght.reach",   "§4: ever larger events, beside stacks and voxels",
                               kReachSpecs,   reach_cases,
                               measure_reach, Experiment::kTimed};

}  // namespace terrabench::ght
