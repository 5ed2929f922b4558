// What lies over what: columns of more than one solid interval, and the air under the topmost surface, which
// a heightmap of the same terrain fills.
#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/experiment.h"
#include "experiments/ght/site.h"
#include "terrain/events/evaluate.h"

namespace terrabench::ght {
namespace {

using namespace events;

const std::array kSpecs{
    ParameterSpec{"size", std::int64_t{32}, "cells", "length of an event; the terrain is 4 times as long", 32,
                  512},
    ParameterSpec{"columns_a_cell", std::int64_t{4}, "", "asked along each side of a cell", 1, 64},
};

struct Hollow {
  std::size_t overhangs = 0;  // columns with more than one interval
  std::size_t most = 0;       // intervals
  std::size_t manifold = 0;   // columns with more than two
  double air = 0;             // metres, under the top, of all columns

  // Intervals from below: bottoms and tops.
  template <class Intervals>
  void column(const Intervals& intervals, std::size_t count) {
    overhangs += count > 1;
    manifold += count > 2;
    most = std::max(most, count);
    for (std::size_t k = 1; k < count; ++k) air += intervals(k).first - intervals(k - 1).second;
  }
};

std::vector<Case> cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const char* const name :
       {"no-event", "normal-fault", "inverse-fault", "tunnel", "cave", "two-tunnels", "sequence"}) {
    cases.push_back(
        {name, {kSpecs, {{"columns_a_cell", std::int64_t{options.profile == Profile::kPaper ? 8 : 4}}}}, ""});
  }
  return cases;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress&) {
  const std::string what = at.name.substr(0, at.name.find(' '));
  const auto size = static_cast<int>(at.parameters.integer("size"));
  const auto per_cell = static_cast<int>(at.parameters.integer("columns_a_cell"));
  const Site site = make_site(kEventsAlong * size, size, options.seed);
  auto sculpture = std::make_shared<Sculpture>(Sculpture{site.ground, {}});
  if (what == "two-tunnels") {
    sculpture->events = two_tunnels(site);
  } else if (what == "sequence") {
    sculpture->events = overlapping_events(site);
  } else if (what != "no-event") {
    sculpture->events = {single_event(site, kind_named(what))};
  }
  Ght tree = plain_tree(site.ground);
  for (const Event& event : sculpture->events) tree.apply(event);
  const Evaluation evaluation(sculpture);
  recorder.terrain("diamond-square", checksum(site.ground));

  Hollow found, truth;
  const int columns = (site.ground.width - 1) * per_cell;
  const double step = static_cast<double>(site.ground.cell_x) / per_cell;
  std::vector<float> x(static_cast<std::size_t>(columns)), z(x.size());
  std::vector<Stretch> stretches;
  SpanSink sink;
  for (int j = 0; j < columns; ++j) {
    for (int i = 0; i < columns; ++i) x[i] = static_cast<float>((i + 0.5) * step);
    std::fill(z.begin(), z.end(), static_cast<float>((j + 0.5) * step));
    sink.clear();
    tree.spans({x, z}, sink);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const std::span<const Span> spans = sink.column(i);
      found.column([&](std::size_t k) { return std::pair<double, double>(spans[k].bottom, spans[k].top); },
                   spans.size());
      evaluation.column({x[i], z[i]}, stretches);
      truth.column(
          [&](std::size_t k) {
            const Stretch& s = stretches[stretches.size() - 1 - k];
            return std::pair(s.bottom, s.top);
          },
          stretches.size());
    }
  }
  const double all = static_cast<double>(columns) * columns;
  recorder.add("events", "", static_cast<double>(sculpture->events.size()));
  recorder.add("columns", "", all);
  recorder.add("overhang_columns", "", static_cast<double>(found.overhangs));
  recorder.add("overhang_share", "", static_cast<double>(found.overhangs) / all);
  recorder.add("most_intervals", "", static_cast<double>(found.most));
  recorder.add("lost_volume", "m³", found.air * step * step);
  recorder.add("columns_of_three", "", static_cast<double>(found.manifold));
  recorder.add("evaluated_columns_of_three", "", static_cast<double>(truth.manifold));
  recorder.add("evaluated_most_intervals", "", static_cast<double>(truth.most));
  recorder.add("evaluated_overhang_columns", "", static_cast<double>(truth.overhangs));
  recorder.add("evaluated_lost_volume", "m³", truth.air * step * step);
}

}  // namespace

extern const Experiment kOverhang{"ght.overhang", "§1: what a heightmap cannot hold", kSpecs, cases, measure};

}  // namespace terrabench::ght
