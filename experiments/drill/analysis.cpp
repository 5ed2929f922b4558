#include "experiments/drill/analysis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <set>

namespace terrabench::drill {

Effects main_effects(const std::vector<Outcome>& outcomes, const ErrorOf& error) {
  double mean = 0, total = 0;
  for (const Outcome& o : outcomes) mean += error(o);
  mean /= static_cast<double>(outcomes.size());
  for (const Outcome& o : outcomes) total += (error(o) - mean) * (error(o) - mean);
  if (total == 0) return {};
  // The sum of squares of the level means about the grand mean, as a share of the total.
  const auto between = [&](const auto& levels, auto factor, double* means) {
    double squares = 0;
    for (std::size_t l = 0; l < levels.size(); ++l) {
      double sum = 0, count = 0;
      for (const Outcome& o : outcomes) {
        if (o.setting.*factor != levels[l]) continue;
        sum += error(o);
        ++count;
      }
      if (count == 0) continue;
      if (means != nullptr) means[l] = sum / count;
      squares += count * (sum / count - mean) * (sum / count - mean);
    }
    return squares / total;
  };
  Effects effects;
  effects.tau = between(kTaus, &Setting::tau, effects.mean_at_tau.data());
  effects.w = between(kWidths, &Setting::w, nullptr);
  effects.k = between(kInfluences, &Setting::k, nullptr);
  effects.interactions = 1 - effects.tau - effects.w - effects.k;
  return effects;
}

const Outcome& least(const std::vector<Outcome>& outcomes, const ErrorOf& error) {
  assert(!outcomes.empty());
  return *std::min_element(outcomes.begin(), outcomes.end(),
                           [&](const Outcome& a, const Outcome& b) { return error(a) < error(b); });
}

std::vector<Outcome> without_outliers(const std::vector<Outcome>& outcomes, const ErrorOf& error) {
  std::vector<double> values;
  for (const Outcome& o : outcomes) values.push_back(error(o));
  std::sort(values.begin(), values.end());
  // Between neighbours in proportion.
  const auto quantile = [&](double share) {
    const double at = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return std::lerp(values[below], values[above], at - std::floor(at));
  };
  std::vector<Outcome> good;
  if (values.empty()) return good;
  const double lower = quantile(0.25), upper = quantile(0.75), fence = upper + 1.5 * (upper - lower);
  std::copy_if(outcomes.begin(), outcomes.end(), std::back_inserter(good),
               [&](const Outcome& o) { return error(o) <= fence; });
  return good;
}

Cases rising_with_tau(const std::vector<Outcome>& outcomes, const ErrorOf& error) {
  Cases cases;
  for (const Outcome& first : outcomes) {
    if (first.setting.tau != kTaus.front()) continue;
    double before = error(first);
    bool rises = true;
    for (std::size_t t = 1; t < kTaus.size(); ++t) {
      const Setting at{kTaus[t], first.setting.w, first.setting.k};
      const auto next =
          std::find_if(outcomes.begin(), outcomes.end(), [&](const Outcome& o) { return o.setting == at; });
      const double after = next == outcomes.end() ? before : error(*next);
      rises = rises && after > before;
      before = after;
    }
    cases.rising += rises;
    ++cases.all;
  }
  return cases;
}

std::size_t distinct(const std::vector<Outcome>& outcomes, const ErrorOf& error) {
  std::set<double> values;
  for (const Outcome& o : outcomes) {
    if (std::isfinite(error(o))) values.insert(error(o));
  }
  return values.size();
}

namespace {

template <class Add>
void add_effects(const std::vector<Outcome>& outcomes, const ErrorOf& error, std::string_view where,
                 const Add& add) {
  const Effects effects = main_effects(outcomes, error);
  add(fmt::format("effect_tau{}", where), effects.tau);
  add(fmt::format("effect_w{}", where), effects.w);
  add(fmt::format("effect_k{}", where), effects.k);
  add(fmt::format("effect_interactions{}", where), effects.interactions);
}

// Of outcomes with an error that passes the test.
template <class Test>
double count(const std::vector<Outcome>& outcomes, const ErrorOf& error, const Test& test) {
  return static_cast<double>(
      std::count_if(outcomes.begin(), outcomes.end(), [&](const Outcome& o) { return test(error(o)); }));
}

}  // namespace

void record_error(const std::vector<Outcome>& outcomes, std::string_view prefix, const ErrorOf& error,
                  Recorder& recorder) {
  const auto add_with_unit = [&](std::string_view what, std::string_view unit, double value) {
    recorder.add(fmt::format("{}{}", prefix, what), unit, value);
  };
  const auto add = [&](std::string_view what, double value) { add_with_unit(what, "", value); };
  const double infinite = count(outcomes, error, [](double e) { return !std::isfinite(e); });
  add("infinite_sets", infinite);
  if (infinite > 0) return;
  const Outcome& best = least(outcomes, error);
  add("least", error(best));
  add_with_unit("best_tau", "pixels", best.setting.tau);
  add_with_unit("best_w", "samples", best.setting.w);
  add_with_unit("best_k", "samples", best.setting.k);
  add("best_untouched", best.untouched);
  const auto in_range = [](double e) { return e >= kPaperLeast && e <= kPaperMost; };
  const std::vector<Outcome> good = without_outliers(outcomes, error);
  add("sets_in_range", count(outcomes, error, in_range));
  add("good_sets", static_cast<double>(good.size()));
  add("good_in_range", count(good, error, in_range) / static_cast<double>(good.size()));
  add("sets_above_1", count(outcomes, error, [](double e) { return e > 1; }));
  add("distinct", static_cast<double>(distinct(outcomes, error)));
  const Cases cases = rising_with_tau(outcomes, error);
  add("cases_rising_with_tau", cases.rising);
  add("cases", cases.all);
  const Effects effects = main_effects(outcomes, error);
  for (std::size_t t = 0; t < kTaus.size(); ++t) {
    add(fmt::format("mean_at_tau_{}", kTaus[t]), effects.mean_at_tau[t]);
  }
  add_effects(outcomes, error, "", add);
  // With the least k much of the ground stays plateau, which dominates the variance.
  std::vector<Outcome> wide;
  std::copy_if(outcomes.begin(), outcomes.end(), std::back_inserter(wide),
               [](const Outcome& o) { return o.setting.k > kInfluences.front(); });
  add_effects(wide, error, "_k_from_10", add);
}

}  // namespace terrabench::drill
