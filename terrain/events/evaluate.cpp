#include "terrain/events/evaluate.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "terrain/events/event_file.h"
#include "terrain/files.h"

namespace terrabench::events {
namespace {

constexpr int kBins = 32;  // per side
// A column under n inverse faults reads 3ⁿ columns of the first ground.
constexpr int kMostInverseFaults = 8;

// The bins that a box on the terrain touches.
struct BinRange {
  int low_x, low_z, high_x, high_z;
  BinRange(const PlanBox& box, glm::dvec2 extent)
      : low_x(bin(box.low.x, extent.x)),
        low_z(bin(box.low.y, extent.y)),
        high_x(bin(box.high.x, extent.x)),
        high_z(bin(box.high.y, extent.y)) {}
  static int bin(double at, double extent) {
    return static_cast<int>(std::clamp(at / extent * kBins, 0.0, kBins - 1.0));
  }
  template <class Call>
  void each(const Call& call) const {
    for (int z = low_z; z <= high_z; ++z) {
      for (int x = low_x; x <= high_x; ++x) call(static_cast<std::size_t>(z) * kBins + x);
    }
  }
};

// What an event does to a column whose ground comes from one place: raises it by `lift`, then cuts it at
// `ceiling`.
struct Step {
  double lift, ceiling;
};

// The most by which an event can raise and lower the ground, and the level down to which it can cut it.
struct Reach {
  double up = 0, down = 0, cut = HUGE_VAL;
};
Reach reach_of(const Event& event) {
  if (const auto* const e = std::get_if<LinearErosion>(&event)) return {.down = e->depth};
  if (const auto* const e = std::get_if<DipFault>(&event)) return {.up = e->rise / 2, .down = e->rise / 2};
  if (const auto* const e = std::get_if<RadialErosion>(&event)) return {.cut = e->centre.y - e->radii.y};
  return {};
}

// Appends the parts of a column where the weights of the crossings above add up to more than 0.
template <class Crossings>
void solid_stretches(Crossings& crossings, std::vector<Stretch>& out) {
  std::sort(crossings.begin(), crossings.end(), [](const auto& a, const auto& b) { return a.y > b.y; });
  int count = 0;
  for (const auto& crossing : crossings) {
    const bool was_solid = count > 0;
    count += crossing.weight;
    if (!was_solid && count > 0) {
      // Solid parts that touch become one.
      if (!out.empty() && out.back().bottom == crossing.y) continue;
      out.push_back({-HUGE_VAL, crossing.y});
    } else if (was_solid && count <= 0) {
      out.back().bottom = crossing.y;
      if (out.back().top == crossing.y) out.pop_back();
    }
  }
  if (!out.empty() && count > 0) out.back().bottom = -HUGE_VAL;
}

}  // namespace

Evaluation::Evaluation(std::shared_ptr<const Sculpture> sculpture)
    : sculpture_(std::move(sculpture)),
      cell_(std::min(sculpture_->ground.cell_x, sculpture_->ground.cell_z)),
      extent_(sculpture_->ground.extent_x(), sculpture_->ground.extent_z()) {
  const Heightfield& ground = sculpture_->ground;
  if (ground.width < 2 || ground.depth < 2) {
    throw bad_input(
        fmt::format("the ground must have at least 2×2 samples, got {}×{}", ground.width, ground.depth),
        "events", "take a larger ground");
  }
  if (const std::size_t holes = height_range(ground).no_data; holes > 0) {
    throw bad_input(fmt::format("the ground has {} samples without a height", holes), "events",
                    "fill them first");
  }
  for (std::size_t e = 0; e < sculpture_->events.size(); ++e) {
    validate(sculpture_->events[e], extent_, e + 1);
    boxes_.push_back(plan_box(sculpture_->events[e]));
  }
  index_events();
  for (std::size_t e = 0; e < sculpture_->events.size(); ++e) {
    if (const auto* const carving = std::get_if<Carving>(&sculpture_->events[e])) carve(*carving, e);
  }
  find_bounds();
}

// Lists the events that reach each bin. Carvings are left out: they do not move the ground.
void Evaluation::index_events() {
  bin_first_.assign(kBins * kBins + 1, 0);
  std::vector<int> inverse(kBins * kBins, 0);  // the most over one another
  const auto& events = sculpture_->events;
  const auto moves_ground = [&](std::size_t e) { return !std::holds_alternative<Carving>(events[e]); };
  for (std::size_t e = 0; e < events.size(); ++e) {
    if (!moves_ground(e)) continue;
    const BinRange bins(boxes_[e], extent_);
    bins.each([&](std::size_t bin) { ++bin_first_[bin + 1]; });
    int most = 0;
    BinRange(source_box(events[e]), extent_).each([&](std::size_t b) { most = std::max(most, inverse[b]); });
    most += kind(events[e]) == Kind::kInverseFault;
    if (most > kMostInverseFaults) {
      throw EventError(events[e], e + 1,
                       fmt::format("more than {} inverse faults over one another", kMostInverseFaults),
                       "remove some, or move them apart");
    }
    bins.each([&](std::size_t b) { inverse[b] = std::max(inverse[b], most); });
  }
  for (std::size_t bin = 0; bin < kBins * kBins; ++bin) bin_first_[bin + 1] += bin_first_[bin];
  bin_events_.resize(bin_first_.back());
  std::vector<std::uint32_t> next(bin_first_.begin(), bin_first_.end() - 1);
  for (std::size_t e = 0; e < events.size(); ++e) {
    if (!moves_ground(e)) continue;
    BinRange(boxes_[e], extent_).each([&](std::size_t bin) {
      bin_events_[next[bin]++] = static_cast<std::uint32_t>(e);
    });
  }
}

std::optional<std::size_t> Evaluation::last_event_at(glm::dvec2 plan, std::size_t before) const {
  const std::size_t bin =
      static_cast<std::size_t>(BinRange::bin(plan.y, extent_.y)) * kBins + BinRange::bin(plan.x, extent_.x);
  const auto first = bin_events_.begin() + bin_first_[bin], last = bin_events_.begin() + bin_first_[bin + 1];
  for (auto at = std::lower_bound(first, last, before); at != first;) {
    if (boxes_[*--at].contains(plan)) return *at;
  }
  return std::nullopt;
}

void Evaluation::ground(glm::dvec2 plan, std::size_t before, Crossings& out) const {
  const std::size_t begin = out.size();
  std::vector<Step> steps;  // the last event first
  for (;;) {
    const std::optional<std::size_t> event = last_event_at(plan, before);
    if (!event) {
      // Rounding may move a point slightly beyond the edge.
      const glm::dvec2 at = glm::clamp(plan, glm::dvec2(0), extent_);
      out.push_back({sculpture_->ground.sample(static_cast<float>(at.x), static_cast<float>(at.y)), 1});
      break;
    }
    before = *event;
    const Event& e = sculpture_->events[before];
    if (const auto* const linear = std::get_if<LinearErosion>(&e)) {
      steps.push_back({-linear->drop(linear->line().local(plan)), HUGE_VAL});
    } else if (const auto* const radial = std::get_if<RadialErosion>(&e)) {
      steps.push_back({0, radial->bottom(plan)});
    } else if (const auto* const lateral = std::get_if<LateralFault>(&e)) {
      const Line line = lateral->line();
      const glm::dvec2 local = line.local(plan);
      if (local.x >= 0 && local.x <= line.length && std::abs(local.y) <= lateral->extent) {
        plan = line.plan(lateral->before(local));
      }
    } else {
      const auto& fault = std::get<DipFault>(e);
      const Line line = fault.line();
      const glm::dvec2 local = line.local(plan);
      if (local.x < 0 || local.x > line.length || std::abs(local.y) > fault.extent) continue;
      const double half = fault.offset() / 2;
      if (std::abs(local.y) < half && fault.inverse) {
        hang_over(fault, local, before, out);
        break;
      }
      if (std::abs(local.y) < half) {  // the open slope between the lips, which were one line
        plan = line.plan({local.x, 0});
        steps.push_back({fault.rise * local.y / fault.offset(), HUGE_VAL});
        continue;
      }
      // d' = d + σ·(o/2)·(1 - d/extent), solved for d on the left, and the mirror image on the right.
      const double shift = fault.inverse ? -half : half;
      const double side = local.y < 0 ? -1 : 1;
      const double d = (std::abs(local.y) - shift) / (1 - shift / fault.extent);
      plan = line.plan({local.x, side * d});
      steps.push_back({side * fault.rise / 2 * (1 - d / fault.extent), HUGE_VAL});
    }
  }
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
    int cut = 0;
    std::size_t kept = begin;
    for (std::size_t i = begin; i < out.size(); ++i) {
      out[i].y += step->lift;
      if (out[i].y > step->ceiling) {
        cut += out[i].weight;
      } else {
        out[kept++] = out[i];
      }
    }
    out.resize(kept);
    if (cut != 0) out.push_back({step->ceiling, cut});
  }
}

