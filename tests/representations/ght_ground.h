// Grounds and events for the tests of the grounded heightmap tree.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "representations/ght/ght.h"
#include "representations/ght/invariants.h"
#include "tests/representations/ground.h"
#include "tests/terrain/errors.h"

namespace terrabench::test {

// Hills some 25 cells wide and a fifth as high, roughened by `rough` cells per sample.
inline Heightfield rolling(int width, int depth, float cell = 1, float rough = 0.3F, unsigned seed = 1) {
  Heightfield field{width, depth, cell, cell, {}, {}};
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(-1, 1);
  const float phase = 3 * unit(random);
  for (int j = 0; j < depth; ++j) {
    for (int i = 0; i < width; ++i) {
      const auto x = static_cast<float>(i), z = static_cast<float>(j);
      field.heights.push_back(cell * (20 + 2.5F * std::sin(0.25F * x + phase) * std::cos(0.21F * z - phase) +
                                      rough * unit(random)));
    }
  }
  return field;
}

inline Ght make_ght(const Heightfield& field) {
  return Ght({field.width, field.depth, field.cell_x, field.cell_z, 0, 0}, field.heights,
             height_range(field).lowest - field.cell_x);
}

// What a refused event says; the tree stays as it was, to the bit.
inline std::string refusal(Ght& ght, const events::Event& event) {
  const std::vector<std::byte> before = saved(ght);
  const Failure failure = failure_of([&] { ght.apply(event); });
  EXPECT_EQ(failure.code, ExitCode::kBadInput);
  EXPECT_FALSE(failure.advice.empty());
  EXPECT_EQ(saved(ght), before);
  return failure.what;
}

inline void expect_sound(const Ght& ght) {
  EXPECT_THAT(ght::broken_invariants(ght.model()), testing::IsEmpty());
  EXPECT_TRUE(check_edges(ght.mesh({})).watertight());
}

}  // namespace terrabench::test
