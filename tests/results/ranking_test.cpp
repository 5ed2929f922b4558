#include "results/claims/ranking.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "results/report/findings_table.h"
#include "results/report/report.h"
#include "results/store/record_json.h"
#include "terrain/error.h"
#include "tests/results/fake_results.h"
#include "tests/terrain/errors.h"

namespace terrabench {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr std::string_view kLayout = R"(
[sets]
ground = [{name = "hill", where = "on a hill"}, {name = "sea", where = "at sea"}]
type = [{name = "a", label = "drills"}, {name = "b", label = "voxels"}, {name = "c", label = "stacks"}]

[[ranking]]
each = ["ground"]
id = "time-{ground}"
task = "Fastest"
table = "Speed"
question = "Shortest time"
ground = "{ground}"
headline = true
where = "{ground.where}"
experiment = "x"
metric = "time"
unit = "ms"
best = "least"
needs = {metric = "lost", range = [0, 0.2], text = "of those that lose little"}
entries = [{each = ["type"], label = "{type.label}", case = "{ground}/{type}"}]

[[ranking]]
id = "rate-hill"
task = "Most queries"
where = "on a hill"
experiment = "x"
metric = "bytes"
unit = "kB"
best = "most"
entries = [{each = ["type"], label = "{type.label}", case = "hill/{type}"}]
)";

class RankingTest : public FolderTest {
 protected:
  RankingTest() : store_(folder_) { store_.begin_run(run_); }

  // Three samples stand for six: each was measured twice.
  static std::vector<double> six(std::vector<double> three) {
    three.resize(6);
    std::copy_n(three.begin(), 3, three.begin() + 3);
    return three;
  }
  void measure(const std::string& name, std::vector<double> seconds, double bytes = 1000, double lost = -1) {
    Record record = fake_record(run_, "x", name);
    if (seconds.size() == 3) seconds = six(std::move(seconds));
    add(record, "time", "s", std::move(seconds));
    add(record, "bytes", "B", {bytes});
    if (lost >= 0) add(record, "lost", "", {lost});
    store_.append(record);
  }
  // The sentence of the n-th task.
  std::string sentence(std::size_t n = 0) const {
    const Facts facts = findings(rank(layouts_, store_, "quick"));
    return n < facts.lines.size() ? facts.lines[n].first + ": " + facts.lines[n].second : "";
  }

  Provenance run_ = fake_provenance();
  Store store_;
  std::vector<RankingLayout> layouts_ = paper_of(kLayout).rankings;
};

TEST_F(RankingTest, SaysWhoWinsByHowMuchAndChangesWithTheFigures) {
  measure("hill/a", {0.010, 0.010, 0.011});
  measure("hill/b", {0.030, 0.030, 0.033});
  measure("hill/c", {0.050, 0.050, 0.055});
  EXPECT_EQ(sentence(),
            "Fastest: Of those that lose little, on a hill: drills (10 ms), ahead of voxels (30 ms) by a "
            "factor of 3 "
            "[2.73, 3.3].");
  measure("hill/c", {0.005, 0.005, 0.0055});
  EXPECT_EQ(sentence(),
            "Fastest: Of those that lose little, on a hill: stacks (5 ms), ahead of drills (10 ms) by a "
            "factor of 2 "
            "[1.82, 2.2].");
}

// An unknown key would be a misspelt one, ignored.
TEST_F(RankingTest, UnknownKeysOfEntriesAreRefused) {
  const auto with_entry = [](const std::string& entry) {
    return paper_of(fmt::format(R"(
[[ranking]]
id = "r"
task = "Fastest"
where = "on a hill"
experiment = "x"
metric = "<of>_time"
best = "least"
entries = [{}]
)",
                                entry))
        .rankings;
  };
  EXPECT_NO_THROW(with_entry(R"({label = "A", case = "a", of = "x"})"));
  for (const char* const entry :
       {R"({label = "A", case = "a", off = "x"})", R"({label = "A", case = "a", of = "x", metrik = "y"})",
        R"({label = "A", case = "a", of = "x", needs = 3})"}) {
    const Failure failure = failure_of([&] { with_entry(entry); });
    EXPECT_EQ(failure.code, ExitCode::kBadInput) << entry;
    EXPECT_THAT(failure.what, HasSubstr("claims.toml:12"));
  }
  EXPECT_THAT(failure_of([&] { with_entry(R"({label = "A", case = "a", off = "x"})"); }).what,
              HasSubstr("'off'"));
}