// Appends the crossings where the left block of an inverse fault lies over the right one: those of both, and
// of the scarp between, which faces down.
void Evaluation::hang_over(const DipFault& fault, glm::dvec2 local, std::size_t event, Crossings& out) const {
  const Line line = fault.line();
  const double half = fault.offset() / 2;
  for (const double side : {1.0, -1.0}) {
    const double d = (side * local.y + half) / (1 + half / fault.extent);
    const std::size_t begin = out.size();
    ground(line.plan({local.x, side * d}), event, out);
    for (std::size_t i = begin; i < out.size(); ++i) {
      out[i].y += side * fault.rise / 2 * (1 - d / fault.extent);
    }
  }
  out.push_back({top(line.plan({local.x, 0}), event) - fault.rise * local.y / fault.offset(), -1});
}

double Evaluation::top(glm::dvec2 plan, std::size_t before) const {
  std::vector<Stretch> solid;
  stretches(plan, before, solid);
  return solid.front().top;
}

void Evaluation::stretches(glm::dvec2 plan, std::size_t before, std::vector<Stretch>& out) const {
  Crossings crossings;
  ground(plan, before, crossings);
  out.clear();
  solid_stretches(crossings, out);
}

// Tracks, event by event, how low and high the ground of each bin can be.
void Evaluation::find_bounds() {
  const Heightfield& ground = sculpture_->ground;
  std::vector<Stretch> range(kBins * kBins, {HUGE_VAL, -HUGE_VAL});
  const auto widen = [&](std::size_t bin, double low, double high) {
    range[bin] = {std::min(range[bin].bottom, low), std::max(range[bin].top, high)};
  };
  for (int j = 0; j + 1 < ground.depth; ++j) {
    for (int i = 0; i + 1 < ground.width; ++i) {
      const auto [low, high] =
          std::minmax({ground.at(i, j), ground.at(i + 1, j), ground.at(i, j + 1), ground.at(i + 1, j + 1)});
      const PlanBox square{
          {i * static_cast<double>(ground.cell_x), j * static_cast<double>(ground.cell_z)},
          {(i + 1) * static_cast<double>(ground.cell_x), (j + 1) * static_cast<double>(ground.cell_z)}};
      BinRange(square, extent_).each([&](std::size_t bin) { widen(bin, low, high); });
    }
  }
  double lowest = HUGE_VAL, highest = -HUGE_VAL;
  for (std::size_t e = 0; e < boxes_.size(); ++e) {
    const Reach reach = reach_of(sculpture_->events[e]);
    double low = HUGE_VAL, high = -HUGE_VAL;
    BinRange(source_box(sculpture_->events[e]), extent_).each([&](std::size_t bin) {
      low = std::min(low, range[bin].bottom), high = std::max(high, range[bin].top);
    });
    low = std::min(low - reach.down, reach.cut);
    BinRange(boxes_[e], extent_).each([&](std::size_t bin) { widen(bin, low, high + reach.up); });
  }
  for (const Stretch& bin : range) {
    lowest = std::min(lowest, bin.bottom);
    highest = std::max(highest, bin.top);
  }
  for (const Protovolume& volume : protovolumes_) {
    for (const double u : {volume.low, volume.high}) {
      for (const glm::dvec2 corner : volume.carving->section) {
        lowest = std::min(lowest, volume.carving->height(u) + corner.y * volume.carving->scale(u) -
                                      volume.carving->roughness);
      }
    }
  }
  const double floor = lowest - std::max(ground.cell_x, ground.cell_z);
  bounds_ = {{0, static_cast<float>(floor), 0},
             {ground.extent_x(), static_cast<float>(highest), ground.extent_z()}};
}

Solid evaluate(std::shared_ptr<const Sculpture> sculpture) {
  const auto evaluation = std::make_shared<const Evaluation>(sculpture);
  return {evaluation->bounds(), checksum(checksum(sculpture->ground) + to_text(sculpture->events)),
          [evaluation](const ColumnSamples& at, std::span<Material> out) {
            thread_local std::vector<Stretch> solid;
            evaluation->column({at.x, at.z}, solid);
            // Stretches run from the top down, samples from the bottom up.
            auto stretch = solid.rbegin();
            for (std::size_t i = 0; i < out.size(); ++i) {
              const double y = static_cast<double>(at.y0) + static_cast<double>(i) * at.dy;
              while (stretch != solid.rend() && stretch->top < y) ++stretch;
              const bool inside = stretch != solid.rend() && stretch->bottom <= y;
              out[i] = inside ? Material::kBedrock : Material::kAir;
            }
          }};
}

}  // namespace terrabench::events
