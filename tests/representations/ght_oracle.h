// The tree against the independent evaluation of the same events (terrain/events/evaluate.h).
#pragma once

#include <ostream>

#include "terrain/events/evaluate.h"
#include "tests/representations/ght_ground.h"

namespace terrabench::test {

struct Disagreement {
  struct Point {
    glm::dvec3 at;
    bool ground;  // as the tree says
  };
  std::size_t points = 0;
  std::size_t explained = 0;  // wrong by the strict comparison, right by the forgiving one
  std::vector<Point> wrong;
};
inline std::ostream& operator<<(std::ostream& out, const Disagreement& found) {
  out << found.wrong.size() << " of " << found.points << " points wrong:";
  for (const auto& p : found.wrong) out << " (" << p.at.x << ' ' << p.at.y << ' ' << p.at.z << ')';
  return out;
}

// Whether the evaluation has ground (or air) within one sample spacing above or below a point, in any column
// within one spacing of it.
class NearBy {
 public:
  NearBy(const events::Evaluation& truth, const ght::SampleGrid& grid) : truth_(truth), grid_(grid) {}

  bool has(bool ground, glm::dvec3 p) {
    const double cell = grid_.spacing();
    return any_column(p, [&](const std::vector<events::Stretch>& column) {
      double above = HUGE_VAL;  // the bottom of the stretch above
      for (const events::Stretch& s : column) {
        if (ground ? s.top >= p.y - cell && s.bottom <= p.y + cell
                   : s.top < p.y + cell && above > p.y - cell) {
          return true;
        }
        above = s.bottom;
      }
      return false;
    });
  }
  // Whether surfaces that face up lie above the point and below it.
  bool between_surfaces(glm::dvec3 p) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    return any_column(p, [&](const std::vector<events::Stretch>& column) {
      low = std::min(low, column.back().top), high = std::max(high, column.front().top);
      return p.y >= low && p.y <= high;
    });
  }

 private:
  template <class Visit>
  bool any_column(glm::dvec3 p, const Visit& visit) {
    constexpr int kSteps = 6;  // per sample spacing
    for (int dz = -kSteps; dz <= kSteps; ++dz) {
      for (int dx = -kSteps; dx <= kSteps; ++dx) {
        const glm::dvec2 plan{p.x + dx * grid_.spacing_x / kSteps, p.z + dz * grid_.spacing_z / kSteps};
        if (plan.x < 0 || plan.y < 0 || plan.x > grid_.x(grid_.width - 1) ||
            plan.y > grid_.z(grid_.depth - 1)) {
          continue;
        }
        truth_.column(plan, stretches_);
        if (visit(stretches_)) return true;
      }
    }
    return false;
  }

  const events::Evaluation& truth_;
  const ght::SampleGrid& grid_;
  std::vector<events::Stretch> stretches_;
};

// Points where tree and evaluation differ although the evaluation has only one answer within one sample
// spacing of the point: the tree claims to be exact to one spacing. `per_cell` columns per spacing are
// compared; in each, every stretch on which the two differ is tested at both of its ends, where the
// difference is largest.
inline Disagreement compare(const Ght& ght, const events::Evaluation& truth, int per_cell = 1) {
  const ght::SampleGrid& grid = ght.model().tree.grid();
  const double slip = 1e-3 * grid.spacing();
  NearBy near_by(truth, grid);
  Disagreement all;
  std::vector<events::Stretch> stretches;
  std::vector<double> ends;
  SpanSink sink;
  const auto columns = [&](int samples) { return (samples - 1) * per_cell; };
  for (int j = 0; j < columns(grid.depth); ++j) {
    for (int i = 0; i < columns(grid.width); ++i) {
      // Off the samples, so that no column runs along an edge.
      const auto x = static_cast<float>((i + 0.37) / per_cell * grid.spacing_x),
                 z = static_cast<float>((j + 0.61) / per_cell * grid.spacing_z);
      sink.clear();
      ght.spans({std::span(&x, 1), std::span(&z, 1)}, sink);
      truth.column({x, z}, stretches);
      ends.clear();
      for (const Span& s : sink.column(0)) ends.insert(ends.end(), {s.bottom, s.top});
      for (const events::Stretch& s : stretches) {
        ends.insert(ends.end(), {std::max<double>(s.bottom, ght.bounds().low.y), s.top});
      }
      std::sort(ends.begin(), ends.end());
      for (std::size_t e = 0; e + 1 < ends.size(); ++e) {
        const double y = (ends[e] + ends[e + 1]) / 2;
        if (y <= ght.bounds().low.y) continue;
        ++all.points;
        const auto holds = [y](const auto& s) { return y > s.bottom && y < s.top; };
        const bool tree_says = std::any_of(sink.column(0).begin(), sink.column(0).end(), holds);
        if (tree_says == std::any_of(stretches.begin(), stretches.end(), holds)) continue;
        for (const double end : {std::min(y, ends[e] + slip), std::max(y, ends[e + 1] - slip)}) {
          if (!near_by.has(tree_says, {x, end, z})) all.wrong.push_back({{x, end, z}, tree_says});
        }
      }
    }
  }
  return all;
}

