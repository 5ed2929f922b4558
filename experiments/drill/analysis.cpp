#include "experiments/drill/analysis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <map>
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

int rising_with_tau(const std::vector<Outcome>& outcomes, const ErrorOf& error) {
  std::map<Setting, double> at;
  for (const Outcome& o : outcomes) at[o.setting] = error(o);
  int rising = 0;
  for (const int w : kWidths) {
    for (const int k : kInfluences) {
      rising += at[{kTaus[0], w, k}] < at[{kTaus[1], w, k}] && at[{kTaus[1], w, k}] < at[{kTaus[2], w, k}];
    }
  }
  return rising;
}

std::size_t distinct(const std::vector<Outcome>& outcomes, const ErrorOf& error) {
  std::set<double> values;
  for (const Outcome& o : outcomes) {
    if (std::isfinite(error(o))) values.insert(error(o));
  }
  return values.size();
}

namespace {

// Of outcomes with an error that passes the test.
template <class Test>
double count(const std::vector<Outcome>& outcomes, const ErrorOf& error, const Test& test) {
  return static_cast<double>(
      std::count_if(outcomes.begin(), outcomes.end(), [&](const Outcome& o) { return test(error(o)); }));
}

bool in_range(double error) { return error >= kPaperLeast && error <= kPaperMost; }
bool above_1(double error) { return error > 1 && std::isfinite(error); }

double good_in_range(const std::vector<Outcome>& outcomes, const ErrorOf& error) {
  const std::vector<Outcome> good = without_outliers(outcomes, error);
  return count(good, error, in_range) / static_cast<double>(good.size());
}

}  // namespace

bool gives_all(const std::vector<Outcome>& outcomes, const ErrorOf& error) {
  const auto means = main_effects(outcomes, error).mean_at_tau;
  return good_in_range(outcomes, error) >= 0.5 && count(outcomes, error, above_1) > 0 &&
         means[0] < means[1] && means[1] < means[2];
}

void record_error(const std::vector<Outcome>& outcomes, std::string_view prefix, const ErrorOf& error,
                  Recorder& recorder, std::initializer_list<std::string_view> unread) {
  const auto add = [&](std::string_view what, double value) {
    if (std::ranges::find(unread, what) == unread.end())
      recorder.add(fmt::format("{}{}", prefix, what), "", value);
  };
  const double infinite = count(outcomes, error, [](double e) { return !std::isfinite(e); });
  if (infinite > 0) return add("infinite_sets", infinite);
  add("least", error(least(outcomes, error)));
  add("sets_in_range", count(outcomes, error, in_range));
  add("good_in_range", good_in_range(outcomes, error));
  add("sets_above_1", count(outcomes, error, above_1));
  add("cases_rising_with_tau", rising_with_tau(outcomes, error));
  const Effects effects = main_effects(outcomes, error);
  for (std::size_t t = 0; t < kTaus.size(); ++t) {
    add(fmt::format("mean_at_tau_{}", kTaus[t]), effects.mean_at_tau[t]);
  }
  add("effect_tau", effects.tau);
  add("effect_w", effects.w);
  add("effect_k", effects.k);
}

}  // namespace terrabench::drill
