// The JSON and JUnit forms of the verdicts.
#include "results/claims/check_output.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "results/claims/statements.h"
#include "results/store/format.h"

namespace terrabench {

namespace {

using Json = nlohmann::ordered_json;

// {"stated in the paper": {"hold as printed": 3}, …}: statements, without their sub-rows.
Json counts_json(std::span<const Judgement> judgements) {
  Json json = Json::object();
  for (const auto& [group, counts] : count_standings(statements(judgements))) {
    Json& of_group = json[std::string(name(group))];
    for (const Standing standing : kStandings)
      of_group[std::string(name(standing, group))] = counts[static_cast<std::size_t>(standing)];
  }
  return json;
}

// The claim's conditions that are expected to fail, or that may.
Json formulas(const Claim& claim, Condition::Expected expected) {
  Json list = Json::array();
  for (const Condition& condition : claim.conditions) {
    if (condition.expected == expected) list.push_back(formula(condition));
  }
  return list;
}

}  // namespace

std::string check_json(const JudgedResults& results) {
  Json rows = Json::array();
  for (const Judgement& judgement : results.judgements) {
    const Claim& claim = *judgement.claim;
    rows.push_back({{"id", claim.id},
                    {"paper", judgement.paper->id},
                    {"where", claim.where},
                    {"statement", claim.statement},
                    {"class", std::string(1, claim.claim_class)},
                    {"group", name(claim.group)},
                    {"is", name(claim.varies)},
                    {"of", claim.of},
                    {"reported", claim.reported},
                    {"unit", claim.unit},
                    {"tolerance", claim.tolerance},
                    {"verdict", name(judgement.verdict)},
                    {"expected", name(claim.expected())},
                    {"fails", formulas(claim, Condition::Expected::kFails)},
                    {"may_fail", formulas(claim, Condition::Expected::kEither)},
                    {"measured", judgement.measured},
                    {"decided_by", judgement.deciding.text},
                    {"reason", claim.expected() == Verdict::kDiffers || judgement.verdict == Verdict::kDiffers
                                   ? claim.reason()
                                   : ""},
                    {"matches", claim.matches},
                    {"cause", claim.cause},
                    {"note", claim.note},
                    {"check_failure", judgement.check_failure},
                    {"runs", judgement.runs}});
  }
  Json papers = Json::object();
  for (const Judgement& judgement : results.judgements) {
    Json& counts = papers[judgement.paper->id];
    if (counts.is_null()) counts = counts_json(results.of(*judgement.paper));
  }
  Json absent = Json::array();
  for (const Absence& absence : results.absences) {
    absent.push_back({{"what", absence.what}, {"reason", absence.reason}, {"where", absence.where}});
  }
  const Json json = {{"profile", results.profile},     {"ignored", results.ignored},
                     {"without_measurements", absent}, {"passed", results.passed()},
                     {"left_out", results.left_out},   {"counts", counts_json(results.judgements)},
                     {"counts_by_paper", papers},      {"rows", rows},
                     {"warnings", results.warnings},   {"faults", results.faults}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string check_junit(const JudgedResults& results) {
  std::string cases;
  std::size_t failures = 0, skipped = 0;
  const auto add = [&](std::string_view suite, std::string_view id, std::string_view inside) {
    cases += fmt::format("    <testcase classname=\"{}\" name=\"{}\">{}</testcase>\n", escape_html(suite),
                         escape_html(id), inside);
  };
  for (const Judgement& judgement : results.judgements) {
    std::string inside = fmt::format("<system-out>{}</system-out>", escape_html(judgement.measured));
    if (!judgement.check_failure.empty()) {
      ++failures;
      inside = fmt::format("<failure message=\"{}\">{}</failure>", escape_html(judgement.check_failure),
                           escape_html(judgement.measured));
    } else if (!was_measured(judgement.verdict)) {
      ++skipped;
      inside = fmt::format("<skipped message=\"{}: {}\"/>", name(judgement.verdict),
                           escape_html(judgement.measured));
    }
    add(judgement.paper->id, judgement.claim->id, inside);
  }
  for (const std::string& fault : results.faults) {
    ++failures;
    add("results", "trustworthy", fmt::format("<failure message=\"{}\"/>", escape_html(fault)));
  }
  const std::size_t tests = results.judgements.size() + results.faults.size();
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n"
      "  <testsuite name=\"claims\" tests=\"{}\" failures=\"{}\" skipped=\"{}\">\n{}  "
      "</testsuite>\n</testsuites>\n",
      tests, failures, skipped, cases);
}

}  // namespace terrabench
