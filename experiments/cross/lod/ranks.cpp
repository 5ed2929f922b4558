// Every level-of-detail method at the same largest error, and again at the same root mean square of the
// error: what each costs under either, its rank, and how many pairs of methods change places.
#include "experiments/cross/lod/ranks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>

#include "experiments/cross/lod/tuned_cases.h"

namespace terrabench::cross {
namespace {

// The largest error of a normal distribution's few 10,000 samples is about four times its RMS, hence 4 px and
// 1 px.
const std::array kSpecs{
    ParameterSpec{"options", std::string(), "",
                  "options of methods, such as geomipmap.patch=32,mrbsp.threshold=area"},
    ParameterSpec{"largest", 4.0, "px", "required largest screen-space error of a visible sample", 0.01,
                  1000},
    ParameterSpec{"rms", 1.0, "px", "required root mean square of the visible samples' error", 0.01, 1000},
    ParameterSpec{"path", std::string("fly"), "", "camera path: cross, fly, low, turn, walk, or a TOML file"},
    ParameterSpec{"frames", std::int64_t{24}, "", "frames of the path that are metered", 1, 100000},
    ParameterSpec{"size", std::int64_t{257}, "samples", "side of the generated grounds, 2^n + 1", 3, 8193},
};

bool clearly_less(double a, double b) { return a * (1 + kFlipMargin) <= b && a < b; }

struct Equalised {
  std::string_view name;  // in metrics, and of the parameter
  Criterion criterion;
};
constexpr std::array kEqualised{Equalised{"largest", Criterion::kLargest}, Equalised{"rms", Criterion::kRms}};

// By method.
struct Costs {
  std::vector<double> triangles, uploaded;  // per frame, means
  std::vector<bool> reached;

  std::vector<std::optional<double>> where_reached(const std::vector<double>& costs) const {
    std::vector<std::optional<double>> known(costs.size());
    for (std::size_t k = 0; k < costs.size(); ++k) {
      if (reached[k]) known[k] = costs[k];
    }
    return known;
  }
};

// `prefix`: of the metrics.
void measure_one(Flight& flight, const ConfiguredMethod& method, const Equalised& what, double pixels,
                 const std::string& prefix, Costs& costs, Recorder& recorder, Progress& progress) {
  const Tuned tuned = tune_to(flight, method, pixels, progress, what.criterion);
  const PathCost cost = fly(flight, method, tuned.knob, progress);
  const std::unique_ptr<Lod> lod = method.build(flight.ground(), progress);
  lod->tune(tuned.knob);
  const Distribution errors = errors_along(flight, *lod);
  costs.triangles.push_back(std::accumulate(cost.triangles.begin(), cost.triangles.end(), 0.0) /
                            static_cast<double>(cost.triangles.size()));
  costs.uploaded.push_back(cost.uploaded);
  // Brute force reaches any error, and its rank is no finding.
  costs.reached.push_back(method.tunable() && tuned.reached);
  recorder.add(prefix + "reached", "", tuned.reached ? 1 : 0);
  recorder.add(prefix + "error_largest", "px", errors.largest());
  recorder.add(prefix + "error_rms", "px", errors.rms());
  recorder.add(prefix + "triangles", "", costs.triangles.back());
  recorder.add(prefix + "uploaded", "B", cost.uploaded);
  for (const double t : cost.times) recorder.add_frame(prefix + "update_time", "s", t);
}

std::vector<Case> cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const std::string& terrain : compared_grounds(options))
    cases.push_back(case_on(terrain, terrain, kSpecs, options));
  return cases;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  Flight& flight = flight_of(at, options, recorder, progress);
  const std::vector<Entrant> all = entrants();
  std::array<Costs, kEqualised.size()> costs;
  for (std::size_t e = 0; e < kEqualised.size(); ++e) {
    const Equalised& what = kEqualised[e];
    for (const Entrant& entrant : all) {
      measure_one(flight, named_method(entrant.name, at.parameters.text("options")), what,
                  at.parameters.number(what.name), fmt::format("{}_{}_", entrant.name, what.name), costs[e],
                  recorder, progress);
    }
    const std::vector<int> by_triangles = ranks(costs[e].triangles), by_bytes = ranks(costs[e].uploaded);
    for (std::size_t k = 0; k < all.size(); ++k) {
      recorder.add(fmt::format("{}_{}_rank_triangles", all[k].name, what.name), "", by_triangles[k]);
      recorder.add(fmt::format("{}_{}_rank_uploaded", all[k].name, what.name), "", by_bytes[k]);
    }
  }
  const auto flips = [&](std::vector<double> Costs::*cost) {
    return count_flips(costs[0].where_reached(costs[0].*cost), costs[1].where_reached(costs[1].*cost));
  };
  recorder.add("pairs", "", flips(&Costs::triangles).pairs);
  recorder.add("flips_triangles", "", flips(&Costs::triangles).flipped);
  recorder.add("flips_uploaded", "", flips(&Costs::uploaded).flipped);
}

}  // namespace

std::vector<int> ranks(std::span<const double> costs) {
  std::vector<int> ranks;
  for (const double cost : costs) {
    ranks.push_back(1 + static_cast<int>(std::ranges::count_if(costs, [&](double c) { return c < cost; })));
  }
  return ranks;
}

Flips count_flips(std::span<const std::optional<double>> one, std::span<const std::optional<double>> other) {
  Flips flips;
  for (std::size_t a = 0; a < one.size(); ++a) {
    for (std::size_t b = a + 1; b < one.size(); ++b) {
      if (!one[a] || !one[b] || !other[a] || !other[b]) continue;
      ++flips.pairs;
      flips.flipped += (clearly_less(*one[a], *one[b]) && clearly_less(*other[b], *other[a])) ||
                       (clearly_less(*one[b], *one[a]) && clearly_less(*other[a], *other[b]));
    }
  }
  return flips;
}

extern const Experiment kLodRanks{"cross.lod-ranks",
                                  "Level-of-detail methods at the same largest error and at the same RMS",
                                  kSpecs,
                                  cases,
                                  measure,
                                  Experiment::kTimed};

}  // namespace terrabench::cross
