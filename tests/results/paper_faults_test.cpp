#include "results/report/paper_faults.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/results/fake_results.h"

namespace terrabench {
namespace {

using testing::HasSubstr;
using testing::Not;

// Two statements that differ for one cause, one of which holds in another reading; one with a reason of its
// own; one that holds; one of ours that differs.
constexpr std::string_view kText = R"(paper = "p"
title = "A paper"
source = "s"
[[cause]]
id = "p.S"
title = "S has two meanings"
text = "The formula and the table cannot both be right."
[[claim]]
id = "p.1"
where = "Table 1"
statement = "The first"
class = "E"
check = [{equal = ["e/c/m", 1]}]
fails = ["*"]
cause = "p.S"
matches = "p.1.other"
[[claim]]
id = "p.1.other"
reading_of = "p.1"
where = "Table 1"
statement = "The first, read otherwise"
class = "E"
check = [{equal = ["e/c/m", 2]}]
[[claim]]
id = "p.2"
where = "Table 2"
statement = "The second"
class = "E"
check = [{equal = ["e/c/m", 3]}]
fails = ["*"]
cause = "p.S"
matches = "None does."
[[claim]]
id = "p.3"
where = "Table 3"
statement = "The third"
class = "E"
check = [{equal = ["e/c/m", 4]}]
fails = ["*"]
note = "The machine differs. Much."
matches = "None at all."
[[claim]]
id = "p.4"
where = "Table 4"
statement = "The fourth"
class = "E"
check = [{equal = ["e/c/m", 2]}]
[[claim]]
id = "p.5"
about = "beyond"
where = "Ours"
statement = "The fifth"
class = "E"
check = [{equal = ["e/c/m", 5]}]
fails = ["*"]
note = "It does not."
matches = "None of ours."
)";

class PaperFaults : public FolderTest {
 protected:
  PaperFaults() : papers_{parse_claims(kText, "claims.toml")} {
    Store store(folder_);
    Record record = fake_record(fake_provenance(), "e", "c");
    add(record, "m", "", {2});
    store.append(record);
  }
  std::string page() const { return markdown(paper_faults(judge(Store::open(folder_), papers_), papers_)); }
  std::vector<Paper> papers_;
};

TEST_F(PaperFaults, ACauseStandsOnceWithAllItsStatements) {
  const std::string text = page();
  const std::size_t cause = text.find("cannot both be right"), first = text.find("Table 1: The first"),
                    second = text.find("Table 2: The second"), third = text.find("Table 3: The third");
  EXPECT_EQ(text.find("cannot both be right", cause + 1), text.npos);
  EXPECT_LT(cause, first);
  EXPECT_LT(first, second);
  EXPECT_LT(second, third);
  EXPECT_NE(third, text.npos);
  EXPECT_THAT(text, HasSubstr("p.1.other, reproduced: The first, read otherwise"));
  EXPECT_THAT(text, HasSubstr("The machine differs."));
  EXPECT_THAT(text, Not(HasSubstr("The fourth")));
  EXPECT_THAT(text, Not(HasSubstr("The fifth"))) << "what is ours says nothing about the paper";
}

TEST_F(PaperFaults, StatementsAreCountedOnceAndApartFromOurOwn) {
  EXPECT_THAT(
      page(),
      HasSubstr(
          "Statements of the papers in numbers or orders: 4, of which 1 holds as printed, 1 holds in another "
          "reading, 2 do not hold. Asked beyond the papers: 1, of which 1 does not hold."));
}

}  // namespace
}  // namespace terrabench
