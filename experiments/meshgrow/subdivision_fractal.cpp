// Fractal surfaces (§3 of "meshgrow"): the spectrum of a plane, height fields, and the error where
// subdivision stops.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <numeric>

#include "experiments/cases.h"
#include "experiments/meshgrow/subdivision_reference.h"
#include "representations/procedural_mesh/base_mesh.h"
#include "representations/procedural_mesh/subdivision/subdivide.h"

namespace terrabench::meshgrow {
namespace {

using namespace subdivision;

// So that a plane stays square.
constexpr RefinementOptions kCornersStay{.boundary = Boundary::kEdgeAndCorner};

// Figure 2: random displacements in proportion to the local scale factor give a 1/f
// surface.
//
// Theory. At level l the local scale factor is s = c 2^-l. Independent displacements of deviation d s^a at
// vertices 2^-l apart have, in plan, the spectral density d² s^2a · 4^-l ∝ 2^-(2a+2)l below the frequency
// f ∝ 2^l, above which smooth placement lets nothing pass. The coarsest level that reaches f has the most:
// density(f) ∝ f^-(2+2a). So an octave has power f² · density ∝ f^-2a, and amplitude f^-a: in proportion to
// the scale factor, a = 1, means amplitudes of 1/f and a density of f^-4 (fractional Brownian motion, H = a).
constexpr std::array<std::string_view, 2> kAxes{"normal", "up"};
constexpr std::array<std::string_view, 2> kPlacements{"standard", "linear"};
constexpr std::uint32_t kBaseCells = 4;
constexpr int kSurfaces = 8;
constexpr int kFirstFrequency = 4;  // cycles per side of the plane; lower ones have too few waves

const std::array kSpectrumSpecs{
    ParameterSpec{"power", 1.0, "", "of the scale factor, to which displacements are proportional", 0.25, 2},
    choice("along", kAxes, "direction of the displacements: local normals, or one for all"),
    choice("placement", kPlacements, "before displacement"),
    ParameterSpec{"levels", std::int64_t{7}, "", "refinements of 4 × 4 cells", 5, 10},
    ParameterSpec{"amplitude", 0.05, "scale factors", "largest displacement at the first level", 0.001, 1},
};

std::vector<Case> spectrum_cases(const RunOptions& options) {
  const std::int64_t levels = options.profile == Profile::kPaper ? 8 : 7;
  std::vector<Case> cases;
  for (const double power : {0.5, 1.0, 1.5}) {
    cases.push_back(
        {fmt::format("power={}", power), {kSpectrumSpecs, {{"power", power}, {"levels", levels}}}});
  }
  cases.push_back({"up", {kSpectrumSpecs, {{"along", std::string("up")}, {"levels", levels}}}});
  cases.push_back({"linear", {kSpectrumSpecs, {{"placement", std::string("linear")}, {"levels", levels}}}});
  return cases;
}

using Complex = std::complex<double>;

// Forward transform in place. The size is a power of 2.
void fourier_transform(std::vector<Complex>& values) {
  const std::size_t n = values.size();
  for (std::size_t i = 1, j = 0; i < n; ++i) {
    std::size_t bit = n / 2;
    for (; (j & bit) != 0; bit /= 2) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(values[i], values[j]);
  }
  for (std::size_t length = 2; length <= n; length *= 2) {
    const std::size_t half = length / 2;
    for (std::size_t k = 0; k < half; ++k) {
      const Complex turn = std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(k) / length);
      for (std::size_t start = k; start < n; start += length) {
        const Complex even = values[start], odd = turn * values[start + half];
        values[start] = even + odd;
        values[start + half] = even - odd;
      }
    }
  }
}

// Heights of n × n samples, row by row, multiplied by a window that is 0 at the sides (von Hann's), become
// their power per frequency.
std::vector<double> power_spectrum(const std::vector<double>& heights, std::size_t n) {
  const double mean = std::accumulate(heights.begin(), heights.end(), 0.0) / static_cast<double>(n * n);
  const auto window = [n](std::size_t i) {
    const double s = std::sin(std::numbers::pi * static_cast<double>(i) / static_cast<double>(n));
    return s * s;
  };
  std::vector<std::vector<Complex>> columns(n, std::vector<Complex>(n));
  std::vector<Complex> row(n);
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = 0; i < n; ++i) row[i] = window(i) * window(j) * (heights[j * n + i] - mean);
    fourier_transform(row);
    for (std::size_t i = 0; i < n; ++i) columns[i][j] = row[i];
  }
  std::vector<double> power(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    fourier_transform(columns[i]);
    for (std::size_t j = 0; j < n; ++j) power[j * n + i] = std::norm(columns[i][j]);
  }
  return power;
}

