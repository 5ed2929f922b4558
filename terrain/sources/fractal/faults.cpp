#include "terrain/sources/fractal/faults.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string_view>

#include "terrain/sources/fractal/counter_random.h"
#include "terrain/sources/fractal/limits.h"

namespace terrabench::fractal {
namespace {

// Of FaultOptions or PlanetFaultOptions.
template <class Options>
void check_faults(const Options& options, std::string_view where) {
  constexpr int kMostFaults = 1'000'000;
  check_side(options.width, "width", where);
  check_side(options.depth, "depth", where);
  check_between(options.faults, 0, kMostFaults, "faults", where);
  check_between(options.step, 0, kLargestMetres, "step", where);
}

// A field of width × depth samples whose first `columns` columns hold the sums of all faults, in metres.
// crossings_of(row) returns a function of (fault, sum, turns) that adds what a fault does to that row: to
// `sum`, the steps at its first sample, and to `turns[i]`, how many more there are from sample i on. Parallel
// over rows, O(depth · (faults + width)).
template <class CrossingsOf, class Options>
Heightfield sum_of_faults(const Options& options, int columns, const CrossingsOf& crossings_of) {
  Heightfield field = Heightfield::zeros(options.width, options.depth);
  constexpr int kRowsPerTask = 16;
  tbb::parallel_for(tbb::blocked_range<int>(0, options.depth, kRowsPerTask), [&](const auto& rows) {
    std::vector<int> turns;
    for (int j = rows.begin(); j < rows.end(); ++j) {
      turns.assign(static_cast<std::size_t>(columns) + 1, 0);
      int sum = 0;
      const auto cross = crossings_of(j);
      for (std::size_t k = 0; k < static_cast<std::size_t>(options.faults); ++k) cross(k, sum, turns);
      for (int i = 0; i < columns; ++i) {
        sum += turns[static_cast<std::size_t>(i)];
        field.at(i, j) = static_cast<float>(sum * static_cast<double>(options.step));
      }
    }
  });
  return field;
}

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

namespace {

// On one parallel the points that a plane lifts are one arc, whose ends follow from a formula to within a
// column; which columns belong to it is then decided by the plane itself.
constexpr char kOnSphere[] = "fault formation on the sphere";

// sin(2π · part / whole), 0 ≤ part < whole. Sums and products alone: the libraries' sines may differ by
// machine. Multiples of a quarter turn are exact, and so are all symmetries.
double sine_of_turn(std::int64_t part, std::int64_t whole) {
  const std::int64_t quarter = 4 * part / whole, rest = 4 * part - quarter * whole;
  // Within the quarter, rising or falling, and through whichever of sine and cosine has the smaller angle.
  const std::int64_t up = quarter % 2 == 0 ? rest : whole - rest;
  const bool small = 2 * up <= whole;
  const double angle =
      0.5 * std::numbers::pi * static_cast<double>(small ? up : whole - up) / static_cast<double>(whole);
  double term = small ? angle : 1, value = term;
  for (int k = small ? 2 : 1; k < 20; k += 2) {
    term *= -angle * angle / (k * (k + 1));
    value += term;
  }
  return quarter < 2 ? value : -value;
}

struct SineTable {
  // Of `columns` angles around a turn, from half a turn back; three turns, so that an arc can be followed
  // over the date line without a modulus.
  explicit SineTable(int columns) : turn(columns) {
    const std::int64_t n = 4 * static_cast<std::int64_t>(columns);
    for (int i = 0; i < 3 * columns; ++i) {
      const std::int64_t part = 4 * static_cast<std::int64_t>(i) + n / 2;
      sine.push_back(sine_of_turn(part % n, n));
      cosine.push_back(sine_of_turn((part + n / 4) % n, n));
    }
  }
  int turn;
  std::vector<double> sine, cosine;
};

// A plane as the columns see it: the height of a point of the unit circle at the equator over the plane's
// direction is `east(i)`, largest at `summit` and least at `bottom`.
struct Wave {
  FaultPlane plane;
  double reach;        // of the direction, in the plane of the equator
  int summit, bottom;  // columns of the middle turn; summit < bottom < summit + turn
};

double height_along(const FaultPlane& plane, const SineTable& table, int column) {
  const auto i = static_cast<std::size_t>(column);
  return plane.x * table.cosine[i] + plane.z * table.sine[i];
}

Wave wave_of(const FaultPlane& plane, const SineTable& table) {
  Wave wave{plane, std::sqrt(plane.x * plane.x + plane.z * plane.z), 0, 0};
  const int n = table.turn;
  const double turns = std::atan2(plane.z, plane.x) / (2 * std::numbers::pi) + 0.5;
  const int near = n + std::clamp(static_cast<int>(turns * n), 0, n - 1);
  const auto best = [&](int middle, double sign) {
    int chosen = middle - 1;
    for (int i = middle; i <= middle + 1; ++i) {
      if (sign * height_along(plane, table, i) > sign * height_along(plane, table, chosen)) chosen = i;
    }
    return chosen;
  };
  wave.summit = best(near, 1);
  wave.bottom = best(near + n / 2, -1);
  return wave;
}

// Adds what the plane does to the parallel at sine and cosine of its latitude.
void cross(const Wave& wave, const SineTable& table, double sine, double cosine, int& sum,
           std::vector<int>& turns) {
  const int n = table.turn;
  const double level = wave.plane.offset - wave.plane.y * sine;
  const auto rises = [&](int column) { return cosine * height_along(wave.plane, table, column) > level; };
  if (!rises(wave.summit)) {
    --sum;
    return;
  }
  if (rises(wave.bottom)) {
    ++sum;
    return;
  }
  const double half_turns =
      std::acos(std::clamp(level / (cosine * wave.reach), -1.0, 1.0)) / (2 * std::numbers::pi);
  const int half = static_cast<int>(half_turns * n);
  int east = std::min(wave.summit + half, wave.bottom - 1);
  int west = std::max(wave.summit - half, wave.bottom - n + 1);
  while (!rises(east)) --east;
  while (east + 1 < wave.bottom && rises(east + 1)) ++east;
  while (!rises(west)) ++west;
  while (west - 1 > wave.bottom - n && rises(west - 1)) --west;

  // Columns west … east rise, in coordinates of the middle turn.
  const auto column = [&](int i) { return static_cast<std::size_t>((i % n + n) % n); };
  --sum;
  const std::size_t first = column(west), after = column(east + 1);
  turns[first] += 2;
  turns[after] -= 2;
  if (after <= first) sum += 2;  // the arc holds the date line
}

FaultPlane fault_plane(const PlanetFaultOptions& options, int number) {
  const CounterRandom random(options.seed, kPlanetFaults, static_cast<std::uint64_t>(number));
  FaultPlane plane{};
  std::uint64_t drawn = 0;
  double squared = 0;
  while (squared < 1e-4 || squared > 1) {  // directions spread evenly over a ball
    for (double* const part : {&plane.x, &plane.y, &plane.z}) *part = 2 * random.share(drawn++) - 1;
    squared = plane.x * plane.x + plane.y * plane.y + plane.z * plane.z;
  }
  const double length = std::sqrt(squared);
  plane.x /= length;
  plane.y /= length;
  plane.z /= length;
  plane.offset = 2 * random.share(drawn) - 1;
  return plane;
}

}  // namespace

std::vector<FaultPlane> fault_planes(const PlanetFaultOptions& options) {
  check_faults(options, kOnSphere);
  check_between(options.width, 5, kLargestSide, "width",
                kOnSphere);  // four columns around, and the first again
  check_between(options.radius, 1e-3, kLargestMetres, "radius", kOnSphere);
  std::vector<FaultPlane> planes;
  planes.reserve(static_cast<std::size_t>(options.faults));
  for (int k = 0; k < options.faults; ++k) planes.push_back(fault_plane(options, k));
  return planes;
}

Heightfield planet_faults(const PlanetFaultOptions& options) {
  const std::vector<FaultPlane> planes = fault_planes(options);
  check_memory(options.width, options.depth, kOnSphere);
  const int columns = options.width - 1, parallels = options.depth - 1;
  const SineTable table(columns);
  std::vector<Wave> waves;
  for (const FaultPlane& plane : planes) waves.push_back(wave_of(plane, table));
  Heightfield field = sum_of_faults(options, columns, [&](int j) {
    // Row j is j half-turns of parallels from the north pole: its sine is the cosine of that angle.
    const std::int64_t whole = 8 * static_cast<std::int64_t>(parallels),
                       part = 4 * static_cast<std::int64_t>(j);
    const double sine = sine_of_turn((part + whole / 4) % whole, whole), cosine = sine_of_turn(part, whole);
    return [&, sine, cosine](std::size_t k, int& sum, std::vector<int>& turns) {
      cross(waves[k], table, sine, cosine, sum, turns);
    };
  });
  for (int j = 0; j < options.depth; ++j) field.at(columns, j) = field.at(0, j);
  const double degree_metres = options.radius * std::numbers::pi / 180;
  field.cell_x = static_cast<float>(360.0 / columns * degree_metres);
  field.cell_z = static_cast<float>(180.0 / parallels * degree_metres);
  return field;
}

}  // namespace terrabench::fractal
