#include "results/report/latex_bundle.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "results/claims/judge.h"
#include "results/claims/ranking.h"
#include "results/plot/plot.h"
#include "results/plot/rasterise.h"
#include "results/report/citation.h"
#include "results/report/fill.h"
#include "results/report/further_grounds.h"
#include "results/report/report_tables.h"
#include "results/report/shown_pictures.h"
#include "results/report/statement_table.h"
#include "results/store/format.h"
#include "results/store/new_folder.h"
#include "terrain/error.h"
#include "terrain/files.h"
#include "terrain/image.h"

namespace terrabench {
namespace {

constexpr double kColumn = 84, kPage = 174;  // millimetres
// Pictures are printed at 254 dpi, at which their words can be read, and leave room for a caption.
constexpr double kPixelsPerMillimetre = 10, kHighest = 190;

constexpr FolderMark kMark{"LaTeX bundle", "main.tex",
                           "% Written by terrabench report --latex: a later one replaces this folder."};

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
% pdfTeX's default, 9, compiles five times as long and saves 6 %.
\ifdefined\pdfcompresslevel\pdfcompresslevel=3\fi
\ifdefined\pdfsuppresswarningpagegroup\pdfsuppresswarningpagegroup=1\fi
)";

// A paper's own numbers would stand beside the bundle's: "Table 2: Table 1: …".
std::string title_beside_number(const std::string& title) {
  return title.starts_with("Table ") || title.starts_with("Figure ") ? "The paper's " + title : title;
}

// Name of the picture's copy, without extension. It is made from the file's name, because two pictures may
// share an id, and includes the folder unless that is figures/.
std::string picture_name(const RecordedFigure& figure) {
  constexpr std::string_view kFolder = "figures/", kEnding = ".webp";
  std::string_view name = figure.file;
  // No name of the other kind begins with a slash.
  if (!name.starts_with(kFolder) || !name.ends_with(kEnding)) return file_name(fmt::format("/{}", name));
  name.remove_prefix(kFolder.size());
  name.remove_suffix(kEnding.size());
  return file_name(name);
}

// A figure of main.tex. `include`: what shows it.
std::string figure_text(std::string_view include, const std::string& title, std::string_view caption,
                        std::string_view id) {
  return fmt::format(
      "\\begin{{figure}}[htbp]\n  \\centering\n  {}\n  \\caption{{{}. {}}}\n  \\label{{fig:{}}}\n"
      "\\end{{figure}}\n",
      include, escape_latex(title_beside_number(title)), escape_latex(caption), file_name(id));
}

class Bundle {
 public:
  Bundle(const Store& store, std::span<const Paper> papers, const std::filesystem::path& out)
      : store_(store), papers_(papers), out_(out), results_(judge(store, papers)) {}

  // The files of pictures that are left out.
  const std::vector<std::string>& left_out() const { return left_out_; }
  const std::vector<std::string>& faults() const { return results_.faults; }