// Whatever the order of the entries, all are in the layout's unit, or none is compared.
TEST_F(RankingTest, UnitsOfEntriesAreConvertedOrRefused) {
  const auto one = [&](const std::string& name, const std::string& unit, std::vector<double> samples) {
    Record record = fake_record(run_, "x", "hill/" + name);
    add(record, "time", unit, six(std::move(samples)));
    store_.append(record);
  };
  one("a", "s", {0.010, 0.010, 0.011});
  one("b", "ms", {5, 5, 5.5});
  one("c", "µs", {20000, 20000, 22000});
  EXPECT_EQ(sentence(),
            "Fastest: Of those that lose little, on a hill: voxels (5 ms), ahead of drills (10 ms) by a "
            "factor of 2 [1.82, 2.2].");
  for (const char* const other : {"a", "b", "c"}) {
    const Record before = *store_.find("x", std::string("hill/") + other, "quick");
    one(other, "B", {1, 1, 1});
    EXPECT_THAT(sentence(), AllOf(HasSubstr("not compared, as"),
                                  HasSubstr("is measured in B, which cannot be converted to ms")))
        << other;
    const std::optional<Ranking> ranking = rank(layouts_.at(0), store_, "quick");
    ASSERT_TRUE(ranking);
    EXPECT_FALSE(ranking->decided());
    EXPECT_EQ(ranking->left_out.size(), 1U);
    store_.append(before);
  }
}

// Of cases that hold the figures of several methods.
TEST_F(RankingTest, EntriesMayNameTheirMetrics) {
  const std::vector<RankingLayout> layouts = paper_of(R"(
[[ranking]]
id = "frame"
task = "Cheapest"
where = "on a hill"
experiment = "x"
metric = "<of>_frame"
unit = "ms"
best = "least"
needs = {metric = "<of>_reached", range = [1, 1], text = "of those that come close"}
entries = [
  {label = "A", case = "all", of = "a"}, {label = "B", case = "all", of = "b"},
  {label = "C", case = "all", of = "c"}, {label = "D", case = "all", of = "d"},
]
)")
                                                 .rankings;
  Record record = fake_record(run_, "x", "all");
  for (const auto& [name, time, reached] : {std::tuple{"a", 0.03, 1}, {"b", 0.01, 1}, {"c", 0.001, 0}}) {
    add(record, std::string(name) + "_frame", "s", std::vector<double>(6, time));
    add(record, std::string(name) + "_reached", "", {1.0 * reached});
  }
  store_.append(record);
  const std::optional<Ranking> ranking = rank(layouts.at(0), store_, "quick");
  ASSERT_TRUE(ranking);
  ASSERT_EQ(ranking->places.size(), 2U) << "D was not measured";
  EXPECT_EQ(ranking->places[0].label, "B");
  EXPECT_EQ(ranking->places[1].label, "A");
  EXPECT_EQ(ranking->left_out, (std::vector<std::string>{"D", "C"}));
}

// A lead that two searches would not agree on is a tie; a method that was measured and has no value is named.
TEST_F(RankingTest, ALeadOfASearchNeedsAWiderMargin) {
  const auto ranked = [&](const char* more) {
    return rank(paper_of(fmt::format(R"(
[[ranking]]
id = "files"
task = "Smallest"
where = "on a hill"
experiment = "x"
metric = "bytes"
unit = "B"
best = "least"
{}
entries = [{{label = "A", case = "a"}}, {{label = "B", case = "b"}}, {{label = "C", case = "c"}}]
)",
                                     more))
                    .rankings.at(0),
                store_, "quick");
  };
  for (const auto& [name, bytes] : {std::pair{"a", 100.0}, {"b", 105.0}, {"c", 0.0}}) {
    Record record = fake_record(run_, "x", name);
    if (bytes > 0) add(record, "bytes", "B", {bytes});
    store_.append(record);
  }
  EXPECT_EQ(ranked("")->lead(), "1.05 ×");
  EXPECT_EQ(ranked("searched = true")->lead(), "tied");
  EXPECT_EQ(ranked("searched = true")->left_out, std::vector<std::string>{"C"});
}

