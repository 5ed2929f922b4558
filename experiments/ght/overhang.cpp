// Overhangs: columns of more than one solid interval, and the air below the topmost surface, which a
// heightmap of the same terrain would fill.
#include <algorithm>
#include <array>

#include "experiments/cases.h"
#include "experiments/ght/site.h"
#include "terrain/events/evaluate.h"

namespace terrabench::ght {
namespace {

using namespace events;

struct Terrain {
  std::string_view name;
  std::vector<Event> (*events)(const Site&);
};
template <Kind kind>
std::vector<Event> single(const Site& site) {
  return {single_event(site, kind)};
}
constexpr std::array kTerrains{
    Terrain{"no-event", [](const Site&) { return std::vector<Event>(); }},
    Terrain{"normal-fault", single<Kind::kNormalFault>},
    Terrain{"inverse-fault", single<Kind::kInverseFault>},
    Terrain{"tunnel", single<Kind::kTunnel>},
    Terrain{"cave", single<Kind::kCave>},
    Terrain{"two-tunnels", two_tunnels},
    Terrain{"sequence", overlapping_events},
};
constexpr std::array kNames = names_of(kTerrains);
const std::array kSpecs{
    choice("events", kNames, "the events that shape the terrain"),
    ParameterSpec{"size", std::int64_t{32}, "cells", "length of an event; the terrain is 4 times as long", 32,
                  512},
    ParameterSpec{"columns_per_cell", std::int64_t{4}, "", "columns along each side of a cell", 1, 64},
};

struct Hollow {
  std::size_t overhangs = 0;  // columns with more than one interval
  std::size_t most = 0;       // intervals
  std::size_t manifold = 0;   // columns with more than two
  double air = 0;             // metres below the top, summed over all columns

  // intervals(k) is the bottom and top of the k-th of `count` intervals, from below.
  template <class Intervals>
  void column(const Intervals& intervals, std::size_t count) {
    overhangs += count > 1;
    manifold += count > 2;
    most = std::max(most, count);
    for (std::size_t k = 1; k < count; ++k) air += intervals(k).first - intervals(k - 1).second;
  }
};

std::vector<Case> cases(const RunOptions& options) {
  return cases_by("events", kSpecs,
                  {{"columns_per_cell", std::int64_t{options.profile == Profile::kPaper ? 8 : 4}}});
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress&) {
  const int size = at.integer("size");
  const int per_cell = at.integer("columns_per_cell");
  const Site site = make_site(kEventsAlong * size, size, options.seed);
  const auto sculpture = std::make_shared<Sculpture>(
      Sculpture{site.ground, kTerrains[at.parameters.choice("events")].events(site)});
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
  recorder.add("events", "", sculpture->events.size());
  recorder.add("columns", "", all);
  recorder.add("overhang_columns", "", found.overhangs);
  recorder.add("overhang_share", "", static_cast<double>(found.overhangs) / all);
  recorder.add("most_intervals", "", found.most);
  recorder.add("lost_volume", "m³", found.air * step * step);
  recorder.add("columns_of_three", "", found.manifold);
  recorder.add("evaluated_columns_of_three", "", truth.manifold);
  recorder.add("evaluated_most_intervals", "", truth.most);
  recorder.add("evaluated_overhang_columns", "", truth.overhangs);
  recorder.add("evaluated_lost_volume", "m³", truth.air * step * step);
}

}  // namespace

extern const Experiment kOverhang{"ght.overhang", "§1: what a heightmap cannot hold", kSpecs, cases, measure};

}  // namespace terrabench::ght
