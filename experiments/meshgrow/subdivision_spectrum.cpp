// §3 of "meshgrow", figure 2: random displacements in proportion to the local scale factor give a 1/f
// surface.
//
// Theory. At level l the local scale factor is s = c 2^-l. Independent displacements of deviation d s^a at
// vertices 2^-l apart have, in plan, the spectral density d² s^2a · 4^-l ∝ 2^-(2a+2)l below the frequency
// f ∝ 2^l, above which smooth placement lets nothing pass. The coarsest level that reaches f has the most:
// density(f) ∝ f^-(2+2a). So an octave has power f² · density ∝ f^-2a, and amplitude f^-a: in proportion to
// the scale factor, a = 1, means amplitudes of 1/f and a density of f^-4 (fractional Brownian motion, H = a).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

#include "experiments/cases.h"
#include "representations/procedural_mesh/base_mesh.h"
#include "representations/procedural_mesh/subdivision/refinement.h"

namespace terrabench::meshgrow {
namespace {

constexpr std::array<std::string_view, 2> kAxes{"normal", "up"};
constexpr std::array<std::string_view, 2> kPlacements{"standard", "linear"};
constexpr std::uint32_t kBaseCells = 4;
constexpr int kFirstFrequency = 4;  // cycles per side of the plane; lower ones have too few waves

const std::array kSpecs{
    ParameterSpec{"power", 1.0, "", "of the scale factor, to which displacements are proportional", 0.25, 2},
    choice("along", kAxes, "direction of the displacements: local normals, or one for all"),
    choice("placement", kPlacements, "before displacement"),
    ParameterSpec{"levels", std::int64_t{7}, "", "refinements of 4 × 4 cells", 5, 10},
    ParameterSpec{"seeds", std::int64_t{8}, "", "surfaces", 1, 64},
    ParameterSpec{"amplitude", 0.05, "scale factors", "largest displacement at the first level", 0.001, 1},
};

std::vector<Case> cases(const RunOptions& options) {
  const std::int64_t levels = options.profile == Profile::kPaper ? 8 : 7;
  std::vector<Case> cases;
  for (const double power : {0.5, 1.0, 1.5}) {
    cases.push_back({fmt::format("power={}", power), {kSpecs, {{"power", power}, {"levels", levels}}}});
  }
  cases.push_back({"up", {kSpecs, {{"along", std::string("up")}, {"levels", levels}}}});
  cases.push_back({"linear", {kSpecs, {{"placement", std::string("linear")}, {"levels", levels}}}});
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

std::vector<subdivision::PlacementRule> rules_of(const Case& at, std::uint64_t seed) {
  using namespace subdivision;
  std::vector<PlacementRule> rules;
  for (int level = 1; level <= at.integer("levels"); ++level) {
    PlacementRule rule;
    if (at.parameters.text("placement") == "linear") rule.base = Base::kLinear;
    rule.texture = Base::kLinear;
    // The displacement is amplitude · s^power, of which by_scale gives one factor s = s(1) · 2^(1 - level).
    Displacement displacement;
    displacement.axis = at.parameters.text("along") == "up" ? Axis::kFixed : Axis::kNormal;
    displacement.amount.kind = Signal::Kind::kUniform;
    displacement.amount.seed = seed;
    displacement.amount.amplitude = static_cast<float>(
        at.parameters.number("amplitude") * std::exp2((1 - level) * (at.parameters.number("power") - 1)));
    rule.displacements.push_back(displacement);
    rules.push_back(rule);
  }
  return rules;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress&) {
  using namespace subdivision;
  const FaceMesh base = growing::plane({10, 10}, kBaseCells, kBaseCells).mesh;
  const int levels = at.integer("levels");
  // Corners stay, so that the plane's vertices stay at equal distances.
  const Refinement refinement(base, levels, {.boundary = Boundary::kEdgeAndCorner});
  const std::size_t n = std::size_t{kBaseCells} << static_cast<unsigned>(levels);
  std::vector<double> slopes;
  for (int k = 0; k < at.integer("seeds"); ++k) {
    const std::uint64_t seed = options.seed + static_cast<std::uint64_t>(k);
    const std::vector<PlacementRule> rules = rules_of(at, seed);
    LevelPoints points{base.positions, base.texture};
    for (int level = 0; level < levels; ++level) {
      points = next_points(refinement, level, points, rules[static_cast<std::size_t>(level)],
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
    for (std::size_t octave = 0; octave < densities.size(); ++octave) {
      recorder.add(fmt::format("density_{}", kFirstFrequency << octave), "",
                   densities[octave] / densities[0]);
    }
  }
  const double theory = -(2 + 2 * at.parameters.number("power"));
  const double mean = std::accumulate(slopes.begin(), slopes.end(), 0.0) / static_cast<double>(slopes.size());
  const auto [least, most] = std::minmax_element(slopes.begin(), slopes.end());
  recorder.add("theory", "", theory);
  recorder.add("slope", "", mean);
  recorder.add("slope_least", "", *least);
  recorder.add("slope_most", "", *most);
  recorder.add("from_theory", "", mean - theory);
  recorder.add("farthest_from_theory", "", std::max(std::abs(*least - theory), std::abs(*most - theory)));
  recorder.add("samples_per_side", "", static_cast<double>(n));
}

}  // namespace

extern const Experiment kSpectrum{"meshgrow.spectrum", "§3: spectra of fractal planes", kSpecs, cases,
                                  measure};

}  // namespace terrabench::meshgrow
