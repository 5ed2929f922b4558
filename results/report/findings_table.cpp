#include "results/report/findings_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <utility>

#include "results/report/report_tables.h"
#include "results/store/format.h"

namespace terrabench {
namespace {

std::string joined(const std::vector<std::string>& methods) {
  return fmt::format("{}", fmt::join(methods, " ≈ "));
}

constexpr std::size_t kMostNamed = 3;  // in a cell; the ground's page has all

Cell cell_of(const Ranking& ranking) {
  const std::vector<std::string> best = ranking.best(), contenders = ranking.contenders();
  Cell cell{joined(best)};
  if (best.empty()) {
    cell.text = contenders.empty()               ? "not decided"
                : contenders.size() > kMostNamed ? fmt::format("{} methods, undecided", contenders.size())
                                                 : list_of(contenders, ", ", " or ");
    cell.style = "undecided";
  } else if (best.size() > 1) {
    if (best.size() > kMostNamed) cell.text = fmt::format("{} methods tied", best.size());
    cell.style = "tied";
  } else if (ranking.places.size() == 1) {
    cell.text += " (alone)";
  } else {
    cell.text += fmt::format(" {} ×", format_number(ranking.places[1].factor.median));
  }
  cell.link = ground_page(ranking.layout->ground) + ".*";
  return cell;
}

bool differs(const Ranking& ranking, std::span<const Answer> elsewhere) {
  const auto answer = std::ranges::find(elsewhere, ranking.layout, &Answer::layout);
  const std::vector<std::string> best = ranking.best();
  return answer != elsewhere.end() && !answer->best.empty() && !best.empty() &&
         std::ranges::find_first_of(best, answer->best) == best.end();
}

// Of one question: which methods are best on which grounds, tied or alone.
class Outcomes {
 public:
  void add(const Ranking& ranking) {
    const std::vector<std::string> best = ranking.best();
    for (const std::string& method : best) grounds_of_[method].push_back(grounds_);
    if (best.empty()) ++undecided_;
    for (const std::string& method : ranking.contenders()) ++may_be_best_on_[method];
    if (best.size() > 1) shared_.insert(grounds_);
    ++grounds_;
  }

  // "ROAM on 3 of 5 grounds (tied on 2), clipmap and hybrid on 2 (tied); not decided on 1": methods that are
  // best on the same grounds stand together; those on the most grounds, and on request the next, too.
  std::string text(bool with_next) const {
    std::map<std::vector<int>, std::vector<std::string>> methods_of;
    for (const auto& [method, grounds] : grounds_of_) methods_of[grounds].push_back(method);
    std::vector<std::pair<std::vector<int>, std::vector<std::string>>> groups(methods_of.begin(),
                                                                              methods_of.end());
    std::ranges::stable_sort(groups, std::greater{}, [](const auto& group) { return group.first.size(); });
    std::string text;
    for (std::size_t i = 0; i < groups.size(); ++i) {
      const auto& [grounds, methods] = groups[i];
      const bool as_good = grounds.size() == groups[0].first.size();
      if (!as_good && (!with_next || i > 1)) break;
      text += fmt::format("{}{} on {}", i == 0 ? "" : ", ", list_of(methods, ", ", " and "), grounds.size());
      if (i == 0) text += fmt::format(" of {} grounds", grounds_);
      text += shares(grounds);
    }
    if (text.empty()) return undecided();
    return undecided_ == 0 ? text : text + fmt::format("; not decided on {}", undecided_);
  }

 private:
  // "no clear winner; CBT or RTIN may be the best on 3 of 3 grounds"
  std::string undecided() const {
    int most = 0;
    std::vector<std::string> methods;
    for (const auto& [method, grounds] : may_be_best_on_) {
      if (grounds > most) methods.clear();
      if (grounds >= most) methods.push_back(method);
      most = std::max(most, grounds);
    }
    if (methods.empty()) return fmt::format("not decided on {} grounds", grounds_);
    return fmt::format("no clear winner; {} may be the best on {} of {} grounds",
                       list_of(methods, ", ", " or "), most, grounds_);
  }

  std::string shares(const std::vector<int>& grounds) const {
    const auto tied = std::ranges::count_if(grounds, [&](int ground) { return shared_.contains(ground); });
    if (tied == 0) return "";
    return std::cmp_equal(tied, grounds.size()) ? " (tied)" : fmt::format(" (tied on {})", tied);
  }

