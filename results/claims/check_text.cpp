#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "results/claims/check_output.h"
#include "results/claims/statements.h"
#include "results/store/format.h"

namespace terrabench {
namespace {

constexpr std::string_view kRed = "\x1b[31m", kGreen = "\x1b[32m", kYellow = "\x1b[33m", kPlain = "\x1b[0m";
constexpr std::size_t kWidestId = 30;  // a longer id moves the rest of its own line
constexpr std::size_t kLeastName = 8;  // columns for a figure's name; with fewer it is left out

std::string_view colour_of(const Judgement& judgement) {
  if (!judgement.check_failure.empty()) return kRed;
  const bool good = judgement.verdict == Verdict::kReproduced || judgement.verdict == Verdict::kShape;
  return good ? kGreen : kYellow;
}

std::string cut(const std::string& text, std::size_t width) {
  if (characters(text) <= width) return text;
  return width == 0 ? "" : fmt::format("{:.{}}…", text, width - 1);
}

// Breaks the text into indented lines of at most this width.
std::string wrapped(std::string_view text, std::size_t indent, std::size_t width) {
  std::string out;
  for (const std::string& line : wrap(text, width - indent)) out += std::string(indent, ' ') + line + "\n";
  return out;
}

class Writer {
 public:
  Writer(const JudgedResults& results, const TextLook& look)
      : results_(results), look_(look), width_(static_cast<std::size_t>(look.width)) {}

  std::string write() {
    for (const Judgement& judgement : results_.judgements) {
      const Paper* const paper = judgement.paper;
      if (papers_.empty() || papers_.back() != paper) papers_.push_back(paper);
    }
    write_failing();
    for (const Paper* const paper : papers_) write_paper(*paper);
    write_ids(Verdict::kNotRun);
    write_absences();
    write_summary();
    return std::move(text_);
  }

 private:
  void write_failing() {
    std::vector<Judgement> failing;
    std::ranges::copy_if(results_.judgements, std::back_inserter(failing),
                         [](const Judgement& j) { return !j.check_failure.empty(); });
    const std::size_t all = results_.judgements.size();
    text_ += failing.empty() ? fmt::format("Profile {}: {} rows, {}\n", results_.profile, all,
                                           judged_none() ? "none of them judged: none was measured"
                                                         : "every verdict as expected")
                             : fmt::format("Profile {}: {} of {} rows fail the check\n", results_.profile,
                                           failing.size(), all);
    if (results_.left_out > 0) {
      text_ += wrapped(fmt::format("{} further claims read experiments that were not run; --all asks for "
                                   "them, too",
                                   results_.left_out),
                       2, width_);
    }
    for (const std::string& ignored : results_.ignored) text_ += wrapped(ignored, 2, width_);
    write_lines(failing, true);
  }

  bool judged_none() const {
    return std::ranges::none_of(results_.judgements,
                                [](const Judgement& j) { return was_measured(j.verdict); });
  }

  void write_absences() {
    if (!results_.absences.empty()) {
      text_ += "\nWithout measurements\n" + absences_text(results_.absences, look_.verbose);
    }
  }

  void write_paper(const Paper& paper) {
    std::vector<Judgement> measured;
    std::ranges::copy_if(results_.of(paper), std::back_inserter(measured),
                         [](const Judgement& j) { return was_measured(j.verdict); });
    if (measured.empty()) return;
    text_ += fmt::format("\n{}\n", paper.title);
    write_lines(measured, false);
  }

  // The claims with this verdict, by id alone.
  void write_ids(Verdict verdict) {
    std::string ids;
    for (const Judgement& judgement : results_.judgements) {
      if (judgement.verdict == verdict) ids += (ids.empty() ? "" : " ") + judgement.claim->id;
    }
    if (!ids.empty()) text_ += fmt::format("\n{}\n{}", name(verdict), wrapped(ids, 2, width_));
  }

