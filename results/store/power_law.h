// The power law through measurements: least squares of the logarithms, and the 95 % interval of the exponent
// by Student's t with two degrees of freedom fewer than points (Draper & Smith 1998, §1.4). The interval
// assumes that the errors of the points are independent and of one relative size.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace terrabench {

struct PowerLaw {
  double exponent = 0;
  double low = 0, high = 0;  // 95 % interval of the exponent; infinite with two points
  std::size_t points = 0;
};

// y ∝ x^exponent. Nothing for fewer than two distinct x, nor where an x or y is not above 0: a fit through
// the other points would hide a faulty one. The spans are of one length. O(points).
std::optional<PowerLaw> fit_power_law(std::span<const double> x, std::span<const double> y);

// The 97.5 % quantile of Student's t; infinite for 0 degrees of freedom. Exact to 0.001.
double student_t(std::size_t degrees);

}  // namespace terrabench
