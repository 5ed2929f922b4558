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

// Whether the evaluation has ground (or air, as asked) in [y - cell, y + cell] on one of the columns within a
// cell of (x, z) to all sides.
class NearBy {
 public:
  NearBy(const events::Evaluation& truth, const ght::Lattice& lattice) : truth_(truth), lattice_(lattice) {}

  bool has(bool ground, glm::dvec3 p) {
    const double cell = lattice_.cell();
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
  // Whether surfaces that face up lie over the point and under it.
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
    constexpr int kSteps = 6;  // a cell
    for (int dz = -kSteps; dz <= kSteps; ++dz) {
      for (int dx = -kSteps; dx <= kSteps; ++dx) {
        const glm::dvec2 plan{p.x + dx * lattice_.cell_x / kSteps, p.z + dz * lattice_.cell_z / kSteps};
        if (plan.x < 0 || plan.y < 0 || plan.x > lattice_.x(lattice_.width - 1) ||
            plan.y > lattice_.z(lattice_.depth - 1)) {
          continue;
        }
        truth_.column(plan, stretches_);
        if (visit(stretches_)) return true;
      }
    }
    return false;
  }

  const events::Evaluation& truth_;
  const ght::Lattice& lattice_;
  std::vector<events::Stretch> stretches_;
};

// Points where tree and evaluation differ although the evaluation has only one answer within a cell of the
// point: the tree claims to be true to one cell. `per_cell` columns along a cell are asked; along each, every
// stretch on which the two differ is asked at both of its ends, which are furthest from what is right.
inline Disagreement compare(const Ght& ght, const events::Evaluation& truth, int per_cell = 1) {
  const ght::Lattice& lattice = ght.model().tree.lattice();
  const double slip = 1e-3 * lattice.cell();
  NearBy near_by(truth, lattice);
  Disagreement all;
  std::vector<events::Stretch> stretches;
  std::vector<double> ends;
  SpanSink sink;
  const auto columns = [&](int samples) { return (samples - 1) * per_cell; };
  for (int j = 0; j < columns(lattice.depth); ++j) {
    for (int i = 0; i < columns(lattice.width); ++i) {
      // Off the samples, so that no column runs along an edge.
      const auto x = static_cast<float>((i + 0.37) / per_cell * lattice.cell_x),
                 z = static_cast<float>((j + 0.61) / per_cell * lattice.cell_z);
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

// At the two ends of an inverse fault the sheet of the ground runs down from the overhang to the ground
// beyond and back on itself: a cliff of no thickness, which is no ground in the evaluation's columns. The
// tree's cliffs are a cell wide, and there it may have ground.
inline bool at_end_of_overhang(const events::Event& event, glm::dvec3 at, double cell) {
  const auto* const fault = std::get_if<events::DipFault>(&event);
  if (fault == nullptr || !fault->inverse) return false;
  const glm::dvec2 local = fault->line().local({at.x, at.z});
  return std::min(std::abs(local.x), std::abs(local.x - fault->line().length)) <= cell &&
         std::abs(local.y) <= fault->offset() / 2 + cell;
}

// A sequence need not keep two grounds within a cell of one another that are so: a fault opens its line into
// a scarp and turns a cliff beside the line into one o = throw / tan(dip) away, for whatever structure. So a
// point counts only if it stays wrong when the ground that a fault meets is moved by up to a cell first.
inline Disagreement compare(const Ght& ght, const std::shared_ptr<const events::Sculpture>& sculpture,
                            int per_cell = 1) {
  const events::Evaluation evaluation(sculpture);
  Disagreement all = compare(ght, evaluation, per_cell);
  const ght::Lattice& lattice = ght.model().tree.lattice();
  const auto explained = [&](const Disagreement::Point& point) {
    constexpr int kSteps = 3;  // a cell
    for (std::size_t first = 0; first < sculpture->events.size(); ++first) {
      if (at_end_of_overhang(sculpture->events[first], point.at, lattice.cell()) &&
          NearBy(evaluation, lattice).between_surfaces(point.at)) {
        return true;
      }
      if (!std::holds_alternative<events::DipFault>(sculpture->events[first])) continue;
      for (int k = 0; k < (2 * kSteps + 1) * (2 * kSteps + 1); ++k) {
        const glm::dvec2 by{(k % (2 * kSteps + 1) - kSteps) * lattice.cell_x / kSteps,
                            (k / (2 * kSteps + 1) - kSteps) * lattice.cell_z / kSteps};
        // The fault and what follows go the other way instead, and so does the point.
        auto other = std::make_shared<events::Sculpture>(*sculpture);
        for (std::size_t e = first; e < other->events.size(); ++e) {
          other->events[e] = moved(other->events[e], -by);
        }
        try {
          const events::Evaluation truth(other);
          if (NearBy(truth, lattice).has(point.ground, point.at - glm::dvec3(by.x, 0, by.y))) return true;
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
