#include "results/report/table.h"

#include <gmock/gmock.h>

#include "results/report/document.h"
#include "results/store/format.h"

namespace terrabench {
namespace {

using testing::HasSubstr;
using testing::Not;

Table awkward() {
  return {"a.b",
          "Title & <co>",
          "50 % of $x_1$",
          {{"Name|s", "", false}, {"Size", "B", true}},
          {{{"a,\"b\"\nc", "", "", ""}, {"1,024", "1024", "", ""}},
           {{"<script>alert(1)</script>", "", "", ""}, {"2 % & 3 # {4} ~^\\", "", "#x", "verdict"}}}};
}

TEST(Format, NumbersForPeople) {
  EXPECT_EQ(format_number(0), "0");
  EXPECT_EQ(format_number(-0.0), "0");
  EXPECT_EQ(format_number(393216), "393,216");
  EXPECT_EQ(format_number(-1234567), "-1,234,567");
  EXPECT_EQ(format_number(-123), "-123");
  EXPECT_EQ(format_number(0.142345), "0.1423");
  EXPECT_EQ(format_number(12345.6), "12,346");
  EXPECT_EQ(format_number(1e20), "1e+20");
  EXPECT_EQ(format_quantity(2.5, "s"), "2.5 s");
  EXPECT_EQ(format_exact(0.1), "0.1");
}

TEST(TableTest, Csv) {
  EXPECT_EQ(csv(awkward()),
            "Name|s,Size [B]\r\n\"a,\"\"b\"\"\nc\",1024\r\n<script>alert(1)</script>,2 % & 3 # {4} ~^\\\r\n");
}

TEST(TableTest, CsvHoldsNoFormula) {
  for (const char* text : {"=1+1", "@SUM(A1)", "+cmd", "-2+3", "-x", "--set", "\t=1", "- … 3", "-1 … x"}) {
    EXPECT_EQ(escape_csv(text), std::string("'") + text) << text;
  }
  EXPECT_EQ(escape_csv("=HYPERLINK(\"x\", 1)"), "\"'=HYPERLINK(\"\"x\"\", 1)\"");
  for (const char* text : {"-1", "-1.5e-07", "-2 … -1", "a=1", "1-2", "–", "", "x"})
    EXPECT_EQ(escape_csv(text), text);
}

TEST(Format, WhatIsNotPrintableBecomesASpace) {
  EXPECT_EQ(printable("a\x1b[1m\tb\x7f\r\n"), "a [1m b   ");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m \xc2\x80\xc2\x9f\xc2\xa0°"),
            " 31m   \xc2\xa0°");
  EXPECT_EQ(printable("\xef\xbf\xbe\xef\xbf\xbf\xef\xbf\xbd"), "  \xef\xbf\xbd");
  EXPECT_EQ(printable("Łódź 中 \xc2"), "Łódź 中 \xc2");
  EXPECT_EQ(escape_html("\xc2\x9b<"), " &lt;");
  EXPECT_EQ(escape_markdown("\xc2\x9b<"), " &lt;");
  EXPECT_EQ(escape_latex("\xc2\x9b%"), " \\%");
}

TEST(Format, AMarkdownTargetStaysWithinItsParentheses) {
  EXPECT_EQ(escape_markdown_target("../figures/a%20b.png#x-y_z~"), "../figures/a%20b.png#x-y_z~");
  EXPECT_EQ(escape_markdown_target("a) <b>|\"\\&:"), "a%29%20%3Cb%3E%7C%22%5C%26%3A");
}

TEST(TableTest, HtmlEscapesAndMarksUp) {
  const std::string text = html(awkward());
  EXPECT_THAT(text, Not(HasSubstr("<script>")));
  EXPECT_THAT(text, HasSubstr("Title &amp; &lt;co&gt;"));
  EXPECT_THAT(text, HasSubstr("<th scope=\"col\" class=\"number\">Size [B]</th>"));
  EXPECT_THAT(text, HasSubstr("<td class=\"verdict number\"><a href=\"#x\">"));
}

TEST(TableTest, MarkdownKeepsRowsOnOneLine) {
  const std::string text = markdown(awkward());
  EXPECT_THAT(text, HasSubstr("| Name\\|s | Size \\[B\\] |\n|---|---:|\n"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4);
}

TEST(DocumentTest, PageNeedsNothingFromOutside) {
  const Document document = {Heading{1, "A <title>", "top"},
                             Heading{2, "Part", "part"},
                             Heading{2, "Second", "second"},
                             Heading{2, "Third", "third"},
                             Paragraph{"a & b", true},
                             Facts{{{"x", "<y>"}}},
                             TableBlock{awkward(), {{"CSV", "a.csv"}}},
                             Gallery{{{"P", "c", "p.svg", {}, "p.p"}}}};
  const std::string page = html(document);
  EXPECT_THAT(page, HasSubstr("<html lang=\"en\">"));
  EXPECT_THAT(page, HasSubstr("<li><a href=\"#part\">Part</a></li>"));
  EXPECT_THAT(page, HasSubstr("<figure id=\"p.p\">"));
  EXPECT_THAT(page, HasSubstr("alt=\"P: c\""));
  EXPECT_THAT(page, Not(HasSubstr("http")));
  EXPECT_THAT(page, Not(HasSubstr("<y>")));
  const std::string text = markdown(document);
  EXPECT_THAT(text, HasSubstr("<a id=\"p.p\"></a>![P](p.svg)"));
  EXPECT_THAT(text, HasSubstr("[CSV](a.csv)"));
}

TEST(DocumentTest, BarsSayTheirNumbersInWords) {
  const Bars bars{"b",           "Bars",
                  "c",           {"a", "b", "c", "d", "e", "f", "g"},
                  "of pictures", {{{"<P>", "p.html"}, "p", {3, 0, 1, 0, 0, 0, 0}, "2 of 2"}}};
  const std::string page = html(Document{bars}), text = markdown(Document{bars});
  for (const char* const part : {"aria-label=\"3 a, 1 c\"", "id=\"p\"", "<a href=\"p.html\">&lt;P&gt;</a>",
                                 "flex-grow:3", ">3</span>", "2 of 2"})
    EXPECT_THAT(page, HasSubstr(part));
  EXPECT_THAT(page, Not(HasSubstr(">0</span>")));
  EXPECT_THAT(text, HasSubstr("[<a id=\"p\"></a>&lt;P&gt;](p.html) | 3 | 1 | 2 of 2 |"));
  EXPECT_THAT(page, HasSubstr("class=\"part2\"></span>c</span>"));
  EXPECT_THAT(page, Not(HasSubstr("class=\"part1\"></span>b</span>"))) << "no bar has such a part";
}

TEST(DocumentTest, ALongTableHasAFieldThatFiltersIt) {
  Table table = awkward();
  EXPECT_THAT(html(Document{TableBlock{table, {}}}), Not(HasSubstr("class=\"filter")));
  EXPECT_THAT(html(Document{TableBlock{table, {}, true}}), HasSubstr("data-search hidden>"));
  table.rows.resize(40, table.rows[0]);
  const std::string page = html(Document{TableBlock{table, {}}});
  EXPECT_THAT(page, HasSubstr("class=\"filter"));
  EXPECT_THAT(page, Not(HasSubstr("data-search hidden>")));
}

TEST(DocumentTest, ALinkWithoutTargetIsACommand) {
  const Document document{Paragraph{"p", false, {{"run <x>"}, {"CSV", "a.csv"}}},
                          Doors{{{"What & why", "do <it>"}}}, Search{"Find", "ledger.html"},
                          Gallery{{{"P", "c", "p.webp", {}, "", "p.html"}}, true}};
  const std::string page = html(document), text = markdown(document);
  for (const char* const part :
       {"<code>run &lt;x&gt;</code> · <a href=\"a.csv\">CSV</a>",
        "<li>What &amp; why<code>do &lt;it&gt;</code>", "action=\"ledger.html\" hidden>",
        "<div class=\"strip\">", "<a href=\"p.html\"><img src=\"p.webp\""}) {
    EXPECT_THAT(page, HasSubstr(part));
  }
  for (const char* const part :
       {"`run <x>` · [CSV](a.csv)", "- What &amp; why: `do <it>`", "[![P](p.webp)](p.html)"})
    EXPECT_THAT(text, HasSubstr(part));
  EXPECT_THAT(text, Not(HasSubstr("Find")));
}

TEST(TableTest, LatexIsBooktabsAndEscaped) {
  const std::string text = latex(awkward());
  EXPECT_THAT(text, HasSubstr("\\toprule"));
  EXPECT_THAT(text, HasSubstr("\\begin{longtable}{@{}lr@{}}"));
  EXPECT_THAT(text, HasSubstr("50 \\% of \\$x\\_1\\$"));
  EXPECT_THAT(text, HasSubstr("\\# \\{4\\} \\textasciitilde{}\\textasciicircum{}\\textbackslash{}"));
  EXPECT_EQ(escape_latex("64³ × 2"), "64\\textsuperscript{3} $\\times$ 2");
}

}  // namespace
}  // namespace terrabench
