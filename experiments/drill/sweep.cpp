#include "experiments/drill/sweep.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "experiments/drill/analysis.h"
#include "experiments/drill/ground.h"
#include "experiments/experiment.h"
#include "experiments/figures/maps.h"
#include "representations/drill/regenerate.h"
#include "terrain/metrics/elevation_error.h"

namespace terrabench::drill {
namespace {

constexpr std::size_t kPaperWidth = std::ranges::find(kSweptWidths, 10) - kSweptWidths.begin();
constexpr int kPaperK = 20;

struct Least {
  std::size_t tau = 0, width = 0;
  int k = kLeastK;
  double rmse = 0;
};

// The least of the given levels, over all τ.
template <class Widths, class Influences>
Least least_of(const Sweep& sweep, const Widths& widths, const Influences& influences) {
  Least least{.rmse = std::numeric_limits<double>::infinity()};
  for (std::size_t t = 0; t < kTaus.size(); ++t) {
    for (const std::size_t w : widths) {
      for (const int k : influences) {
        const double rmse = sweep.at(t, w, k);
        if (rmse < least.rmse) least = {t, w, k, rmse};
      }
    }
  }
  return least;
}

// How much the means per level of each factor vary, and in how many (w, k) the RMSE rises with τ.
struct Spread {
  double tau = 0, w = 0, k = 0;
  int rising = 0;
};

Spread spread(const Sweep& sweep, const Levels& levels) {
  std::array<double, 3> by_tau{}, by_width{};
  std::array<double, 6> by_k{};
  Spread spread;
  for (std::size_t w = 0; w < 3; ++w) {
    for (std::size_t k = 0; k < 6; ++k) {
      std::array<double, 3> at{};
      for (std::size_t t = 0; t < 3; ++t) {
        at[t] = sweep.at(t, levels.widths[w], levels.influences[k]);
        by_tau[t] += at[t] / 18;
        by_width[w] += at[t] / 18;
        by_k[k] += at[t] / 9;
      }
      spread.rising += at[0] < at[1] && at[1] < at[2];
    }
  }
  // The variance of level means is the share that main_effects() gives, but for its common divisor.
  const auto variance = [](const auto& means) {
    double mean = 0, squares = 0;
    for (const double m : means) mean += m / static_cast<double>(means.size());
    for (const double m : means) squares += (m - mean) * (m - mean) / static_cast<double>(means.size());
    return squares;
  };
  spread.tau = variance(by_tau);
  spread.w = variance(by_width);
  spread.k = variance(by_k);
  return spread;
}

}  // namespace

Sweep sweep(const Heightfield& ground, const FlowNetwork& network, const Variant& variant,
            Progress& progress) {
  Sweep sweep;
  progress.begin(fmt::format("sweeping w and k, {}", variant.words), kTaus.size() * kSweptWidths.size());
  for (std::size_t t = 0; t < kTaus.size(); ++t) {
    for (std::size_t w = 0; w < kSweptWidths.size(); ++w) {
      const Drills drills =
          extract_drills(ground, network, options_for({kTaus[t], kSweptWidths[w], kMostK}, variant));
      tbb::parallel_for(kLeastK, kMostK + 1, [&](int k) {
        Drills at = drills;
        at.k = k;
        sweep.rmse[t][w][static_cast<std::size_t>(k - kLeastK)] =
            elevation_error(ground, regenerate(at)).normalised();
      });
      progress.advance();
    }
  }
  return sweep;
}

std::vector<Levels> allowed_levels() {
  std::vector<std::array<int, 6>> influences;
  for (int step = 1; kLeastK + 5 * step <= kMostK; ++step) {
    for (int first = kLeastK; first + 5 * step <= kMostK; ++first) {
      if (first > kPaperK || (kPaperK - first) % step != 0 || first + 5 * step < kPaperK) continue;
      auto& levels = influences.emplace_back();
      for (int i = 0; i < 6; ++i) levels[static_cast<std::size_t>(i)] = first + i * step;
    }
  }
  std::vector<Levels> all;
  for (std::size_t a = 0; a < kSweptWidths.size(); ++a) {
    for (std::size_t b = a + 1; b < kSweptWidths.size(); ++b) {
      if (a == kPaperWidth || b == kPaperWidth) continue;
      for (const auto& k : influences) all.push_back({{a, b, kPaperWidth}, k});
    }
  }
  return all;
}

Held held(const Sweep& sweep) {
  Held held;
  for (const Levels& levels : allowed_levels()) {
    const Least least = least_of(sweep, levels.widths, levels.influences);
    const Spread by = spread(sweep, levels);
    ++held.all;
    held.best += least.width == kPaperWidth && least.k == kPaperK;
    held.best_width += least.width == kPaperWidth;
    held.tau_first += by.tau > by.w && by.tau > by.k;
    held.every_case += by.rising == 18;
  }
  return held;
}

namespace {

constexpr double kCellWidth = 7.5, kCellHeight = 16, kLeft = 52, kTop = 78, kBelow = 84, kRight = 34;
constexpr double kMapWidth = kCellWidth * kSweptK, kMapHeight = kCellHeight * kSweptWidths.size();

// The map of one sweep at the first τ, from x0.
void add_map(figures::Sheet& sheet, double x0, const Sweep& sweep, std::string_view title) {
  Least least{.rmse = std::numeric_limits<double>::infinity()};
  for (std::size_t w = 0; w < kSweptWidths.size(); ++w) {
    for (int k = kLeastK; k <= kMostK; ++k) {
      if (sweep.at(0, w, k) < least.rmse) least = {0, w, k, sweep.at(0, w, k)};
    }
  }
  const double most = 4 * least.rmse;  // larger errors share a colour: the valley would not show otherwise
  const auto centre = [&](std::size_t w, int k) {
    return figures::SheetPoint{x0 + (k - kLeastK + 0.5) * kCellWidth,
                               kTop + (static_cast<double>(kSweptWidths.size() - 1 - w) + 0.5) * kCellHeight};
  };
  sheet.text(x0, kTop - 52, title, 13);
  sheet.text(
      x0, kTop - 30,
      fmt::format("ring: least, {:.4f} at w = {}, k = {}", least.rmse, kSweptWidths[least.width], least.k),
      12);
  sheet.text(x0, kTop - 12, fmt::format("cross: w = 10, k = 20, {:.4f}", sweep.at(0, kPaperWidth, kPaperK)),
             12);
  sheet.panel(x0, kTop, kMapWidth, kMapHeight);
  for (std::size_t w = 0; w < kSweptWidths.size(); ++w) {
    for (int k = kLeastK; k <= kMostK; ++k) {
      const figures::SheetPoint at = centre(w, k);
      const double share = (sweep.at(0, w, k) - least.rmse) / (most - least.rmse);
      sheet.box(at.x - kCellWidth / 2, at.y - kCellHeight / 2, kCellWidth, kCellHeight,
                figures::error_colour(std::min(1.0, share)));
    }
    sheet.text(x0 - 6, centre(w, kLeastK).y + 4, fmt::format("{}", kSweptWidths[w]), 11, "end");
  }
  sheet.text(x0 - 36, kTop + kMapHeight / 2, "w", 13, "middle");
  for (int k = 5; k <= kMostK; k += 5) {
    sheet.text(centre(0, k).x, kTop + kMapHeight + 15, fmt::format("{}", k), 11, "middle");
  }
  sheet.text(x0 + kMapWidth / 2, kTop + kMapHeight + 30, "k", 13, "middle");
  sheet.ring(centre(least.width, least.k), 5, {0, 0, 0}, 2);
  sheet.cross(centre(kPaperWidth, kPaperK), 5, {0, 0, 0});
  const figures::Sheet::Tick ticks[] = {{0, fmt::format("{:.4f}", least.rmse)},
                                        {0.5, fmt::format("{:.4f}", (least.rmse + most) / 2)},
                                        {1, fmt::format("≥ {:.4f}", most)}};
  sheet.colour_bar(x0, kTop + kMapHeight + 42, kMapWidth, figures::error_colour, ticks);
}

}  // namespace

figures::Sheet sweep_sheet(std::span<const Sweep> sweeps, std::span<const Variant> variants) {
  constexpr double kColumn = kLeft + kMapWidth + kRight;
  figures::Sheet sheet(kColumn * static_cast<double>(sweeps.size()), kTop + kMapHeight + kBelow);
  for (std::size_t s = 0; s < sweeps.size(); ++s) {
    add_map(sheet, kLeft + kColumn * static_cast<double>(s), sweeps[s],
            fmt::format("({:c}) {}", 'a' + static_cast<int>(s), variants[s].words));
  }
  return sheet;
}

namespace {

const std::array kSpecs{
    ParameterSpec{"side", std::int64_t{16384}, "samples", "largest side of the part that is swept", 64,
                  16384},
};

std::vector<Case> cases(const RunOptions& options) {
  std::vector<Case> cases;
  // The whole ground takes half a minute of one core.
  const std::int64_t side = options.profile == Profile::kPaper ? 16384 : 128;
  for (const std::string& ground : grounds(options)) {
    cases.push_back({ground, {kSpecs, {{"side", side}}}, ground});
  }
  return cases;
}

void record(const Sweep& sweep, const std::string& prefix, Recorder& recorder) {
  std::array<std::size_t, kSweptWidths.size()> widths;
  std::array<int, kSweptK> influences;
  for (std::size_t w = 0; w < widths.size(); ++w) widths[w] = w;
  for (int k = kLeastK; k <= kMostK; ++k) influences[static_cast<std::size_t>(k - kLeastK)] = k;
  const Least least = least_of(sweep, widths, influences);
  const auto add = [&](std::string_view metric, std::string_view unit, double value) {
    recorder.add(fmt::format("{}_{}", prefix, metric), unit, value);
  };
  const auto add_error = [&](std::string_view metric, double value) {
    add_share(recorder, fmt::format("{}_{}", prefix, metric), value);
  };
  add_error("least", least.rmse);
  add("best_tau", "pixels", kTaus[least.tau]);
  add("best_w", "samples", kSweptWidths[least.width]);
  add("best_k", "samples", least.k);
  add_error("at_w10_k20", std::min({sweep.at(0, kPaperWidth, kPaperK), sweep.at(1, kPaperWidth, kPaperK),
                                    sweep.at(2, kPaperWidth, kPaperK)}));
  const Held held = drill::held(sweep);
  add("factorials", "", held.all);
  const auto add_held = [&](std::string_view metric, int count) {
    add(metric, "", static_cast<double>(count) / held.all);
  };
  add_held("best_holds_share", held.best);
  add_held("best_width_holds_share", held.best_width);
  add_held("tau_first_share", held.tau_first);
  add_held("every_case_share", held.every_case);
}

void measure(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(test_case.terrain, options.seed));
  const int side = test_case.integer("side");
  const Heightfield ground = crop(*source.heights, 0, 0, std::min(side, source.heights->width),
                                  std::min(side, source.heights->depth));
  if (std::max(ground.width, ground.depth) < kSweptWidths.back()) {
    throw SkippedCase("the ground is smaller than the longest cross-section");
  }
  std::vector<Sweep> sweeps;
  for (const Variant& variant : kFits) {
    sweeps.push_back(sweep(ground, variant.route(ground), variant, progress));
    record(sweeps.back(), std::string(variant.name), recorder);
  }
  const HeightRange range = height_range(ground);
  if (!(range.highest > range.lowest)) return;  // flat ground has no error to colour
  sweep_sheet(sweeps, kFits)
      .write(recorder.figure(
          "drill.sweep" + figures::ground_suffix(test_case.terrain, kMainGround),
          fmt::format(
              "RMSE ÷ range of elevations over w and k at τ = 25 on {} × {} samples of {}, for each fit. "
              "Colours are linear from the least error; four times it and more are red.",
              ground.width, ground.depth, source.name)));
}

}  // namespace

extern const Experiment kSweep{"drill.sweep", "§3.1: best parameters over a fine grid of w and k", kSpecs,
                               cases, measure};

}  // namespace terrabench::drill
