#include "results/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <optional>
#include <set>

#include "results/claims/judge.h"
#include "results/claims/ranking.h"
#include "results/claims/statements.h"
#include "results/report/citation.h"
#include "results/report/document.h"
#include "results/report/fill.h"
#include "results/report/further_cases.h"
#include "results/report/further_grounds.h"
#include "results/report/ground_page.h"
#include "results/report/ledger.h"
#include "results/report/lost_columns.h"
#include "results/report/paper_faults.h"
#include "results/report/report_parts.h"
#include "results/report/report_tables.h"
#include "results/report/shown_pictures.h"
#include "results/store/format.h"
#include "results/store/new_folder.h"
#include "terrain/files.h"

namespace terrabench {
namespace {

constexpr std::string_view kMainPage = "";  // TableLayout::page of what stands on it

constexpr FolderMark kMark{"report", "index.html",
                           "<!-- Written by terrabench report: a later one replaces this folder. -->"};

class Report {
 public:
  Report(const Store& store, std::span<const Paper> papers, const Store& reference,
         const std::filesystem::path& out)
      : store_(store),
        reference_(reference),
        papers_(papers),
        out_(out),
        results_(judge(store, papers)),
        further_(further_grounds(papers, {store, results_.profile})),
        parts_(store, results_.profile, out) {}

  // Of the reference too, if it is another folder.
  std::vector<std::string> faults() const {
    std::vector<std::string> all = results_.faults;
    if (&reference_ != &store_) std::ranges::copy(reference_.faults(), std::back_inserter(all));
    return all;
  }

  void write() {
    introduce();
    for (const Paper& paper : papers_) {
      if (has_results(paper)) add_paper(paper);
    }
    add_further_cases();
    add_absences();
    add_other_pictures();
    add_pending();
    add_provenance();
    write_ledger();
    write_file(out_ / kMark.file, fmt::format("{}\n{}", kMark.line, html(document_)));
    write_file(out_ / "report.md", markdown(document_));
  }

 private:
  void introduce() {
    document_.push_back(Heading{1, "Five terrain papers, measured again", "top"});
    document_.push_back(Paragraph{fmt::format(
        "Every verdict below is computed from the measurements of profile “{}” and the papers' own figures; "
        "none is typed in. Each table and picture names the run that it came from. Machine, code and command "
        "of each run are listed at the end.",
        results_.profile)});
    for (const std::string& ignored : results_.ignored) document_.push_back(Paragraph{ignored + ".", true});
    add_warning(document_);
    add_complaints();
    add_summary();
    if (const std::size_t failed = std::ranges::count(results_.absences, "failed", &Absence::what);
        failed > 0) {
      document_.push_back(Paragraph{"Some cases failed: what they should have measured is missing.",
                                    true,
                                    {{"Which, and why", "#absent"}}});
    }
    document_.push_back(Paragraph{"Every statement with what was measured and the reason of its verdict:",
                                  false,
                                  {{"Ledger", "ledger.html"}, {"as Markdown", "ledger.md"}}});
    add_paper_faults();
    add_findings();
    add_further_grounds();
  }

  // Claims of which nothing was measured are many after a run on a ground of the user's: the first are named.
  void add_complaints() {
    constexpr std::size_t kNamed = 3;
    std::vector<std::string> unmeasured;
    for (const Judgement& judgement : results_.judgements) {
      if (judgement.complaint.empty()) continue;
      if (judgement.verdict == Verdict::kMissing && judgement.runs.empty()) {
        unmeasured.push_back(judgement.claim->id);
      } else {
        document_.push_back(
            Paragraph{fmt::format("{}: {}.", judgement.claim->id, judgement.complaint), true});
      }
    }
    if (unmeasured.empty()) return;
    const std::size_t count = unmeasured.size();
    if (count > kNamed) unmeasured.resize(kNamed);
    document_.push_back(
        Paragraph{fmt::format("Verdict “missing”, since nothing of them was measured: {}{}.",
                              fmt::join(unmeasured, ", "),
                              count > kNamed ? fmt::format(" and {} more claims", count - kNamed) : ""),
                  true,
                  {{"All in the ledger", "ledger.html"}, {"as Markdown", "ledger.md"}}});
  }

