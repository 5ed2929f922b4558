#include "results/report/citation.h"

#include <gmock/gmock.h>

#include "results/store/provenance.h"

namespace terrabench {
namespace {

using testing::HasSubstr;

TEST(Citation, EveryPaperAndTheProgramHaveAnEntry) {
  const std::string text = bibtex(papers());
  std::ptrdiff_t entries = 0, depth = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    depth += text[at] == '{' ? 1 : text[at] == '}' ? -1 : 0;  // BibTeX counts them after a backslash, too
    ASSERT_GE(depth, 0);
    if (text.substr(at, 6) != "@misc{") continue;
    EXPECT_EQ(depth, 0);
    ++entries;
  }
  EXPECT_EQ(depth, 0);
  EXPECT_EQ(entries, 6);
  for (const Paper& paper : papers()) {
    EXPECT_EQ(text.find("{" + citation_key(paper) + ",") != text.npos, paper.id != "cross") << paper.id;
  }
  for (const char* const invented : {"doi", "pages", "journal", "booktitle"})
    EXPECT_EQ(text.find(std::string("  ") + invented + " = "), text.npos);
  for (const char* const part : {"author = {Christopher Stuetzle and W. Randolph Franklin}",
                                 "title = {{[Four stages", "reproduced: authors, title, year and place"})
    EXPECT_THAT(text, HasSubstr(part));
  EXPECT_THAT(text, testing::ContainsRegex("note = .Version [0-9.]+, git revision " +
                                           collect_provenance({}).git_revision));
}

TEST(Citation, SpecialCharactersAreEscaped) {
  std::vector<Paper> one(1);
  one[0].id = "x";
  one[0].reference = Reference{{"A & B", "C_D E²", "Politècnica"}, "100 % of $x^2$", "", "#1", 1999};
  for (const char* const part :
       {"author = {A \\& B and C\\_D E\\textsuperscript{2} and Politècnica}",
        "title = {{100 \\% of \\$x\\textasciicircum{}2\\$}}", "howpublished = {\\#1}", "year = {1999}"})
    EXPECT_THAT(bibtex(one), HasSubstr(part));
}

TEST(Citation, ALineOfTextForPages) {
  EXPECT_EQ(reference_text({{"A", "B", "C"}, "Title", "", "Place", 0}), "A, B and C: Title. Place.");
  EXPECT_EQ(reference_text({{}, "", "Subject", "", 1999}), "[Subject]. 1999.");
}

}  // namespace
}  // namespace terrabench
