#include "results/latex_bundle.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "results/citation.h"
#include "results/fill.h"
#include "results/format.h"
#include "results/judge.h"
#include "results/ledger.h"
#include "results/new_folder.h"
#include "results/plot.h"
#include "results/rasterise.h"
#include "results/report_tables.h"
#include "results/tally.h"
#include "terrain/files.h"

namespace terrabench {
namespace {

constexpr double kColumn = 84, kPage = 174;  // millimetres

// The first line of main.tex, by which an earlier bundle is known.
constexpr std::string_view kMark =
    "% Written by terrabench report --latex: a later one replaces this folder.";

constexpr std::string_view kPreamble = R"(
\documentclass[10pt,a4paper]{article}
\usepackage[utf8]{inputenc}
\usepackage[T1]{fontenc}
\usepackage{lmodern,textcomp}
\usepackage[textwidth=174mm,textheight=247mm]{geometry}
\usepackage{array,booktabs,longtable,pdflscape,graphicx}
\usepackage[font=small,labelfont=bf]{caption}
\usepackage[hidelinks]{hyperref}
\extrafloats{200}
\maxdeadcycles=1000
\setcounter{topnumber}{4}
\setcounter{bottomnumber}{2}
\setcounter{totalnumber}{6}
\renewcommand{\topfraction}{0.9}
\renewcommand{\textfraction}{0.05}
\renewcommand{\floatpagefraction}{0.7}
\emergencystretch=3em
)";

bool is_bundle(const std::filesystem::path& folder) {
  std::ifstream file(folder / "main.tex", std::ios::binary);
  std::string start(kMark.size(), ' ');
  return file.read(start.data(), static_cast<std::streamsize>(start.size())) && start == kMark;
}

// A paper's own numbers would stand beside the bundle's: "Table 2: Table 1: …".
std::string title_beside_number(const std::string& title) {
  return title.starts_with("Table ") || title.starts_with("Figure ") ? "The paper's " + title : title;
}

// What the paper says and how it came out, without the rows that repeat others.
Table own_rows(const Store& store, const JudgedResults& results, const Paper& paper) {
  const Table all = ledger_table(store, results, {&paper, 1}, {});
  constexpr std::size_t kShown[] = {0, 2, 3, 4, 1};  // claim, the paper, printed, measured, verdict
  Table table{
      "verdicts-" + paper.id,
      "Verdicts: " + paper.title,
      "What the paper says in our words, what it prints, the measurement that decides, and the verdict. "
      "Rows that repeat another on further grounds or with other parameters are left out.",
      {},
      {}};
  for (const std::size_t i : kShown) table.columns.push_back(all.columns[i]);
  const auto judgements = results.of(paper);
  for (std::size_t row = 0; row < all.rows.size(); ++row) {
    const Judgement& j = judgements[row];
    if (j.claim->about == About::kRepeat || !was_measured(j.verdict)) continue;
    std::vector<Cell> cells;
    for (const std::size_t i : kShown) cells.push_back(all.rows[row][i]);
    table.rows.push_back(std::move(cells));
  }
  return table;
}

class Bundle {
 public:
  Bundle(const Store& store, std::span<const Paper> papers, const std::filesystem::path& out)
      : store_(store), papers_(papers), out_(out), results_(judge(store, papers)) {}

  void write() {
    text_ = fmt::format(
        "{}{}\\title{{Five terrain papers, measured again}}\n\\date{{}}\n\n\\begin{{document}}\n"
        "\\maketitle\n",
        kMark, kPreamble);
    introduce();
    for (const Paper& paper : papers_) add_paper(paper);
    text_ += "\\bibliographystyle{plain}\n\\bibliography{references}\n\\end{document}\n";
    write_file(out_ / "references.bib", bibtex(papers_));
    write_file(out_ / "main.tex", text_);
  }

 private:
  void introduce() {
    paragraph(fmt::format("Every number and verdict is computed from the measurements of profile “{}”.",
                          results_.profile));
    text_ += "The program is~\\cite{terrabench}.\n\n";
    if (!results_.faults.empty()) {
      text_ += "\\textbf{These results cannot be trusted:} ";
      paragraph(fmt::format("{} lines or pictures were altered or damaged, or name an unknown run.",
                            results_.faults.size()));
    }
    std::set<std::string> runs;
    for (const Record& record : store_.records()) {
      const Provenance* const run = store_.run(record.run);
      if (run == nullptr || record.profile != results_.profile || !runs.insert(run->cpu).second) continue;
      paragraph(fmt::format("Measured on: {}, {:.0f} GiB, {}.", run->cpu,
                            static_cast<double>(run->memory) / (1 << 30), run->os));
    }
    add_table(summary_table(results_, papers_));
  }

