#include "results/claims/check_output.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/results/fake_results.h"

namespace terrabench {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class CheckOutput : public FolderTest {
 protected:
  // The fake results of the quick profile, one claim of which is not met.
  JudgedResults failing() {
    write_fake_results(folder_, "quick");
    edit(file(), "\"overhang_columns\",\"samples\":[0.0]", "\"overhang_columns\",\"samples\":[5.0]");
    return judge(Store::open(folder_), faked_papers());
  }
  JudgedResults passing() {
    write_fake_results(folder_, "quick");
    return judge(Store::open(folder_), faked_papers());
  }
};

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) all.push_back(line);
  return all;
}

auto columns(const std::string& line) {
  return std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; });
}

TEST_F(CheckOutput, OneLinePerMeasuredClaimFitsTheWidth) {
  const JudgedResults results = passing();
  for (const int width : {80, 100}) {
    const std::string text = check_text(results, {.width = width});
    for (const std::string& line : lines(text)) EXPECT_LE(columns(line), width) << line;
    for (const Judgement& judgement : results.judgements) {
      if (!was_measured(judgement.verdict)) continue;
      EXPECT_EQ(count(text, "\n  " + judgement.claim->id + " "), 1U) << judgement.claim->id;
    }
    // Verdict, figure, what it must be, and its name where there is room.
    EXPECT_THAT(text, ContainsRegex("\n  hybrid.T2.256 +reproduced .shape. +7.78 +.6.5, 9.5. *"));
  }
  EXPECT_THAT(check_text(results, {.width = 100}),
              ContainsRegex("\n  hybrid.T1.128 +reproduced +393,216 B +[=] 393,216 +paper stack bytes\n"));
  EXPECT_THAT(check_text(results, {.width = 80}),
              ContainsRegex("\n  hybrid.T1.128 +reproduced +393,216 B +[=] 393,216\n"));
}

TEST_F(CheckOutput, WhatChangedComesFirstAndTheSummaryLast) {
  const std::string good = check_text(passing(), {});
  EXPECT_THAT(good, StartsWith("Profile quick: "));
  EXPECT_THAT(lines(good).front(), HasSubstr("every verdict as expected"));
  EXPECT_THAT(good, ContainsRegex("\nSummary\n  hybrid\n    stated in the paper: [0-9]+ hold as printed"));
  EXPECT_THAT(lines(good).back(), ContainsRegex("^PASS: [0-9]+ claims and [0-9]+ further readings"));
  std::filesystem::remove(file());
  const std::string bad = check_text(failing(), {});
  EXPECT_THAT(lines(bad).at(0), HasSubstr("1 of "));
  EXPECT_THAT(lines(bad).at(1), StartsWith("  hybrid.caves.y-only  differs  5 "));
  EXPECT_THAT(lines(bad).at(2), HasSubstr("rests on a record that was altered"));
  EXPECT_LT(bad.find("\n    rests on"), bad.find("\n  hybrid.T1.128 "));
  EXPECT_GT(bad.find("\nSummary\n  hybrid "), bad.find("\n  hybrid.T1.128 "));
  EXPECT_THAT(bad, HasSubstr("\nFAIL: "));
}

TEST_F(CheckOutput, VerbosePrintsAllEvidence) {
  const JudgedResults results = passing();
  std::string brief = check_text(results, {}), verbose = check_text(results, {.verbose = true});
  EXPECT_THAT(brief, Not(HasSubstr("measured:")));
  // Every word of the evidence, whatever line it is on.
  const auto words = [](std::string text) {
    std::istringstream in(text);
    std::string all;
    for (std::string word; in >> word;) all += word + " ";
    return all;
  };
  for (const Judgement& judgement : results.judgements) {
    if (was_measured(judgement.verdict)) {
      EXPECT_THAT(words(verbose), HasSubstr("measured: " + words(judgement.measured)));
    }
  }
}

TEST_F(CheckOutput, VerboseAndJsonNameTheConditionsThatNeedNotHold) {
  const JudgedResults results = passing();
  const std::string text = check_text(results, {.width = 300, .verbose = true});
  std::vector<std::string> conditions;
  for (const int n : {128, 256}) {
    conditions.push_back(fmt::format(
        "hybrid.table1/n={0}/paper_layout_heap_bytes / hybrid.table1/n={0}/paper_stack_bytes in [1, 1]", n));
    EXPECT_THAT(text, HasSubstr("\n    known to fail: " + conditions.back() + "\n"));
  }
  EXPECT_EQ(count(text, "known to fail: hybrid.table1/n=128/paper"), 1U)
      << "the claim's other condition must hold";
  EXPECT_THAT(check_text(results, {.width = 300}), Not(HasSubstr("known to fail")));
  const auto json = nlohmann::json::parse(check_json(results));
  const auto row =
      std::ranges::find_if(json["rows"], [](const auto& r) { return r["id"] == "hybrid.T1.layout"; });
  ASSERT_NE(row, json["rows"].end());
  EXPECT_EQ((*row)["fails"], nlohmann::json(conditions));
  EXPECT_EQ((*row)["may_fail"], nlohmann::json::array());
}

TEST_F(CheckOutput, WhatDiffersSaysWhyAndWhichReadingMatches) {
  const std::string text = check_text(passing(), {.width = 200});
  EXPECT_THAT(text, HasSubstr("and are not counted. matches: hybrid.T1.128\n"));
  EXPECT_THAT(text, Not(HasSubstr("With them the layout"))) << "one sentence is enough here";
}

TEST_F(CheckOutput, ColourIsOptional) {
  const JudgedResults results = passing();
  EXPECT_THAT(check_text(results, {}), Not(HasSubstr("\x1b[")));
  EXPECT_THAT(check_text(results, {.colour = true}), HasSubstr("\x1b[32mreproduced"));
}

TEST_F(CheckOutput, JsonAndJunitHoldEveryClaim) {
  const JudgedResults results = failing();
  const auto json = nlohmann::json::parse(check_json(results));
  EXPECT_EQ(json["passed"], false);
  EXPECT_EQ(json["rows"].size(), results.judgements.size());
  EXPECT_EQ(json["rows"][0]["id"], "hybrid.T1.128");
  EXPECT_EQ(json["rows"][0]["reported"][0], 393216);
  int all = 0, sub_rows = 0;
  for (const auto& group : json["counts"]) {
    for (const int count : group) all += count;
  }
  for (const auto& row : json["rows"]) sub_rows += row["of"] == "" ? 0 : 1;
  EXPECT_EQ(all + sub_rows, static_cast<int>(results.judgements.size())) << "every claim is counted once";
  EXPECT_GT(sub_rows, 0);
  for (const auto& row : json["rows"]) {
    if (row["id"] != "hybrid.T1.layout") continue;
    EXPECT_EQ(row["matches"], "hybrid.T1.128");
    EXPECT_THAT(row["reason"].get<std::string>(), StartsWith("The paper's 24 bytes"));
  }
  const std::string junit = check_junit(results);
  EXPECT_EQ(count(junit, "<testcase "), results.judgements.size() + results.faults.size());
  EXPECT_EQ(count(junit, "<failure "), 2U) << "the claim and the altered line";
  EXPECT_THAT(junit, HasSubstr("failures=\"2\""));
  EXPECT_THAT(junit, HasSubstr("&lt;"));
}

}  // namespace
}  // namespace terrabench