  void write() {
    for (const Paper& paper : papers_) add_paper(paper);
    add_further_grounds();
    const std::string sections = std::move(text_);
    text_ = fmt::format(
        "{}{}\\title{{Five terrain papers, measured again}}\n\\author{{}}\n\\date{{}}\n\n"
        "\\begin{{document}}\n\\maketitle\n",
        kMark.line, kPreamble);
    introduce();
    text_ += sections + "\\bibliographystyle{plain}\n\\bibliography{references}\n\\end{document}\n";
    write_file(out_ / "references.bib", bibtex(papers_));
    write_file(out_ / kMark.file, text_);
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
    if (!left_out_.empty()) {
      text_ += "\\textbf{Pictures left out} ";
      paragraph(fmt::format("(missing, altered or not readable): {}.", fmt::join(left_out_, ", ")));
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
    std::vector<Table> tables = filled_tables(paper);
    const bool judged =
        std::ranges::any_of(results_.of(paper), [](const Judgement& j) { return !j.runs.empty(); });
    for (const Group group : kGroups) {
      Table verdicts = statement_table(results_, paper, group);
      if (judged && !verdicts.rows.empty()) tables.push_back(std::move(verdicts));
    }
    std::string figures = plots(paper);
    for (const ShownPicture& shown : claimed_pictures(store_, results_, paper))
      figures += picture(shown, kPage);
    for (const PageLayout& page : paper.pages) figures += pictures(page);
    if (tables.empty() && figures.empty()) return;
    begin_section(paper.title, paper.id);
    if (paper.reference) text_ += fmt::format("The paper is~\\cite{{{}}}. ", citation_key(paper));
    paragraph(paper.source);
    for (const PageLayout& page : paper.pages) {
      const std::string lost = lost_columns(store_, results_.profile, page.id, page.label);
      if (!lost.empty()) warn(fmt::format("Ground {}. {}", page.label, lost));
    }
    for (const Table& table : tables) add_table(table);
    text_ += figures;
  }

  // A section per ground that no claims file names, with the tables, plots and pictures of its page in the
  // report, and which method is best there, compared with the reference grounds.
  void add_further_grounds() {
    const ProfileOfStore measured{store_, results_.profile};
    const std::vector<FurtherGround> further = further_grounds(papers_, measured);
    std::vector<FilledTable> which = tables_of_further_grounds(further, measured, reference_answers());
    for (const FurtherGround& ground : further) {
      std::vector<Table> tables = filled_tables(ground.paper);
      const auto best =
          std::ranges::find(which, ground.table_id(),
                            [](const FilledTable& filled) -> const std::string& { return filled.table.id; });
      if (best != which.end()) tables.push_back(std::move(best->table));
      const std::string figures = plots(ground.paper) + pictures(ground.page());
      if (tables.empty() && figures.empty()) continue;
      begin_section("Ground " + ground.label, "ground-" + ground.id);
      paragraph(ground.page().about);
      for (const std::string& warning : ground.warnings) warn(warning);
      for (const Table& table : tables) add_table(table);
      text_ += figures;
    }
  }

  void begin_section(const std::string& title, const std::string& id) {
    text_ +=
        fmt::format("\\clearpage\n\\section{{{}}}\n\\label{{sec:{}}}\n", escape_latex(title), file_name(id));
  }

  std::vector<Table> filled_tables(const Paper& paper) const {
    std::vector<Table> tables;
    for (const TableLayout& layout : paper.tables) {
      FilledTable filled = fill(layout, store_, results_);
      if (filled.runs.empty()) continue;
      filled.table.title = title_beside_number(filled.table.title);
      tables.push_back(std::move(filled.table));
    }
    return tables;
  }

  // Writes both files of each plot that has measurements, 84 mm and 174 mm wide, and shows the first.
  std::string plots(const Paper& paper) const {
    std::string figures;
    for (const PlotLayout& layout : paper.plots) {
      const FilledPlot filled = fill(layout, store_, results_.profile);
      if (filled.runs.empty()) continue;
      const std::string stem = "figures/" + file_name(layout.id);
      std::filesystem::create_directories(out_ / "figures");
      svg_text_to_pdf(plot_svg(filled.plot, column_size(filled.plot)), out_ / (stem + ".pdf"), kColumn);
      svg_text_to_pdf(plot_svg(filled.plot, page_size(filled.plot)), out_ / (stem + "-page.pdf"), kPage);
      figures += figure_text(fmt::format("\\includegraphics{{{}.pdf}}", stem), layout.title, layout.caption,
                             layout.id);
    }
    return figures;
  }

  // A ground's `pictures` have no words, so that a column is wide enough.
  std::string pictures(const PageLayout& page) {
    std::string figures;
    for (const auto& [cases, widest] : {std::pair{&page.sheets, kPage}, std::pair{&page.pictures, kColumn}}) {
      for (const ShownPicture& shown : drawn_pictures(store_, results_.profile, *cases, page.label))
        figures += picture(shown, widest);
    }
    return figures;
  }

  // Nothing if it stands elsewhere, or cannot be shown. `widest`: millimetres.
  std::string picture(const ShownPicture& shown, double widest) {
    const std::string& from = shown.figure->file;
    if (!pictures_.insert(from).second) return "";
    const std::optional<Image> image = read_intact(*shown.figure);
    if (!image) {
      left_out_.push_back(from);
      return "";
    }
    const std::string to = "pictures/" + picture_name(*shown.figure) + ".png";
    write_picture(out_ / to, *image);
    const double width =
        std::min({image->width / kPixelsPerMillimetre, widest, kHighest * image->width / image->height});
    return figure_text(fmt::format("\\includegraphics[width={:.1f}mm]{{{}}}", width, to), shown.title,
                       shown.caption, shown.figure->id);
  }

  // Nothing if LaTeX could not read it either, or if it is not the picture that was drawn.
  std::optional<Image> read_intact(const RecordedFigure& figure) const {
    if (!store_.intact(figure)) return std::nullopt;
    try {
      return read_picture(store_.path_of(figure.file));
    } catch (const Error& error) {
      if (error.code() != ExitCode::kBadInput) throw;
      return std::nullopt;
    }
  }

  void add_table(const Table& table) {
    const std::string file = "tables/" + file_name(table.id) + ".tex";
    write_file(out_ / file, latex(table));
    text_ += fmt::format("\\input{{{}}}\n", file);
  }

  void warn(std::string_view text) {
    text_ += "\\textbf{Warning:} ";
    paragraph(text);
  }
  void paragraph(std::string_view text) { text_ += escape_latex(text) + "\n\n"; }

  const Store& store_;
  std::span<const Paper> papers_;
  const std::filesystem::path& out_;
  JudgedResults results_;
  std::string text_;                   // main.tex
  std::set<std::string> pictures_;     // files of all that were asked for so far
  std::vector<std::string> left_out_;  // files of those among them that cannot be shown
};

}  // namespace

WrittenBundle write_latex_bundle(const std::filesystem::path& results, const std::filesystem::path& target,
                                 const std::string& profile) {
  return write_latex_bundle(Store::open(results, profile), papers(), target);
}

WrittenBundle write_latex_bundle(const Store& store, std::span<const Paper> papers,
                                 const std::filesystem::path& target) {
  NewFolder folder(target, kMark);
  Bundle bundle(store, papers, folder.path());
  bundle.write();
  folder.publish();
  return {folder.target() / kMark.file, bundle.left_out(), bundle.faults()};
}

}  // namespace terrabench