  // On the main page and on every ground's.
  void add_warning(Document& to) const {
    if (results_.faults.empty()) return;
    to.push_back(Paragraph{
        fmt::format("These results cannot be trusted: {} lines or pictures were altered or damaged, "
                    "or name an unknown run. The first: {}",
                    results_.faults.size(), without_folder(results_.faults.front())),
        true});
  }

  void add_findings() {
    const std::vector<Ranking> rankings = rank(ranking_layouts(), store_, results_.profile);
    Facts facts = findings(rankings);
    if (facts.lines.empty()) return;
    write_file(out_ / "findings.json", findings_json(rankings));
    Facts brief = in_short(rankings);
    if (std::string standings = standings_sentence(results_); !standings.empty())
      brief.lines.emplace_back("Papers and measurements", std::move(standings));
    write_file(out_ / "findings.md", markdown({facts}));
    write_file(out_ / "findings-short.md", markdown({brief}));
    document_.push_back(Heading{2, "Findings", "findings"});
    document_.push_back(Paragraph{
        fmt::format(
            "Which method leads at what, from the medians of the comparisons across the papers, and where "
            "the papers differ from what was measured. In parentheses stands by how many times the leader is "
            "ahead of the next method, or within which factor methods are tied, in brackets the 95 % "
            "interval "
            "of that factor, where the figures vary. {}",
            tie_rule()),
        false,
        {{"JSON", "findings.json"}, {"Markdown", "findings.md"}}});
    document_.push_back(std::move(brief));
    document_.push_back(
        Paragraph{"Every task with its measured values, and with the 95 % interval of each factor:"});
    document_.push_back(std::move(facts));
  }

  // What was measured on grounds that no claims file names: a list of their pages, and which method is best
  // there.
  void add_further_grounds() {
    write_further_pages();
    std::vector<FilledTable> tables = tables_of_further_grounds(
        further_, {store_, results_.profile}, ranking_layouts(), {reference_, reference_.profile()});
    if (further_pages_.empty() && tables.empty()) return;
    document_.push_back(Heading{2, "Further grounds", "grounds"});
    document_.push_back(Paragraph{
        "Grounds chosen with the option --terrain of run. No claim is about them. The page of each has "
        "the tables, plots and pictures that the grounds of the comparisons across the papers have, as "
        "far as they were measured."});
    if (!further_pages_.empty())
      document_.push_back(
          TableBlock{ground_table("further.grounds", "One page per further ground", further_pages_), {}});
    if (!tables.empty() && &reference_ == &store_) {
      document_.push_back(
          Paragraph{"The option --reference of report compares these grounds with those of another results "
                    "folder, such as results/reference."});
    }
    if (!tables.empty() && !reference_.faults().empty()) {
      document_.push_back(
          Paragraph{fmt::format("The results that these are compared with cannot be trusted: {} faults",
                                reference_.faults().size()),
                    true});
    }
    for (const FurtherGround& ground : further_) {
      for (const std::string& warning : ground.warnings) {
        document_.push_back(Paragraph{fmt::format("Ground {}. {}", ground.label, warning), true});
      }
    }
    for (FilledTable& filled : tables) add_table(std::move(filled.table), filled.runs);
  }

  void write_further_pages() {
    for (const FurtherGround& ground : further_) {
      GroundPage page = filled_page(ground.paper, ground.page(), ground.warnings);
      page.elsewhere =
          "Which method is best on this ground, the measurements on other grounds, and the machine and code "
          "of each run:";
      page.section = {"Further grounds", "#grounds"};
      if (!write_page(page)) continue;
      further_pages_.push_back(ground.page());
      keep_off_main_page(ground.page());
    }
  }

