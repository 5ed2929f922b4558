#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "representations/procedural_mesh/growing/expression.h"
#include "terrain/splitmix.h"

namespace terrabench::growing {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double gradient(std::uint64_t hash, double x, double y, double z) {
  // The 12 edges of a cube, four of them twice.
  const auto h = static_cast<unsigned>(hash >> 60);
  const double u = h < 8 ? x : y;
  const double v = h < 4 ? y : h == 12 || h == 14 ? x : z;
  return ((h & 1U) != 0 ? -u : u) + ((h & 2U) != 0 ? -v : v);
}

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

}  // namespace

double gradient_noise(double x, double y, double z) {
  constexpr double kFar = 1e15;  // beyond it a double has too few bits for a position in a cell
  if (!(std::abs(x) < kFar && std::abs(y) < kFar && std::abs(z) < kFar)) return kNaN;
  const double cx = std::floor(x), cy = std::floor(y), cz = std::floor(z);
  const double fx = x - cx, fy = y - cy, fz = z - cz;
  const auto corner = [&](int i, int j, int k) {
    const auto ix = static_cast<std::uint64_t>(static_cast<std::int64_t>(cx) + i);
    const auto iy = static_cast<std::uint64_t>(static_cast<std::int64_t>(cy) + j);
    const auto iz = static_cast<std::uint64_t>(static_cast<std::int64_t>(cz) + k);
    return gradient(scramble(ix + scramble(iy + scramble(iz))), fx - i, fy - j, fz - k);
  };
  const double u = fade(fx), v = fade(fy), w = fade(fz);
  const auto along_x = [&](int j, int k) { return std::lerp(corner(0, j, k), corner(1, j, k), u); };
  const auto plane = [&](int k) { return std::lerp(along_x(0, k), along_x(1, k), v); };
  return std::lerp(plane(0), plane(1), w);
}

std::span<const Function> functions() {
  using Arguments = const double*;
  static constexpr Function kAll[] = {
      {"sin", 1, [](Arguments a) { return std::sin(a[0] * kDegree); }},
      {"cos", 1, [](Arguments a) { return std::cos(a[0] * kDegree); }},
      {"tan", 1, [](Arguments a) { return std::tan(a[0] * kDegree); }},
      {"asin", 1, [](Arguments a) { return std::asin(a[0]) / kDegree; }},
      {"acos", 1, [](Arguments a) { return std::acos(a[0]) / kDegree; }},
      {"atan2", 2, [](Arguments a) { return std::atan2(a[0], a[1]) / kDegree; }},
      {"sqrt", 1, [](Arguments a) { return std::sqrt(a[0]); }},
      {"abs", 1, [](Arguments a) { return std::abs(a[0]); }},
      {"floor", 1, [](Arguments a) { return std::floor(a[0]); }},
      {"ceil", 1, [](Arguments a) { return std::ceil(a[0]); }},
      {"round", 1, [](Arguments a) { return std::round(a[0]); }},
      {"sign", 1, [](Arguments a) { return a[0] > 0   ? 1.0
                                           : a[0] < 0 ? -1.0
                                                      : 0.0; }},
      {"exp", 1, [](Arguments a) { return std::exp(a[0]); }},
      {"log", 1, [](Arguments a) { return std::log(a[0]); }},
      {"min", 2, [](Arguments a) { return std::min(a[0], a[1]); }},
      {"max", 2, [](Arguments a) { return std::max(a[0], a[1]); }},
      {"clamp", 3, [](Arguments a) { return a[1] > a[2] ? kNaN : std::min(std::max(a[0], a[1]), a[2]); }},
      {"mix", 3, [](Arguments a) { return a[0] + (a[1] - a[0]) * a[2]; }},
      {"noise", 3, [](Arguments a) { return gradient_noise(a[0], a[1], a[2]); }},
      {"random", 0, nullptr, Code::kRandom},
      {"random", 2, nullptr, Code::kRandomBetween}};
  return kAll;
}

// A sign that begins with another one comes first.
std::span<const Function> signs() {
  using Arguments = const double*;
  static constexpr Function kAll[] = {
      {"<=", 2, [](Arguments a) { return a[0] <= a[1] ? 1.0 : 0.0; }, Code::kCall, 0},
      {">=", 2, [](Arguments a) { return a[0] >= a[1] ? 1.0 : 0.0; }, Code::kCall, 0},
      {"==", 2, [](Arguments a) { return a[0] == a[1] ? 1.0 : 0.0; }, Code::kCall, 0},
      {"!=", 2, [](Arguments a) { return a[0] != a[1] ? 1.0 : 0.0; }, Code::kCall, 0},
      {"<", 2, [](Arguments a) { return a[0] < a[1] ? 1.0 : 0.0; }, Code::kCall, 0},
      {">", 2, [](Arguments a) { return a[0] > a[1] ? 1.0 : 0.0; }, Code::kCall, 0},
      {"+", 2, nullptr, Code::kAdd, 1},
      {"-", 2, nullptr, Code::kSubtract, 1},
      {"*", 2, nullptr, Code::kMultiply, 2},
      {"/", 2, [](Arguments a) { return a[1] == 0 ? kNaN : a[0] / a[1]; }, Code::kCall, 2},
      {"%", 2, [](Arguments a) { return a[1] == 0 ? kNaN : a[0] - a[1] * std::floor(a[0] / a[1]); },
       Code::kCall, 2}};
  return kAll;
}

double evaluate(const Expression& expression, const Values& values) {
  std::array<double, kMostStack> stack;
  double* top = stack.data();  // the next free entry
  const Operation* const code = expression.code.data();
  const std::size_t size = expression.code.size();
  for (std::size_t at = 0; at < size; ++at) {
    const Operation& operation = code[at];
    switch (operation.code) {
      case Code::kNumber:
        *top++ = operation.value;
        continue;
      case Code::kVariable:
        *top++ = values.variables[operation.where];
        continue;
      case Code::kTable: {
        const double index = std::floor(top[-1]);
        if (!(index >= 0 && index < operation.value)) return kNaN;
        top[-1] = values.tables[operation.where + static_cast<std::size_t>(index)];
        continue;
      }
      case Code::kJump:
        at = operation.where - 1;
        continue;
      case Code::kJumpIfNot:
        if (*--top == 0) at = operation.where - 1;
        continue;
      case Code::kRandom:
        *top++ = random_share(values.random, operation.where);
        continue;
      case Code::kRandomBetween:
        --top;
        top[-1] += (*top - top[-1]) * random_share(values.random, operation.where);
        break;
      case Code::kAdd:
        --top;
        top[-1] += *top;
        break;
      case Code::kSubtract:
        --top;
        top[-1] -= *top;
        break;
      case Code::kMultiply:
        --top;
        top[-1] *= *top;
        break;
      case Code::kCall:
        top -= operation.arguments - 1;
        top[-1] = operation.call(top - 1);
    }
    if (!std::isfinite(top[-1])) return kNaN;
  }
  return std::isfinite(top[-1]) ? top[-1] : kNaN;
}

}  // namespace terrabench::growing
