#include "terrain/sources/fractal/faults.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "terrain/sources/fractal/counter_random.h"
#include "terrain/sources/fractal/sum_of_faults.h"

namespace terrabench::fractal {
namespace {

constexpr char kWhere[] = "fault formation";

FaultLine fault_line(const FaultOptions& options, int number) {
  const CounterRandom random(options.seed, kFaults, static_cast<std::uint64_t>(number));
  // Whole directions spread evenly over a disc; those near its centre are too coarse.
  constexpr std::int64_t kReach = 1 << 15, kLeast = 1 << 10;
  FaultLine line{};
  std::uint64_t drawn = 0;
  for (std::int64_t squared = 0; squared < kLeast * kLeast || squared > kReach * kReach;) {
    line.a = static_cast<std::int64_t>(random.below(2 * kReach, drawn++)) - kReach;
    line.b = static_cast<std::int64_t>(random.below(2 * kReach, drawn++)) - kReach;
    squared = line.a * line.a + line.b * line.b;
  }
  // Between the values at the corners, so that the line leaves samples on both sides.
  const std::int64_t east = line.a * (options.width - 1), south = line.b * (options.depth - 1);
  const std::int64_t lowest = std::min<std::int64_t>(east, 0) + std::min<std::int64_t>(south, 0);
  const auto span = static_cast<std::uint64_t>(std::abs(east) + std::abs(south));
  line.c = lowest + static_cast<std::int64_t>(random.below(span, drawn));
  return line;
}

// Adds what the line does to row j: to the sum at its west end, and where it crosses.
void cross(const FaultLine& line, int j, int width, int& sum, std::vector<int>& turns) {
  const std::int64_t rest = line.c - line.b * j;
  if (line.a == 0) {
    sum += rest < 0 ? 1 : -1;
    return;
  }
  // All numbers have at most 32 bits, and a fraction over a ≤ 2^15 is at least 2^-15 from a whole number it
  // does not equal: the rounded quotient has the same floor as the true one.
  const double at = static_cast<double>(rest) / static_cast<double>(line.a);
  const bool rises_in_the_east = line.a > 0;
  const double first = rises_in_the_east ? std::floor(at) + 1 : std::ceil(at);  // sample of the other side
  const int west = rises_in_the_east ? -1 : 1;
  const double inside = std::clamp(first, 0.0, static_cast<double>(width));
  sum += west;
  turns[static_cast<std::size_t>(inside)] -= 2 * west;
}

}  // namespace

std::vector<FaultLine> fault_lines(const FaultOptions& options) {
  check_faults(options, kWhere);
  check_between(options.cell, 1e-6, kLargestMetres, "cell", kWhere);
  std::vector<FaultLine> lines;
  lines.reserve(static_cast<std::size_t>(options.faults));
  for (int k = 0; k < options.faults; ++k) lines.push_back(fault_line(options, k));
  return lines;
}

Heightfield fault_terrain(const FaultOptions& options) {
  const std::vector<FaultLine> lines = fault_lines(options);
  check_memory(options.width, options.depth, kWhere);
  Heightfield field = sum_of_faults(options, options.width, [&](int j) {
    return [&, j](std::size_t k, int& sum, std::vector<int>& turns) {
      cross(lines[k], j, options.width, sum, turns);
    };
  });
  field.cell_x = field.cell_z = options.cell;
  return field;
}

}  // namespace terrabench::fractal