  void write_ledger() {
    set_form(kHtmlForm);
    write_file(out_ / "ledger.html", html(ledger(store_, results_, papers_, links_)));
    write_file(out_ / "tables/ledger.csv", csv(ledger_table(store_, results_, papers_, links_)));
    set_form(kMarkdownForm);
    write_file(out_ / "ledger.md", markdown(ledger(store_, results_, papers_, links_)));
  }

  void set_form(const ReportForm& form) {
    links_.form = form;
    links_.grounds = ground_links(grounds_, form);
    std::ranges::move(ground_links(further_pages_, form), std::back_inserter(links_.grounds));
  }

  void add_paper_faults() {
    constexpr std::string_view kHtml = "wrong-or-vague.html", kMarkdown = "wrong-or-vague.md";
    const Document page = paper_faults(results_, papers_, "ledger.html");
    if (page.empty()) return;
    write_file(out_ / kHtml, html(page));
    write_file(out_ / kMarkdown, markdown(paper_faults(results_, papers_, "ledger.md")));
    document_.push_back(Paragraph{
        "Every difference with its reason and the reading that matches:",
        false,
        {{std::string(kPaperFaultsTitle), std::string(kHtml)}, {"as Markdown", std::string(kMarkdown)}}});
  }

  // Drops the folder's path: it is private, and changes when the folder is copied.
  std::string without_folder(std::string text) const {
    const std::string prefix = store_.folder().string() + "/";
    const std::size_t at = text.find(prefix);
    return at == text.npos ? text : text.erase(at, prefix.size());
  }

  void add_summary() {
    Table table = summary_table(results_, papers_);
    const bool pending = !pending_table(results_).rows.empty();
    for (std::vector<Cell>& row : table.rows) {
      const auto paper = std::ranges::find(papers_, row[0].text, &Paper::title);
      if (paper == papers_.end()) continue;
      if (has_results(*paper)) {
        row[0].link = "#" + paper->id;
      } else if (pending) {
        row[0].link = "#pending";
      }
    }
    add_table(std::move(table), {});
  }

  // True also for a paper with filled tables but no measured claim.
  bool has_results(const Paper& paper) const {
    return std::ranges::any_of(results_.of(paper), [](const Judgement& j) { return !j.runs.empty(); }) ||
           std::ranges::any_of(paper.tables, [&](const TableLayout& layout) {
             return !fill(layout, store_, results_).runs.empty();
           });
  }

  void add_paper(const Paper& paper) {
    document_.push_back(Heading{2, paper.title, paper.id});
    const std::string reference = paper.reference ? reference_text(*paper.reference) : "";
    document_.push_back(
        Paragraph{reference + (reference.empty() || paper.source.empty() ? "" : " ") + paper.source});
    add_ground_pages(paper);
    for (FilledTable& filled : filled_tables(paper, kMainPage)) {
      add_table(std::move(filled.table), filled.runs);
    }
    add_plots(paper, kMainPage, document_);
    add_verdicts(paper);
    add_gallery(paper);
  }

  // A page for every ground of which something was measured, and a list of these pages.
  void add_ground_pages(const Paper& paper) {
    std::vector<PageLayout> written;
    for (const PageLayout& layout : paper.pages) {
      std::vector<std::string> warnings;
      std::string lost = lost_columns(paper, layout, store_, results_.profile);
      if (!lost.empty()) warnings.push_back(std::move(lost));
      GroundPage page = filled_page(paper, layout, warnings);
      page.elsewhere =
          "The verdicts on these measurements, the other comparisons, and the machine and code of each run:";
      page.section = {paper.title, "#" + paper.id};
      if (write_page(page)) written.push_back(layout);
    }
    if (written.empty()) return;
    document_.push_back(TableBlock{ground_table(paper.id + ".grounds", "One page per ground", written), {}});
    grounds_.insert(grounds_.end(), written.begin(), written.end());
  }

