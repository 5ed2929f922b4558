#include <gmock/gmock.h>

#include <cstdlib>
#include <sstream>

#include "results/plot/plot.h"
#include "results/plot/rasterise.h"
#include "results/report/latex_bundle.h"
#include "results/report/table.h"
#include "results/store/format.h"
#include "terrain/error.h"
#include "terrain/image.h"
#include "tests/results/fake_results.h"

namespace terrabench {
namespace {

using testing::HasSubstr;
using testing::Not;

bool installed(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

bool can_compile() {
  return installed("latexmk") && installed("kpsewhich") &&
         std::system("kpsewhich booktabs.sty lmodern.sty >/dev/null") == 0;
}
constexpr const char* kCannotCompile =
    "Debian's latexmk, texlive-latex-recommended and lmodern are not all installed";

// What the program prints; fails the test when it fails. `scratch`: a file that may be written.
std::string output_of(const std::string& command, const std::filesystem::path& scratch) {
  const int code = std::system((command + " >" + scratch.string() + " 2>&1").c_str());
  std::string text = read_file(scratch);
  EXPECT_EQ(code, 0) << command << "\n" << text;
  return text;
}

// Of what pdffonts prints: two lines of heading, then one line per font, with "yes" or "no" below "emb".
bool all_fonts_are_embedded(const std::string& fonts) {
  std::istringstream lines(fonts);
  std::string heading, line;
  std::getline(lines, heading);
  const std::size_t column = heading.find("emb");
  std::getline(lines, line);
  std::size_t embedded = 0;
  while (std::getline(lines, line)) {
    if (column == heading.npos || line.size() < column || line.compare(column, 3, "yes") != 0) return false;
    ++embedded;
  }
  return embedded > 0;
}

Table sized(std::size_t rows, std::size_t columns, const std::string& cell, bool numeric = true) {
  Table table{"t", "T", "c", {{"Name"}}, {}};
  for (std::size_t i = 1; i < columns; ++i)
    table.columns.push_back({"Column " + std::to_string(i), "m", numeric});
  for (std::size_t i = 0; i < rows; ++i) {
    table.rows.emplace_back(columns, Cell{cell});
    table.rows.back()[0] = {"row" + std::to_string(i)};
  }
  return table;
}

constexpr std::string_view kAwkward =
    "% _ & # $ { } ~ ^ \\ < > | \" ` τ ² ³ ⁻⁷ ₀ ≤ ≥ ≠ ± − – … “x” × ÷ · ° § è Ł √ π µ 中 --x";

TEST(Latex, SpecialCharactersSurvive) {
  EXPECT_EQ(escape_latex("50 % of a_b & τ² ≤ −3"),
            "50 \\% of a\\_b \\& $\\tau$\\textsuperscript{2} $\\leq$ $-$3");
  EXPECT_EQ(escape_latex("--set ---"), "-{}-set -{}-{}-");
  EXPECT_EQ(escape_latex("Politècnica Łódź"), "Politècnica Łódź");
  EXPECT_EQ(escape_latex("中 \xFF\xE4\xB8"), "[U+4E2D] ???");
  EXPECT_EQ(escape_latex("a\nb\tc"), "a b c");
  // Nothing that LaTeX could not read is left.
  EXPECT_THAT(escape_latex(kAwkward), Not(HasSubstr("中")));
}

TEST(Latex, NumbersArePrintedAsNumbers) {
  Table table{
      "t", "T", "c", {{"A"}, {"B", "", true}}, {{{"[0, 1]"}, {"1.5e-07"}}, {{"a-3"}, {"-2,000 … 1e+20"}}}};
  const std::string text = latex(table);
  EXPECT_THAT(text, HasSubstr("$1.5\\times10^{-7}$"));
  EXPECT_THAT(text, HasSubstr("$-$2,000 \\ldots{} $1\\times10^{20}$"));
  EXPECT_THAT(text, HasSubstr("a-3"));
  EXPECT_THAT(text, HasSubstr("  {}[0, 1] &")) << "a bracket after a row's end is an option of it";
}

TEST(Latex, ATableFitsThePage) {
  const std::string small = latex(sized(5, 6, "1,234"));
  EXPECT_THAT(small, HasSubstr("\\footnotesize"));
  EXPECT_THAT(small, HasSubstr("\\begin{longtable}{@{}lrrrrr@{}}"));
  EXPECT_EQ(count(small, "Column\\\\1 [m]"), 2U) << "its head is repeated on the next page";
  // Wide: on its side.
  EXPECT_THAT(latex(sized(40, 16, "123,456,789")), HasSubstr("\\begin{landscape}"));
  // Text is broken into lines, ids too.
  const std::string text = latex(sized(3, 3, std::string(20, 'a') + "." + std::string(30, 'b'), false));
  EXPECT_EQ(count(text, "\\raggedright"), 2U);
  EXPECT_THAT(text, HasSubstr("a.\\allowbreak{}b"));
}

class LatexBundle : public FolderTest {
 protected:
  std::filesystem::path bundle() const { return folder_ / "bundle"; }
  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(bundle())) {
      if (entry.is_regular_file()) files[entry.path().lexically_relative(bundle())] = read_file(entry.path());
    }
    return files;
  }
  // Compiles the bundle; its log. Fails the test when LaTeX fails or a reference leads nowhere.
  std::string compiled() const {
    output_of("cd " + bundle().string() + " && latexmk -pdf -interaction=nonstopmode -halt-on-error main.tex",
              folder_ / "latexmk.txt");
    EXPECT_TRUE(read_file(bundle() / "main.pdf").starts_with("%PDF-"));
    std::string log = read_file(bundle() / "main.log");
    for (const char* fault : {"undefined references", "undefined citations", "multiply-defined labels"})
      EXPECT_THAT(log, Not(HasSubstr(fault)));
    return log;
  }
};

TEST_F(LatexBundle, HoldsWhatMainNames) {
  write_fake_results(folder_, "paper");
  EXPECT_EQ(write_latex_bundle(folder_, bundle()).main, bundle() / "main.tex");
  const auto all = files();
  const std::string& main = all.at("main.tex");
  std::size_t named = 2;  // main.tex, references.bib
  for (const auto& [file, content] : all) {
    if (file.starts_with("tables/")) {
      EXPECT_THAT(main, HasSubstr("\\input{" + file + "}"));
      EXPECT_THAT(content, HasSubstr("\\caption{"));
      EXPECT_THAT(content, HasSubstr("\\label{tab:"));
      ++named;
    } else if (file.starts_with("figures/")) {
      EXPECT_TRUE(content.starts_with("%PDF-")) << file;
      EXPECT_EQ(count(main, "\\includegraphics{" + file + "}"), file.ends_with("-page.pdf") ? 0U : 1U);
      ++named;
    } else if (file.starts_with("pictures/")) {
      const auto drawn = (std::filesystem::path("figures") / file.substr(9)).replace_extension(".webp");
      EXPECT_EQ(read_picture(bundle() / file).rgb, read_picture(folder_ / drawn).rgb) << file;
      EXPECT_EQ(count(main, "mm]{" + file + "}"), 1U);
      EXPECT_EQ(count(main, "\\label{fig:" + drawn.stem().string() + "}"), 1U);
      ++named;
    }
  }
  EXPECT_EQ(named, all.size());
  for (const char* file : {"tables/hybrid.table1.tex", "tables/summary.tex", "tables/hybrid.stated.tex",
                           "figures/hybrid.table2-growth.pdf", "figures/hybrid.table2-growth-page.pdf",
                           "pictures/hybrid.F3.png", "pictures/relief.jacksboro.heightmap.png"}) {
    EXPECT_TRUE(all.contains(file)) << file;
  }
  EXPECT_THAT(all.at("tables/hybrid.table1.tex"), HasSubstr("6,291,456"));
  EXPECT_THAT(all.at("tables/hybrid.stated.tex"), HasSubstr("hybrid."));
  EXPECT_THAT(
      all.at("tables/hybrid.stated.tex"),
      testing::ContainsRegex(
          "Statement[^&]*& The paper &[^&]*Printed[^&]*& Measured &[^&]*Tolerance[^&]*&[^&]*Verdict"));
  EXPECT_THAT(all.at("references.bib"), HasSubstr("@misc{paper:hybrid,"));
  EXPECT_THAT(main, HasSubstr("\\cite{paper:hybrid}"));
}

TEST_F(LatexBundle, NothingFromARecordBecomesACommand) {
  write_fake_results(folder_, "quick");
  const std::string evil = "a}\\input{/etc/hostname}%";
  Store store(folder_);
  Record record = fake_record(fake_provenance(), "cross.error-maps", evil);
  record.terrain = evil;
  const std::string file = "figures/" + std::string("y}%.webp");
  write_picture(folder_ / file, Image(9, 9, {1, 2, 3}));
  record.figures = {{evil, file, evil, checksum(read_file(folder_ / file))}};
  store.append(record);
  write_latex_bundle(folder_, bundle());
  std::size_t shown = 0;
  for (const auto& [name, content] : files()) {
    if (!name.ends_with(".tex")) continue;
    EXPECT_THAT(content, Not(HasSubstr("\\input{/etc"))) << name;
    EXPECT_THAT(content, Not(HasSubstr("}%"))) << name;
    shown += count(content, "\\label{fig:a");
  }
  EXPECT_GT(shown, 0U) << "the picture is in the bundle";
  const std::string table = latex(Table{evil, evil, evil, {{evil}}, {{{evil}}}});
  EXPECT_THAT(table, Not(HasSubstr("\\input{/etc")));
  EXPECT_THAT(table, HasSubstr("\\label{tab:a_"));
}

TEST_F(LatexBundle, PicturesThatAreGoneOrAlteredAreNamed) {
  write_fake_results(folder_, "quick");
  std::filesystem::remove(folder_ / "figures/hybrid.F4.webp");
  write_file(folder_ / "figures/hybrid.F6.webp", std::string_view("altered"));
  // As it was drawn, but not readable.
  write_file(folder_ / "figures/x.webp", std::string_view("no picture"));
  Record newer = fake_record(fake_provenance(), "x", "y");
  newer.figures = {{"hybrid.F7", "figures/x.webp", "No picture", checksum("no picture")}};
  Store(folder_).append(newer);
  EXPECT_THAT(write_latex_bundle(folder_, bundle()).left_out,
              testing::ElementsAre("figures/hybrid.F4.webp", "figures/hybrid.F6.webp", "figures/x.webp"));
  const auto all = files();
  EXPECT_THAT(all.at("main.tex"), HasSubstr("(missing, altered or not readable): figures/hybrid.F4.webp, "
                                            "figures/hybrid.F6.webp, figures/x.webp."));
  for (int k = 3; k <= 13; ++k) {
    const std::string name = "pictures/hybrid.F" + std::to_string(k) + ".png";
    const bool there = k != 4 && k != 6 && k != 7;
    EXPECT_EQ(all.contains(name), there) << name;
    EXPECT_EQ(count(all.at("main.tex"), "{" + name + "}"), there ? 1U : 0U) << name;
  }
}

TEST_F(LatexBundle, SameMeasurementsSameBytesAndAnEarlierOneIsReplaced) {
  write_fake_results(folder_, "quick");
  write_latex_bundle(folder_, bundle());
  const auto first = files();
  write_file(bundle() / "main.pdf", std::string_view("compiled"));
  write_latex_bundle(folder_, folder_ / "bundle/.");
  EXPECT_EQ(files(), first);
}

TEST_F(LatexBundle, FiguresHaveTheirPrintSizeAndFonts) {
  if (!installed("pdffonts") || !installed("pdfinfo"))
    GTEST_SKIP() << "Debian's poppler-utils is not installed";
  Plot plot{"p", {"x", "m", true}, {"y", "τ² ≤ 1", false}, {{"s", {{1, 2, 2, 2}, {10, 3, 3, 3}}}}};
  const std::filesystem::path pdf = folder_ / "p.pdf", out = folder_ / "out";
  svg_text_to_pdf(plot_svg(plot, column_size(plot)), pdf, 84);
  // 84 mm in points of 1/72 inch.
  EXPECT_THAT(output_of("pdfinfo " + pdf.string(), out), HasSubstr("Page size:       238.11 x"));
  const std::string fonts = output_of("pdffonts " + pdf.string(), out);
  EXPECT_THAT(fonts, HasSubstr("DejaVuSans"));
  EXPECT_TRUE(all_fonts_are_embedded(fonts)) << fonts;
}

TEST_F(LatexBundle, Compiles) {
  if (!can_compile()) GTEST_SKIP() << kCannotCompile;
  Store store(folder_);
  const Provenance run = fake_provenance();
  store.begin_run(run);
  Record record = fake_record(run, "hybrid.table2", "n=64");
  add(record, "generation_time", "s", {0.02});
  store.append(record);
  std::vector<Paper> one = {faked_papers()[0]};
  one[0].title += kAwkward;
  one[0].source = kAwkward;
  one[0].tables[0].caption = kAwkward;
  one[0].reference->authors = {"A & B_C %"};
  for (Claim& claim : one[0].claims) claim.statement += kAwkward;
  write_latex_bundle(store, one, bundle());
  EXPECT_THAT(compiled(), Not(HasSubstr("Missing character")));
}

// The bundle of the run that is kept, whole: takes 20 s.
TEST_F(LatexBundle, OfTheReferenceCompiles) {
  if (!can_compile()) GTEST_SKIP() << kCannotCompile;
  if (!installed("pdffonts")) GTEST_SKIP() << "Debian's poppler-utils is not installed";
  const auto reference = std::filesystem::path(TERRABENCH_SOURCE_DIR) / "results/reference";
  EXPECT_THAT(write_latex_bundle(reference, bundle()).left_out, testing::IsEmpty());
  std::size_t bytes = 0, plots = 0;
  for (const auto& [file, content] : files()) {
    bytes += content.size();
    if (!file.starts_with("figures/")) continue;
    const std::string fonts = output_of("pdffonts " + (bundle() / file).string(), folder_ / "fonts");
    EXPECT_TRUE(all_fonts_are_embedded(fonts)) << file << "\n" << fonts;
    ++plots;
  }
  EXPECT_LT(bytes, 60'000'000U);
  EXPECT_GE(plots, 50U);
  const std::string log = compiled();
  for (const char* fault : {"Overfull", "Missing character", "LaTeX Warning", "pdfTeX warning"})
    EXPECT_THAT(log, Not(HasSubstr(fault)));
  EXPECT_THAT(read_file(bundle() / "main.blg"), Not(HasSubstr("Warning")));
}

}  // namespace
}  // namespace terrabench
