#include "experiments/ght/shown.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "experiments/ght/site.h"
#include "experiments/ght/tree_view.h"

namespace terrabench::ght {
namespace {

using namespace events;
using figures::Drawing;

template <class Test>
double share(const Image& image, const Test& test) {
  std::size_t found = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) found += test(image.pixel(x, y));
  }
  return static_cast<double>(found) / (static_cast<double>(image.width) * image.height);
}

// The columns of change(): places in plan, in metres.
struct PlanGrid {
  explicit PlanGrid(const Ght& ght) {
    constexpr int kPerCell = 4;
    const SampleGrid& grid = ght.model().tree.grid();
    step = static_cast<double>(grid.spacing()) / kPerCell;
    for (int j = 0; j < (grid.depth - 1) * kPerCell; ++j) {
      for (int i = 0; i < (grid.width - 1) * kPerCell; ++i) {
        x.push_back(static_cast<float>((i + 0.5) * step));
        z.push_back(static_cast<float>((j + 0.5) * step));
      }
    }
  }
  SpanSink spans(const Ght& ght) const {
    SpanSink sink;
    ght.spans({x, z}, sink);
    return sink;
  }
  double step;
  std::vector<float> x, z;
};

// The solid spans of the vertical line at a place; none outside the terrain.
SpanSink line_at(const Ght& ght, glm::dvec2 plan) {
  const float x = static_cast<float>(plan.x), z = static_cast<float>(plan.y);
  SpanSink sink;
  ght.spans({{&x, 1}, {&z, 1}}, sink);
  return sink;
}

// Of a place inside the terrain, which has no column without ground.
double top_at(const Ght& ght, glm::dvec2 plan) {
  const SpanSink sink = line_at(ght, plan);
  const auto spans = sink.column(0);
  assert(!spans.empty());
  return spans.back().top;
}

// Metres of a line above `floor`; its lowest span reaches down to there, as the floors of two trees differ.
double solid(std::span<const Span> spans, double floor) {
  double sum = spans.empty() ? 0 : spans.front().bottom - floor;
  for (const Span& span : spans) sum += static_cast<double>(span.top) - span.bottom;
  return sum;
}

enum class Place { kRock, kAir, kSky };

Place place_on(const Ght& ght, const Carving& carving, double u) {
  const SpanSink sink = line_at(ght, carving.line().plan({u, 0}));
  const auto spans = sink.column(0);
  const double y = carving.height(u);
  if (spans.empty() || y > spans.back().top) return Place::kSky;
  const bool in_rock = std::ranges::any_of(spans, [&](const Span& s) { return y > s.bottom && y < s.top; });
  return in_rock ? Place::kRock : Place::kAir;
}

// The volume in m³ that an erosion removes by its definition: the ground at a place sinks by drop(place,
// height).
template <class Drop>
double defined_volume(const Ght& before, const Drop& drop) {
  const PlanGrid grid(before);
  const SpanSink old = grid.spans(before);
  double sum = 0;
  for (std::size_t c = 0; c < grid.x.size(); ++c) {
    const auto spans = old.column(c);
    assert(!spans.empty());
    sum += std::max(0.0, drop({grid.x[c], grid.z[c]}, spans.back().top));
  }
  return grid.step * grid.step * sum;
}

// A carving's axis from side to side of the hill that it is in: from its middle both ways to the open sky.
struct Axis {
  double rock_before = 0, rock_after = 0;  // metres in plan inside the ground, without and with the carving
  double dug = 0;                          // of rock_before, metres before its end at `to`
};

Axis axis_of(const Ght& before, const Ght& after, const Carving& carving) {
  const double length = carving.line().length, step = 0.05 * before.model().tree.grid().spacing();
  Axis axis;
  for (const int way : {-1, 1}) {
    const double first = length / 2 + way * step / 2;
    for (double u = first; place_on(before, carving, u) == Place::kRock; u += way * step) {
      axis.rock_before += step;
      if (u < length) axis.dug += step;
    }
    for (double u = first;; u += way * step) {
      const Place place = place_on(after, carving, u);
      if (place == Place::kSky) break;
      if (place == Place::kRock) axis.rock_after += step;
    }
  }
  return axis;
}

// How far the ground on the left of the line of a lateral fault must move back to meet the ground on its
// right. Metres.
double slip_between(const Ght& ght, const Line& line) {
  const double cell = ght.model().tree.grid().spacing(), aside = 0.05 * cell;
  double best = 0, least = HUGE_VAL;
  for (double slip = 0; slip < line.length - 6 * cell; slip += 0.05 * cell) {
    double sum = 0, places = 0;
    for (double u = cell; u + slip < line.length - cell; u += 0.1 * cell) {
      const double left = top_at(ght, line.plan({u + slip, aside})),
                   right = top_at(ght, line.plan({u, -aside}));
      sum += (left - right) * (left - right);
      ++places;
    }
    if (sum / places >= least) continue;
    least = sum / places;
    best = slip;
  }
  return best;
}

}  // namespace

