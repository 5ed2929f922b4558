// Overhangs: columns of more than one solid interval, and the air below the topmost surface, which a
// heightmap of the same terrain would fill. And of all events: how far the tree's ground is from the one that
// the events' definitions give.
#include <algorithm>
#include <array>
#include <cmath>

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
    Terrain{"linear-erosion", single<Kind::kLinearErosion>},
    Terrain{"radial-erosion", single<Kind::kRadialErosion>},
    Terrain{"normal-fault", single<Kind::kNormalFault>},
    Terrain{"inverse-fault", single<Kind::kInverseFault>},
    Terrain{"lateral-fault", single<Kind::kLateralFault>},
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
  double air = 0;             // metres below the top, summed over all columns

  // intervals(k) is the bottom and top of the k-th of `count` intervals, from below. Returns the air between.
  template <class Intervals>
  double column(const Intervals& intervals, std::size_t count) {
    const double before = air;
    overhangs += count > 1;
    most = std::max(most, count);
    for (std::size_t k = 1; k < count; ++k) air += intervals(k).first - intervals(k - 1).second;
    return air - before;
  }
};

// Solid metres of columns after the events, in the tree and as their definitions give, over the columns that
// the definitions change by more than a hundredth of a cell.
struct Change {
  std::size_t columns = 0;
  double changed = 0, missed = 0;  // sums of |defined − before| and |tree − defined|

  void column(double before, double tree, double defined, double cell) {
    if (std::abs(defined - before) < 0.01 * cell) return;
    ++columns;
    changed += std::abs(defined - before);
    missed += std::abs(tree - defined);
  }
};

// What the tree has of the overhangs that the evaluation has, column by column.
//
// The tree is exact to one sample spacing, so an overhang, such as the edge of a mouth on a slope that the
// carving grazes, may be missing where it is narrower. The core is what is wider: overhanging columns without
// a column of one interval within one spacing. Strays are the tree's overhanging columns that are further
// than one spacing from all of the evaluation's.
struct Core {
  std::size_t columns = 0, missed = 0, strays = 0;
  double air = 0, evaluated_air = 0;  // in the core, metres summed over its columns
};

class Comparison {
 public:
  Comparison(int columns, int per_cell)
      : columns_(columns), reach_(per_cell), tree_(cells()), truth_(cells()) {}

  void column(int i, int j, double tree_air, double evaluated_air) {
    tree_[at(i, j)] = static_cast<float>(tree_air);
    truth_[at(i, j)] = static_cast<float>(evaluated_air);
  }
  Core core() const {
    // Columns with a column of one interval near, and with an overhang near, in the evaluation.
    const std::vector<char> open = near([&](std::size_t k) { return truth_[k] == 0; }),
                            hollow = near([&](std::size_t k) { return truth_[k] > 0; });
    Core found;
    for (std::size_t k = 0; k < cells(); ++k) {
      found.strays += tree_[k] > 0 && hollow[k] == 0;
      if (open[k] != 0) continue;
      ++found.columns;
      found.missed += tree_[k] == 0;
      found.air += tree_[k];
      found.evaluated_air += truth_[k];
    }
    return found;
  }

 private:
  std::size_t cells() const {
    return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(columns_);
  }
  std::size_t at(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(i);
  }
  // Whether a column within one spacing along each axis has the property: along rows, then along columns.
  template <class Has>
  std::vector<char> near(const Has& has) const {
    std::vector<char> row(cells(), 0), all(cells(), 0);
    const auto spread = [&](auto from, std::vector<char>& to, bool along_rows) {
      for (int a = 0; a < columns_; ++a) {
        int last = -reach_ - 1;  // the last column that has it, from either end
        for (int b = 0; b < columns_; ++b) {
          const std::size_t k = along_rows ? at(b, a) : at(a, b);
          if (from(k)) last = b;
          if (b - last <= reach_) to[k] = 1;
        }
        last = columns_ + reach_;
        for (int b = columns_ - 1; b >= 0; --b) {
          const std::size_t k = along_rows ? at(b, a) : at(a, b);
          if (from(k)) last = b;
          if (last - b <= reach_) to[k] = 1;
        }
      }
    };
    spread(has, row, true);
    spread([&](std::size_t k) { return row[k] != 0; }, all, false);
    return all;
  }

