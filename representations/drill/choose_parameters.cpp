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

// The w and k of least error for a τ, under one k for all drills.
DrillOptions best_shape(const Heightfield& field, const FlowNetwork& network, DrillOptions options) {
  options.adaptive_k = false;
  const int longest = std::max(field.width, field.depth);
  // The answer for terrains smaller than the shortest cross-section.
  DrillOptions best = options;
  best.w = std::min(options.w, longest);
  double least = std::numeric_limits<double>::infinity();
  for (const int w : kCrossSections) {
    if (w > longest) continue;
    options.w = w;
    options.k = std::ranges::max(kInfluences);
    Drills drills = extract_drills(field, network, options);
    for (const int k : kInfluences) {
      options.k = drills.k = k;  // on which the shapes do not depend
      const double error = elevation_error(field, regenerate(drills)).rmse;
      if (error >= least) continue;
      least = error;
      best = options;
    }
  }
  return best;
}

}  // namespace

DrillChoice choose_parameters(const Heightfield& field, const FlowNetwork& network, const DrillBudget& budget,
                              const DrillOptions& options, Progress* progress) {
  if ((budget.bytes > 0) == (budget.rmse > 0)) {
    throw usage_error("expected one budget, of bytes or of error", "drill",
                      "set either budget_bytes or max_rmse above 0");
  }
  const float automatic = automatic_quantum(field);
  if (progress != nullptr) progress->begin("parameters for the budget", std::size(kTaus));
  DrillChoice best;
  std::pair<double, double> least{std::numeric_limits<double>::infinity(), 0};
  for (const std::uint32_t tau : kTaus) {
    DrillChoice choice;
    choice.options = options;
    choice.options.tau = tau;
    choice.options = best_shape(field, network, choice.options);
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