  // Writes the page in both forms unless it is empty. Returns whether it was written.
  bool write_page(const GroundPage& page) const {
    if (page.empty()) return false;
    const std::string& id = page.layout->id;
    write_file(out_ / page_file(id, kHtmlForm), html(ground_page(page, kHtmlForm)));
    write_file(out_ / page_file(id, kMarkdownForm), markdown(ground_page(page, kMarkdownForm)));
    return true;
  }

  GroundPage filled_page(const Paper& paper, const PageLayout& layout,
                         const std::vector<std::string>& warnings) {
    GroundPage page{&layout, "", {}, {}, {}, {}, {}};
    page.remarks.push_back(Paragraph{fmt::format("Measured in profile “{}”.", results_.profile)});
    add_warning(page.remarks);
    for (const std::string& warning : warnings) page.remarks.push_back(Paragraph{warning, true});
    for (FilledTable& filled : filled_tables(paper, layout.id)) {
      links_.shown.insert(filled.table.id);
      page.tables.push_back(parts_.table(std::move(filled.table), filled.runs));
    }
    add_plots(paper, layout.id, page.plots);
    for (const PageLayout::Drawn& sheet : layout.sheets) {
      add_pictures(std::span(&sheet, 1), layout.label, page.pictures);
    }
    add_pictures(layout.pictures, layout.label, page.pictures);
    return page;
  }

  // The paper's tables of which something was measured, as far as they stand on this page.
  std::vector<FilledTable> filled_tables(const Paper& paper, std::string_view page) const {
    std::vector<FilledTable> tables;
    for (const TableLayout& layout : paper.tables) {
      if (layout.page != page) continue;
      FilledTable filled = fill(layout, store_, results_);
      if (!filled.runs.empty()) tables.push_back(std::move(filled));
    }
    return tables;
  }

  void add_verdicts(const Paper& paper) {
    std::string counts;
    for (const auto& [group, standings] : count_standings(statements(results_.of(paper)))) {
      counts +=
          fmt::format("{}{}: {}", counts.empty() ? "" : ". ", name(group), counts_text(standings, group));
    }
    if (counts.empty()) return;
    counts[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(counts[0])));
    document_.push_back(Heading{3, "Verdicts", paper.id + "-verdicts"});
    document_.push_back(Paragraph{
        counts + ".", false, {{"Each statement", "ledger.html#" + paper.id}, {"as Markdown", "ledger.md"}}});
  }

  void add_gallery(const Paper& paper) {
    Gallery gallery;
    for (ShownPicture& shown : claimed_pictures(store_, results_, paper)) {
      claimed_.insert(shown.figure->id);
      add_picture(gallery, std::move(shown));
    }
    if (gallery.pictures.empty()) return;
    document_.push_back(Heading{3, "Figures, in the paper's order", paper.id + "-figures"});
    document_.push_back(std::move(gallery));
  }

  void add_further_cases() {
    const std::vector<TableLayout> layouts = further_cases(store_, papers_, further_, results_.profile);
    if (layouts.empty()) return;
    document_.push_back(Heading{2, "Further cases", "further"});
    for (const TableLayout& layout : layouts) {
      FilledTable filled = fill(layout, store_, results_);
      add_table(std::move(filled.table), filled.runs);
    }
  }

  void add_other_pictures() {
    const GroundLabels labels = labels_of_grounds(store_, results_.profile);
    Gallery gallery;
    for (const Record& record : store_.records()) {
      if (record.profile != results_.profile) continue;
      for (const RecordedFigure& figure : record.figures) {
        if (!claimed_.contains(figure.id)) {
          add_picture(gallery,
                      {&record, &figure, labelled(record.experiment + " " + record.case_name, record, labels),
                       labelled(figure.caption, record, labels)});
        }
      }
    }
    if (gallery.pictures.empty()) return;
    document_.push_back(Heading{2, "Terrains", "terrains"});
    document_.push_back(Paragraph{"The measured terrains, as each representation stores them."});
    document_.push_back(std::move(gallery));
  }

