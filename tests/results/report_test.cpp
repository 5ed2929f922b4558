#include "results/report/report.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <regex>

#include "results/claims/ranking.h"
#include "results/store/record_json.h"
#include "terrain/error.h"
#include "terrain/image.h"
#include "tests/results/fake_results.h"
#include "tests/terrain/dead_process.h"
#include "tests/terrain/small_files.h"
#include "tests/terrain/temporary_of.h"

namespace terrabench {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

using ReportTest = FolderTest;

// Every file of a folder with its content.
std::map<std::string, std::string> files_of(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      files[std::filesystem::relative(entry.path(), folder).string()] = read_file(entry.path());
    }
  }
  return files;
}

TEST_F(ReportTest, HoldsTablesPlotsFiguresAndProvenance) {
  write_fake_results(folder_, "quick");
  EXPECT_EQ(write_report(folder_).page, folder_ / "report/index.html");
  const auto files = files_of(folder_ / "report");
  for (const char* file : {"index.html", "report.md", "tables/hybrid.table1.csv",
                           "figures/hybrid.table2-growth.svg", "figures/hybrid.table1-bytes.svg"}) {
    EXPECT_TRUE(files.contains(file)) << file;
  }
  for (const char* text : {"393,216", "2,097,152", "reproduced (shape)", "Figure 13"})
    EXPECT_THAT(files.at("paper-hybrid.html"), HasSubstr(text));
  for (const char* text : {"0123456789abcdef0123456789abcdef01234567", "terrabench run --profile quick",
                           "A processor &lt;of &amp; for&gt; tests"}) {
    EXPECT_THAT(files.at("runs.html"), HasSubstr(text));
  }
  EXPECT_THAT(files.at("paper-hybrid.md"), HasSubstr("393,216"));
  EXPECT_THAT(files.at("tables/inputs.csv"), HasSubstr("00112233445566778899aabbccddeeff"));
  EXPECT_THAT(files.at("tables/hybrid.table1.csv"), HasSubstr("128³,2097152,2097152"));
}

// The targets of all links of a page, and what it shows.
std::vector<std::string> targets_of(const std::string& page, bool is_html) {
  const std::regex link(is_html ? "(?:href|src|data|action)=\"([^\"]*)\"" : "[^\\\\]\\]\\(([^)]*)\\)");
  std::vector<std::string> targets;
  for (std::sregex_iterator at(page.begin(), page.end(), link), end; at != end; ++at)
    targets.push_back((*at)[1]);
  return targets;
}

TEST_F(ReportTest, EveryLinkOfEveryPageLeadsSomewhere) {
  write_fake_results(folder_, "paper");
  write_report(folder_);
  const auto files = files_of(folder_ / "report");
  int pages = 0;
  std::size_t links = 0;
  for (const auto& [name, page] : files) {
    const bool is_html = name.ends_with(".html");
    if (!is_html && !name.ends_with(".md")) continue;
    if (name.starts_with("tables/")) continue;  // a part of a page
    for (const std::string& target : targets_of(page, is_html)) {
      const std::string file = target.substr(0, target.find('#'));
      EXPECT_TRUE(file.empty() || std::filesystem::is_regular_file(folder_ / "report" / file))
          << name << ": " << target;
      ++links;
      if (file.size() == target.size() || (!file.empty() && !files.contains(file))) continue;
      const std::string id = target.substr(file.size() + 1);
      EXPECT_THAT(file.empty() ? page : files.at(file), HasSubstr("id=\"" + id + "\""))
          << name << ": " << target;
    }
    ++pages;
  }
  EXPECT_GE(pages, 8);
  EXPECT_GT(links, 500U);
  EXPECT_THAT(targets_of(files.at("ledger.html"), true), testing::Contains("../figures/hybrid.F3.webp"));
}

TEST_F(ReportTest, WhatDiffersStandsOnAPageOfItsOwn) {
  write_fake_results(folder_, "paper");
  write_report(folder_);
  const std::string page = read_file(folder_ / "report/wrong-or-vague.html"),
                    text = read_file(folder_ / "report/wrong-or-vague.md");
  EXPECT_THAT(read_file(folder_ / "report/index.html"), HasSubstr("href=\"wrong-or-vague.html\""));
  EXPECT_THAT(page, HasSubstr("href=\"ledger.html#hybrid.T2.ten\""));
  for (const std::string* const form : {&page, &text}) {
    // The row, what was measured, the reason, and the row of the reading that matches.
    for (const char* part : {"hybrid.T2.ten", "grows by the factor", "the work grows with n³, by 8.",
                             "hybrid.T2.256, reproduced (shape): ", "Left open"}) {
      EXPECT_THAT(*form, HasSubstr(part));
    }
    EXPECT_THAT(*form, Not(HasSubstr("hybrid.T1.512")));
  }
}

