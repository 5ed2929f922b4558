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

// A method is tied with the best unless they differ() (statistics.h): times and rates by kTimingMargin, all
// else, such as bytes, triangles and errors, by this. A smaller lead is exact, but no reason to choose a
// method: stacks take 0.2 % fewer bytes than the implicit surface that is built on them.
inline constexpr double kExactMargin = 1.01;
// Both margins, as a sentence for those who read who is tied.
std::string tie_rule();

// One layout, filled: the entries that take part, from best to worst.
struct Ranking {
  struct Place {
    std::string label;
    double value;    // median, in the layout's unit
    Summary factor;  // how many times worse than the best, with its 95 % interval; 1 for the best
  };
  const RankingLayout* layout = nullptr;
  std::vector<Place> places;
  double margin = kExactMargin;       // below it, a factor is a tie
  std::size_t tied = 1;               // places that belong to the best
  bool too_few = false;               // a time with fewer than kFewestSamples: no interval, no winner
  std::string not_compared;           // the reason, as words after "as"; empty: they are comparable
  std::vector<std::string> left_out;  // labels of entries in another unit, or that lack what is needed
  std::vector<std::string> runs;

  // Whether there is a best method, or several tied: not if times have too few samples or if the values
  // cannot be compared.
  bool decided() const { return !places.empty() && not_compared.empty() && !too_few; }
  // "heightmap (262 kB), ahead of drills (341 kB) by a factor of 1.3"
  std::string result() const;
  // The factor alone: "1.3 [1.2, 1.4] ×", "tied, within 1.1 [1.05, 1.2] ×", "tied", "alone"; of one that is
  // decided.
  std::string lead() const;
  // "on caves: " and the result
  std::string clause() const { return layout->where + ": " + result(); }
};

// Of all claims files that are compiled in.
std::span<const RankingLayout> ranking_layouts();

// Nothing when fewer than two entries were measured. If one is in a unit that cannot be converted, none are
// compared.
std::optional<Ranking> rank(const RankingLayout&, const Store&, const std::string& profile);
// All that were measured.
std::vector<Ranking> rank(std::span<const RankingLayout>, const Store&, const std::string& profile);

// A sentence per name of RankingLayout::sentence, in the order of first use: for each of its tasks, whose
// rankings follow each other, which method led on how many grounds, the most first, and by how many times it
// was ahead of the next, or within which factor methods are tied, with 95 % intervals: "For the most queries:
// heightmap led on 2 of 3 grounds (real mountains, a fractal; 1.3 [1.2, 1.4] to 2.1 [2, 2.2] ×); drills and
// stacks tied on 1 (caves; within 1.1 [1.05, 1.2] ×); for the least error: …".
Facts in_short(std::span<const Ranking>);
// A sentence per task, which joins the clauses of all its grounds.
Facts findings(std::span<const Ranking>);
std::string findings_json(std::span<const Ranking>);

}  // namespace terrabench