  int grounds_ = 0, undecided_ = 0;
  std::set<int> shared_;  // grounds on which several methods are best
  std::map<std::string, std::vector<int>> grounds_of_;
  std::map<std::string, int> may_be_best_on_;  // grounds
};

std::vector<const Ranking*> placed(std::span<const Ranking> rankings) {
  std::vector<const Ranking*> in_tables;
  for (const Ranking& ranking : rankings) {
    if (!ranking.layout->ground.empty()) in_tables.push_back(&ranking);
  }
  return in_tables;
}

bool same_row(const Ranking& a, const Ranking& b) {
  return a.layout->table == b.layout->table && a.layout->question == b.layout->question;
}

std::string slug(std::string text) {
  for (char& c : text) c = c == ' ' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

// `rankings`: of one table.
Table table_of(const std::string& name, const std::vector<const Ranking*>& rankings,
               std::span<const Answer> elsewhere) {
  Table table{slug("findings " + name),
              name,
              "The best method on each ground with its lead over the next. ≈ joins methods that are tied, "
              "“or” those of "
              "which one may be the best: their times vary too much to say which.",
              {{"Best at"}},
              {}};
  std::vector<std::string> grounds;
  for (const Ranking* const ranking : rankings) {
    const std::string& ground = ranking->layout->ground;
    if (std::ranges::count(grounds, ground) == 0) grounds.push_back(ground);
  }
  for (const std::string& ground : grounds) table.columns.push_back({ground});
  table.columns.push_back({"In all"});
  Outcomes outcomes;
  bool marked = false;
  const auto finish_row = [&] {
    if (!table.rows.empty()) table.rows.back().back().text = outcomes.text(false);
    outcomes = {};
  };
  for (std::size_t i = 0; i < rankings.size(); ++i) {
    if (i == 0 || !same_row(*rankings[i - 1], *rankings[i])) {
      finish_row();
      table.rows.emplace_back(table.columns.size(), Cell{"–"})[0].text = rankings[i]->layout->question;
    }
    const auto at = std::ranges::find(grounds, rankings[i]->layout->ground) - grounds.begin();
    Cell& cell = table.rows.back()[static_cast<std::size_t>(at) + 1];
    cell = cell_of(*rankings[i]);
    if (differs(*rankings[i], elsewhere)) {
      cell.text += " †";
      marked = true;
    }
    outcomes.add(*rankings[i]);
  }
  finish_row();
  if (marked) table.caption += " †: in the reference run another method is best.";
  return table;
}

}  // namespace

std::vector<Table> findings_tables(std::span<const Ranking> rankings, std::span<const Answer> elsewhere) {
  std::vector<std::pair<std::string, std::vector<const Ranking*>>> groups;
  for (const Ranking* const ranking : placed(rankings)) {
    const std::string& name = ranking->layout->table;
    auto at = std::ranges::find(groups, name, &decltype(groups)::value_type::first);
    if (at == groups.end()) at = groups.insert(at, {name, {}});
    at->second.push_back(ranking);
  }
  std::vector<Table> tables;
  for (const auto& [name, members] : groups) tables.push_back(table_of(name, members, elsewhere));
  return tables;
}

Facts headlines(std::span<const Ranking> rankings) {
  const std::vector<const Ranking*> in_tables = placed(rankings);
  Facts lines;
  for (auto first = in_tables.begin(); first != in_tables.end();) {
    const Ranking& head = **first;
    Outcomes outcomes;
    for (; first != in_tables.end() && same_row(**first, head); ++first) outcomes.add(**first);
    if (head.layout->headline) lines.lines.emplace_back(head.layout->question, outcomes.text(true) + ".");
  }
  return lines;
}

std::string plain_text(const Table& table, std::size_t widest) {
  std::vector<std::vector<std::vector<std::string>>> rows(1);  // their cells' lines
  for (const Column& column : table.columns) rows[0].push_back({column.title});
  for (const std::vector<Cell>& row : table.rows) {
    rows.emplace_back();
    for (const Cell& cell : row) rows.back().push_back(wrap(cell.text, widest));
  }
  std::vector<std::size_t> widths(table.columns.size());
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < widths.size(); ++i) {
      for (const std::string& line : row[i]) widths[i] = std::max(widths[i], characters(line));
    }
  }
  std::string text;
  for (const auto& row : rows) {
    const std::size_t lines = std::ranges::max(row, {}, [](const auto& cell) { return cell.size(); }).size();
    for (std::size_t k = 0; k < lines; ++k) {
      std::string line;
      for (std::size_t i = 0; i < widths.size(); ++i) {
        const std::string cell = k < row[i].size() ? row[i][k] : "";
        line += cell + std::string(widths[i] - characters(cell) + 2, ' ');
      }
      text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
  }
  return text;
}

}  // namespace terrabench