TEST_F(ReportTest, SameMeasurementsSameBytes) {
  write_fake_results(folder_, "quick");
  write_report(folder_);
  const auto first = files_of(folder_ / "report");
  write_file(folder_ / "report/stray.txt", std::string_view("from an older version"));
  write_report(folder_);
  EXPECT_EQ(files_of(folder_ / "report"), first) << "the earlier report is replaced as a whole";
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    EXPECT_THAT(entry.path().string(), Not(HasSubstr(".tmp")));
  }
}

TEST_F(ReportTest, ComesOutOfAPartialRun) {
  Store store(folder_);
  const Provenance run = fake_provenance();
  store.begin_run(run);
  Record record = fake_record(run, "hybrid.table2", "n=64");
  add(record, "generation_time", "s", {0.02});
  store.append(record);
  EXPECT_THAT(read_file(write_report(folder_).page), HasSubstr("missing"));
  EXPECT_THAT(read_file(folder_ / "report/paper-hybrid.html"), HasSubstr("Table 2"));
  EXPECT_THAT(read_file(folder_ / "report/paper-hybrid.html"),
              HasSubstr("<code>terrabench run hybrid.table2 &#39;n=64&#39; --profile"));
}

TEST_F(ReportTest, SaysAtTheTopThatTheMachineWasBusyWhileTimesWereTaken) {
  Store store(folder_);
  for (const auto& [warning, n, metric, unit] :
       {std::tuple{"", "n=128", "generation_time", "s"},
        {"other work used 2 of 2 processors", "n=64", "generation_time", "s"},
        {"other work used 1 of 2 processors", "n=256", "stack_memory", "B"}}) {
    Provenance run = fake_provenance();
    if (*warning != 0) run.timing_warnings = {warning};
    run.id = digest(run);
    store.begin_run(run);
    Record record = fake_record(run, "hybrid.table2", n);
    add(record, metric, unit, {0.02});
    store.append(record);
  }
  write_report(folder_);
  for (const char* const name : {"index.html", "report.md"}) {
    const std::string page = read_file(folder_ / "report" / name);
    const std::size_t at = page.find("The times of 1 of 3 runs are uncertain");
    EXPECT_LT(at, page.find("What holds of each paper")) << name;
  }
  const std::string page = read_file(folder_ / "report/paper-hybrid.html");
  EXPECT_THAT(page, HasSubstr(", times uncertain</a>"));
  EXPECT_THAT(page, testing::ContainsRegex(">run [0-9a-f]+</a>"));
}

TEST_F(ReportTest, ATableNamesTheCommandAndTheRecordsBehindIt) {
  write_fake_results(folder_, "paper");
  write_report(folder_);
  const Store store = Store::open(folder_);
  const std::string page = read_file(folder_ / "report/paper-hybrid.html");
  const std::size_t table = page.find("<table id=\"hybrid.table1\">"), end = page.find("<table", table + 1);
  const std::string part = page.substr(table, end - table);
  EXPECT_THAT(part, HasSubstr("<code>terrabench run hybrid.table1 --profile paper</code>"));
  const std::size_t line = store.line(*store.find("hybrid.table1", "n=128", "paper"));
  EXPECT_THAT(part,
              HasSubstr(fmt::format("<a href=\"../measurements.jsonl\">measurements.jsonl, lines {}", line)));
}

TEST_F(ReportTest, EveryPageLeadsToEveryOther) {
  write_fake_results(folder_, "paper");
  write_report(folder_);
  const auto files = files_of(folder_ / "report");
  std::vector<std::string> names;
  for (const auto& [name, text] : files) {
    if (name.ends_with(".html")) names.push_back(name);
  }
  ASSERT_THAT(names, testing::IsSupersetOf({"paper-hybrid.html", "runs.html", "ledger.html", "index.html"}));
  for (const std::string& from : names) {
    for (const std::string& to : names) {
      const std::string target = from == to ? "#top" : to;
      EXPECT_THAT(files.at(from), HasSubstr(fmt::format("<a href=\"{}\"", target)));
    }
  }
  EXPECT_THAT(files.at("runs.md"),
              AllOf(HasSubstr("(report.md)"), HasSubstr("(paper-hybrid.md)"), HasSubstr("(runs.html)")));
}

