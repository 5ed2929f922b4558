// The three forms of a check report.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "results/check.h"
#include "results/format.h"

namespace terrabench {
namespace {

constexpr std::string_view kRed = "\x1b[31m", kGreen = "\x1b[32m", kYellow = "\x1b[33m", kPlain = "\x1b[0m";

std::string_view colour_of(const Row& row) {
  if (!row.complaint.empty()) return kRed;
  if (row.verdict == Verdict::kReproduced || row.verdict == Verdict::kShape) return kGreen;
  return kYellow;
}

bool was_measured(Verdict verdict) { return verdict != Verdict::kPending && verdict != Verdict::kNotRun; }

// "3 reproduced, 2 pending", in the verdicts' order.
std::string tally(const std::vector<Row>& rows) {
  std::map<Verdict, int> counts;
  for (const Row& row : rows) ++counts[row.verdict];
  std::string text;
  for (const auto& [verdict, count] : counts) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name(verdict));
  }
  return text;
}

}  // namespace

std::string check_text(const CheckReport& report, bool colour) {
  std::size_t id_width = 0;
  for (const Row& row : report.rows) id_width = std::max(id_width, row.claim->id.size());
  std::string text = fmt::format("Profile {}\n", report.profile);
  const Paper* paper = nullptr;
  for (const Row& row : report.rows) {
    if (!was_measured(row.verdict) && row.complaint.empty()) continue;
    if (row.paper != paper) text += fmt::format("\n{}\n", row.paper->title);
    paper = row.paper;
    text += fmt::format("  {:<{}}  {}{:<18}{}  {}\n", row.claim->id, id_width, colour ? colour_of(row) : "",
                        name(row.verdict), colour ? kPlain : "", row.measured);
    if (!row.complaint.empty()) text += fmt::format("  {:<{}}  ^ {}\n", "", id_width, row.complaint);
  }
  for (const Verdict verdict : {Verdict::kNotRun, Verdict::kPending}) {
    std::string ids;
    for (const Row& row : report.rows) {
      if (row.verdict == verdict) ids += " " + row.claim->id;
    }
    if (!ids.empty()) text += fmt::format("\n{}:{}\n", name(verdict), ids);
  }
  if (!report.warnings.empty()) text += '\n';
  for (const std::string& warning : report.warnings) text += fmt::format("warning: {}\n", warning);
  const bool passed = report.passed();
  const std::string_view paint = !colour ? "" : passed ? kGreen : kRed;
  text += fmt::format("\n{}{}{}: {}\n", paint, passed ? "PASS" : "FAIL", colour ? kPlain : "",
                      tally(report.rows));
  if (!report.faults.empty()) {
    text += fmt::format("{} lines of the results cannot be trusted: measure again into a new folder\n",
                        report.faults.size());
  }
  return text;
}

std::string check_json(const CheckReport& report) {
  using Json = nlohmann::ordered_json;
  Json rows = Json::array();
  for (const Row& row : report.rows) {
    const Claim& claim = *row.claim;
    rows.push_back({{"id", claim.id},
                    {"paper", row.paper->id},
                    {"where", claim.where},
                    {"statement", claim.statement},
                    {"class", std::string(1, claim.type)},
                    {"reported", claim.reported},
                    {"unit", claim.unit},
                    {"tolerance", claim.tolerance},
                    {"verdict", name(row.verdict)},
                    {"known", claim.pending.empty() ? name(claim.known) : name(Verdict::kPending)},
                    {"measured", row.measured},
                    {"note", claim.note},
                    {"complaint", row.complaint},
                    {"runs", row.runs}});
  }
  const Json json = {{"profile", report.profile},
                     {"passed", report.passed()},
                     {"rows", rows},
                     {"warnings", report.warnings},
                     {"faults", report.faults}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string check_junit(const CheckReport& report) {
  std::string cases;
  std::size_t failures = 0, skipped = 0;
  const auto add = [&](std::string_view suite, std::string_view id, std::string_view inside) {
    cases += fmt::format("    <testcase classname=\"{}\" name=\"{}\">{}</testcase>\n", escape_html(suite),
                         escape_html(id), inside);
  };
  for (const Row& row : report.rows) {
    std::string inside = fmt::format("<system-out>{}</system-out>", escape_html(row.measured));
    if (!row.complaint.empty()) {
      ++failures;
      inside = fmt::format("<failure message=\"{}\">{}</failure>", escape_html(row.complaint),
                           escape_html(row.measured));
    } else if (!was_measured(row.verdict)) {
      ++skipped;
      inside = fmt::format("<skipped message=\"{}: {}\"/>", name(row.verdict), escape_html(row.measured));
    }
    add(row.paper->id, row.claim->id, inside);
  }
  for (const std::string& fault : report.faults) {
    ++failures;
    add("results", "trustworthy", fmt::format("<failure message=\"{}\"/>", escape_html(fault)));
  }
  const std::size_t tests = report.rows.size() + report.faults.size();
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n"
      "  <testsuite name=\"claims\" tests=\"{}\" failures=\"{}\" skipped=\"{}\">\n{}  "
      "</testsuite>\n</testsuites>\n",
      tests, failures, skipped, cases);
}

}  // namespace terrabench