inline events::Event moved(const events::Event& event, glm::dvec2 by) {
  return std::visit(
      [by](auto e) -> events::Event {
        if constexpr (requires { e.centre; }) {
          e.centre += glm::dvec3(by.x, 0, by.y);
        } else if constexpr (std::is_same_v<decltype(e.from), glm::dvec3>) {
          e.from += glm::dvec3(by.x, 0, by.y), e.to += glm::dvec3(by.x, 0, by.y);
        } else {
          e.from += by, e.to += by;
        }
        return e;
      },
      event);
}

// At the two ends of an inverse fault the surface runs down from the overhang to the ground beyond and back
// on itself: a cliff of no thickness, which is no ground in the evaluation's columns. The tree's cliffs are
// one sample spacing wide, and may contain ground.
inline bool at_end_of_overhang(const events::Event& event, glm::dvec3 at, double cell) {
  const auto* const fault = std::get_if<events::DipFault>(&event);
  if (fault == nullptr || !fault->inverse) return false;
  const glm::dvec2 local = fault->line().local({at.x, at.z});
  return std::min(std::abs(local.x), std::abs(local.x - fault->line().length)) <= cell &&
         std::abs(local.y) <= fault->offset() / 2 + cell;
}

// In a sequence, a difference of less than one spacing can grow: a fault opens its line into a scarp and
// moves a cliff beside the line by o = throw / tan(dip), in any structure. So a point counts only if it stays
// wrong when the ground before the fault is moved by up to one spacing.
inline Disagreement compare(const Ght& ght, const std::shared_ptr<const events::Sculpture>& sculpture,
                            int per_cell = 1) {
  const events::Evaluation evaluation(sculpture);
  Disagreement all = compare(ght, evaluation, per_cell);
  const ght::SampleGrid& grid = ght.model().tree.grid();
  const auto explained = [&](const Disagreement::Point& point) {
    constexpr int kSteps = 3;  // per sample spacing
    for (std::size_t first = 0; first < sculpture->events.size(); ++first) {
      if (at_end_of_overhang(sculpture->events[first], point.at, grid.spacing()) &&
          NearBy(evaluation, grid).between_surfaces(point.at)) {
        return true;
      }
      if (!std::holds_alternative<events::DipFault>(sculpture->events[first])) continue;
      for (int k = 0; k < (2 * kSteps + 1) * (2 * kSteps + 1); ++k) {
        const glm::dvec2 by{(k % (2 * kSteps + 1) - kSteps) * grid.spacing_x / kSteps,
                            (k / (2 * kSteps + 1) - kSteps) * grid.spacing_z / kSteps};
        // Instead of the ground, the fault, the later events and the point are moved the other way.
        auto other = std::make_shared<events::Sculpture>(*sculpture);
        for (std::size_t e = first; e < other->events.size(); ++e) {
          other->events[e] = moved(other->events[e], -by);
        }
        try {
          const events::Evaluation truth(other);
          if (NearBy(truth, grid).has(point.ground, point.at - glm::dvec3(by.x, 0, by.y))) return true;
        } catch (const events::EventError&) {
          continue;  // now leaves the terrain
        }
      }
    }
    return false;
  };
  all.explained = std::erase_if(all.wrong, explained);
  return all;
}

}  // namespace terrabench::test
