#include "representations/drill/choose_parameters.h"

#include <algorithm>
#include <limits>

#include "representations/drill/drill_codec.h"
#include "representations/drill/quantum.h"
#include "representations/drill/regenerate.h"
#include "terrain/error.h"
#include "terrain/metrics/elevation_error.h"

namespace terrabench {
namespace {

constexpr std::uint32_t kTaus[] = {6, 12, 25, 50, 100, 200, 400, 800};
constexpr int kCrossSections[] = {3, 5, 7, 10, 14, 20}, kInfluences[] = {4, 6, 8, 10, 12, 15, 20, 30};
constexpr float kQuanta[] = {1, 2, 4, 8};  // times the automatic one

// How far a choice exceeds the budget, and then its cost in the other measure: less is better.
std::pair<double, double> cost(const DrillChoice& choice, const DrillBudget& budget) {
  const auto bytes = static_cast<double>(choice.bytes);
  if (budget.bytes > 0) return {std::max(0.0, bytes - static_cast<double>(budget.bytes)), choice.rmse};
  return {std::max(0.0, choice.rmse - budget.rmse), bytes};
}

class Search {
 public:
  Search(const Heightfield& field, const FlowNetwork& network, DrillOptions options)
      : field_(field), network_(network), options_(options) {
    // Shapes are compared under one k for all drills; the chosen one then gets a k per drill.
    options_.adaptive_k = false;
  }

  // The w and k of least error for a τ.
  DrillOptions best_shape(std::uint32_t tau) {
    // The answer for terrains smaller than the shortest cross-section.
    DrillOptions best = options_;
    best.tau = tau;
    best.w = std::min(options_.w, std::max(field_.width, field_.depth));
    double least = std::numeric_limits<double>::infinity();
    for (const int w : kCrossSections) {
      if (w > std::max(field_.width, field_.depth)) continue;
      DrillOptions at = options_;
      at.tau = tau;
      at.w = w;
      at.k = *std::max_element(std::begin(kInfluences), std::end(kInfluences));
      Drills drills = extract_drills(field_, network_, at);
      for (const int k : kInfluences) {
        at.k = drills.k = k;
        // The shapes depend on k in this reading only.
        if (at.fit == DrillFit::kMonotoneInWindow) drills = extract_drills(field_, network_, at);
        const double error = elevation_error(field_, regenerate(drills)).rmse;
        if (error >= least) continue;
        least = error;
        best = at;
      }
    }
    return best;
  }

 private:
  const Heightfield& field_;
  const FlowNetwork& network_;
  DrillOptions options_;
};

}  // namespace

DrillChoice choose_parameters(const Heightfield& field, const FlowNetwork& network, const DrillBudget& budget,
                              const DrillOptions& options, Progress* progress) {
  if ((budget.bytes > 0) == (budget.rmse > 0)) {
    throw usage_error("expected one budget, of bytes or of error", "drill",
                      "set either budget_bytes or max_rmse above 0");
  }
  Search search(field, network, options);
  const float automatic = automatic_quantum(field);
  if (progress != nullptr) progress->begin("parameters for the budget", std::size(kTaus));
  DrillChoice best;
  std::pair<double, double> least{std::numeric_limits<double>::infinity(), 0};
  for (const std::uint32_t tau : kTaus) {
    DrillChoice choice;
    choice.options = search.best_shape(tau);
    choice.options.adaptive_k = options.adaptive_k;
    const Drills exact = extract_drills(field, network, choice.options);
    for (const float factor : kQuanta) {
      choice.quantum = automatic * factor;
      Drills drills = exact;
      quantise(drills, choice.quantum);
      ByteSink bytes;
      encode_drills(drills, bytes);
      choice.bytes = bytes.bytes().size();
      choice.rmse = elevation_error(field, regenerate(drills)).rmse;
      const std::pair<double, double> at = cost(choice, budget);
      choice.within_budget = at.first == 0;
      if (at >= least) continue;
      least = at;
      best = choice;
    }
    if (progress != nullptr) progress->advance();
  }
  return best;
}

}  // namespace terrabench
