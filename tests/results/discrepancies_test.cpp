#include "results/report/discrepancies.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/results/fake_results.h"

namespace terrabench {
namespace {

using testing::HasSubstr;
using testing::Not;

// Two statements that differ for one cause, one of which holds in another reading; one with a reason of its
// own; one that holds; one of ours that differs.
std::string entries() {
  const std::string cause = "fails = [\"*\"]\ncause = \"p.S\"\n",
                    own = "fails = [\"*\"]\nmatches = \"None does.\"\n";
  return "[[cause]]\nid = \"p.S\"\ntitle = \"S has two meanings\"\ntext = \"They cannot both be right.\"\n" +
         claim_entry("p.1", R"({equal = ["e/c/m", 1]})", cause + "matches = \"p.1.other\"\n") +
         claim_entry("p.1.other", R"({equal = ["e/c/m", 2]})", "reading_of = \"p.1\"\n") +
         claim_entry("p.2", R"({equal = ["e/c/m", 3]})", cause + "matches = \"None does.\"\n") +
         claim_entry("p.3", R"({equal = ["e/c/m", 4]})", own + "note = \"The machine differs. Much.\"\n") +
         claim_entry("p.4", R"({equal = ["e/c/m", 2]})") +
         claim_entry("p.5", R"({equal = ["e/c/m", 5]})",
                     own + "note = \"It does not.\"\nabout = \"beyond\"\n");
}

class Discrepancies : public FolderTest {
 protected:
  Discrepancies() : papers_{paper_of(entries())} {
    Store store(folder_);
    Record record = fake_record(fake_provenance(), "e", "c");
    add(record, "m", "", {2});
    store.append(record);
  }
  std::string page() const { return markdown(discrepancies(judge(Store::open(folder_), papers_), papers_)); }
  std::vector<Paper> papers_;
};

TEST_F(Discrepancies, ACauseStandsOnceWithAllItsStatements) {
  const std::string text = page();
  const std::size_t cause = text.find("cannot both be right"), first = text.find("w: states p.1"),
                    second = text.find("w: states p.2"), third = text.find("w: states p.3");
  EXPECT_EQ(text.find("cannot both be right", cause + 1), text.npos);
  EXPECT_LT(cause, first);
  EXPECT_LT(first, second);
  EXPECT_LT(second, third);
  EXPECT_NE(third, text.npos);
  EXPECT_THAT(text, HasSubstr("p.1.other, reproduced: states p.1.other"));
  EXPECT_THAT(text, HasSubstr("The machine differs."));
  EXPECT_THAT(text, Not(HasSubstr("states p.4")));
  EXPECT_THAT(text, Not(HasSubstr("states p.5"))) << "what is ours says nothing about the paper";
}

TEST_F(Discrepancies, StatementsAreCountedOnceAndApartFromOurOwn) {
  EXPECT_THAT(page(),
              HasSubstr("Statements of the papers in numbers or comparisons: 4, of which 1 holds as printed, "
                        "1 holds in another "
                        "reading, 2 do not hold. Asked beyond the papers: 1, of which 1 does not hold."));
}

}  // namespace
}  // namespace terrabench