double blue_share(const Image& image) {
  return share(image, [](const Rgb& c) { return c[2] > c[0] + 60; });
}

double yellow_share(const Image& image) {
  return share(image, [](const Rgb& c) { return c[0] > 225 && c[1] > 185 && c[2] < 40; });
}

Change change(const Ght& before, const Ght& after) {
  const PlanGrid grid(after);
  const SpanSink old = grid.spans(before), now = grid.spans(after);
  Change all;
  const double area = grid.step * grid.step, floor = after.bounds().low.y;
  const auto lowest = [&](std::span<const Span> spans) { return spans.empty() ? floor : spans.front().top; };
  const auto top = [&](std::span<const Span> spans) { return spans.empty() ? floor : spans.back().top; };
  for (std::size_t c = 0; c < grid.x.size(); ++c) {
    const auto was = old.column(c), is = now.column(c);
    const double gain = solid(is, floor) - solid(was, floor);
    (gain > 0 ? all.added : all.removed) += area * std::abs(gain);
    all.highest = std::max(all.highest, top(is) - top(was));
    all.deepest = std::max(all.deepest, top(was) - lowest(is));
    if (is.size() > 1) all.overhang += area;
  }
  return all;
}

double planes_of_events(const Ght& ght) {
  return static_cast<double>(ground_planes(ght.model().tree).size() - 1);
}

void record_event(Drawing& drawing, const Event& event, const Ght& before, const Ght& after,
                  const Image& wires) {
  const Kind which = kind(event);
  const Change shape = change(before, after);
  drawing.record(metric_of("planes", which), planes_of_events(after));
  drawing.record(metric_of("blue", which), blue_share(wires));
  if (const auto* const trench = std::get_if<LinearErosion>(&event)) {
    const auto drop = [&](glm::dvec2 plan, double) { return trench->drop(trench->line().local(plan)); };
    drawing.record(metric_of("defined", which), defined_volume(before, drop));
  } else if (const auto* const bowl = std::get_if<RadialErosion>(&event)) {
    const auto drop = [&](glm::dvec2 plan, double height) { return height - bowl->bottom(plan); };
    drawing.record(metric_of("defined", which), defined_volume(before, drop));
  } else if (const auto* const fault = std::get_if<DipFault>(&event)) {
    drawing.record(metric_of("overhang", which), shape.overhang);
    if (fault->inverse) drawing.record("overlap_inverse_fault", fault->offset() * fault->line().length);
    drawing.record(metric_of("step", which), shape.deepest + shape.highest);
    return;
  } else {
    drawing.record(metric_of("slip", which), slip_between(after, std::get<LateralFault>(event).line()));
    return;
  }
  drawing.record(metric_of("removed", which), shape.removed);
  drawing.record(metric_of("added", which), shape.added);
}

void record_carving(Drawing& drawing, const Carving& carving, const Ght& before, const Ght& after) {
  const Kind which = carving.cave ? Kind::kCave : Kind::kTunnel;
  const Axis axis = axis_of(before, after, carving);
  drawing.record(metric_of("planes", which), planes_of_events(after));
  drawing.record(metric_of("rock_before", which), axis.rock_before);
  drawing.record(metric_of("rock_after", which), axis.rock_after);
  if (carving.cave) drawing.record("rock_beyond_cave", axis.rock_before - axis.dug);
}

int open_tunnels(const Ght& before, const Ght& after, std::span<const Event> carvings) {
  return static_cast<int>(std::ranges::count_if(carvings, [&](const Event& event) {
    const Axis axis = axis_of(before, after, std::get<Carving>(event));
    return axis.rock_before > 0 && axis.rock_after == 0;
  }));
}

Blueness blueness(const Image& wires, const Image& textured) {
  constexpr int kMargin = 4;  // pixels at the skyline that belong to neither
  double sky = 0, blue_sky = 0, ground = 0, blue_ground = 0;
  for (int x = 0; x < wires.width; ++x) {
    int line = 0;
    while (line < wires.height && wires.pixel(x, line) == Rgb{255, 255, 255}) ++line;
    for (int y = 0; y < wires.height; ++y) {
      const Rgb c = textured.pixel(x, y);
      if (y < line - kMargin) {
        ++sky;
        blue_sky += c[2] > c[0];
      } else if (y > line + kMargin) {
        ++ground;
        blue_ground += c[2] > c[0];
      }
    }
  }
  return {sky > 0 ? blue_sky / sky : 0, ground > 0 ? blue_ground / ground : 0};
}

}  // namespace terrabench::ght
