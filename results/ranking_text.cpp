// The sentences of ranking.h.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <utility>

#include "results/format.h"
#include "results/ranking.h"

namespace terrabench {
namespace {

std::string joined(const std::vector<std::string>& parts, std::string_view last) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += i + 1 == parts.size() ? last : ", ";
    text += parts[i];
  }
  return text;
}

// Clauses become a sentence.
void finish(std::string& text) {
  text += ".";
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
}

// Of 1.002, three digits would be 1.
std::string digits(double factor) { return fmt::format("{:.{}g}", factor, factor < 1.1 ? 4 : 3); }

// "1.3 [1.2, 1.4]"; the interval is left out where there is none.
std::string factor_text(const Summary& factor) {
  const std::string median = digits(factor.median);
  if (factor.low == factor.high) return median;
  return fmt::format("{} [{:.3g}, {:.3g}]", median, factor.low, factor.high);
}

// Grounds of one task with the same outcome, a subject and a verb: "drills and stacks tied".
struct Group {
  std::string outcome;
  std::vector<std::string> where;
  double least = 0, most = 0;  // by which factor the best is ahead of the next; 0: of none
};

std::string outcome_of(const Ranking& ranking) {
  if (ranking.places.empty()) return "none took part";
  if (!ranking.decided()) return "nothing was decided";
  if (ranking.places.size() == 1) return ranking.places[0].label + " alone took part";
  std::vector<std::string> best;
  for (std::size_t i = 0; i < ranking.tied; ++i) best.push_back(ranking.places[i].label);
  if (best.size() == 1) return best[0] + " led";
  std::ranges::sort(best);
  return joined(best, " and ") + " tied";
}

void add_to(std::vector<Group>& groups, const Ranking& ranking) {
  const std::string outcome = outcome_of(ranking);
  auto at = std::ranges::find(groups, outcome, &Group::outcome);
  if (at == groups.end()) at = groups.insert(at, {outcome, {}, 0, 0});
  at->where.push_back(ranking.layout->where);
  if (!ranking.decided() || ranking.tied > 1 || ranking.places.size() == 1) return;
  const double ahead = ranking.places[1].factor.median;
  at->least = at->most == 0 ? ahead : std::min(at->least, ahead);
  at->most = std::max(at->most, ahead);
}

std::string text_of(const Group& group) {
  const std::string text = joined(group.where, " and ") + ", " + group.outcome;
  if (group.most == 0) return text;
  const std::string least = digits(group.least), most = digits(group.most);
  return text + (least == most ? fmt::format(" ({} ×)", most) : fmt::format(" ({} to {} ×)", least, most));
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
    const Summary& last = places[tied - 1].factor;
    return fmt::format("{} are tied{}", joined(best, " and "),
                       last.median != 1 ? fmt::format(", within a factor of {}", factor_text(last)) : "");
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

Facts in_short(std::span<const Ranking> rankings) {
  Facts facts;
  for (auto first = rankings.begin(); first != rankings.end();) {
    const RankingLayout& layout = *first->layout;
    std::vector<Group> groups;
    for (; first != rankings.end() && first->layout->task == layout.task; ++first) add_to(groups, *first);
    if (layout.sentence.empty()) continue;
    std::vector<std::string> texts;
    for (const Group& group : groups) texts.push_back(text_of(group));
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
                    {"tied", ranking.places.empty() ? 0 : ranking.tied},
                    {"too_few_samples", ranking.too_few},
                    {"comparable", ranking.not_compared.empty()},
                    {"finding", ranking.clause()},
                    {"runs", ranking.runs}});
  }
  return list.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace terrabench
