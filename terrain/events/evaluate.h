// What a ground is after its events, column by column, from the definitions in event.h alone: a column asks
// where its ground was before the last event that reaches it, and so on down to the heights (bilinear). No
// structure takes part, so this is the measure for those that repeat the events, and the source for those
// that cannot.
//
// Building: O(samples + events). A column: O(events that reach it); each inverse fault that hangs over it
// asks three columns of the ground before.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "terrain/events/event.h"
#include "terrain/solid.h"

namespace terrabench::events {

// Solid part of a vertical line; `bottom` is -infinity in the lowest.
struct Stretch {
  double bottom, top;
  bool operator==(const Stretch&) const = default;
};

class Evaluation {
 public:
  // Throws bad_input when the ground has a hole (no-data) or an event cannot happen to it, whatever
  // validate() refuses included: a carving that starts in the air, leaves the ground on its way or does not
  // come out where it must; or too many inverse faults over one another.
  explicit Evaluation(std::shared_ptr<const Sculpture> sculpture);

  // Solid stretches at a point of the terrain, from the top down. `out` is overwritten. Thread-safe.
  void column(glm::dvec2 plan, std::vector<Stretch>& out) const;

  // Holds all ground; its floor lies at least a cell under the lowest.
  const Bounds& bounds() const { return bounds_; }

 private:
  // The ground is a sheet, perhaps folded: a vertical line crosses it downwards (+1) or, under an overhang,
  // upwards (-1). Solid is where the crossings above add up to more than 0.
  struct Crossing {
    double y;
    int weight;
  };
  using Crossings = std::vector<Crossing>;
  // A carving as it was cut: it runs from `low` to `high` along its axis.
  struct Prism {
    const Carving* carving;
    Line line;
    double low, high;
    PlanBox box;
  };

  void index_events();
  void find_bounds();
  std::optional<std::size_t> last_event_at(glm::dvec2 plan, std::size_t before) const;
  // Appends the crossings of the ground after the first `before` events.
  void ground(glm::dvec2 plan, std::size_t before, Crossings& out) const;
  void hang_over(const DipFault& fault, glm::dvec2 local, std::size_t event, Crossings& out) const;
  double top(glm::dvec2 plan, std::size_t before) const;
  void stretches(glm::dvec2 plan, std::size_t before, std::vector<Stretch>& out) const;

  enum class Cover : std::uint8_t { kGround, kAir, kBoth };
  Cover cover(const Carving& carving, const Line& line, double u, std::size_t before) const;
  double mouth(const Carving& carving, std::size_t event, double from, double step) const;
  void carve(const Carving& carving, std::size_t event);

  std::shared_ptr<const Sculpture> sculpture_;
  double cell_;  // the smaller side of one
  glm::dvec2 extent_;
  std::vector<PlanBox> boxes_;  // one an event
  // For each of kBins² squares of the terrain the events that reach it, ascending.
  std::vector<std::uint32_t> bin_first_, bin_events_;
  std::vector<Prism> prisms_;
  Bounds bounds_;
};

// As a source for any structure. Throws as Evaluation does.
Solid evaluate(std::shared_ptr<const Sculpture> sculpture);

}  // namespace terrabench::events