  // One line per claim, its columns as wide as these claims need.
  void write_lines(const std::vector<Judgement>& judgements, bool with_failures) {
    std::size_t id = 0, verdict = 0, value = 0, expected = 0;
    for (const Judgement& j : judgements) {
      id = std::max(id, std::min(kWidestId, characters(j.claim->id)));
      verdict = std::max(verdict, characters(name(j.verdict)));
      value = std::max(value, characters(j.deciding.value));
      expected = std::max(expected, characters(j.deciding.expected));
    }
    for (const Judgement& j : judgements) {
      const std::string start = fmt::format("  {:<{}}  ", j.claim->id, id);
      const std::size_t used = characters(start) + verdict + 2, left = width_ > used ? width_ - used : 0;
      std::string rest = j.measured;  // the reason, where nothing was measured
      if (!j.deciding.value.empty()) {
        rest = fmt::format("{:<{}}  {:<{}}  ", j.deciding.value, value, j.deciding.expected, expected);
        if (characters(rest) + kLeastName <= left) rest += j.deciding.quantity;
        rest.erase(rest.find_last_not_of(' ') + 1);
      }
      text_ += fmt::format("{}{}{:<{}}{}  {}\n", start, paint(colour_of(j)), name(j.verdict), verdict,
                           paint(kPlain), cut(rest, left));
      if (with_failures) {
        text_ += wrapped(j.check_failure, 4, width_);
        continue;
      }
      if (look_.verbose) {
        text_ += wrapped(j.claim->where + ": " + j.claim->statement, 4, width_) +
                 wrapped("measured: " + j.measured, 4, width_) + wrapped(counts_as(*j.claim), 4, width_);
        write_expected(*j.claim);
      }
      if (look_.verbose || j.claim->of.empty()) write_reason(j);
    }
  }

  static std::string counts_as(const Claim& claim) {
    if (claim.of.empty()) return fmt::format("counts as: {}", name(claim.group));
    return fmt::format("{} of {}: not counted", name(claim.varies), claim.of);
  }

  // The conditions that need not hold, one per line.
  void write_expected(const Claim& claim) {
    for (const Condition& condition : claim.conditions) {
      if (condition.expected == Condition::Expected::kHolds) continue;
      const bool fails = condition.expected == Condition::Expected::kFails;
      text_ += wrapped((fails ? "known to fail: " : "may fail: ") + formula(condition), 4, width_);
    }
  }

  // Why a claim differs, and what matches instead.
  void write_reason(const Judgement& j) {
    if (j.verdict != Verdict::kDiffers || j.claim->matches.empty()) return;
    text_ += wrapped(fmt::format("{} matches: {}", j.claim->reason(), j.claim->matches), 4, width_);
  }

  void write_summary() {
    if (!results_.warnings.empty()) text_ += '\n';
    for (const std::string& warning : results_.warnings) text_ += fmt::format("warning: {}\n", warning);
    text_ += "\nSummary\n";
    for (const Paper* const paper : papers_) {
      text_ += fmt::format("  {}\n", paper->id);
      for (const auto& [group, counts] : count_standings(statements(results_.of(*paper))))
        text_ += wrapped(fmt::format("{}: {}", name(group), counts_text(counts, group)), 4, width_);
    }
    const bool passed = results_.passed();
    const auto sub_rows =
        std::ranges::count_if(results_.judgements, [](const Judgement& j) { return !j.claim->of.empty(); });
    text_ += fmt::format("{}{}{}: {} claims and {} further readings, settings and grounds of them\n",
                         paint(passed ? kGreen : kRed), passed ? "PASS" : "FAIL", paint(kPlain),
                         results_.judgements.size() - sub_rows, sub_rows);
    if (!results_.faults.empty()) {
      text_ += fmt::format("{} faults: the results cannot be trusted, measure again into a new folder\n",
                           results_.faults.size());
    }
  }

  std::string_view paint(std::string_view colour) const { return look_.colour ? colour : ""; }

  const JudgedResults& results_;
  const TextLook& look_;
  std::size_t width_;
  std::vector<const Paper*> papers_;  // with a judgement
  std::string text_;
};

}  // namespace

std::string check_text(const JudgedResults& results, const TextLook& look) {
  return Writer(results, look).write();
}

}  // namespace terrabench