TEST_F(ReportTest, AlteredResultsCarryAWarning) {
  write_fake_results(folder_, "quick");
  EXPECT_THAT(write_report(folder_).faults, testing::IsEmpty());
  edit(file(), "\"seed\":1", "\"seed\":2");
  std::filesystem::remove(folder_ / "figures/hybrid.F4.webp");
  const WrittenReport report = write_report(folder_);
  EXPECT_THAT(read_file(report.page), HasSubstr("cannot be trusted"));
  EXPECT_THAT(report.faults,
              testing::ElementsAre(HasSubstr("measurements.jsonl:2: altered"), HasSubstr("hybrid.F4")));
}

// Of every string that a record holds, in every file of the report.
TEST_F(ReportTest, NothingFromOutsideBecomesMarkup) {
  write_fake_results(folder_, "quick");
  Store store(folder_);
  for (const std::string evil :
       {"x\"><script>alert(1)</script>", "x}\\input{/etc/hostname}%", "x](javascript:alert(1))",
        "=cmd|' /C calc'!A0", "](x) <b> | \" ' \\evil{}"}) {
    Record record = fake_record(fake_provenance(), evil, evil);
    record.terrain = evil;
    record.parameters = {{evil, evil}};
    add(record, evil, evil, {1, 2, 3});
    record.figures = {{evil, "figures/xy.webp", evil, ""}};  // and no file is named after its id
    write_picture(folder_ / "figures/xy.webp", Image(9, 9, {1, 2, 3}));
    record.figures[0].checksum = checksum(read_file(folder_ / "figures/xy.webp"));
    store.append(record);
  }
  write_report(folder_);
  for (const auto& [file, text] : files_of(folder_ / "report")) {
    EXPECT_THAT(file, Not(HasSubstr("<script>")));
    if (file.ends_with(".csv")) {
      EXPECT_FALSE(text.starts_with("=")) << file;
      EXPECT_THAT(text, Not(testing::ContainsRegex("[,\n\"]=cmd"))) << file;
    } else if (file.ends_with(".html") || file.ends_with(".md") || file.ends_with(".svg")) {
      EXPECT_THAT(text, Not(HasSubstr("<script>alert"))) << file;
      EXPECT_THAT(text, Not(HasSubstr("<b>"))) << file;
      if (file.ends_with(".md")) {
        EXPECT_THAT(text, Not(HasSubstr("[x](javascript"))) << file;
      }
    }
  }
}

TEST_F(ReportTest, AFigureInAnotherUnitStandsWithIt) {
  write_fake_results(folder_, "quick");
  edit(file(), "\"paper_stack_bytes\",\"samples\":[98304.0],\"unit\":\"B\"",
       "\"paper_stack_bytes\",\"samples\":[98304.0],\"unit\":\"s\"");
  edit(file(), "\"stack_bytes_per_column\",\"samples\":[13.01171875],\"unit\":\"B\"",
       "\"stack_bytes_per_column\",\"samples\":[13.01171875],\"unit\":\"m\"");
  write_report(folder_);
  const std::string table = read_file(folder_ / "report/tables/hybrid.table1.csv");
  EXPECT_THAT(table, HasSubstr("98304 s,"));
  EXPECT_THAT(table, HasSubstr("393216,")) << "the row below has the column's unit";
  EXPECT_THAT(read_file(folder_ / "report/figures/hybrid.table1-bytes.svg"),
              HasSubstr(", 1 in other units left out"));
}

TEST_F(ReportTest, DoesNotReplaceWhatIsNoReport) {
  write_fake_results(folder_, "quick");
  write_file(folder_ / "report/thesis.tex", std::string_view("years of work"));
  EXPECT_THROW(write_report(folder_), Error);
  EXPECT_EQ(read_file(folder_ / "report/thesis.tex"), "years of work");
  // Nor another program's page.
  write_file(folder_ / "report/index.html", std::string_view("<!DOCTYPE html>\n<html lang=\"en\">"));
  EXPECT_THROW(write_report(folder_), Error);
  EXPECT_EQ(read_file(folder_ / "report/thesis.tex"), "years of work");
}

TEST_F(ReportTest, RemovesWhatKilledProcessesLeft) {
  write_fake_results(folder_, "quick");
  const std::filesystem::path mine = folder_ / temporary_of(".report", std::to_string(getppid())),
                              dead = folder_ / temporary_of(".report", std::to_string(dead_process()));
  write_file(dead / "index.html", std::string_view("half"));
  write_file(mine / "index.html", std::string_view("of one that runs"));
  write_report(folder_);
  EXPECT_FALSE(std::filesystem::exists(dead));
  EXPECT_TRUE(std::filesystem::exists(mine));
}

