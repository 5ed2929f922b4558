#include <array>
#include <cmath>
#include <numbers>

#include "representations/procedural_mesh/growing/expression.h"
#include "representations/procedural_mesh/growing/operations.h"
#include "terrain/splitmix.h"

namespace terrabench::growing {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double one(Code code, double a) {
  switch (code) {
    case Code::kTruth:
      return a != 0 ? 1 : 0;
    case Code::kNegate:
      return -a;
    case Code::kNot:
      return a == 0 ? 1 : 0;
    case Code::kSin:
      return std::sin(a * kDegree);
    case Code::kCos:
      return std::cos(a * kDegree);
    case Code::kTan:
      return std::tan(a * kDegree);
    case Code::kAsin:
      return std::asin(a) / kDegree;
    case Code::kAcos:
      return std::acos(a) / kDegree;
    case Code::kSqrt:
      return std::sqrt(a);
    case Code::kAbs:
      return std::abs(a);
    case Code::kFloor:
      return std::floor(a);
    case Code::kCeil:
      return std::ceil(a);
    case Code::kRound:
      return std::round(a);
    case Code::kSign:
      return a > 0 ? 1 : a < 0 ? -1 : 0;
    case Code::kExp:
      return std::exp(a);
    case Code::kLog:
      return std::log(a);
    default:
      return kNaN;
  }
}

double two(Code code, double a, double b) {
  switch (code) {
    case Code::kAdd:
      return a + b;
    case Code::kSubtract:
      return a - b;
    case Code::kMultiply:
      return a * b;
    case Code::kDivide:
      return b == 0 ? kNaN : a / b;
    case Code::kModulo:
      return b == 0 ? kNaN : a - b * std::floor(a / b);
    case Code::kPower:
      return std::pow(a, b);
    case Code::kLess:
      return a < b ? 1 : 0;
    case Code::kLessOrEqual:
      return a <= b ? 1 : 0;
    case Code::kGreater:
      return a > b ? 1 : 0;
    case Code::kGreaterOrEqual:
      return a >= b ? 1 : 0;
    case Code::kEqual:
      return a == b ? 1 : 0;
    case Code::kNotEqual:
      return a != b ? 1 : 0;
    case Code::kAtan2:
      return std::atan2(a, b) / kDegree;
    case Code::kMin:
      return std::min(a, b);
    case Code::kMax:
      return std::max(a, b);
    default:
      return kNaN;
  }
}

double three(Code code, double a, double b, double c) {
  if (code == Code::kClamp) return b > c ? kNaN : std::min(std::max(a, b), c);
  if (code == Code::kMix) return a + (b - a) * c;
  return gradient_noise(a, b, c);
}

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

double evaluate(const Expression& expression, const Values& values) {
  std::array<double, kMostStack> stack;
  double* top = stack.data();  // the next free entry
  const Operation* const code = expression.code.data();
  const std::size_t size = expression.code.size();
  for (std::size_t at = 0; at < size; ++at) {
    const Operation& operation = code[at];
    switch (static_cast<Code>(operation.code)) {
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
      default:
        if (operation.arguments == 1) {
          top[-1] = one(static_cast<Code>(operation.code), top[-1]);
        } else if (operation.arguments == 2) {
          --top;
          top[-1] = two(static_cast<Code>(operation.code), top[-1], *top);
        } else {
          top -= 2;
          top[-1] = three(static_cast<Code>(operation.code), top[-1], top[0], top[1]);
        }
    }
    if (!std::isfinite(top[-1])) return kNaN;
  }
  return std::isfinite(top[-1]) ? top[-1] : kNaN;
}

}  // namespace terrabench::growing
