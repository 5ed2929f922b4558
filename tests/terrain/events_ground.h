// Grounds of 65×65 samples, a metre apart, whose heights are a formula.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "terrain/events/evaluate.h"
#include "tests/terrain/ground.h"

namespace terrabench::events {

template <class Height>
Heightfield ground_of(const Height& height) {
  return test::ground_of(65, 65, height);
}

inline Heightfield flat() {
  return ground_of([](double, double) { return 20; });
}
inline Heightfield rising_east() {
  return ground_of([](double x, double) { return 20 + 0.25 * x; });
}
inline Heightfield rising_north() {
  return ground_of([](double, double z) { return 20 + 0.5 * (32 - z); });
}
// 30 m high from x = 24 to 40, then down by 2 in 1 to 10 m.
inline Heightfield ridge() {
  return ground_of(
      [](double x, double) { return std::fmax(10, 30 - 2 * std::fmax(0, std::abs(x - 32) - 8)); });
}

inline Evaluation after(Heightfield ground, std::vector<Event> events) {
  return Evaluation(std::make_shared<const Sculpture>(Sculpture{std::move(ground), std::move(events)}));
}
inline std::vector<Stretch> column(const Evaluation& evaluation, double x, double z) {
  std::vector<Stretch> out;
  evaluation.column({x, z}, out);
  return out;
}
// Of ground that is a plain surface there.
inline double height(const Evaluation& evaluation, double x, double z) {
  const std::vector<Stretch> solid = column(evaluation, x, z);
  return solid.size() == 1 && solid[0].bottom == -HUGE_VAL ? solid[0].top : NAN;
}

// A square of 4 m around the axis.
inline Carving square_tunnel(glm::dvec3 from, glm::dvec3 to) {
  Carving tunnel;
  tunnel.from = from;
  tunnel.to = to;
  tunnel.section = {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}};
  return tunnel;
}

}  // namespace terrabench::events
