#include "experiments/meshgrow/ring_eigenvalue.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace terrabench::meshgrow {
namespace {

// One step of a vertex with n faces and its ring: values[0] is the vertex, then the ends of its edges, then
// the far corners of its faces, face k between edges k and k + 1.
std::vector<double> step_of_ring(const std::vector<double>& values) {
  const std::size_t n = (values.size() - 1) / 2;
  const double v = values[0];
  std::vector<double> next(values.size());
  const auto edge = [&](std::size_t k) { return values[1 + k % n]; };
  const auto face_point = [&](std::size_t k) {
    return (v + edge(k) + edge(k + 1) + values[1 + n + k % n]) / 4;
  };
  double edges = 0, faces = 0;
  for (std::size_t k = 0; k < n; ++k) {
    edges += (v + edge(k)) / 2;
    faces += face_point(k);
    next[1 + k] = (v + edge(k) + face_point(k + n - 1) + face_point(k)) / 4;
    next[1 + n + k] = face_point(k);
  }
  const auto count = static_cast<double>(n);
  next[0] = (faces / count + 2 * edges / count + (count - 3) * v) / count;
  return next;
}

// Takes the constant vector out, whose eigenvalue is 1. Rounding brings it back at each step.
void remove_constant(std::vector<double>& values) {
  for (std::size_t k = values.size(); k-- > 0;) values[k] -= values[0];
}

}  // namespace

double ring_eigenvalue(std::size_t n, int turns) {
  std::vector<double> x(1 + 2 * n);
  x[0] = turns == 0 ? 1 : 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * turns / static_cast<double>(n);
    x[1 + k] = turns == 0 ? 0.3 : std::cos(angle * static_cast<double>(k));
    x[1 + n + k] = turns == 0 ? -0.2 : 1.5 * std::cos(angle * (static_cast<double>(k) + 0.5));
  }
  remove_constant(x);
  double factor = 0;
  for (int i = 0; i < 100; ++i) {
    std::vector<double> y = step_of_ring(x);
    remove_constant(y);
    factor = y[1] / x[1];
    const double scale = y[1];
    for (double& value : y) value /= scale;
    x = std::move(y);
  }
  return factor;
}

}  // namespace terrabench::meshgrow