// The mean density of each octave from kFirstFrequency on: whole octaves, since the levels make the spectrum
// wave with a period of one octave. The last octaves lack the levels that were not made.
std::vector<double> octave_densities(const std::vector<double>& power, std::size_t n) {
  std::vector<double> sums, counts;
  for (std::size_t last = 2 * kFirstFrequency; last <= n / 8; last *= 2) {
    sums.push_back(0);
    counts.push_back(0);
  }
  const auto frequency = [n](std::size_t k) { return static_cast<double>(std::min(k, n - k)); };
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = 0; i < n; ++i) {
      const double octave = std::floor(std::log2(std::hypot(frequency(i), frequency(j)) / kFirstFrequency));
      if (octave < 0 || octave >= static_cast<double>(sums.size())) continue;
      sums[static_cast<std::size_t>(octave)] += power[j * n + i];
      counts[static_cast<std::size_t>(octave)] += 1;
    }
  }
  for (std::size_t k = 0; k < sums.size(); ++k) sums[k] /= counts[k];
  return sums;
}

// Least squares of log2(density) over the octave's number.
double slope_of(const std::vector<double>& densities) {
  const double middle = 0.5 * static_cast<double>(densities.size() - 1);
  double product = 0, square = 0;
  for (std::size_t k = 0; k < densities.size(); ++k) {
    const double x = static_cast<double>(k) - middle;
    product += x * std::log2(densities[k]);
    square += x * x;
  }
  return product / square;
}

// The displacement is amplitude · s^power, of which by_scale gives one factor s = s(1) · 2^(1 - level).
PlacementRule rule_of(const Case& test_case, int level, std::uint64_t seed) {
  PlacementRule rule =
      fractal_rule(static_cast<float>(test_case.parameters.number("amplitude") *
                                      std::exp2((1 - level) * (test_case.parameters.number("power") - 1))),
                   seed);
  if (test_case.parameters.text("placement") == "linear") rule.base = Base::kLinear;
  if (test_case.parameters.text("along") == "up") rule.displacements[0].axis = Axis::kFixed;
  rule.texture = Base::kLinear;
  return rule;
}

void measure_spectrum(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress&) {
  const FaceMesh base = growing::plane({10, 10}, kBaseCells, kBaseCells).mesh;
  const int levels = test_case.integer("levels");
  const Refinement refinement(base, levels, kCornersStay);
  const std::size_t n = std::size_t{kBaseCells} << static_cast<unsigned>(levels);
  std::vector<double> slopes;
  for (int k = 0; k < kSurfaces; ++k) {
    const std::uint64_t seed = options.seed + static_cast<std::uint64_t>(k);
    LevelPoints points{base.positions, base.texture};
    for (int level = 0; level < levels; ++level) {
      points = next_points(refinement, level, points, rule_of(test_case, level + 1, seed),
                           static_cast<std::uint32_t>(level + 1));
    }
    std::vector<double> heights(n * n);  // the last row and column would repeat the window's zero
    for (std::size_t v = 0; v < points.positions.size(); ++v) {
      const auto i = static_cast<std::size_t>(std::lround(points.texture[v].x * static_cast<float>(n))),
                 j = static_cast<std::size_t>(std::lround(points.texture[v].y * static_cast<float>(n)));
      if (i < n && j < n) heights[j * n + i] = points.positions[v].y;
    }
    const std::vector<double> densities = octave_densities(power_spectrum(heights, n), n);
    slopes.push_back(slope_of(densities));
    recorder.add(fmt::format("slope_seed_{}", k + 1), "", slopes.back());
  }
  recorder.add("theory", "", -(2 + 2 * test_case.parameters.number("power")));
  recorder.add("slope", "",
               std::accumulate(slopes.begin(), slopes.end(), 0.0) / static_cast<double>(slopes.size()));
}