// Neither led nor tied: the interval holds the margin.
TEST_F(RankingTest, WhatTheIntervalDoesNotTellIsUndecided) {
  measure("hill/a", {0.010, 0.010, 0.010});
  measure("hill/b", {0.009, 0.013, 0.014});
  measure("hill/c", {0.030, 0.030, 0.030});
  EXPECT_EQ(
      sentence(),
      "Fastest: Of those that lose little, on a hill: undecided between drills (10 ms) and voxels (13 ms), "
      "a factor of 1.3 [0.9, 1.4].");
  EXPECT_FALSE(rank(layouts_.at(0), store_, "quick")->decided());
}

// The printed figures decide: what rounds to the margin lies at it.
TEST_F(RankingTest, FactorsAreRoundedBeforeTheyDecide) {
  measure("hill/a", {0.010, 0.010, 0.010});
  measure("hill/b", {0.01246, 0.01246, 0.01246});
  EXPECT_THAT(sentence(), HasSubstr("drills (10 ms), ahead of voxels (12.5 ms) by a factor of 1.25"));
  measure("hill/b", {0.01244, 0.01244, 0.01244});
  EXPECT_THAT(sentence(), HasSubstr("are tied, within a factor of 1.24"));
}

TEST(Ranking, TheRuleOfTiesGivesBothMarginsWithTheirReasons) {
  EXPECT_THAT(tie_rule(), HasSubstr("The margin is 1.25 for times and rates, since two thirds of them"));
  EXPECT_THAT(tie_rule(), HasSubstr("and 1.01 for all else, since a smaller lead is no reason"));
}

TEST_F(RankingTest, AShortLeadOfExactFiguresIsATie) {
  measure("hill/a", {0.010, 0.010, 0.010}, 1000);
  measure("hill/b", {0.010, 0.010, 0.010}, 1004);
  EXPECT_EQ(sentence(1), "Most queries: On a hill: voxels (1.004 kB) and drills (1 kB) are tied.");
  measure("hill/b", {0.010, 0.010, 0.010}, 1010);
  EXPECT_THAT(sentence(1), HasSubstr("voxels (1.01 kB), ahead of drills (1 kB) by a factor of 1.01"));
}

TEST_F(RankingTest, WithinTheMarginItIsATie) {
  measure("hill/a", {0.0120, 0.0125, 0.0130});
  measure("hill/b", {0.0125, 0.0130, 0.0135});
  measure("hill/c", {0.050, 0.050, 0.050});
  EXPECT_THAT(sentence(),
              HasSubstr("on a hill: drills (12.5 ms) and voxels (13 ms) are tied, within a factor of "
                        "1.04 ["));
  measure("hill/a", {0.0130, 0.0130, 0.0130});  // runs of one machine differ by more
  measure("hill/b", {0.0155, 0.0155, 0.0155});
  EXPECT_THAT(sentence(), HasSubstr("on a hill: drills (13 ms) and voxels (15.5 ms) are tied, within a "
                                    "factor of 1.19"));
  measure("hill/b", {0.0165, 0.0165, 0.0165});
  EXPECT_THAT(sentence(), HasSubstr("on a hill: drills (13 ms), ahead of voxels (16.5 ms) by"));
  // Exact figures have a margin of their own.
  EXPECT_EQ(sentence(1), "Most queries: On a hill: drills (1 kB), voxels (1 kB) and stacks (1 kB) are tied.");
  measure("hill/c", {1}, 1020);
  EXPECT_THAT(sentence(1), HasSubstr("stacks (1.02 kB), ahead of drills (1 kB) by a factor of 1."));
}

