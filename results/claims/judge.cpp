#include "results/claims/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string_view>

#include "results/store/glob.h"
#include "terrain/error.h"

namespace terrabench {
namespace {

using Outcome = ConditionResult::Outcome;

// The results' texts, separated by semicolons.
std::string joined(const std::vector<ConditionResult>& results) {
  std::string text;
  for (const ConditionResult& result : results) {
    if (!text.empty()) text += "; ";
    text += result.text;
  }
  return text;
}

// What is not as expected; empty if all is.
std::string unexpected(const Claim& claim, Verdict verdict, const std::vector<ConditionResult>& results) {
  if (verdict == Verdict::kMissing)
    return fmt::format("expected verdict '{}', computed '{}'", name(claim.expected()), name(verdict));
  std::string text;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Condition::Expected expected = claim.conditions[i].expected;
    const bool fails = results[i].outcome == Outcome::kFails;
    if (expected == Condition::Expected::kEither || fails == (expected == Condition::Expected::kFails))
      continue;
    if (!text.empty()) text += "; ";
    text += (fails ? "fails and must hold: " : "holds and was known to fail: ") + results[i].text;
  }
  return text;
}

// The index of Judgement::deciding. `exact`: whether the claim is of class E.
std::size_t find_deciding(const std::vector<ConditionResult>& results, bool exact) {
  for (const Outcome outcome : {Outcome::kMissing, Outcome::kFails}) {
    const auto at = std::ranges::find(results, outcome, &ConditionResult::outcome);
    if (at != results.end()) return at - results.begin();
  }
  if (exact && !results[0].margin) return 0;
  const auto margin = [](const ConditionResult& f) {
    return f.margin.value_or(std::numeric_limits<double>::infinity());
  };
  return std::ranges::min_element(results, {}, margin) - results.begin();
}

void judge_measured(Judgement& judgement, const Store& store, const std::string& profile) {
  const Claim& claim = *judgement.claim;
  Evidence evidence = gather_evidence(claim, store, profile);
  std::vector<ConditionResult>& results = evidence.results;
  const auto first = [&](Outcome outcome) {
    return std::ranges::find(results, outcome, &ConditionResult::outcome);
  };
  judgement.runs = evidence.runs;
  judgement.deciding_condition = find_deciding(results, claim.claim_class == 'E');
  judgement.deciding = results[judgement.deciding_condition];
  judgement.stated = results.front().text;
  if (first(Outcome::kMissing) != results.end()) {
    // Report only what is missing.
    std::erase_if(results, [](const ConditionResult& result) { return result.outcome != Outcome::kMissing; });
    judgement.verdict = Verdict::kMissing;
  } else if (first(Outcome::kFails) != results.end()) {
    judgement.verdict = Verdict::kDiffers;
  } else {
    judgement.verdict = claim.claim_class == 'S' ? Verdict::kShape : Verdict::kReproduced;
  }
  judgement.measured = joined(results);
  if (evidence.altered) {
    judgement.check_failure = "rests on a record that was altered";
  } else if (evidence.incomparable) {
    judgement.check_failure = "compares what was measured on different machines or builds";
  } else {
    judgement.check_failure = unexpected(claim, judgement.verdict, results);
  }
}

Judgement judge_claim(const Paper& paper, const Claim& claim, const Store& store,
                      const std::string& profile) {
  Judgement judgement;
  judgement.paper = &paper;
  judgement.claim = &claim;
  if (!claim.not_comparable.empty()) {
    judgement.verdict = Verdict::kNotComparable;
    judgement.measured = claim.not_comparable;
  } else if (!claim.measured_in(profile)) {
    judgement.verdict = Verdict::kNotRun;
    judgement.measured = fmt::format("measured in profile {}", fmt::join(claim.profiles, ", "));
  } else {
    judge_measured(judgement, store, profile);
  }
  return judgement;
}

std::set<std::string_view> experiments_run(const Store& store) {
  std::set<std::string_view> run;
  for (const Record& record : store.records()) {
    if (record.profile == store.profile()) run.insert(record.experiment);
  }
  return run;
}

// Whether each experiment that the claim reads was run; of a claim that reads none, any of its paper. Which
// one draws a picture is known only from the numbers that the claim asks of it: a picture that was not drawn
// counts as not run where there are none.
bool can_be_judged(const Paper& paper, const Claim& claim, const Store& store,
                   const std::set<std::string_view>& run) {
  if (claim.conditions.empty()) {
    const std::string beginning = paper.id + ".";
    return std::ranges::any_of(run, [&](std::string_view id) { return id.starts_with(beginning); });
  }
  const auto ran = [&](const Operand& operand) {
    return operand.is_number() || run.contains(operand.experiment);
  };
  return std::ranges::all_of(claim.conditions, [&](const Condition& condition) {
    const bool drawn = condition.kind != Condition::Kind::kFigure ||
                       store.find_figure(condition.figure, store.profile()).second != nullptr;
    const bool asked = !condition.operands.empty() || !condition.brightness.empty();
    return (drawn || asked) && std::ranges::all_of(condition.operands, ran) &&
           std::ranges::all_of(condition.brightness, ran);
  });
}

void look_for_altered_pictures(const Store& store, JudgedResults& results) {
  for (const Record& record : store.records()) {
    if (record.profile != results.profile) continue;
    for (const RecordedFigure& figure : record.figures) {
      if (store.intact(figure)) continue;
      results.faults.push_back(fmt::format("{}: picture altered or gone: not the one that {} {} drew",
                                           (store.folder() / figure.file).string(), record.experiment,
                                           record.case_name));
      results.warnings.push_back(results.faults.back());
    }
  }
}

// What the profile lacks, and what the other profiles hold.
void read_profile(const Store& store, JudgedResults& results) {
  std::vector<const Record*> records;
  std::map<std::string, int> others;
  for (const Record& record : store.records()) {
    if (record.profile == results.profile) {
      records.push_back(&record);
    } else {
      ++others[record.profile];
    }
  }
  results.absences = absences(records);
  for (const auto& [profile, count] : others) {
    results.ignored.push_back(fmt::format(
        "{} cases of profile {} are not read; --profile {} reads them instead", count, profile, profile));
  }
}

}  // namespace