// §3: displacements along one global direction give a fractal height field; along the local normals, the same
// displacements move vertices aside, and the surface folds over.
constexpr std::array<std::string_view, 2> kAlong{"up", "normal"};
const std::array kHeightFieldSpecs{
    choice("along", kAlong, "direction of the displacements: one for all vertices, or each vertex's normal"),
    ParameterSpec{"steps", std::int64_t{6}, "", "subdivisions of a plane of 4 × 4 faces", 1, 8},
    ParameterSpec{"amplitude", 0.6, "scale factors", "largest displacement", 0, 4},
};

std::vector<Case> height_field_cases(const RunOptions&) { return cases_by("along", kHeightFieldSpecs); }

void measure_height_field(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress&) {
  PlacementRule rule =
      fractal_rule(static_cast<float>(test_case.parameters.number("amplitude")), options.seed);
  if (test_case.parameters.choice("along") == 0) rule.displacements[0].axis = Axis::kFixed;
  const FaceMesh base = growing::plane({4, 4}, 4, 4).mesh;
  const auto steps = static_cast<std::size_t>(test_case.integer("steps"));
  const FaceMesh flat = subdivide(base, std::vector(steps, PlacementRule{}), kCornersStay);
  const FaceMesh mesh = subdivide(base, std::vector(steps, rule), kCornersStay);

  double aside = 0, facing_down = 0, low = 0, high = 0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const glm::vec3 &p = mesh.positions[v], &from = flat.positions[v];
    if (p.x != from.x || p.z != from.z) ++aside;
    low = std::min(low, static_cast<double>(p.y));
    high = std::max(high, static_cast<double>(p.y));
  }
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    const auto corner = [&](std::size_t k) { return mesh.positions[mesh.face(f)[k]]; };
    if (glm::cross(corner(2) - corner(0), corner(3) - corner(1)).y <= 0) ++facing_down;
  }
  recorder.add("moved_aside", "", aside);
  recorder.add("faces_facing_down", "", facing_down);
  recorder.add("relief", "m", high - low);
}

// §3: displacements bounded by the local scale factor at every step give a fractal surface; if
// subdivision stops after finitely many steps, the error in vertex positions is on the order of the local
// scale factor. Displacements here are random, up to one scale factor; the finest mesh stands for the
// surface.
//
// Theory. At each later step a vertex moves by a bounded number of the scale factors of that step, which fall
// geometrically: their sum, the error, is in proportion to the scale factor of the step that was the last. On
// a smooth surface the error falls as the square of the scale factor, so that its ratio halves at each step.
constexpr std::array<std::string_view, 2> kMeshes{"plane", "sphere"};
constexpr int kStops = 4;  // steps after which subdivision may stop; the others make the surface
const std::array kApproximationSpecs{
    choice("mesh", kMeshes, "base mesh"),
    ParameterSpec{"levels", std::int64_t{8}, "", "steps that stand for all", kStops + 1, 10},
    ParameterSpec{"bound", 1.0, "scale factors", "largest displacement", 0, 1},
};

