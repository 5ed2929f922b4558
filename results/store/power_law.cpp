#include "results/store/power_law.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace terrabench {

double student_t(std::size_t degrees) {
  constexpr std::array kFew = {12.7062, 4.3027, 3.1824, 2.7764, 2.5706,
                               2.4469,  2.3646, 2.3060, 2.2622, 2.2281};
  if (degrees == 0) return std::numeric_limits<double>::infinity();
  if (degrees <= kFew.size()) return kFew[degrees - 1];
  // Cornish and Fisher's expansion around the normal distribution.
  constexpr double z = 1.959964;
  const auto n = static_cast<double>(degrees);
  return z + (std::pow(z, 3) + z) / (4 * n) +
         (5 * std::pow(z, 5) + 16 * std::pow(z, 3) + 3 * z) / (96 * n * n) +
         (3 * std::pow(z, 7) + 19 * std::pow(z, 5) + 17 * std::pow(z, 3) - 15 * z) / (384 * n * n * n);
}

std::optional<PowerLaw> fit_power_law(std::span<const double> x, std::span<const double> y) {
  assert(x.size() == y.size());
  std::vector<double> u, v;  // logarithms
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!(x[i] > 0 && y[i] > 0)) return std::nullopt;
    u.push_back(std::log(x[i]));
    v.push_back(std::log(y[i]));
  }
  const auto n = static_cast<double>(u.size());
  double mean_u = 0, mean_v = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    mean_u += u[i] / n;
    mean_v += v[i] / n;
  }
  double uu = 0, uv = 0, largest = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    uu += (u[i] - mean_u) * (u[i] - mean_u);
    uv += (u[i] - mean_u) * (v[i] - mean_v);
    largest = std::max(largest, std::abs(u[i]));
  }
  if (u.size() < 2 || uu <= 1e-12 * largest * largest) return std::nullopt;
  PowerLaw law{uv / uu, 0, 0, u.size()};
  double left = 0;  // squares that the line does not explain
  for (std::size_t i = 0; i < u.size(); ++i) {
    const double off = v[i] - mean_v - law.exponent * (u[i] - mean_u);
    left += off * off;
  }
  const std::size_t degrees = u.size() - 2;
  const double half = degrees == 0 ? std::numeric_limits<double>::infinity()
                                   : student_t(degrees) * std::sqrt(left / static_cast<double>(degrees) / uu);
  law.low = law.exponent - half;
  law.high = law.exponent + half;
  return law;
}

}  // namespace terrabench