  void add_paper(const Paper& paper) {
    std::vector<Table> tables;
    for (const TableLayout& layout : paper.tables) {
      FilledTable filled = fill(layout, store_, results_);
      if (filled.runs.empty()) continue;
      filled.table.title = title_beside_number(filled.table.title);
      tables.push_back(std::move(filled.table));
    }
    Table verdicts = own_rows(store_, results_, paper);
    if (!verdicts.rows.empty()) tables.push_back(std::move(verdicts));
    std::vector<std::string> figures;
    for (const PlotLayout& layout : paper.plots) {
      if (std::string figure = draw(layout); !figure.empty()) figures.push_back(std::move(figure));
    }
    if (tables.empty() && figures.empty()) return;
    floating_ = false;
    text_ +=
        fmt::format("\\clearpage\n\\section{{{}}}\n\\label{{sec:{}}}\n", escape_latex(paper.title), paper.id);
    if (paper.reference) text_ += fmt::format("The paper is~\\cite{{{}}}. ", citation_key(paper));
    paragraph(paper.source);
    for (const Table& table : tables) add_table(table);
    add_figures(figures);
  }

  // The two files of a plot, and what shows the smaller one in half a line; empty if nothing was measured.
  std::string draw(const PlotLayout& layout) const {
    const FilledPlot filled = fill(layout, store_, results_.profile);
    if (filled.runs.empty()) return "";
    const std::string stem = "figures/" + file_name(layout.id);
    std::filesystem::create_directories(out_ / "figures");
    svg_text_to_pdf(plot_svg(filled.plot, column_size(filled.plot)), out_ / (stem + ".pdf"), kColumn);
    svg_text_to_pdf(plot_svg(filled.plot, page_size(filled.plot)), out_ / (stem + "-page.pdf"), kPage);
    return fmt::format(
        "  \\begin{{minipage}}[t]{{{}mm}}\n    \\vspace{{0pt}}\\centering\n    \\includegraphics{{{}.pdf}}\n"
        "    \\caption{{{}. {}}}\n    \\label{{fig:{}}}\n  \\end{{minipage}}",
        kColumn, stem, escape_latex(title_beside_number(layout.title)), escape_latex(layout.caption),
        layout.id);
  }

  // Two in a line.
  void add_figures(const std::vector<std::string>& figures) {
    for (std::size_t i = 0; i < figures.size(); i += 2) {
      text_ += "\\begin{figure}[htbp]\n" + figures[i];
      if (i + 1 < figures.size()) text_ += "\\hfill\n" + figures[i + 1];
      text_ += "\n\\end{figure}\n";
    }
  }

  void add_table(const Table& table) {
    const std::string file = "tables/" + file_name(table.id) + ".tex";
    const std::string text = latex(table);
    write_file(out_ / file, text);
    // Tables that float would otherwise come after a longtable that follows them.
    const bool floats = text.find("\\begin{longtable}") == text.npos;
    if (!floats && floating_) text_ += "\\clearpage\n";
    floating_ = floats;
    text_ += fmt::format("\\input{{{}}}\n", file);
  }

  void paragraph(std::string_view text) { text_ += escape_latex(text) + "\n\n"; }

  const Store& store_;
  std::span<const Paper> papers_;
  const std::filesystem::path& out_;
  JudgedResults results_;
  std::string text_;       // main.tex
  bool floating_ = false;  // whether a table since the last clearpage may still move
};

}  // namespace

std::filesystem::path write_latex_bundle(const std::filesystem::path& results,
                                         const std::filesystem::path& target) {
  return write_latex_bundle(Store::open(results), papers(), target);
}

std::filesystem::path write_latex_bundle(const Store& store, std::span<const Paper> papers,
                                         const std::filesystem::path& target) {
  NewFolder folder(target, is_bundle, "LaTeX bundle");
  Bundle(store, papers, folder.path()).write();
  folder.publish();
  return folder.target() / "main.tex";
}

}  // namespace terrabench