std::vector<Case> approximation_cases(const RunOptions& options) {
  return cases_by("mesh", kApproximationSpecs,
                  {{"levels", std::int64_t{options.profile == Profile::kPaper ? 8 : 7}}});
}

double mean_of(const Array<float>& values) {
  double sum = 0;
  for (const float value : values) sum += static_cast<double>(value);
  return sum / static_cast<double>(values.size());
}

void measure_approximation(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress&) {
  const FaceMesh base = test_case.parameters.choice("mesh") == 0 ? growing::plane({4, 4}, 4, 4).mesh
                                                                 : growing::sphere(1, 2).mesh;
  const int levels = test_case.integer("levels");
  const Refinement refinement(base, levels, kCornersStay);
  const PlacementRule rough =
      fractal_rule(static_cast<float>(test_case.parameters.number("bound")), options.seed);
  std::vector<LevelPoints> meshes{{base.positions, {}}};
  const auto next = [&](const LevelPoints& points, int level, const PlacementRule& rule) {
    return next_points(refinement, level, points, rule, static_cast<std::uint32_t>(level + 1));
  };
  for (int level = 0; level < levels; ++level) meshes.push_back(next(meshes.back(), level, rough));
  const std::vector<glm::vec3>& surface = meshes.back().positions;

  for (int stop = 1; stop <= kStops; ++stop) {
    const auto surface_at = [&](int level) {
      return local_surface(refinement.topology(level), meshes[static_cast<std::size_t>(level)].positions, {},
                           false);
    };
    const LocalSurface here = surface_at(stop), after = surface_at(stop + 1);
    const std::vector<glm::vec3>& stopped = meshes[static_cast<std::size_t>(stop)].positions;
    RootMeanSquare error, share, turn, finished;
    double largest = 0;
    for (std::size_t v = 0; v < stopped.size(); ++v) {  // a vertex keeps its number in finer meshes
      const auto off = static_cast<double>(glm::distance(stopped[v], surface[v]));
      const double of_scale = off / static_cast<double>(here.scales[v]);
      error.add(off);
      share.add(of_scale);
      largest = std::max(largest, of_scale);
      const float cosine = std::clamp(glm::dot(here.normals[v], after.normals[v]), -1.0F, 1.0F);
      turn.add(static_cast<double>(glm::degrees(std::acos(cosine))));
    }
    // All vertices of the surface, where standard steps follow instead.
    LevelPoints smooth = meshes[static_cast<std::size_t>(stop)];
    for (int level = stop; level < levels; ++level) smooth = next(smooth, level, PlacementRule{});
    for (std::size_t v = 0; v < surface.size(); ++v) {
      finished.add(static_cast<double>(glm::distance(smooth.positions[v], surface[v])));
    }
    recorder.add(fmt::format("scale_{}", stop), "m", mean_of(here.scales));
    recorder.add(fmt::format("error_{}", stop), "m", error.value());
    recorder.add(fmt::format("error_in_scales_{}", stop), "", share.value());
    recorder.add(fmt::format("largest_in_scales_{}", stop), "", largest);
    recorder.add(fmt::format("finished_in_scales_{}", stop), "", finished.value() / mean_of(here.scales));
    if (stop == 1 || stop == kStops) recorder.add(fmt::format("normal_turns_{}", stop), "°", turn.value());
  }
}

}  // namespace

extern const Experiment kSpectrum{"meshgrow.spectrum", "§3: spectra of fractal planes", kSpectrumSpecs,
                                  spectrum_cases, measure_spectrum};
extern const Experiment kHeightField{"meshgrow.height-field",
                                     "§3: displacements along one direction, and along normals",
                                     kHeightFieldSpecs, height_field_cases, measure_height_field};
extern const Experiment kApproximation{"meshgrow.approximation",
                                       "§3: the error where subdivision of a fractal surface stops",
                                       kApproximationSpecs, approximation_cases, measure_approximation};

}  // namespace terrabench::meshgrow
