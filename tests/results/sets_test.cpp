// Sets that a claims file derives from others, and from the registries.
#include "results/claims/sets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lod/lod.h"
#include "representations/representation.h"
#include "results/claims/claims.h"
#include "tests/terrain/errors.h"

namespace terrabench {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

// Rows of a table with one row per member of the set `chosen`.
std::vector<TableLayout::Row> rows(const std::string& sets) {
  return parse_claims("paper = \"p\"\ntitle = \"t\"\nsource = \"s\"\n[sets]\n" + sets +
                          "\n[[table]]\nid = \"t\"\ntitle = \"t\"\ncaption = \"c\"\nexperiment = \"e\"\n"
                          "rows_title = \"r\"\nrows = [{each = [\"chosen\"], label = \"{chosen.label}\", "
                          "case = \"{chosen}\"}]\ncolumns = [{title = \"c\", metric = \"m\"}]\n",
                      "claims.toml")
      .tables.at(0)
      .rows;
}

std::vector<std::string> chosen(const std::string& set) {
  std::vector<std::string> names;
  for (const TableLayout::Row& row :
       rows("hill = [{name = \"a\", label = \"A\", high = \"yes\"}, {name = \"b\", label = \"B\"}, "
            "{name = \"c\", label = \"C\", high = \"yes\", far = \"\"}]\nleft_out = [\"a\", \"b\"]\n"
            "chosen = " +
            set)) {
    names.push_back(row.case_name);
  }
  return names;
}

TEST(DerivedSets, KeepTheMembersWithTheFieldsAskedForInTheirOrder) {
  EXPECT_THAT(chosen(R"({of = "hill"})"), ElementsAre("a", "b", "c"));
  EXPECT_THAT(chosen(R"({of = "hill", with = ["high"]})"), ElementsAre("a", "c"));
  EXPECT_THAT(chosen(R"({of = "hill", with = ["high", "far"]})"), ElementsAre("c"));
  EXPECT_THAT(chosen(R"({of = "hill", without = ["far"]})"), ElementsAre("a", "b"));
  EXPECT_THAT(chosen(R"({of = "hill", with = ["high"], except = ["c"]})"), ElementsAre("a"));
  EXPECT_THAT(chosen(R"({of = "hill", except = ["{left_out}"]})"), ElementsAre("c"));
}

TEST(DerivedSets, RefuseWhatCannotBeMeant) {
  const auto refused = [](const std::string& set, const std::string& what) {
    EXPECT_THAT(failure_of([&] { chosen(set); }).what, AllOf(HasSubstr(what), HasSubstr("claims.toml:7")))
        << set;
  };
  refused(R"({of = "valley"})", "unknown set 'valley'");
  refused(R"({of = "chosen"})", "unknown set 'chosen'");
  refused(R"({of = "hill", except = ["d"]})", "'hill' has no member 'd'");
  refused(R"({of = "hill", with = ["deep"]})", "the set is empty");
  refused(R"({with = ["high"]})", "'of' is missing");
  refused(R"({of = "hill", has = ["high"]})", "has");
}

TEST(DerivedSets, TakeMethodsAndTheirTraitsFromTheRegistries) {
  std::vector<std::string> editable, labels;
  for (const RepresentationType& type : representations()) {
    if (type.traits.editable) editable.emplace_back(type.name);
  }
  EXPECT_THAT(chosen(R"({of = "representations", with = ["editable"]})"),
              testing::ElementsAreArray(editable));
  for (const TableLayout::Row& row : rows(R"(chosen = {of = "entrants", with = ["joins"]})"))
    labels.push_back(row.label);
  std::vector<std::string> expected;
  for (const Entrant& entrant : entrants()) {
    if (!lod(entrant.method).unstitched.empty()) expected.push_back(entrant.label);
  }
  EXPECT_THAT(labels, testing::ElementsAreArray(expected));
  EXPECT_GT(chosen(R"({of = "lods", with = ["tunable"]})").size(), 4U);
}

}  // namespace
}  // namespace terrabench