bool JudgedResults::passed() const {
  return faults.empty() && std::ranges::count(absences, "failed", &Absence::what) == 0 &&
         std::ranges::any_of(judgements, [](const Judgement& j) { return j.verdict <= Verdict::kDiffers; }) &&
         std::ranges::all_of(judgements, [](const Judgement& j) { return j.check_failure.empty(); });
}

std::span<const Judgement> JudgedResults::of(const Paper& paper) const {
  const auto first = std::ranges::find(judgements, &paper, &Judgement::paper);
  return {first,
          std::find_if(first, judgements.end(), [&](const Judgement& j) { return j.paper != &paper; })};
}

JudgedResults judge(const std::filesystem::path& folder, std::span<const std::string> globs,
                    const std::string& profile, Demand demand) {
  return judge(Store::open(folder, profile), papers(), globs, demand);
}

JudgedResults judge(const Store& store, std::span<const Paper> papers, std::span<const std::string> globs,
                    Demand demand) {
  std::vector<std::string_view> ids;
  for (const Paper& paper : papers) {
    for (const Claim& claim : paper.claims) ids.push_back(claim.id);
  }
  demand_matches(globs, ids, "claim", "terrabench list claims");
  JudgedResults results{store.profile(), {}, store.warnings(), store.faults()};
  read_profile(store, results);
  look_for_altered_pictures(store, results);
  const std::set<std::string_view> run = experiments_run(store);
  for (const Paper& paper : papers) {
    for (const Claim& claim : paper.claims) {
      if (!matches_any(globs, claim.id)) continue;
      const bool left_to_choose = demand == Demand::kRun || claim.of_profile_scale();
      if (left_to_choose && !can_be_judged(paper, claim, store, run)) {
        ++results.left_out;
      } else {
        results.judgements.push_back(judge_claim(paper, claim, store, results.profile));
      }
    }
  }
  return results;
}

}  // namespace terrabench