  int columns_, reach_;
  std::vector<float> tree_, truth_;  // air below the top of each column, metres
};

std::vector<Case> cases(const RunOptions& options) {
  return cases_by("events", kSpecs,
                  {{"columns_per_cell", std::int64_t{options.profile == Profile::kPaper ? 8 : 4}}});
}

void measure(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress&) {
  const int size = test_case.integer("size");
  const int per_cell = test_case.integer("columns_per_cell");
  const Site site = recorded_site(kEventsAlong * size, size, options.seed, recorder);
  const auto sculpture = std::make_shared<Sculpture>(
      Sculpture{site.ground, kTerrains[test_case.parameters.choice("events")].events(site)});
  Ght tree = plain_tree(site.ground);
  for (const Event& event : sculpture->events) tree.apply(event);
  const Evaluation evaluation(sculpture);

  Hollow found, truth;
  Change change;
  const double floor = tree.bounds().low.y;
  const int columns = (site.ground.width - 1) * per_cell;
  const double step = static_cast<double>(site.ground.cell_x) / per_cell;
  std::vector<float> x(static_cast<std::size_t>(columns)), z(x.size());
  std::vector<Stretch> stretches;
  SpanSink sink;
  Comparison comparison(columns, per_cell);
  for (int j = 0; j < columns; ++j) {
    for (int i = 0; i < columns; ++i) x[i] = static_cast<float>((i + 0.5) * step);
    std::fill(z.begin(), z.end(), static_cast<float>((j + 0.5) * step));
    sink.clear();
    tree.spans({x, z}, sink);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const std::span<const Span> spans = sink.column(i);
      const double tree_air = found.column(
          [&](std::size_t k) { return std::pair<double, double>(spans[k].bottom, spans[k].top); },
          spans.size());
      evaluation.column({x[i], z[i]}, stretches);
      const double evaluated_air = truth.column(
          [&](std::size_t k) {
            const Stretch& s = stretches[stretches.size() - 1 - k];
            return std::pair(s.bottom, s.top);
          },
          stretches.size());
      comparison.column(static_cast<int>(i), j, tree_air, evaluated_air);
      change.column(site.ground.sample(x[i], z[i]) - floor, spans.back().top - floor - tree_air,
                    stretches.front().top - floor - evaluated_air, site.ground.cell_x);
    }
  }
  recorder.add("columns", "", static_cast<double>(columns) * columns);
  recorder.add("changed_columns", "", change.columns);
  if (change.columns > 0) {
    const double cells = static_cast<double>(change.columns) * site.ground.cell_x;
    recorder.add("changed_cells", "cells", change.changed / cells);
    recorder.add("missed_cells", "cells", change.missed / cells);
    recorder.add("missed_share", "", change.missed / change.changed);
  }
  recorder.add("overhang_columns", "", found.overhangs);
  recorder.add("most_intervals", "", found.most);
  recorder.add("lost_volume", "m³", found.air * step * step);
  recorder.add("evaluated_overhang_columns", "", truth.overhangs);
  recorder.add("evaluated_lost_volume", "m³", truth.air * step * step);
  const Core core = comparison.core();
  recorder.add("core_columns", "", core.columns);
  recorder.add("core_missed", "", core.missed);
  recorder.add("stray_columns", "", core.strays);
  recorder.add("core_volume", "m³", core.air * step * step);
  recorder.add("evaluated_core_volume", "m³", core.evaluated_air * step * step);
}

}  // namespace

extern const Experiment kOverhang{"ght.overhang", "§1: what a heightmap cannot hold", kSpecs, cases, measure};

}  // namespace terrabench::ght
