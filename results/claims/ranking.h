// Who is best at what, in sentences made from the measurements: the [[ranking]] entries of the claims files.
// Each compares the same metric of several cases, such as the bytes of every representation of one ground.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "results/claims/claims.h"
#include "results/report/document.h"
#include "results/store/statistics.h"
#include "results/store/store.h"

namespace terrabench {

// relation() (statistics.h) in sentences, for those who read who led and who is tied.
std::string tie_rule();

// One layout, filled: the entries that take part, from best to worst.
struct Ranking {
  struct Place {
    std::string label;
    double value;  // median, in the layout's unit
    // How many times worse than the best, with its 95 % interval, in three digits; 1 for the best.
    Summary factor;
  };
  const RankingLayout* layout = nullptr;
  std::vector<Place> places;
  bool timed = false;
  double margin = 0;  // relation()
  // The best, and the places after it that are tied with it or of which this is undecided. The first place
  // that is behind ends them: those after it have worse medians.
  std::size_t tied = 1;
  bool undecided = false;             // whether there are any of the last
  bool too_few = false;               // and since a time was taken fewer than kFewestSamples times
  std::string not_compared;           // the reason, as words after "as"; empty: they are comparable
  std::vector<std::string> left_out;  // labels of measured entries in another unit, or without what is needed
  std::vector<std::string> runs;

  // Whether there is a best method, or several tied.
  bool decided() const { return !places.empty() && not_compared.empty() && !undecided; }
  // "heightmap (262 kB), ahead of drills (341 kB) by a factor of 1.3"
  std::string result() const;
  // The best, or those tied with it, by name; none if it is not decided.
  std::vector<std::string> best() const;
  // Where the samples vary too much to say which: those of which one may be the best, by name; else none.
  std::vector<std::string> contenders() const;
  // By how much the best is ahead: "1.3 ×", "tied", "alone"; a dash if it is not decided.
  std::string lead() const;
  // Why, in numbers: "2.9 kB against 5.1 kB (TIN)"; or why it is not decided.
  std::string reason() const;
  // "on caves: ", the result, and "(left out: drills and heightmap)"
  std::string clause() const;
};

// Of all claims files that are compiled in.
std::span<const RankingLayout> ranking_layouts();

// Nothing when fewer than two entries were measured. If one is in a unit that cannot be converted, none are
// compared.
std::optional<Ranking> rank(const RankingLayout&, const Store&, const std::string& profile);
// All that were measured.
std::vector<Ranking> rank(std::span<const RankingLayout>, const Store&, const std::string& profile);

// A sentence per task, which joins the clauses of all its grounds.
Facts findings(std::span<const Ranking>);
std::string findings_json(std::span<const Ranking>);

}  // namespace terrabench
