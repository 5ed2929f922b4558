// The carvings of an Evaluation: how far each one runs, and what it takes out of a column.
#include <fmt/format.h>

#include <algorithm>

#include "terrain/events/evaluate.h"
#include "terrain/events/section.h"

namespace terrabench::events {
namespace {

// Removes [low, high] from the stretches, which run from the top down.
void take_out(double low, double high, std::vector<Stretch>& stretches) {
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const Stretch old = stretches[i];
    if (high <= old.bottom || low >= old.top) continue;
    if (high < old.top && low > old.bottom) {
      stretches[i].bottom = high;
      stretches.insert(stretches.begin() + static_cast<std::ptrdiff_t>(i) + 1, {old.bottom, low});
      return;
    }
    if (high < old.top) {
      stretches[i].bottom = high;
    } else if (low > old.bottom) {
      stretches[i].top = low;
    } else {
      stretches.erase(stretches.begin() + static_cast<std::ptrdiff_t>(i--));
    }
  }
}

}  // namespace

void Evaluation::column(glm::dvec2 plan, std::vector<Stretch>& out) const {
  stretches(plan, sculpture_->events.size(), out);
  std::vector<SectionRange> ranges;
  for (const Protovolume& volume : protovolumes_) {
    if (!volume.box.contains(plan)) continue;
    const glm::dvec2 local = volume.line.local(plan);
    if (local.x < volume.low || local.x > volume.high) continue;
    section_ranges(*volume.carving, local.x, -local.y, ranges);
    const double axis = volume.carving->height(local.x);
    for (const SectionRange& range : ranges) take_out(axis + range.low, axis + range.high, out);
  }
}

// Whether the section at u lies in the ground after the first `before` events, in the air, or in both.
Evaluation::Cover Evaluation::cover(const Carving& carving, const Line& line, double u,
                                    std::size_t before) const {
  const SectionRange reach = section_reach(carving, u);
  const int columns = 8 + static_cast<int>(2 * (reach.high - reach.low) / cell_);
  std::vector<SectionRange> ranges;
  std::vector<Stretch> solid;
  bool in_ground = false, in_air = false;
  for (int c = 0; c < columns && !(in_ground && in_air); ++c) {
    const double a = std::lerp(reach.low, reach.high, (c + 0.5) / columns);
    section_ranges(carving, u, a, ranges);
    stretches(line.plan({u, -a}), before, solid);
    for (const SectionRange& range : ranges) {
      const double low = range.low + carving.height(u), high = range.high + carving.height(u);
      bool inside = false, meets = false;
      for (const Stretch& stretch : solid) {
        inside |= low >= stretch.bottom && high <= stretch.top;
        meets |= high > stretch.bottom && low < stretch.top;
      }
      in_ground |= meets;
      in_air |= !inside;
    }
  }
  return in_ground && in_air ? Cover::kBoth : in_ground ? Cover::kGround : Cover::kAir;
}

// Moves from `from` in steps of `step` until the whole section is in the air, and returns that u.
double Evaluation::mouth(const Carving& carving, std::size_t event, double from, double step) const {
  const Line line = carving.line();
  for (double u = from + step;; u += step) {
    const SectionRange reach = section_reach(carving, u);
    for (const double a : {reach.low, reach.high}) {
      const glm::dvec2 plan = line.plan({u, -a});
      const bool outside = plan.x < 0 || plan.y < 0 || plan.x > extent_.x || plan.y > extent_.y;
      if (outside || carving.scale(u) <= 0) {
        throw EventError(sculpture_->events[event], event + 1,
                         fmt::format("does not come out of the ground beyond '{}'", step < 0 ? "from" : "to"),
                         "let the axis rise to the surface, and more steeply than the ground");
      }
    }
    if (cover(carving, line, u, event) == Cover::kAir) return u;
  }
}

void Evaluation::carve(const Carving& carving, std::size_t event) {
  const Line line = carving.line();
  const auto require = [&](double u, std::string_view what) {
    if (cover(carving, line, u, event) == Cover::kGround) return;
    throw EventError(sculpture_->events[event], event + 1, what,
                     "move 'from' and 'to' deeper into the ground, or take a smaller section");
  };
  require(0, "starts in the air: not all of the section at 'from' is underground");
  require(line.length, "ends in the air: not all of the section at 'to' is underground");
  const int steps = 1 + static_cast<int>(2 * line.length / cell_);
  for (int s = 1; s < steps; ++s) {
    const double u = line.length * s / steps;
    require(u, fmt::format("leaves the ground {:.6g} m from 'from'", u));
  }
  Protovolume volume{&carving, line, mouth(carving, event, 0, -cell_ / 2), line.length, {}};
  if (!carving.cave) volume.high = mouth(carving, event, line.length, cell_ / 2);
  for (const double u : {volume.low, volume.high}) {
    const SectionRange reach = section_reach(carving, u);
    for (const double a : {reach.low, reach.high}) {
      volume.box.low = glm::min(volume.box.low, line.plan({u, -a}));
      volume.box.high = glm::max(volume.box.high, line.plan({u, -a}));
    }
  }
  protovolumes_.push_back(volume);
}

}  // namespace terrabench::events
