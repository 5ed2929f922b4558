// The tree against the independent evaluation of the same events (terrain/events/evaluate.h).
#pragma once

#include "terrain/events/evaluate.h"
#include "tests/representations/ght_ground.h"

namespace terrabench::test {

struct Disagreement {
  std::size_t points = 0, wrong = 0;
  glm::dvec3 worst{0};  // one of the wrong points
};

// Points where tree and evaluation differ although the evaluation has only one answer within a cell of the
// point: the tree claims to be true to one cell. `per_cell` columns along a cell are asked; along each column
// the ends of all stretches of the two are what decides.
inline Disagreement compare(const Ght& ght, const events::Evaluation& truth, int per_cell = 1) {
  const ght::Lattice& lattice = ght.model().tree.lattice();
  const double cell = lattice.cell();
  const auto solid_at = [&](glm::dvec3 p, std::vector<events::Stretch>& scratch) {
    truth.column({p.x, p.z}, scratch);
    return std::any_of(scratch.begin(), scratch.end(),
                       [&](const events::Stretch& s) { return p.y >= s.bottom && p.y <= s.top; });
  };
  Disagreement all;
  std::vector<events::Stretch> stretches, scratch;
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
      std::vector<double> ends;
      for (const Span& s : sink.column(0)) ends.insert(ends.end(), {s.bottom, s.top});
      for (const events::Stretch& s : stretches) {
        ends.insert(ends.end(), {std::max<double>(s.bottom, ght.bounds().low.y), s.top});
      }
      std::sort(ends.begin(), ends.end());
      for (std::size_t e = 0; e + 1 < ends.size(); ++e) {
        const double y = (ends[e] + ends[e + 1]) / 2;
        if (y <= ght.bounds().low.y) continue;
        ++all.points;
        const bool tree_says = std::any_of(sink.column(0).begin(), sink.column(0).end(),
                                           [&](const Span& s) { return y > s.bottom && y < s.top; });
        if (tree_says == solid_at({x, y, z}, scratch)) continue;
        bool near = false;
        constexpr int kSteps = 6;  // a cell
        for (int dz = -kSteps; dz <= kSteps && !near; ++dz) {
          for (int dx = -kSteps; dx <= kSteps && !near; ++dx) {
            const glm::dvec2 plan{x + dx * lattice.cell_x / kSteps, z + dz * lattice.cell_z / kSteps};
            if (plan.x < 0 || plan.y < 0 || plan.x > lattice.x(lattice.width - 1) ||
                plan.y > lattice.z(lattice.depth - 1)) {
              continue;
            }
            truth.column(plan, scratch);
            // Whether [y - cell, y + cell] has what the tree says.
            if (tree_says) {
              for (const events::Stretch& s : scratch) near |= s.top >= y - cell && s.bottom <= y + cell;
            } else {
              double from = HUGE_VAL;  // the bottom of the stretch above
              for (const events::Stretch& s : scratch) {
                near |= s.top < from && s.top < y + cell && from > y - cell;
                from = s.bottom;
              }
            }
          }
        }
        if (!near) {
          ++all.wrong;
          all.worst = {x, y, z};
        }
      }
    }
  }
  return all;
}

}  // namespace terrabench::test