  void add_picture(Gallery& gallery, ShownPicture shown) {
    std::optional<Picture> picture =
        parts_.picture(*shown.record, *shown.figure, std::move(shown.title), std::move(shown.caption));
    if (!picture) return;
    links_.pictures.insert(picture->file);
    gallery.pictures.push_back(std::move(*picture));
  }

  // The figures that these cases drew, side by side.
  void add_pictures(std::span<const PageLayout::Drawn> cases, const std::string& label, Document& to) {
    Gallery gallery;
    for (ShownPicture& shown : drawn_pictures(store_, results_.profile, cases, label)) {
      add_picture(gallery, std::move(shown));
    }
    if (!gallery.pictures.empty()) to.push_back(std::move(gallery));
  }

  // Keeps the figures that this page shows from standing on the main page too.
  void keep_off_main_page(const PageLayout& page) {
    for (const auto* const cases : {&page.sheets, &page.pictures}) {
      for (const ShownPicture& shown : drawn_pictures(store_, results_.profile, *cases, page.label)) {
        claimed_.insert(shown.figure->id);
      }
    }
  }

  void add_plots(const Paper& paper, std::string_view page, Document& to) {
    for (const PlotLayout& layout : paper.plots) {
      if (layout.page != page) continue;
      std::optional<Gallery> plot = parts_.plot(layout);
      if (!plot) continue;
      links_.shown.insert(layout.id);
      to.push_back(std::move(*plot));
    }
  }

  void add_table(Table table, const std::vector<std::string>& runs) {
    links_.shown.insert(table.id);
    document_.push_back(parts_.table(std::move(table), runs));
  }

  void add_absences() {
    Table table = absence_table(results_);
    if (table.rows.empty()) return;
    document_.push_back(Heading{2, "Without measurements", "absent"});
    add_table(std::move(table), {});
  }

  void add_pending() {
    Table table = pending_table(results_);
    if (table.rows.empty()) return;
    document_.push_back(Heading{2, "Pending", "pending"});
    add_table(std::move(table), {});
  }

  void add_provenance() {
    document_.push_back(Heading{2, "Provenance", "provenance"});
    std::vector<const Provenance*> runs;
    for (const Record& record : store_.records()) {
      const Provenance* const run = store_.run(record.run);
      if (run != nullptr && std::ranges::count(runs, run) == 0) runs.push_back(run);
    }
    for (const Provenance* const run : runs) {
      document_.push_back(Heading{3, "Run " + short_id(run->id), run_anchor(run->id)});
      document_.push_back(run_facts(*run));
    }
    add_table(input_table(store_, results_.profile), {});
  }

  const Store &store_, &reference_;
  std::span<const Paper> papers_;
  const std::filesystem::path& out_;
  JudgedResults results_;
  std::vector<FurtherGround> further_;
  ReportParts parts_;
  Document document_;
  LedgerLinks links_;                                // filled while the report is written
  std::vector<PageLayout> grounds_, further_pages_;  // those with a page
  std::set<std::string>
      claimed_;  // ids of pictures that belong to a claim or stand on a further ground's page
};

}  // namespace

WrittenReport write_report(const std::filesystem::path& folder, const std::filesystem::path& reference,
                           const std::string& profile) {
  const Store store = Store::open(folder, profile);
  if (reference.empty()) return write_report(store, papers());
  const Store compared = Store::open(reference);
  return write_report(store, papers(), &compared);
}

WrittenReport write_report(const Store& store, std::span<const Paper> papers, const Store* reference) {
  const std::filesystem::path target = store.folder() / "report";
  NewFolder folder(target, kMark);
  Report report(store, papers, reference == nullptr ? store : *reference, folder.path());
  report.write();
  folder.publish();
  return {target / kMark.file, report.faults()};
}

}  // namespace terrabench