TEST_F(ReportTest, ALinkOutOfTheFolderIsNoPicture) {
  const std::filesystem::path outside = folder_ / "outside", results = folder_ / "results";
  write_fake_results(results, "quick");
  std::filesystem::create_directories(outside);
  std::filesystem::rename(results / "figures/hybrid.F4.webp", outside / "secret.png");
  std::filesystem::create_symlink(outside / "secret.png", results / "figures/hybrid.F4.webp");
  EXPECT_THAT(write_report(results).faults, testing::ElementsAre(HasSubstr("hybrid.F4")));
  const std::string page = read_file(results / "report/paper-hybrid.html");
  EXPECT_THAT(page, Not(HasSubstr("src=\"../figures/hybrid.F4.webp")));
  EXPECT_THAT(page, HasSubstr("src=\"../figures/hybrid.F3.webp"));
  // The whole folder of pictures likewise; a link to the results folder itself is none out of it.
  std::filesystem::rename(results / "figures", outside / "figures");
  std::filesystem::create_directory_symlink(outside / "figures", results / "figures");
  EXPECT_GT(write_report(results).faults.size(), 5U);
  std::filesystem::remove(results / "figures");
  std::filesystem::rename(outside / "figures", results / "figures");
  std::filesystem::create_directory_symlink(results, folder_ / "link");
  EXPECT_EQ(write_report(folder_ / "link").faults.size(), 1U);
  EXPECT_EQ(Store(folder_ / "new/").path_of("figures/x.webp"), folder_ / "new/figures/x.webp");
}

// No half report may appear, and the earlier one stays.
TEST_F(ReportTest, IsWrittenWholeOrNotAtAll) {
  write_fake_results(folder_, "quick");
  write_report(folder_);
  const auto before = files_of(folder_);
  EXPECT_EQ(failure_with_small_files(20'000, [&] { write_report(folder_); }).code, ExitCode::kEnvironment);
  EXPECT_EQ(files_of(folder_), before);
}

TEST(Readme, HasTheCountsOfTheRunThatIsKept) {
  const std::filesystem::path root = TERRABENCH_SOURCE_DIR;
  std::string counts = read_file(root / "results/reference/report/tables/summary.md");
  for (std::size_t at = 0; (at = counts.find("](#", at)) != counts.npos; at += 3) {
    counts.insert(at + 2, "results/reference/report/report.md");
  }
  EXPECT_THAT(read_file(root / "README.md"), HasSubstr("<!-- counts -->\n" + counts))
      << "run scripts/readme-counts";
}

// The committed report, without the pictures that it shows, and with every one of them beside it.
TEST(Reference, ReportIsSmall) {
  const std::filesystem::path report =
      std::filesystem::path(TERRABENCH_SOURCE_DIR) / "results/reference/report";
  std::uintmax_t bytes = 0;
  for (const auto& [file, text] : files_of(report)) bytes += text.size();
  EXPECT_LT(bytes, 15'000'000U);
  std::size_t files = 0;
  for (const auto& [name, text] : files_of(report)) {
    if (!name.ends_with(".html")) continue;
    for (const std::string& target : targets_of(text, true)) {
      const std::string file = target.substr(0, target.find('#'));
      EXPECT_TRUE(std::filesystem::exists(report / file)) << target;
      ++files;
    }
  }
  EXPECT_GE(files, 100U);
}

// The findings above their second heading, with links that start at the tree.
TEST(Readme, HasTheFindingsOfTheRunThatIsKept) {
  const std::filesystem::path root = TERRABENCH_SOURCE_DIR;
  std::string findings = read_file(root / "results/reference/report/findings.md");
  findings.erase(findings.find("\n## ") + 1);
  findings.erase(0, findings.find("\n\n") + 2);
  for (std::size_t at = 0; (at = findings.find("](", at)) != findings.npos; at += 2) {
    findings.insert(at + 2, "results/reference/report/");
  }
  EXPECT_THAT(findings, AllOf(HasSubstr("| Best at |"), HasSubstr("| Fewest triangles at 2 px |")));
  EXPECT_THAT(read_file(root / "README.md"),
              HasSubstr("<!-- findings -->\n" + findings + "<!-- end of findings -->"))
      << "run scripts/readme-counts";
}

}  // namespace
}  // namespace terrabench
