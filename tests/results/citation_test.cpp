#include "results/report/citation.h"

#include <gmock/gmock.h>

#include <map>

#include "results/store/provenance.h"

namespace terrabench {
namespace {

using testing::HasSubstr;

struct Entry {
  std::string type;
  std::map<std::string, std::string> fields;
};

// Reads BibTeX as BibTeX does: braces balance, also after a backslash. Fails the test at a syntax error.
class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  std::map<std::string, Entry> read() {
    std::map<std::string, Entry> entries;
    for (skip(); at_ < text_.size(); skip()) {
      expect('@');
      Entry entry{word(), {}};
      expect('{');
      const std::string key = word();
      expect(',');
      for (skip(); at_ < text_.size() && text_[at_] != '}'; skip()) {
        const std::string name = word();
        expect('=');
        EXPECT_TRUE(entry.fields.emplace(name, braced()).second) << key << " has two of " << name;
        expect(',');
      }
      expect('}');
      EXPECT_TRUE(entries.emplace(key, entry).second) << key << " is there twice";
    }
    return entries;
  }

 private:
  void skip() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }
  void expect(char c) {
    skip();
    if (at_ >= text_.size() || text_[at_] != c) {
      ADD_FAILURE() << "expected " << c << " before: " << text_.substr(std::min(at_, text_.size()), 40);
      at_ = text_.size();
      return;
    }
    ++at_;
  }
  std::string word() {
    skip();
    const std::size_t begin = at_;
    while (at_ < text_.size() && std::string_view(" ,={}\n").find(text_[at_]) == std::string_view::npos)
      ++at_;
    return std::string(text_.substr(begin, at_ - begin));
  }
  std::string braced() {
    expect('{');
    const std::size_t begin = at_;
    for (int depth = 1; at_ < text_.size(); ++at_) {
      depth += text_[at_] == '{' ? 1 : text_[at_] == '}' ? -1 : 0;
      if (depth == 0) break;
    }
    const std::string value(text_.substr(begin, at_ - begin));
    expect('}');
    return value;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

TEST(Citation, EveryPaperAndTheProgramHaveAnEntry) {
  const auto entries = Parser(bibtex(papers())).read();
  EXPECT_EQ(entries.size(), 6U);
  for (const Paper& paper : papers()) {
    ASSERT_EQ(entries.contains(citation_key(paper)), paper.id != "cross") << paper.id;
    if (paper.id == "cross") continue;
    const auto& fields = entries.at(citation_key(paper)).fields;
    EXPECT_THAT(fields.at("title"), testing::MatchesRegex("\\{.+\\}"));
    EXPECT_EQ(fields.contains("author"), !paper.reference->authors.empty());
    EXPECT_EQ(fields.contains("year"), paper.reference->year != 0);
    for (const char* const invented : {"doi", "pages", "journal", "booktitle"}) {
      EXPECT_FALSE(fields.contains(invented)) << paper.id;
    }
  }
  EXPECT_EQ(entries.at("paper:drill").fields.at("author"), "Christopher Stuetzle and W. Randolph Franklin");
  EXPECT_THAT(entries.at("paper:mrbsp").fields.at("title"), testing::StartsWith("{[Four stages"));
  EXPECT_THAT(entries.at("paper:mrbsp").fields.at("note"), HasSubstr("authors, title, year and place"));
}

TEST(Citation, TheProgramsEntryNamesVersionAndRevision) {
  const auto entries = Parser(bibtex({})).read();
  ASSERT_EQ(entries.size(), 1U);
  EXPECT_THAT(
      entries.at("terrabench").fields.at("note"),
      testing::ContainsRegex("^Version [0-9.]+, git revision " + collect_provenance({}).git_revision));
}

TEST(Citation, SpecialCharactersKeepTheBracesBalanced) {
  std::vector<Paper> one(1);
  one[0].id = "x";
  one[0].reference = Reference{{"A & B", "C_D {E²", "Politècnica"}, "100 % of } {$x^2$", "", "#1", 1999};
  const auto entries = Parser(bibtex(one)).read();
  ASSERT_EQ(entries.size(), 2U);
  const auto& fields = entries.at("paper:x").fields;
  EXPECT_EQ(fields.at("author"), "A \\& B and C\\_D \\textbraceleft{}E\\textsuperscript{2} and Politècnica");
  EXPECT_EQ(fields.at("title"),
            "{100 \\% of \\textbraceright{} \\textbraceleft{}\\$x\\textasciicircum{}2\\$}");
  EXPECT_EQ(fields.at("howpublished"), "\\#1");
  EXPECT_EQ(fields.at("year"), "1999");
}

TEST(Citation, ALineOfTextForPages) {
  EXPECT_EQ(reference_text({{"A", "B", "C"}, "Title", "", "Place", 0}), "A, B and C: Title. Place.");
  EXPECT_EQ(reference_text({{}, "", "Subject", "", 1999}), "[Subject]. 1999.");
}

}  // namespace
}  // namespace terrabench
