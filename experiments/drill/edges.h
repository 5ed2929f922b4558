// Steps of height between neighbouring samples where drills end (Stuetzle & Franklin 2012, §2 and §4:
// discontinuities "can exist at the edge of, and on the border between, two drills").
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "representations/drill/drills.h"
#include "terrain/heightfield.h"

namespace terrabench::drill {

// Equation 1 as printed: one drill after another, in the given order, and which of them shaped each sample.
// O(drills · (2k + 1)²).
struct Drilled {
  static constexpr std::uint32_t kPlateau = UINT32_MAX;

  Heightfield terrain;
  std::vector<std::uint32_t> by;  // the drill that cut deepest, the first of equal ones; kPlateau for none
};
Drilled drill_one_by_one(const Drills& drills, std::span<const std::uint32_t> order);
std::vector<std::uint32_t> as_listed(const Drills& drills);

// Over pairs of samples side by side (4-neighbours), both with data, in metres.
struct Steps {
  double largest = 0, mean = 0;
  std::size_t pairs = 0;
};

Steps steps(const Heightfield& field);  // O(samples)

// Steps of the drilled terrain, split by what shaped the two samples: a pair lies across a window's border if
// one of the two lies outside the window of the drill that shaped the other. Every pair is in one of the two.
struct EdgeSteps {
  Steps across, inside;
};
EdgeSteps edge_steps(const Drills& drills, const Drilled& drilled);

}  // namespace terrabench::drill