TEST_F(RankingTest, WhatLacksTheNeedIsLeftOut) {
  measure("hill/a", {0.001}, 1, 0.9);
  measure("hill/b", {0.030}, 1, 0.1);
  measure("hill/c", {0.060}, 1, 0);
  measure("sea/a", {0.001});  // nobody has the metric: all take part
  measure("sea/b", {0.002});
  EXPECT_EQ(sentence(),
            "Fastest: Of those that lose little, on a hill: undecided, as they were measured fewer than 6 "
            "times: voxels (30 ms) and stacks (60 ms), a factor of 2 (left out: drills); at sea: undecided, "
            "as they were measured "
            "fewer than 6 times: drills (1 ms) and voxels (2 ms), a factor of 2.");
  const auto json = nlohmann::json::parse(findings_json(rank(layouts_, store_, "quick")));
  EXPECT_EQ(json[0]["left_out"], nlohmann::json({"drills"}));
  EXPECT_EQ(json[0]["places"][0]["label"], "voxels");
  EXPECT_EQ(json[0]["places"][1]["factor"], 2.0);
  measure("hill/b", {0.030}, 1, 0.5);
  EXPECT_THAT(sentence(), HasSubstr("on a hill: stacks (60 ms) alone (left out: drills and voxels); "));
  measure("hill/c", {0.030}, 1, 0.5);
  EXPECT_THAT(sentence(), HasSubstr("on a hill: none (left out: drills, voxels and stacks); "));
}

TEST_F(RankingTest, TimesOfDifferentMachinesAreNotCompared) {
  measure("hill/a", {0.010});
  run_.cpu = "another";
  run_.id = digest(run_);
  store_.begin_run(run_);
  measure("hill/b", {0.030}, 2000);
  EXPECT_THAT(sentence(), HasSubstr("on a hill: not compared"));
  EXPECT_THAT(sentence(1), HasSubstr("voxels (2 kB), ahead of drills (1 kB) by a factor of 2."));
}

TEST_F(RankingTest, CountsOfDifferentRevisionsAreNotCompared) {
  measure("hill/a", {0.010});
  run_.git_revision = std::string(40, 'f');
  run_.id = digest(run_);
  store_.begin_run(run_);
  measure("hill/b", {0.030}, 2000);
  EXPECT_THAT(sentence(1), HasSubstr("On a hill: not compared, as the figures are of different revisions"));
}

TEST_F(RankingTest, OneMethodAloneIsNoFinding) {
  measure("hill/a", {0.010});
  EXPECT_EQ(sentence(), "");
  EXPECT_THROW(paper_of("[[ranking]]\nid = \"x\"\n"), Error);
}

TEST_F(RankingTest, NothingIsAMultipleOfZero) {
  measure("hill/a", {0, 0, 0});
  measure("hill/b", {0.013, 0.013, 0.013});
  EXPECT_THAT(sentence(), HasSubstr("not compared, as drills has 0"));
  EXPECT_FALSE(rank(layouts_.at(0), store_, "quick")->decided());
}

// A row per question, a column per ground, who is best in each cell, and on how many grounds.
TEST_F(RankingTest, ATableOfFindingsHasARowPerQuestionAndAColumnPerGround) {
  const auto tables = [&] { return findings_tables(rank(layouts_, store_, "quick")); };
  const auto row = [&] {
    std::vector<std::string> texts;
    const std::vector<Cell> cells = tables().at(0).rows.at(0);
    for (const Cell& cell : cells) texts.push_back(cell.text);
    return texts;
  };
  measure("hill/a", {0.010, 0.010, 0.010});
  measure("hill/b", {0.030, 0.030, 0.030});
  measure("sea/a", {0.010, 0.010, 0.010});
  measure("sea/b", {0.040, 0.040, 0.040});
  ASSERT_EQ(tables().size(), 1U) << "queries have no place in a table";
  EXPECT_EQ(tables()[0].title, "Speed");
  EXPECT_THAT(row(), ElementsAre("Shortest time", "drills 3 ×", "drills 4 ×", "drills on 2 of 2 grounds"));
  EXPECT_EQ(tables()[0].rows[0][2].link, "ground-sea.*");
  measure("sea/b", {0.005, 0.005, 0.005});
  EXPECT_THAT(row(), ElementsAre("Shortest time", "drills 3 ×", "voxels 2 ×",
                                 "drills on 1 of 2 grounds, voxels on 1"));
  EXPECT_EQ(tables()[0].id, "findings-speed");
  const Facts lines = headlines(rank(layouts_, store_, "quick"));
  ASSERT_EQ(lines.lines.size(), 1U);
  EXPECT_EQ(lines.lines[0].first, "Shortest time");
  EXPECT_EQ(lines.lines[0].second, "drills on 1 of 2 grounds, voxels on 1.");
  measure("sea/b", {0.010, 0.010, 0.010});
  EXPECT_EQ(row()[2], "drills ≈ voxels");
  EXPECT_EQ(row()[3], "drills on 2 of 2 grounds (tied on 1)");
  EXPECT_EQ(tables()[0].rows[0][2].style, "tied");
  measure("sea/b", {0.010});
  EXPECT_EQ(row()[2], "not decided") << "too few samples";
  EXPECT_EQ(row()[3], "drills on 1 of 2 grounds; not decided on 1");
  measure("sea/b", {0.010, 0.010, 0.010}, 1000, 0.1);
  EXPECT_EQ(row()[2], "voxels (alone)") << "of those that lose little there is one at sea";
  EXPECT_EQ(plain_text(tables()[0]),
            "Best at        hill        sea             In all\n"
            "Shortest time  drills 3 ×  voxels (alone)  drills on 1 of 2 grounds, voxels on 1\n");
}

