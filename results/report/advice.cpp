#include "results/report/advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "results/claims/embedded.h"
#include "results/report/findings_table.h"

namespace terrabench {
namespace {

constexpr std::size_t kWidest = 30;  // of a cell on a terminal, in characters

// A question in tables of findings is answered there by the grounds that have a column.
bool counts(const RankingLayout& layout) {
  return matters(layout, "") && (layout.table.empty() || !layout.ground.empty());
}

bool comparable(const RankingLayout& a, const RankingLayout& b) {
  return a.question == b.question && a.kind == b.kind;
}

bool share_one(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  return std::ranges::any_of(a, [&](const std::string& method) { return std::ranges::count(b, method) > 0; });
}

// "as on 3 of 7"; "differs: ROAM on 5 of 7" where another method is best on most.
std::string beside(const Ranking& here, std::span<const Answer> elsewhere) {
  const std::vector<std::string> best = here.best();
  int grounds = 0, same = 0, most = 0;
  std::map<std::string, int> grounds_of;
  for (const Answer& answer : elsewhere) {
    if (!comparable(*answer.layout, *here.layout)) continue;
    ++grounds;
    same += share_one(answer.best, best) ? 1 : 0;
    for (const std::string& method : answer.best) most = std::max(most, ++grounds_of[method]);
  }
  if (grounds == 0) return "–";
  if (most == 0) return "not decided there";
  std::vector<std::string> leaders;
  for (const auto& [method, count] : grounds_of) {
    if (count == most) leaders.push_back(method);
  }
  if (!best.empty() && share_one(best, leaders)) return fmt::format("as on {} of {}", same, grounds);
  return fmt::format("{}{} on {} of {}", best.empty() ? "" : "differs: ", fmt::join(leaders, " or "), most,
                     grounds);
}

Answer answer_from(const nlohmann::json& ranking, const RankingLayout& layout) {
  Answer answer{&layout, {}};
  if (ranking.at("undecided").get<bool>() || !ranking.at("comparable").get<bool>()) return answer;
  for (std::size_t i = 0; i < ranking.at("tied").get<std::size_t>(); ++i)
    answer.best.push_back(ranking.at("places").at(i).at("label").get<std::string>());
  return answer;
}

}  // namespace

std::vector<Answer> answers(std::span<const Ranking> rankings) {
  std::vector<Answer> all;
  for (const Ranking& ranking : rankings) {
    if (counts(*ranking.layout)) all.push_back({ranking.layout, ranking.best()});
  }
  return all;
}

std::span<const Answer> reference_answers() {
  static const std::vector<Answer> kAnswers = [] {
    std::vector<Answer> all;
    for (const auto& ranking : nlohmann::json::parse(embedded_findings().front().text)) {
      const auto layout =
          std::ranges::find(ranking_layouts(), ranking.at("id").get<std::string>(), &RankingLayout::id);
      if (layout != ranking_layouts().end() && counts(*layout)) all.push_back(answer_from(ranking, *layout));
    }
    return all;
  }();
  return kAnswers;
}

bool matters(const RankingLayout& layout, std::string_view purpose) {
  return !layout.question.empty() && (purpose.empty() || std::ranges::count(layout.purposes, purpose) > 0);
}

std::vector<std::string> purposes() {
  std::vector<std::string> all;
  for (const RankingLayout& layout : ranking_layouts()) {
    for (const std::string& purpose : layout.purposes) {
      if (std::ranges::count(all, purpose) == 0) all.push_back(purpose);
    }
  }
  return all;
}

std::vector<std::string> experiments_for(std::string_view purpose) {
  std::vector<std::string> all;
  for (const RankingLayout& layout : ranking_layouts()) {
    if (matters(layout, purpose) && std::ranges::count(all, layout.experiment) == 0)
      all.push_back(layout.experiment);
  }
  return all;
}

Table advice(std::span<const Ranking> here, std::span<const Answer> elsewhere) {
  Table table{
      "",
      "",
      "Take: the best method, or those that are tied. Next and lead: the best of the others, and by which "
      "factor it is behind. Reference: the number of other reference grounds of this kind on which a "
      "method to take is best or tied, or the method best on most.",
      {{"Question"}, {"Take"}, {"Next"}, {"Lead"}, {"Reference"}, {"Why"}},
      {}};
  for (const Ranking& ranking : here) {
    const std::vector<std::string> best = ranking.best();
    const bool has_next = !best.empty() && ranking.tied < ranking.places.size();
    table.rows.push_back({{ranking.layout->question},
                          {best.empty() ? "not decided" : fmt::format("{}", fmt::join(best, " ≈ "))},
                          {has_next ? ranking.places[ranking.tied].label : "–"},
                          {ranking.lead()},
                          {beside(ranking, elsewhere)},
                          {ranking.reason()}});
  }
  return table;
}

std::string advice_text(const Table& table) {
  Table answers = table;
  answers.columns.pop_back();
  for (std::vector<Cell>& row : answers.rows) row.pop_back();
  std::string text =
      (table.title.empty() ? "" : table.title + "\n") + plain_text(answers, kWidest) + "\nWhy:\n";
  for (const std::vector<Cell>& row : table.rows) {
    text += fmt::format("  {}: {}\n", row.front().text, row.back().text);
  }
  return text;
}

}  // namespace terrabench
