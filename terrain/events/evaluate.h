// The ground after its events, column by column, from the definitions in event.h alone: a column asks where
// its ground was before the last event that reaches it, and so on down to the first heights (bilinear). It
// uses no terrain structure, so it is the reference for structures that repeat the events, and the source for
// those that cannot.
//
// Building is O(samples + events). A column is O(events that reach it); each inverse fault that hangs over it
// needs three columns of the ground before.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "terrain/events/event.h"
#include "terrain/solid.h"

namespace terrabench::events {

// A solid part of a vertical line; `bottom` is -infinity for the lowest.
struct Stretch {
  double bottom, top;
  bool operator==(const Stretch&) const = default;
};

class Evaluation {
 public:
  // Throws bad_input when the ground has a hole (no-data), when validate() refuses an event, when a carving
  // starts in the air, leaves the ground on its way or does not come out where it must, and when too many
  // inverse faults lie over one another.
  explicit Evaluation(std::shared_ptr<const Sculpture> sculpture);

  // Solid stretches at a point of the terrain, from the top down. `out` is overwritten. Thread-safe.
  void column(glm::dvec2 plan, std::vector<Stretch>& out) const;

  // Contain all ground; the floor lies at least one cell below the lowest.
  const Bounds& bounds() const { return bounds_; }

 private:
  // The ground is a surface that may fold: from above, a vertical line crosses it into the ground (+1) or,
  // under an overhang, out of it (-1). It is solid where the weights above add up to more than 0.
  struct Crossing {
    double y;
    int weight;
  };
  using Crossings = std::vector<Crossing>;
  // The volume that a carving takes out, from `low` to `high` along its axis (the paper's protovolume).
  struct Protovolume {
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
  double cell_;  // metres, the smaller side of a cell of the ground
  glm::dvec2 extent_;
  std::vector<PlanBox> boxes_;  // one per event
  // For each of kBins² squares of the terrain, the events that reach it, ascending.
  std::vector<std::uint32_t> bin_first_, bin_events_;
  std::vector<Protovolume> protovolumes_;
  Bounds bounds_;
};

// The evaluation as a source for any structure. Throws as Evaluation does.
Solid evaluate(std::shared_ptr<const Sculpture> sculpture);

}  // namespace terrabench::events
