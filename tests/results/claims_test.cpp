#include "results/claims/claims.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <sstream>

#include "results/store/format.h"
#include "tests/terrain/errors.h"

namespace terrabench {
namespace {

using testing::HasSubstr;

constexpr std::string_view kHead = "paper = \"p\"\ntitle = \"t\"\nsource = \"s\"\n";
constexpr std::string_view kClaim =
    "[[claim]]\nid = \"p.1\"\nwhere = \"w\"\nstatement = \"s\"\nclass = \"E\"\n";

void expect_refused(const std::string& text, const std::string& what, int line) {
  const Failure failure = failure_of([&] { parse_claims(text, "claims.toml"); });
  EXPECT_EQ(failure.code, ExitCode::kBadInput) << text;
  EXPECT_THAT(failure.what, HasSubstr(what));
  EXPECT_THAT(failure.what, HasSubstr(line > 0 ? fmt::format("claims.toml:{}:", line) : "claims.toml"));
}

TEST(Claims, EveryClaimOfThePapersIsThere) {
  std::set<std::string> ids;
  for (const Paper& paper : papers()) {
    for (const Claim& claim : paper.claims) EXPECT_TRUE(ids.insert(claim.id).second) << claim.id << " twice";
  }
  std::vector<std::string> expected = wrap(
      "hybrid.T3 hybrid.implicit hybrid.slope hybrid.slope.difference hybrid.bary.sum hybrid.T1.layout "
      "hybrid.T2.ten hybrid.T2.256 hybrid.T2.512 hybrid.bary hybrid.fresnel hybrid.sky hybrid.caves "
      "hybrid.stitch hybrid.less-geometry ght.count.tunnel ght.count.cave ght.continuity ght.links "
      "ght.host ght.refused ght.overhang ght.effective drill.channels.25 drill.channels.100 drill.maxflow "
      "drill.error.rmse drill.error.rmse.best drill.error.ahd drill.tau.ahd drill.tau.ahd-order drill.best "
      "drill.best.levels drill.tau.rmse drill.tau.rmse.levels drill.every-case drill.every-case.mean "
      "drill.tau.time drill.time drill.time.tau drill.time.pixels drill.time.ratio drill.bottleneck "
      "drill.bottleneck.sections drill.local-minima drill.edges drill.untouched drill.hydrography "
      "drill.hydrography.traditional drill.extensions.pits drill.size drill.integers drill.integers.steps "
      "drill.ahd.readings drill.plateau drill.extensions drill.time.growth mrbsp.tris mrbsp.T2.tris.brute "
      "mrbsp.T2.tris.lod mrbsp.T2.tris.vis mrbsp.T2.tris.both mrbsp.T2.time mrbsp.lodtime mrbsp.threshold "
      "mrbsp.holes mrbsp.T1 mrbsp.vis-safe mrbsp.vis-faster mrbsp.quality mrbsp.T2.time.fitted "
      "mrbsp.vis-small mrbsp.grow mrbsp.landscape meshgrow.cc meshgrow.1f meshgrow.limit-at "
      "meshgrow.converge meshgrow.error meshgrow.normals "
      "meshgrow.wellformed meshgrow.fork-u meshgrow.size meshgrow.time meshgrow.lod meshgrow.lazy "
      "cross.representations cross.lod-equal-error cross.lod-ranks cross.lod-jump cross.lod-seams "
      "cross.lod-surface cross.lod-edit cross.scale cross.round-trip cross.round-trip.lossless "
      "cross.round-trip.levels cross.round-trip.polygons cross.round-trip.approximate "
      "cross.round-trip.place ",
      0);
  for (const int n : {128, 256, 512}) {
    for (const char* row : {"hybrid.T1", "hybrid.T1.voxels", "hybrid.T1.ratio"}) {
      expected.push_back(fmt::format("{}.{}", row, n));
    }
  }
  const auto figures = [&](std::string_view paper, std::initializer_list<int> numbers) {
    for (const int number : numbers) expected.push_back(fmt::format("{}.F{}", paper, number));
  };
  for (int i = 1; i <= 25; ++i) figures("hybrid", {i});
  for (int i = 1; i <= 16; ++i) figures("meshgrow", {i});
  figures("ght", {1, 5, 6, 7, 8, 9, 10, 13, 15, 17, 18, 19, 20, 21, 22, 23, 24});
  figures("drill", {1, 2, 3, 4});
  // The other two fits are readings of each claim that depends on the fit.
  for (const char* row : {"error.rmse", "error.ahd", "best", "tau.rmse", "every-case", "tau.ahd", "time.tau",
                          "time.ratio", "bottleneck", "local-minima", "edges", "untouched", "hydrography",
                          "extensions.pits", "size", "integers", "F3", "F4"}) {
    for (const char* fit : {"monotone", "vertex"}) expected.push_back(fmt::format("drill.{}.{}", fit, row));
  }
  figures("mrbsp", {1, 2});
  // A claim with several figures may be split: drill.error into drill.error.rmse and drill.error.ahd.
  for (const std::string& id : expected) {
    EXPECT_TRUE(ids.contains(id) || ids.lower_bound(id + ".") != ids.lower_bound(id + "/")) << id;
  }
  EXPECT_EQ(papers().size(), 6U);
  EXPECT_EQ(papers()[0].id, "hybrid");
}

TEST(Claims, IdsBelongToTheirPaper) {
  for (const Paper& paper : papers()) {
    for (const Claim& claim : paper.claims) EXPECT_TRUE(claim.id.starts_with(paper.id + ".")) << claim.id;
    for (const TableLayout& table : paper.tables) {
      for (const TableLayout::Row& row : table.rows) {
        const auto claim = row.values.find("claim");
        if (claim == row.values.end()) continue;
        const auto& id = std::get<std::string>(claim->second);
        EXPECT_TRUE(std::any_of(paper.claims.begin(), paper.claims.end(), [&](auto& c) {
          return c.id == id;
        })) << id;
      }
    }
  }
}

constexpr const char* kDrillGrounds[] = {".jacksboro", ".noise-ridges", ".noise-hills"};

bool on_further_ground(const Claim& claim) {
  return std::any_of(std::begin(kDrillGrounds), std::end(kDrillGrounds),
                     [&](const char* ground) { return claim.id.ends_with(ground); });
}

TEST(Claims, EveryClaimOfTheDrillPaperIsJudgedOnFourGrounds) {
  const std::span<const Paper> all = papers();
  const auto drill = std::find_if(all.begin(), all.end(), [](const Paper& p) { return p.id == "drill"; });
  ASSERT_NE(drill, all.end());
  std::set<std::string> ids;
  for (const Claim& claim : drill->claims) ids.insert(claim.id);
  for (const Claim& claim : drill->claims) {
    if (on_further_ground(claim) || !claim.not_comparable.empty()) continue;
    // Have grounds of their own.
    if (claim.id == "drill.time.growth" || claim.id == "drill.maxflow") continue;
    for (const char* const ground : kDrillGrounds) EXPECT_TRUE(ids.contains(claim.id + ground)) << claim.id;
  }
}

TEST(Claims, EachStandsForEveryMemberOfASet) {
  const std::string sets =
      "[sets]\npx = [\"1\", \"2\"]\n"
      "on = [{name = \"a\", at = \"here\", as = \"at {on}\"}, {name = \"b\", as = \"{on.at}: {on}\", at = "
      "\"there\"}]\nother = [\"x\", \"y\"]\n";
  const std::string text =
      std::string(kHead) + sets +
      "[[claim]]\neach = [\"on\"]\nid = \"p.{on}\"\nwhere = \"{on.at}, "
      "{on}\"\nstatement = \"{on.as}\"\nclass = \"E\"\n"
      "check = [{equal = [\"e/{on}/{px}px/m\", 0]}, {each = [\"px\"], within = "
      "[\"e/{on}/{px}/m\"], range = [0, 2]}]\n"
      "[[table]]\neach = [\"px\", \"on\"]\nid = \"t{px}{on}\"\ntitle = \"t\"\ncaption = "
      "\"c\"\nexperiment = \"e\"\n"
      "rows_title = \"r\"\nrows = [{label = \"all\", case = \"x\"}, {each = [\"other\"], "
      "label = \"{on.at}\", case = \"{on}/{px}{other}\"}]\n"
      "columns = [{title = \"c\", metric = \"m\"}]\n";
  const Paper paper = parse_claims(text, "x");
  ASSERT_EQ(paper.claims.size(), 2U);
  const Claim& there = paper.claims[1];
  EXPECT_EQ(paper.claims[0].of, "");
  EXPECT_EQ(there.varies, Variation::kSetting) << "the first member of a set is the claim";
  EXPECT_EQ(there.of, "p.a");
  EXPECT_EQ(there.id, "p.b");
  EXPECT_EQ(there.where, "there, b");
  EXPECT_EQ(paper.claims[0].statement, "at a");
  EXPECT_EQ(there.statement, "there: b");
  ASSERT_EQ(there.conditions.size(), 3U);
  ASSERT_EQ(there.conditions[0].operands.size(), 3U);
  EXPECT_EQ(there.conditions[0].operands[1].case_name, "b/2px");
  EXPECT_EQ(there.conditions[2].operands[0].case_name, "b/2");
  std::vector<std::string> tables;
  for (const TableLayout& table : paper.tables) tables.push_back(table.id);
  EXPECT_EQ(tables, (std::vector<std::string>{"t1a", "t1b", "t2a", "t2b"}));
  ASSERT_EQ(paper.tables[1].rows.size(), 3U);
  EXPECT_EQ(paper.tables[1].rows[1].label, "there");
  EXPECT_EQ(paper.tables[1].rows[1].case_name, "b/1x");
}

TEST(Claims, RefusesInvalidSets) {
  const auto refused = [](const std::string& sets, const std::string& where, const std::string& what,
                          int line) {
    expect_refused(std::string(kHead) + "[sets]\n" + sets + "\n" + std::string(kClaim) + where, what, line);
  };
  const std::string good = "px = [\"1\", \"2\"]";
  refused("px = []", "", "empty", 5);
  refused("px = 3", "", "list", 5);
  refused("px = [3]", "", "table", 5);
  refused("px = [{at = \"x\"}]", "", "'name' is missing", 5);
  refused("px = [{name = \"{px.as}\", as = \"a\"}]", "", "a member of 'px' has no 'as'", 5);
  refused("px = [{name = \"a\", as = \"{px.at}\", at = \"{px}\"}]", "",
          "has no 'at', or that field refers to other fields itself", 5);
  refused("py = [\"1\"]\npx = [{name = \"a\", as = \"{py}\"}]", "", "no 'each' names the set 'py' here", 6);
  refused(good, "note = \"{px}\"\n", "no 'each' names the set 'px' here", 11);
  refused(good, "check = [{equal = [\"e/{py}/m\", 1]}]\n", "unknown set 'py'", 11);
  refused(good, "check = [{each = [\"py\"], equal = [\"e/c/m\", 1]}]\n", "unknown set 'py'", 11);
  refused(good, "check = [{each = \"px\", equal = [\"e/c/m\", 1]}]\n", "not a list", 11);
  refused(good, "check = [{equal = [\"e/{px.at}/m\", 1]}]\n", "no 'at'", 11);
  refused(good, "check = [{each = [\"px\", \"px\"], equal = [\"e/c/m\", 1]}]\n", "names the set 'px' twice",
          11);
  std::string many = "n = [";
  for (int i = 0; i < 100; ++i) many += fmt::format("\"{}\", ", i);
  refused(many + "]\nm = [\"{n}\"]", "", "unknown set 'n'", 6);
  refused(many + "]", "check = [{equal = [\"e/{n}/m\", 1]}]\n", "2 to 64", 11);
}

TEST(Claims, ClaimsAreRepeatedOnFurtherGrounds) {
  const std::string claim(kClaim);
  const std::string text =
      std::string(kHead) + claim +
      "note = \"n\"\nmatches = \"None does.\"\nfails = [\"1 < e/b/*\"]\n"
      "check = [{order = [1, \"e/a/m\", \"e/a/x/m\", \"e/ab/m\"]}, {figure = \"p.F\"}]\n"
      "[[claim]]\nid = \"p.2\"\nwhere = \"w\"\nstatement = \"s\"\nclass = \"E\"\nnot_comparable = \"x\"\n"
      "[[ground]]\nname = \"b\"\nof = \"a\"\nlabel = \"hills\"\nprofiles = [\"paper\"]\n"
      "[[ground]]\nname = \"c\"\nof = \"a\"\nlabel = \"flats\"\n";
  const std::vector<Claim> claims = parse_claims(text, "x").claims;
  std::vector<std::string> ids;
  for (const Claim& c : claims) ids.push_back(c.id);
  ASSERT_EQ(ids, (std::vector<std::string>{"p.1", "p.1.b", "p.1.c", "p.2"}));
  const Condition& order = claims[1].conditions[0];
  EXPECT_EQ(order.operands[0].number, 1);
  EXPECT_EQ(order.operands[1].case_name, "b");
  EXPECT_EQ(order.operands[2].case_name, "b/x");
  EXPECT_EQ(order.operands[3].case_name, "ab");  // another ground, whose name starts with the same letters
  EXPECT_EQ(claims[1].conditions[1].figure, "p.F.b");
  EXPECT_EQ(claims[1].where, "w, on hills");
  EXPECT_EQ(claims[1].profiles, std::vector<std::string>{"paper"});
  EXPECT_EQ(claims[0].expected(), Verdict::kReproduced);
  EXPECT_EQ(claims[1].expected(), Verdict::kDiffers);
  EXPECT_EQ(claims[1].note, "n");
  EXPECT_EQ(claims[1].matches, "None does.");
  EXPECT_EQ(claims[0].varies, Variation::kNone);
  EXPECT_EQ(claims[1].varies, Variation::kGround);
  EXPECT_EQ(claims[2].of, "p.1");
  EXPECT_EQ(claims[2].expected(), Verdict::kReproduced);
  EXPECT_EQ(claims[2].profiles.size(), 2U);
  EXPECT_EQ(claims[0].conditions[0].operands[1].case_name, "a");
}

TEST(Claims, AreOfTheGroupThatTheyAreAbout) {
  const auto group = [](const std::string& file_key, const std::string& key) {
    const std::string text =
        std::string(kHead) + file_key + std::string(kClaim) + "not_comparable = \"x\"\n" + key;
    return parse_claims(text, "x").claims.at(0).group;
  };
  EXPECT_EQ(group("", ""), Group::kStated);
  EXPECT_EQ(group("", "about = \"beyond\"\n"), Group::kBeyond);
  EXPECT_EQ(group("about = \"beyond\"\n", ""), Group::kBeyond);
  EXPECT_EQ(group("about = \"beyond\"\n", "about = \"paper\"\n"), Group::kStated);
  const std::string figure = std::string(kHead) +
                             "[[claim]]\nid = \"p.F1\"\nwhere = \"w\"\nstatement = \"s\"\nclass = \"F\"\n"
                             "check = [{figure = \"p.F1\"}]\n";
  EXPECT_EQ(parse_claims(figure, "x").claims.at(0).group, Group::kFigure);
  EXPECT_EQ(parse_claims(figure + "about = \"beyond\"\n", "x").claims.at(0).group, Group::kBeyond);
  for (const Paper& paper : papers()) {
    for (const Claim& claim : paper.claims) {
      EXPECT_EQ(claim.varies == Variation::kNone, claim.of.empty()) << claim.id;
      EXPECT_TRUE(paper.id != "cross" || claim.group == Group::kBeyond) << claim.id << " is ours";
    }
  }
}

// A sub-row is of the group of its claim, wherever that stands in the file.
TEST(Claims, SubRowsSayWhatTheyVary) {
  const auto claim = [](const std::string& id, const std::string& more) {
    return "[[claim]]\nid = \"p." + id + "\"\nwhere = \"w\"\nstatement = \"s\"\nclass = \"T\"\n" +
           "not_comparable = \"x\"\n" + more;
  };
  const Paper paper = parse_claims(
      std::string(kHead) + "[sets]\nn = [\"1\", \"2\"]\n" + claim("reading", "reading_of = \"p.a\"\n") +
          claim("a", "about = \"beyond\"\n") + claim("b{n}", "each = [\"n\"]\neach_is = \"reading\"\n") +
          claim("c{n}", "each = [\"n\"]\neach_is = \"claim\"\n") +
          claim("d{n}", "each = [\"n\"]\nsetting_of = \"p.a\"\n"),
      "x");
  const auto is = [&](std::size_t i, Variation varies, const std::string& of, Group group) {
    EXPECT_EQ(paper.claims.at(i).varies, varies) << i;
    EXPECT_EQ(paper.claims.at(i).of, of) << i;
    EXPECT_EQ(paper.claims.at(i).group, group) << i;
  };
  is(0, Variation::kReading, "p.a", Group::kBeyond);
  is(1, Variation::kNone, "", Group::kBeyond);
  is(2, Variation::kNone, "", Group::kStated);
  is(3, Variation::kReading, "p.b1", Group::kStated);
  is(4, Variation::kNone, "", Group::kStated);
  is(5, Variation::kNone, "", Group::kStated);
  is(6, Variation::kSetting, "p.a", Group::kBeyond);
  is(7, Variation::kSetting, "p.a", Group::kBeyond);
}

TEST(Claims, ACauseIsTheReasonOfAClaimWithoutANote) {
  const std::string cause = "[[cause]]\nid = \"p.S\"\ntitle = \"S has two meanings\"\ntext = \"t\"\n",
                    differs = std::string(kHead) + std::string(kClaim) +
                              "check = [{equal = [\"e/c/m\", 1]}]\nfails = [\"*\"]\n"
                              "matches = \"None does.\"\ncause = \"p.S\"\n";
  const Paper paper = parse_claims(differs + cause, "x");
  ASSERT_EQ(paper.causes.size(), 1U);
  EXPECT_EQ(paper.causes[0].text, "t");
  EXPECT_EQ(paper.claims[0].reason(), "S has two meanings.");
  EXPECT_EQ(parse_claims(differs + "note = \"First. Second.\"\n" + cause, "x").claims[0].reason(), "First.");
  expect_refused(differs, "unknown cause 'p.S'", 0);
  expect_refused(std::string(kHead) + std::string(kClaim) + "not_comparable = \"x\"\n" + cause,
                 "no claim names this cause", 0);
}

TEST(Claims, ReadsEveryKindOfCondition) {
  const std::string text =
      std::string(kHead) + std::string(kClaim) +
      "check = [{equal = [\"e/c/m\", 3]}, {order = [1, \"e/a/b/m\", 9]},\n"
      "{within = [\"e/c/m\"], range = [0.5, 1]}, {ratio = [\"e/c/m\", \"e/c/n\"], range = [1, 2]},\n"
      "{growth = [\"e/c/m\", \"e/d/m\"], range = [-1, 2]}, {figure = \"p.F1\"}]\n";
  const Claim claim = parse_claims(text, "x").claims.at(0);
  using Kind = Condition::Kind;
  const Kind kinds[] = {Kind::kEqual, Kind::kOrder,  Kind::kWithin,
                        Kind::kRatio, Kind::kGrowth, Kind::kFigure};
  ASSERT_EQ(claim.conditions.size(), std::size(kinds));
  for (std::size_t i = 0; i < std::size(kinds); ++i) EXPECT_EQ(claim.conditions[i].kind, kinds[i]);
  const Operand& operand = claim.conditions[1].operands[1];
  EXPECT_EQ(operand.experiment, "e");
  EXPECT_EQ(operand.case_name, "a/b");
  EXPECT_EQ(operand.metric, "m");
  EXPECT_EQ(claim.conditions[0].operands[1].number, 3);
  EXPECT_EQ(claim.conditions[4].low, -1);
  EXPECT_EQ(claim.expected(), Verdict::kReproduced);
  std::vector<std::string> formulas;
  for (const Condition& condition : claim.conditions) formulas.push_back(formula(condition));
  EXPECT_EQ(formulas,
            (std::vector<std::string>{"e/c/m = 3", "1 < e/a/b/m < 9", "e/c/m in [0.5, 1]",
                                      "e/c/m / e/c/n in [1, 2]", "e/d/m / e/c/m in [-1, 2]", "figure p.F1"}));
}

TEST(Claims, RefusesWithFileAndLine) {
  const std::string head(kHead), claim = head + std::string(kClaim);
  expect_refused("paper = ", "", 1);
  expect_refused("\xff\xfe\x00", "", 0);
  expect_refused("title = \"t\"", "'paper' is missing", 0);
  expect_refused(head + "colour = 1\n", "unknown key 'colour'", 4);
  expect_refused(head + "[[claim]]\nid = \"p.1\"\nwehre = \"x\"\n",
                 "'where' is missing; is it meant by 'wehre' in line 6?", 4);
  expect_refused(head + "claim = 3\n", "'claim' is not a list", 0);
  expect_refused(head + "[[claim]]\nid = \"p.1\"\n", "'where' is missing", 4);
  expect_refused(claim, "needs either 'check' or a reason", 4);
  expect_refused(claim + "not_comparable = \"x\"\ncheck = [{figure = \"f\"}]\n", "needs either", 4);
  expect_refused(claim + "check = [{figure = 3}]\n", "'figure' is not text", 9);
  expect_refused(claim + "check = [{exact = [1, 2]}]\n", "a condition is one of", 9);
  expect_refused(claim + "check = [{equal = [1]}]\n", "takes 2 to 64 operands", 9);
  expect_refused(claim + "check = [{equal = [1, \"e/m\"]}]\n", "an operand is a number or", 9);
  expect_refused(claim + "check = [{equal = [1, nan]}]\n", "not a finite number", 9);
  expect_refused(claim + "check = [{within = [\"e/c/m\"]}]\n", "'range' is missing", 9);
  expect_refused(claim + "check = [{within = [\"e/c/m\"], range = [2, 1]}]\n", "the range is empty", 9);
  const std::string check = claim + "check = [{figure = \"f\"}, {equal = [\"e/c/m\", 1]}]\n",
                    why = "note = \"n\"\nmatches = \"None does.\"\n";
  expect_refused(check + "known = \"differs\"\n", "unknown key 'known'", 10);
  expect_refused(check + why + "fails = [\"e/c/n *\"]\n", "no condition matches 'e/c/n *'", 4);
  expect_refused(check + why + "fails = [\"e/c/m\"]\n", "no condition matches 'e/c/m'", 4);
  expect_refused(check + "fails = [\"e/c/m = 1\"]\nmatches = \"None does.\"\n", "needs a 'cause' or a 'note'",
                 4);
  expect_refused(check + "fails = [\"e/c/m = 1\"]\nnote = \"n\"\n", "and 'matches'", 4);
  expect_refused(check + "may_fail = [\"e/c/m = 1\"]\n", "'machine', need each other", 4);
  expect_refused(check + "machine = \"m\"\n", "'machine', need each other", 4);
  expect_refused(check + why + "fails = [\"*\"]\nmay_fail = [\"* = 1\"]\nmachine = \"m\"\n",
                 "'fails' and 'may_fail' both name 'e/c/m = 1'", 4);
  expect_refused(claim + "check = [{figure = \"f\"}]\nmatches = \"p.9\"\n", "neither a claim's id", 0);
  expect_refused(claim + "not_comparable = \"x\"\nsetting_of = \"p.9\"\n",
                 "a setting of the unknown claim 'p.9'", 0);
  expect_refused(claim + "not_comparable = \"x\"\nreading_of = \"p.1\"\n", "which is a sub-row itself", 0);
  expect_refused(claim + "not_comparable = \"x\"\nabout = \"you\"\n", "one of paper, beyond", 4);
  expect_refused(claim + "not_comparable = \"x\"\neach_is = \"row\"\n", "one of claim, reading, setting", 4);
  expect_refused(claim + "check = [{within = [\"e/c/m\"], range = [0, 1]}]\n", "holds every share", 9);
  expect_refused(claim + "not_comparable = \"x\"\n" + std::string(kClaim) + "not_comparable = \"x\"\n",
                 "used twice", 0);
  const std::string table =
      head +
      "[[table]]\nid = \"p.t\"\ntitle = \"t\"\ncaption = \"c\"\nexperiment = \"e\"\nrows_title = \"r\"\n"
      "rows = [{label = \"l\", case = \"c\"}]\ncolumns = [{title = \"c\", verdict = \"v\"}]\npage = \"x\"\n";
  expect_refused(table, "unknown page 'x'", 4);
  EXPECT_EQ(parse_claims(table + "[[page]]\nid = \"x\"\nabout = \"a\"\n", "x").tables[0].page, "x");
  const std::string ground =
      claim + "check = [{figure = \"f\"}]\n[[ground]]\nname = \"b\"\nof = \"a\"\nlabel = \"l\"\n";
  expect_refused(ground + "known = []\n", "unknown key 'known'", 14);
  expect_refused(
      head +
          "[[claim]]\nid = \"../p\"\nwhere = \"\"\nstatement = \"\"\nclass = \"E\"\nnot_comparable = \"x\"\n",
      "invalid id", 0);
}

// What a table or plot cannot say in so many words belongs into the text.
TEST(Claims, CaptionsAreShort) {
  const auto expect_short = [](const std::string& id, const std::string& caption) {
    std::istringstream words(caption);
    EXPECT_LE(std::distance(std::istream_iterator<std::string>(words), {}), 60) << id;
  };
  for (const Paper& paper : papers()) {
    for (const TableLayout& table : paper.tables) expect_short(table.id, table.caption);
    for (const PlotLayout& plot : paper.plots) expect_short(plot.id, plot.caption);
  }
}

}  // namespace
}  // namespace terrabench