TEST_F(RankingTest, AnUndecidedCellNamesWhichMayBeTheBest) {
  measure("hill/a", {0.010, 0.006, 0.014});
  measure("hill/b", {0.013, 0.007, 0.020});
  const std::vector<Ranking> here = rank(layouts_, store_, "quick");
  const std::vector<Cell> cells = findings_tables(here).at(0).rows.at(0);
  EXPECT_EQ(cells.at(1).text, "drills or voxels");
  EXPECT_EQ(cells.at(1).style, "undecided");
  EXPECT_EQ(cells.at(2).text, "no clear winner; drills or voxels may be the best on 1 of 1 grounds");
}

TEST_F(RankingTest, AFindingThatTheReferenceDoesNotShareIsMarked) {
  measure("hill/a", {0.010, 0.010, 0.010});
  measure("hill/b", {0.030, 0.030, 0.030});
  const std::vector<Ranking> here = rank(layouts_, store_, "quick");
  const auto cell = [&](std::vector<std::string> best) {
    const std::vector<Answer> reference{{here.at(0).layout, std::move(best)}};
    return findings_tables(here, reference).at(0).rows.at(0).at(1).text;
  };
  EXPECT_EQ(cell({"voxels"}), "drills 3 × †");
  EXPECT_EQ(cell({"voxels", "drills"}), "drills 3 ×");
  EXPECT_EQ(cell({}), "drills 3 ×") << "not decided there";
}

TEST(RankingLayouts, OfTheClaimsFilesAreWellFormed) {
  std::set<std::string> ids, cells;
  for (const RankingLayout& layout : ranking_layouts()) {
    EXPECT_TRUE(ids.insert(layout.id).second) << layout.id;
    EXPECT_GE(layout.entries.size(), 2U) << layout.id;
    if (layout.ground.empty()) continue;
    EXPECT_TRUE(cells.insert(layout.table + "/" + layout.question + "/" + layout.ground).second) << layout.id;
  }
  EXPECT_EQ(ids.size(), 112U);
}

TEST_F(RankingTest, StandOnTheReportsFirstPage) {
  const RankingLayout& layout = ranking_layouts()[0];
  for (std::size_t i = 0; i < 2; ++i) {
    Record record = fake_record(run_, layout.experiment, layout.entries[i].case_name);
    add(record, layout.metric, "B", {1000.0 * static_cast<double>(i + 1)});
    store_.append(record);
  }
  const std::string page = read_file(write_report(folder_).page);
  EXPECT_THAT(page, HasSubstr(">" + layout.entries[0].label + " 2\u00a0×</a>"));
  const std::string all = read_file(folder_ / "report/findings.md");
  EXPECT_THAT(all, HasSubstr("- **" + layout.task + "**: "));
  EXPECT_THAT(all, HasSubstr(layout.entries[0].label + " (1 kB), ahead of"));
  EXPECT_THAT(all, HasSubstr(tie_rule()));
  EXPECT_TRUE(nlohmann::json::accept(read_file(folder_ / "report/findings.json")));
}

}  // namespace
}  // namespace terrabench
