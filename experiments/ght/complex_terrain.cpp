// Terrains of many events (§4.2): the overlapping sequence and the rain of particles.
#include <array>
#include <random>

#include "experiments/cases.h"
#include "experiments/ght/site.h"
#include "experiments/samples.h"
#include "experiments/stopwatch.h"
#include "representations/ght/invariants.h"
#include "terrain/events/event_file.h"

namespace terrabench::ght {
namespace {

using namespace events;

constexpr std::array<std::string_view, 2> kTerrains{"sequence", "rain"};
const std::array kSpecs{
    choice("events", kTerrains, "the events that shape the terrain"),
    ParameterSpec{"n", std::int64_t{128}, "cells", "along each side of the terrain", 128, 4096},
    ParameterSpec{"particles", std::int64_t{10000}, "", "in the rain", 1, 20000},
};

// Queries of columns at random places, on one thread.
void time_columns(const Ght& tree, std::uint64_t seed, Recorder& recorder) {
  constexpr std::size_t kColumns = 1 << 20, kBatch = 1 << 14;
  std::mt19937 random(static_cast<std::mt19937::result_type>(seed));
  const Bounds bounds = tree.bounds();
  std::vector<float> x(kColumns), z(kColumns);
  for (std::size_t c = 0; c < kColumns; ++c) {
    x[c] = 0x1p-32F * static_cast<float>(random()) * bounds.high.x;
    z[c] = 0x1p-32F * static_cast<float>(random()) * bounds.high.z;
  }
  SpanSink sink;
  for (int sample = -1; sample < kSamples; ++sample) {  // the first one warms up
    const double time = processor_seconds([&] {
      for (std::size_t c = 0; c < kColumns; c += kBatch) {
        sink.clear();
        tree.spans({std::span(x).subspan(c, kBatch), std::span(z).subspan(c, kBatch)}, sink);
      }
    });
    if (sample >= 0) recorder.add("columns_per_second", "1/s", static_cast<double>(kColumns) / time);
  }
}

std::vector<std::byte> bytes_of(const Ght& tree) {
  ByteSink sink;
  tree.save(sink);
  return {sink.bytes().begin(), sink.bytes().end()};
}

std::vector<Case> cases(const RunOptions&) {
  std::vector<Case> cases = cases_by("events", kSpecs);
  cases[1].parameters.set("n", std::int64_t{1024});
  cases.push_back(cases[0]);
  cases[2].name = "sequence-513";
  cases[2].parameters.set("n", std::int64_t{512});
  return cases;
}

void measure(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const int n = test_case.integer("n");
  const Site site = recorded_site(n, n / kEventsAlong, options.seed, recorder);
  const bool rains = test_case.parameters.text("events") == "rain";
  std::vector<Event> events;
  if (!rains) events = overlapping_events(site);
  // On the heap, as memory() counts the tree's own block.
  const auto held = std::make_unique<Ght>(plain_tree(site.ground));
  Ght& tree = *held;
  const double fresh = static_cast<double>(tree.memory().total());
  for (int sample = 0; sample < kSamples; ++sample) {
    tree = plain_tree(site.ground);
    if (rains) {
      events.clear();
      Rain rain(site.ground, options.seed);
      recorder.add("time", "s", processor_seconds([&] {
                     for (int k = test_case.integer("particles"); k > 0; --k) {
                       events.push_back(rain.next(tree));
                       tree.apply(events.back());
                     }
                   }));
    } else {
      recorder.add("time", "s", processor_seconds([&] {
                     for (const Event& event : events) tree.apply(event);
                   }));
    }
  }
  const Census all = census(tree.model());
  const Memory memory = tree.memory();
  recorder.add("events", "", events.size());
  recorder.add("heightmaps", "", all.nodes);
  recorder.add("deepest_node", "", all.deepest);
  recorder.add("cells", "", all.heights + all.links + all.voids);
  recorder.add("heights", "", all.heights);
  recorder.add("links", "", all.links);
  recorder.add("voids", "", all.voids);
  recorder.add("fresh_bytes", "B", fresh);
  recorder.add("bytes", "B", memory.payload + memory.index);
  recorder.add("slack_bytes", "B", memory.slack);
  const std::vector<std::byte> file = bytes_of(tree);
  recorder.add("file_bytes", "B", file.size());

  // As text, and built again from the text.
  const std::string text = to_text(Script{"diamond-square", site.seed, n + 1, events, {}});
  recorder.add("text_bytes", "B", text.size());
  const Script again = parse_script(text, "ght.complex");
  Ght repeated = plain_tree(site.ground);
  for (const Event& event : again.events) repeated.apply(event);
  recorder.add("differs_from_text", "", bytes_of(repeated) == file ? 0 : 1);
  time_columns(tree, options.seed, recorder);
  progress.advance();
}

}  // namespace

extern const Experiment kComplex{"ght.complex", "§4.2: the sequence of events and the rain of particles",
                                 kSpecs,        cases,
                                 measure,       Experiment::kTimed};

}  // namespace terrabench::ght
