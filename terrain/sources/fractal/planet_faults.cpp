// Fault formation on the sphere. On one parallel the points that a plane lifts are one arc, whose ends follow
// from a formula to within a column; which columns belong to it is then decided by the plane itself.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "terrain/sources/fractal/counter_random.h"
#include "terrain/sources/fractal/faults.h"
#include "terrain/sources/fractal/sum_of_faults.h"

namespace terrabench::fractal {
namespace {

constexpr char kWhere[] = "fault formation on the sphere";

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
  check_faults(options, kWhere);
  check_between(options.width, 5, kLargestSide, "width", kWhere);  // four columns around, and the first again
  check_between(options.radius, 1e-3, kLargestMetres, "radius", kWhere);
  std::vector<FaultPlane> planes;
  planes.reserve(static_cast<std::size_t>(options.faults));
  for (int k = 0; k < options.faults; ++k) planes.push_back(fault_plane(options, k));
  return planes;
}

Heightfield planet_faults(const PlanetFaultOptions& options) {
  const std::vector<FaultPlane> planes = fault_planes(options);
  check_memory(options.width, options.depth, kWhere);
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
