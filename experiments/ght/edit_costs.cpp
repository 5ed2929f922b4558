// What an event costs, beside layered stacks and OpenVDB's voxels doing the same edit. The tree is told the
// event. They are told, column by column, what it leaves: for erosions and carvings the air that it makes, so
// that the edit is a subtraction; for faults, which move ground sideways and which neither has a word for,
// the air and the ground of every column that changes. Finding that out is not in their times; in the tree's
// it is.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/ght/ght.h"
#include "experiments/ght/processor_time.h"
#include "experiments/ght/site.h"
#include "terrain/events/evaluate.h"

namespace terrabench::ght {
namespace {

using namespace events;

const std::array kEditSpecs{
    ParameterSpec{"n", std::int64_t{128}, "cells", "along each side of the terrain", 128, 16384},
    ParameterSpec{"size", std::int64_t{32}, "cells", "length of the event", 32, 4096},
};
const std::array kReachSpecs{
    ParameterSpec{"n", std::int64_t{1024}, "cells", "along each side of the terrain", 128, 16384},
    ParameterSpec{"size", std::int64_t{32}, "cells", "length of the events", 32, 4096},
};

// One is enough of what takes seconds.
constexpr int kMostSamples = 7;
constexpr double kSecondsOfSamples = 0.1;

// Calls sample(), which returns seconds, until there are enough of them.
template <class Sample>
void sample_times(const Sample& sample) {
  double sum = 0;
  for (int k = 0; k < kMostSamples && sum < kSecondsOfSamples; ++k) sum += sample();
}

double used(const Memory& memory) { return static_cast<double>(memory.payload + memory.index); }

// What columns are told, and what takes it back.
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
  std::vector<float> x, z;  // columns that change
};

// Columns stand at the samples, as the structures' own do.
Strokes strokes_of(const Site& site, const Event& event) {
  const Heightfield& ground = site.ground;
  const Evaluation after(std::make_shared<Sculpture>(Sculpture{ground, {event}}));
  PlanBox box = plan_box(event);
  const bool moves = std::holds_alternative<DipFault>(event) || std::holds_alternative<LateralFault>(event);
  if (std::holds_alternative<Carving>(event)) {  // how far it goes on is the ground's affair
    box.low -= site.size;
    box.high += site.size;
  }
  const auto index = [&](double metres, int samples) {
    return std::clamp(static_cast<int>(std::lround(metres / ground.cell_x)), 0, samples - 1);
  };
  Strokes strokes;
  std::vector<Stretch> stretches;
  for (int j = index(box.low.y, ground.depth); j <= index(box.high.y, ground.depth); ++j) {
    for (int i = index(box.low.x, ground.width); i <= index(box.high.x, ground.width); ++i) {
      const float x = static_cast<float>(i) * ground.cell_x, z = static_cast<float>(j) * ground.cell_z;
      after.column({x, z}, stretches);
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
    double length = floor;  // so that floors cancel out
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

  void measure(const Strokes& strokes, std::span<const double> tree_lengths, double cell,
               std::string_view suffix, Recorder& recorder) {
    bool first = true;
    sample_times([&] {
      const double before = used(structure_->memory());
      const double time = processor_seconds([&] { strokes.edit.paint(*structure_); });
      recorder.add(fmt::format("{}_time{}", name_, suffix), "s", time);
      if (std::exchange(first, false)) {
        // Of an untouched structure only: what was taken back leaves nodes behind.
        if (suffix.empty()) {
          recorder.add(fmt::format("{}_bytes", name_), "B", used(structure_->memory()) - before);
        }
        const std::vector<double> lengths = solid_lengths(*structure_, strokes);
        double differences = 0;
        for (std::size_t c = 0; c < lengths.size(); ++c)
          differences += std::abs(lengths[c] - tree_lengths[c]);
        recorder.add(fmt::format("{}_difference{}", name_, suffix), "cells",
                     differences / static_cast<double>(lengths.size()) / cell);
      }
      strokes.undo.paint(*structure_);
      return time;
    });
  }

 private:
  std::string_view name_;
  std::unique_ptr<Representation> structure_;
};

class Comparison {
 public:
  Comparison(const Site& site, Recorder& recorder, Progress& progress)
      : site_(site), recorder_(recorder), tree_(plain_tree(site.ground)) {
    TerrainSource source;
    source.name = "diamond-square";
    source.checksum = checksum(site.ground);
    source.heights = site.ground;
    recorder.terrain(source);
    peers_.emplace_back("layered_stack", "stack", source, progress);
    peers_.emplace_back("voxel", "voxel", source, progress);
  }

  void measure(Kind kind, std::string_view suffix) {
    const Event event = single_event(site_, kind);
    std::vector<double> lengths;
    const Strokes strokes = strokes_of(site_, event);
    recorder_.add(fmt::format("columns{}", suffix), "", static_cast<double>(strokes.x.size()));
    sample_times([&] {
      const auto held = std::make_unique<Ght>(tree_);  // memory() counts its own block
      Ght& tree = *held;
      // The arena is full: the first event of all makes it larger, at a cost that later ones share.
      recorder_.add(fmt::format("first_event_time{}", suffix), "s",
                    processor_seconds([&] { tree.apply(pebble()); }));
      const double before = used(tree.memory());
      const std::uint32_t cells = tree.model().tree.cells();
      const double time = processor_seconds([&] { tree.apply(event); });
      recorder_.add(fmt::format("ght_time{}", suffix), "s", time);
      if (lengths.empty()) {
        recorder_.add(fmt::format("ght_bytes{}", suffix), "B", used(tree.memory()) - before);
        recorder_.add(fmt::format("ght_cells{}", suffix), "", tree.model().tree.cells() - cells);
        lengths = solid_lengths(tree, strokes);
      }
      return time;
    });
    for (Peer& peer : peers_) peer.measure(strokes, lengths, site_.ground.cell_x, suffix, recorder_);
  }

 private:
  // A crater of a few cells, out of everything's way.
  Event pebble() const {
    const double cell = site_.ground.cell_x, at = 6 * cell;
    return RadialErosion{{at, site_.ground.at(6, 6), at}, {2 * cell, cell, 2 * cell}};
  }

  const Site& site_;
  Recorder& recorder_;
  Ght tree_;
  std::vector<Peer> peers_;
};

}  // namespace

constinit const std::span<const ParameterSpec> kEditParameters = kEditSpecs;
constinit const std::span<const ParameterSpec> kReachParameters = kReachSpecs;

std::vector<Case> edit_cases(const RunOptions& options) {
  std::vector<Case> cases;
  const std::int64_t largest = options.profile == Profile::kPaper ? 4096 : 1024;
  for (std::int64_t n = 128; n <= largest; n *= 2) {
    for (int k = 0; k < kKinds; ++k) {
      Case& added = cases.emplace_back(
          Case{fmt::format("n={}/{}", n, name(static_cast<Kind>(k))), Parameters(kEditParameters), ""});
      added.parameters.set("n", n);
    }
  }
  return cases;
}

void measure_edit(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const std::string what = at.name.substr(0, at.name.find(' '));
  const Site site = make_site(static_cast<int>(at.parameters.integer("n")),
                              static_cast<int>(at.parameters.integer("size")), options.seed);
  Comparison(site, recorder, progress).measure(kind_named(what.substr(what.find('/') + 1)), "");
}

std::vector<Case> reach_cases(const RunOptions&) {
  std::vector<Case> cases;
  // Of twice that size the inverse fault's end is a gap that the tree refuses to close.
  constexpr std::int64_t kLargest = 256;
  for (std::int64_t size = 32; size <= kLargest; size *= 2) {
    Case& added = cases.emplace_back(Case{fmt::format("size={}", size), Parameters(kReachParameters), ""});
    added.parameters.set("size", size);
  }
  return cases;
}

void measure_reach(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const Site site = make_site(static_cast<int>(at.parameters.integer("n")),
                              static_cast<int>(at.parameters.integer("size")), options.seed);
  Comparison comparison(site, recorder, progress);
  progress.begin(at.name, kKinds);
  for (int k = 0; k < kKinds; ++k) {
    progress.advance();
    // Finer mountains are rougher about a mouth, until the tree refuses it.
    if (is_carving(static_cast<Kind>(k))) continue;
    std::string suffix = fmt::format("_{}", name(static_cast<Kind>(k)));
    std::replace(suffix.begin(), suffix.end(), '-', '_');
    comparison.measure(static_cast<Kind>(k), suffix);
  }
}

}  // namespace terrabench::ght
