#include "results/report/front_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "results/claims/statements.h"
#include "results/report/report_tables.h"

namespace terrabench {
namespace {

// Of the runs that records of this profile name.
std::vector<const Provenance*> runs_of(const Store& store, const std::string& profile) {
  std::vector<const Provenance*> runs;
  for (const Record& record : store.records()) {
    const Provenance* const run = store.run(record.run);
    if (run != nullptr && record.profile == profile && std::ranges::count(runs, run) == 0)
      runs.push_back(run);
  }
  return runs;
}

// "Measured in profile “paper” from 2026-11-26 to 2026-11-27, on AMD EPYC (2 threads): 28 runs"
std::string when_and_where(const std::vector<const Provenance*>& runs, const std::string& profile) {
  constexpr std::size_t kDay = 10;  // letters of a date
  std::set<std::string> days, machines;
  for (const Provenance* const run : runs) {
    days.insert(run->time.substr(0, kDay));
    machines.insert(fmt::format("{} ({} threads)", run->cpu, run->threads));
  }
  std::string text = fmt::format("Measured in profile “{}”", profile);
  if (days.size() == 1) text += " on " + *days.begin();
  if (days.size() > 1) text += fmt::format(" from {} to {}", *days.begin(), *days.rbegin());
  if (!machines.empty()) text += fmt::format(", on {}", fmt::join(machines, ", "));
  return fmt::format("{}: {} run{}", text, runs.size(), runs.size() == 1 ? "" : "s");
}

// Drops the folder's path: it is private, and changes when the folder is copied.
std::string without_folder(std::string text, const Store& store) {
  const std::string prefix = store.folder().string() + "/";
  const std::size_t at = text.find(prefix);
  return at == text.npos ? text : text.erase(at, prefix.size());
}

Bars::Bar bar_of(const JudgedResults& results, const Paper& paper) {
  std::map<Group, StandingCounts> counts = count_standings(statements(results.of(paper)));
  const StandingCounts &stated = counts[Group::kStated], &beyond = counts[Group::kBeyond],
                       &figures = counts[Group::kFigure];
  const int drawn = sum(figures);
  return {{paper.title, paper_page(paper) + ".*"},
          paper.id,
          {stated[0], stated[1], stated[2], stated[3], beyond[0], beyond[1] + beyond[2], beyond[3]},
          drawn == 0 ? "" : fmt::format("{} of {} figures", figures[0], drawn)};
}

}  // namespace

Document opening(const Store& store, const JudgedResults& results) {
  std::string found =
      "This program rebuilds the methods of five papers on terrain, measures what the papers state, and "
      "compares all "
      "methods on the same grounds.";
  const auto counts = count_standings(statements(results.judgements));
  if (const auto stated = counts.find(Group::kStated);
      stated != counts.end() &&
      sum(stated->second) > stated->second[static_cast<std::size_t>(Standing::kNotJudged)]) {
    found += fmt::format(" Of {} statements in numbers or comparisons, {}.", sum(stated->second),
                         counts_text(stated->second, Group::kStated));
  }
  const std::vector<const Provenance*> runs = runs_of(store, results.profile);
  return {Heading{1, "Five terrain papers, measured again", "top"}, Paragraph{std::move(found)},
          Paragraph{"", false, {{when_and_where(runs, results.profile), "runs.*"}}}};
}

Document cover_pictures(const Store& store, const JudgedResults& results,
                        std::span<const Paper* const> papers) {
  Gallery strip{{}, true};
  for (const Paper* const paper : papers) {
    const RecordedFigure* const figure = paper->cover.figure.empty()
                                             ? nullptr
                                             : store.find_figure(paper->cover.figure, results.profile).second;
    if (figure == nullptr || !store.intact(*figure)) continue;
    strip.pictures.push_back(
        {paper->id, paper->cover.shows, picture_file(*figure), {}, "", paper_page(*paper) + ".*"});
  }
  if (strip.pictures.empty()) return {};
  return {std::move(strip)};
}

Bars verdict_bars(const JudgedResults& results, std::span<const Paper* const> papers) {
  Bars bars{
      "verdicts",
      "What holds of each paper",
      "Statements, judged by measurements and nothing else. What we ask beyond a paper is counted apart.",
      {"holds as printed", "holds in another reading", "does not hold", "not judged",
       "beyond the paper, holds", "beyond the paper, does not", "beyond the paper, not judged"},
      "figures that show what the paper's do",
      {}};
  for (const Paper* const paper : papers) bars.bars.push_back(bar_of(results, *paper));
  return bars;
}

Doors next_commands() {
  return {{{"Find the method for my ground, in five minutes", "terrabench advise my.tif"},
           {"Measure a table of a paper again, and judge it",
            "terrabench run mrbsp.profile --out mine && terrabench check mine"},
           {"Find the experiments and claims of a paper", "terrabench list mrbsp"}}};
}

std::set<std::string, std::less<>> uncertain_runs(const Store& store) {
  std::set<std::string, std::less<>> runs;
  for (const Record& record : store.records()) {
    const Provenance* const run = store.run(record.run);
    if (run != nullptr && !run->timing_warnings.empty() && std::ranges::any_of(record.metrics, timed))
      runs.insert(run->id);
  }
  return runs;
}

Document busy_warning(const Store& store, const JudgedResults& results, bool links) {
  std::vector<Link> busy;
  const auto uncertain = uncertain_runs(store);
  const std::vector<const Provenance*> runs = runs_of(store, results.profile);
  for (const Provenance* const run : runs) {
    if (uncertain.contains(run->id)) busy.push_back({"run " + short_id(run->id), "#" + run_anchor(run->id)});
  }
  if (busy.empty()) return {};
  return {
      Paragraph{fmt::format("The times of {} of {} runs are uncertain; they are marked wherever they stand.",
                            busy.size(), runs.size()),
                true, links ? std::move(busy) : std::vector<Link>{{"Which runs, and why", "runs.*"}}}};
}

Document fault_warning(const Store& store, const JudgedResults& results) {
  if (results.faults.empty()) return {};
  return {
      Paragraph{fmt::format("These results cannot be trusted: {} lines or pictures were altered or damaged, "
                            "or name an unknown run. The first: {}",
                            results.faults.size(), without_folder(results.faults.front(), store)),
                true}};
}

Document failed_checks(const JudgedResults& results) {
  constexpr std::size_t kNamed = 3;
  Document warnings;
  std::vector<std::string> unmeasured;
  for (const Judgement& judgement : results.judgements) {
    if (judgement.check_failure.empty()) continue;
    if (judgement.verdict == Verdict::kMissing && judgement.runs.empty()) {
      unmeasured.push_back(judgement.claim->id);
    } else {
      warnings.push_back(
          Paragraph{fmt::format("{}: {}.", judgement.claim->id, judgement.check_failure), true});
    }
  }
  if (unmeasured.empty()) return warnings;
  std::string more;
  if (unmeasured.size() > kNamed) more = fmt::format(" and {} more claims", unmeasured.size() - kNamed);
  if (unmeasured.size() > kNamed) unmeasured.resize(kNamed);
  warnings.push_back(Paragraph{fmt::format("Verdict “missing”, since nothing of them was measured: {}{}.",
                                           fmt::join(unmeasured, ", "), more),
                               true,
                               {{"All in the ledger", "ledger.*"}}});
  return warnings;
}

}  // namespace terrabench
