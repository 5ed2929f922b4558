// The sentences of ranking.h.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <functional>
#include <nlohmann/json.hpp>
#include <utility>

#include "results/claims/ranking.h"
#include "results/store/format.h"

namespace terrabench {
namespace {

// Clauses become a sentence.
void finish(std::string& text) {
  text += ".";
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
}

// Three digits, and as many more as tell the factor from 1 and from the margins, which decide on ties: 1.002.
std::string digits_of(double factor) {
  constexpr std::array kBounds{1.0, kExactMargin, kTimingMargin};
  constexpr int kFewest = 3, kMost = 7;
  for (int digits = kFewest;; ++digits) {
    std::string text = fmt::format("{:.{}g}", factor, digits);
    const double shown = std::strtod(text.c_str(), nullptr);
    const auto same_side = [&](double bound) { return (shown <=> bound) == (factor <=> bound); };
    if (digits == kMost || std::ranges::all_of(kBounds, same_side)) return text;
  }
}

// "1.3 [1.2, 1.4]"; the interval is left out where there is none.
std::string factor_text(const Summary& factor) {
  const std::string median = digits_of(factor.median);
  if (factor.low == factor.high) return median;
  return fmt::format("{} [{}, {}]", median, digits_of(factor.low), digits_of(factor.high));
}

// Of a ranking with two places or more: by which the best is ahead of the next, or within which the best are
// tied.
const Summary& factor_of(const Ranking& ranking) {
  return ranking.places[ranking.tied > 1 ? ranking.tied - 1 : 1].factor;
}

// Grounds of one task with the same outcome, a subject and a verb: "drills and stacks tied".
struct SameOutcome {
  std::string outcome;
  std::vector<std::string> where;
  bool tied = false;
  // By which factors the best is ahead of the next, or within which the best are tied; without those of 1.
  std::vector<Summary> factors;
};

std::string outcome_of(const Ranking& ranking) {
  if (ranking.places.empty()) return "none took part";
  if (!ranking.decided()) return "nothing was decided";
  if (ranking.places.size() == 1) return ranking.places[0].label + " alone took part";
  std::vector<std::string> best;
  for (std::size_t i = 0; i < ranking.tied; ++i) best.push_back(ranking.places[i].label);
  if (best.size() == 1) return best[0] + " led";
  std::ranges::sort(best);
  return list_of(best, ", ", " and ") + " tied";
}

void add_to(std::vector<SameOutcome>& groups, const Ranking& ranking) {
  const std::string outcome = outcome_of(ranking);
  auto at = std::ranges::find(groups, outcome, &SameOutcome::outcome);
  if (at == groups.end()) at = groups.insert(at, {outcome, {}, ranking.tied > 1, {}});
  at->where.push_back(ranking.layout->where);
  if (!ranking.decided() || ranking.places.size() == 1) return;
  const Summary& factor = factor_of(ranking);
  if (factor.median != 1) at->factors.push_back(factor);
}

// "1.2 to 1.3 ×", "within 1.1 ×"; empty if all factors are 1.
std::string factors_of(const SameOutcome& group) {
  if (group.factors.empty()) return "";
  const auto [least, most] = std::ranges::minmax_element(group.factors, {}, &Summary::median);
  std::string factors = fmt::format("{} to {}", factor_text(*least), factor_text(*most));
  if (digits_of(least->median) == digits_of(most->median)) {
    Summary all = *most;  // one factor with an interval that holds those of all grounds
    for (const Summary& factor : group.factors) {
      all.low = std::min(all.low, factor.low);
      all.high = std::max(all.high, factor.high);
    }
    factors = factor_text(all);
  }
  return fmt::format("{}{} ×", group.tied ? "within " : "", factors);
}

// The grounds' names, without the preposition that most of them have: "a hill, a fractal".
std::string names_of(const SameOutcome& group) {
  std::vector<std::string> names;
  for (const std::string& where : group.where)
    names.push_back(where.substr(where.starts_with("on ") ? 3 : 0));
  return list_of(names, ", ", ", ");
}

// Of a task on `all` grounds: "drills led on 4 of 7 grounds (a hill, …; 1.2 to 1.3 ×)". Grounds that all
// agree are not named, and `counted` says only of the `first` group what is counted.
std::string text_of(const SameOutcome& group, std::size_t all, const std::string& counted, bool first) {
  std::string on = group.where[0], names;
  if (all > 1 && group.where.size() == all) {
    on = all == 2 ? "on both " + counted : fmt::format("on all {} {}", all, counted);
  } else if (all > 1) {
    on = fmt::format("on {}", group.where.size());
    if (first) on += fmt::format(" of {} {}", all, counted);
    names = names_of(group);
  }
  const std::string factors = factors_of(group);
  const std::string inside = names + (names.empty() || factors.empty() ? "" : "; ") + factors;
  return fmt::format("{} {}{}", group.outcome, on, inside.empty() ? "" : " (" + inside + ")");
}

}  // namespace

std::string Ranking::result() const {
  const auto with_value = [&](const Place& p) {
    const double rounded = std::strtod(fmt::format("{:.4g}", p.value).c_str(), nullptr);
    return fmt::format("{} ({})", p.label, format_quantity(rounded, layout->unit));
  };
  if (places.empty()) return "none";
  if (!not_compared.empty()) return "not compared, as " + not_compared;
  if (tied > 1 && !too_few) {
    std::vector<std::string> best;
    for (std::size_t i = 0; i < tied; ++i) best.push_back(with_value(places[i]));
    std::string text = list_of(best, ", ", " and ") + " are tied";
    const Summary& last = factor_of(*this);
    if (last.median != 1) text += fmt::format(", within a factor of {}", factor_text(last));
    if (last.low > 1) text += fmt::format(", less than the margin of {}", margin);
    return text;
  }
  if (places.size() == 1) return with_value(places[0]) + " alone";
  const std::string first = with_value(places[0]), second = with_value(places[1]),
                    factor = factor_text(places[1].factor);
  if (too_few) {
    return fmt::format("undecided, as they were measured only once or twice: {}, {}, a factor of {}", first,
                       second, factor);
  }
  return fmt::format("{}, ahead of {} by a factor of {}", first, second, factor);
}

std::string Ranking::lead() const {
  if (places.size() == 1) return "alone";
  const Summary& factor = factor_of(*this);
  if (tied == 1) return factor_text(factor) + " ×";
  return factor.median == 1 ? "tied" : fmt::format("tied, within {} ×", factor_text(factor));
}

std::string tie_rule() {
  return fmt::format(
      "Methods are called tied if the 95 % interval of that factor contains 1 or if the factor is below a "
      "margin: {} for times and rates, since two thirds of them change by less between two runs on one "
      "machine, and {} for all else, since a smaller lead is no reason to choose a method.",
      kTimingMargin, kExactMargin);
}

Facts in_short(std::span<const Ranking> rankings) {
  Facts facts;
  for (auto first = rankings.begin(); first != rankings.end();) {
    const RankingLayout& layout = *first->layout;
    std::vector<SameOutcome> groups;
    std::size_t all = 0;
    for (; first != rankings.end() && first->layout->task == layout.task; ++first, ++all)
      add_to(groups, *first);
    if (layout.sentence.empty()) continue;
    std::ranges::stable_sort(groups, std::greater{}, [](const auto& group) { return group.where.size(); });
    std::vector<std::string> texts;
    for (const SameOutcome& group : groups)
      texts.push_back(text_of(group, all, layout.counted, texts.empty()));
    const std::string clause = fmt::format("{}: {}", layout.brief, fmt::join(texts, "; "));
    const auto line =
        std::ranges::find(facts.lines, layout.sentence, &std::pair<std::string, std::string>::first);
    if (line == facts.lines.end()) {
      facts.lines.emplace_back(layout.sentence, clause);
    } else {
      line->second += "; " + clause;
    }
  }
  for (auto& [name, text] : facts.lines) finish(text);
  return facts;
}

Facts findings(std::span<const Ranking> rankings) {
  Facts facts;
  const std::string* task = nullptr;
  for (const Ranking& ranking : rankings) {
    if (task == nullptr || *task != ranking.layout->task) {
      task = &ranking.layout->task;
      const std::string& needs = ranking.layout->needs_text;
      facts.lines.emplace_back(*task, needs.empty() ? "" : needs + ", ");
    } else {
      facts.lines.back().second += "; ";
    }
    facts.lines.back().second += ranking.clause();
  }
  for (auto& [name, text] : facts.lines) finish(text);
  return facts;
}

std::string findings_json(std::span<const Ranking> rankings) {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  for (const Ranking& ranking : rankings) {
    const RankingLayout& layout = *ranking.layout;
    Json places = Json::array();
    for (const Ranking::Place& p : ranking.places) {
      places.push_back({{"label", p.label},
                        {"value", p.value},
                        {"factor", p.factor.median},
                        {"factor_low", p.factor.low},
                        {"factor_high", p.factor.high}});
    }
    list.push_back({{"id", layout.id},
                    {"task", layout.task},
                    {"where", layout.where},
                    {"experiment", layout.experiment},
                    {"metric", layout.metric},
                    {"unit", layout.unit},
                    {"best", layout.most ? "most" : "least"},
                    {"needs", layout.needs_text},
                    {"left_out", ranking.left_out},
                    {"places", places},
                    {"margin", ranking.margin},
                    {"tied", ranking.places.empty() ? 0 : ranking.tied},
                    {"too_few_samples", ranking.too_few},
                    {"comparable", ranking.not_compared.empty()},
                    {"finding", ranking.clause()},
                    {"runs", ranking.runs}});
  }
  return list.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace terrabench
