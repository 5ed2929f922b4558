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
#include "results/report/discrepancies.h"
#include "results/report/document.h"
#include "results/report/fill.h"
#include "results/report/findings_table.h"
#include "results/report/further_grounds.h"
#include "results/report/further_section.h"
#include "results/report/ground_name.h"
#include "results/report/ledger.h"
#include "results/report/report_parts.h"
#include "results/report/report_tables.h"
#include "results/report/shown_pictures.h"
#include "results/report/unclaimed_cases.h"
#include "results/store/format.h"
#include "results/store/new_folder.h"
#include "terrain/files.h"

namespace terrabench {
namespace {

constexpr std::string_view kMainPage = "";  // its name, and TableLayout::page of what stands on it

constexpr FolderMark kMark{"report", "index.html",
                           "<!-- Written by terrabench report: a later one replaces this folder. -->"};

class Report {
 public:
  Report(const Store& store, std::span<const Paper> papers, const ReportOptions& options,
         const std::filesystem::path& out)
      : store_(store),
        options_(options),
        papers_(papers),
        out_(out),
        results_(judge(store, papers)),
        further_(further_grounds(papers, {store, results_.profile})),
        parts_(store, results_, out) {}

  // Of the reference too, if it is another folder.
  std::vector<std::string> faults() const {
    std::vector<std::string> all = results_.faults;
    if (options_.reference != nullptr)
      std::ranges::copy(options_.reference->faults(), std::back_inserter(all));
    return all;
  }

  const std::string& findings_text() const { return findings_; }  // once it is written
  const std::string& advice_text() const { return advice_; }

  void write() {
    if (has_claims()) {
      introduce();
    } else {
      introduce_grounds();
    }
    for (const Paper& paper : papers_) {
      if (has_results(paper)) add_paper(paper);
    }
    add_unclaimed_cases();
    add_absences();
    add_other_pictures();
    add(provenance(store_));
    write_file(out_ / "tables/inputs.csv", csv(input_table(store_, results_.profile)));
    document_.push_back(
        Paragraph{"Every case with its seed, its terrain, that terrain's checksum and its parameters:",
                  false,
                  {{"CSV", "tables/inputs.csv"}}});
    if (has_claims()) write_ledger();
    write_page(out_, kMainPage, document_, fmt::format("{}\n", kMark.line));
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
    add_check_failures();
    add_summary();
    if (std::ranges::count(results_.absences, "failed", &Absence::what) > 0) {
      document_.push_back(Paragraph{"Some cases failed: what they should have measured is missing.",
                                    true,
                                    {{"Which, and why", "#absent"}}});
    }
    document_.push_back(Paragraph{"Every statement with what was measured and the reason of its verdict:",
                                  false,
                                  {{"Ledger", "ledger.html"}, {"as Markdown", "ledger.md"}}});
    add_discrepancies();
    add_findings();
    add_further_grounds();
  }

  // Claims of which nothing was measured are many after a run on a ground of the user's: the first are named.
  void add_check_failures() {
    constexpr std::size_t kNamed = 3;
    std::vector<std::string> unmeasured;
    for (const Judgement& judgement : results_.judgements) {
      if (judgement.check_failure.empty()) continue;
      if (judgement.verdict == Verdict::kMissing && judgement.runs.empty()) {
        unmeasured.push_back(judgement.claim->id);
      } else {
        document_.push_back(
            Paragraph{fmt::format("{}: {}.", judgement.claim->id, judgement.check_failure), true});
      }
    }
    if (unmeasured.empty()) return;
    std::string more;
    if (unmeasured.size() > kNamed) more = fmt::format(" and {} more claims", unmeasured.size() - kNamed);
    if (unmeasured.size() > kNamed) unmeasured.resize(kNamed);
    document_.push_back(Paragraph{fmt::format("Verdict “missing”, since nothing of them was measured: {}{}.",
                                              fmt::join(unmeasured, ", "), more),
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

  // The main page shows the part before the heading.
  void add_findings() {
    const std::vector<Ranking> rankings = rank(ranking_layouts(), store_, results_.profile);
    if (rankings.empty()) return;
    write_file(out_ / "findings.json", findings_json(rankings));
    Facts lines = headlines(rankings);
    const auto counts = count_standings(statements(results_.judgements));
    if (const auto stated = counts.find(Group::kStated); stated != counts.end()) {
      lines.lines.emplace_back("What the papers state in numbers or orders",
                               counts_text(stated->second, Group::kStated) + ".");
    }
    Document brief{std::move(lines)};
    for (Table& table : findings_tables(rankings)) {
      findings_ += plain_text(table) + "\n";
      brief.push_back(parts_.table(std::move(table), {}));
    }
    Document page{Heading{1, "Findings", "top"}};
    std::ranges::copy(brief, std::back_inserter(page));
    page.push_back(Heading{2, "Every value, with the 95 % interval of each factor", "values"});
    page.push_back(Paragraph{tie_rule()});
    page.push_back(findings(rankings));
    write_page(out_, "findings", page);
    document_.push_back(Heading{2, "Findings", "findings"});
    add(std::move(brief));
    document_.push_back(Paragraph{
        "Every value, and when methods are called tied:",
        false,
        {{"Findings", "findings.html"}, {"as Markdown", "findings.md"}, {"as JSON", "findings.json"}}});
  }

  // Of a folder without them, as after `terrabench advise`, the grounds are all that there is to say.
  bool has_claims() const {
    return further_.empty() ||
           std::ranges::any_of(results_.judgements, [](const Judgement& j) { return !j.runs.empty(); });
  }

  void introduce_grounds() {
    const std::string name = further_.size() == 1 ? further_[0].label : "my ground";
    document_.push_back(Heading{1, "Which method for " + name, "top"});
    document_.push_back(Paragraph{
        "Terrain methods, measured on this ground. Each answer below is computed from the measurements; the "
        "page of the ground has all of them, as tables, curves and pictures."});
    add_warning(document_);
    add_further_grounds();
  }

  // What was measured on grounds that no claims file names.
  void add_further_grounds() {
    FurtherSection section = further_section(store_, results_.profile, options_, further_, parts_,
                                             [&](const FurtherGround& g) { return remarks(g.warnings); });
    if (!section.blocks.empty())
      document_.push_back(Heading{2, has_claims() ? "Further grounds" : "What to take", "grounds"});
    add(std::move(section.blocks));
    if (!has_claims()) add(std::move(section.pictures));
    further_pages_ = std::move(section.pages);
    claimed_.merge(section.figures);
    advice_ = std::move(section.advice);
  }

  void write_ledger() {
    LedgerLinks& links = parts_.links();
    for (const std::vector<PageLayout>* const pages : {&grounds_, &further_pages_}) {
      for (const PageLayout& page : *pages)
        links.grounds.push_back({"Ground " + page.label, ground_page(page.id) + ".*"});
    }
    write_page(out_, "ledger", ledger(store_, results_, papers_, links));
    write_file(out_ / "tables/ledger.csv", csv(ledger_table(store_, results_, papers_, links)));
  }

  void add_discrepancies() {
    const Document page = discrepancies(results_, papers_);
    if (page.empty()) return;
    write_page(out_, "wrong-or-vague", page);
    document_.push_back(Paragraph{
        "Every difference with its reason and the reading that matches:",
        false,
        {{std::string(kDiscrepanciesTitle), "wrong-or-vague.html"}, {"as Markdown", "wrong-or-vague.md"}}});
  }

  // Drops the folder's path: it is private, and changes when the folder is copied.
  std::string without_folder(std::string text) const {
    const std::string prefix = store_.folder().string() + "/";
    const std::size_t at = text.find(prefix);
    return at == text.npos ? text : text.erase(at, prefix.size());
  }

  void add_summary() {
    Table table = summary_table(results_, papers_);
    for (std::vector<Cell>& row : table.rows) {
      const auto paper = std::ranges::find(papers_, row[0].text, &Paper::title);
      if (paper != papers_.end() && has_results(*paper)) row[0].link = "#" + paper->id;
    }
    write_file(out_ / "tables/summary.md", markdown(table));  // README.md shows it
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
    add(parts_.tables(paper, kMainPage));
    add(parts_.plots(paper, kMainPage));
    add_verdicts(paper);
    add_gallery(paper);
  }

  // A page for every ground of which something was measured, and a list of these pages.
  void add_ground_pages(const Paper& paper) {
    std::vector<PageLayout> written;
    for (const PageLayout& layout : paper.pages) {
      std::vector<std::string> warnings;
      std::string lost = lost_columns(store_, results_.profile, layout.id, layout.label);
      if (!lost.empty()) warnings.push_back(std::move(lost));
      if (parts_.write_ground_page(
              paper, layout, remarks(warnings),
              "The verdicts on these measurements, the other comparisons, and the machine "
              "and code of each run:",
              {{paper.title, "main#" + paper.id}, {"Report", "main"}, {"Ledger", "ledger.*"}}))
        written.push_back(layout);
    }
    if (written.empty()) return;
    document_.push_back(TableBlock{ground_table(paper.id + ".grounds", "One page per ground", written), {}});
    grounds_.insert(grounds_.end(), written.begin(), written.end());
  }

  // At the top of a ground's page.
  Document remarks(const std::vector<std::string>& warnings) const {
    Document remarks{Paragraph{fmt::format("Measured in profile “{}”.", results_.profile)}};
    add_warning(remarks);
    for (const std::string& warning : warnings) remarks.push_back(Paragraph{warning, true});
    return remarks;
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
    const std::vector<ShownPicture> shown = claimed_pictures(store_, results_, paper);
    for (const ShownPicture& picture : shown) claimed_.insert(picture.figure->id);
    add_with_heading({3, "Figures, in the paper's order", paper.id + "-figures"}, parts_.pictures(shown));
  }

  // Nothing if there are no blocks.
  void add_with_heading(Heading heading, Document blocks) {
    if (blocks.empty()) return;
    document_.push_back(std::move(heading));
    add(std::move(blocks));
  }
  void add(Document blocks) { std::ranges::move(blocks, std::back_inserter(document_)); }

  void add_unclaimed_cases() {
    Document tables;
    for (const TableLayout& layout : unclaimed_cases(store_, papers_, further_, results_.profile)) {
      FilledTable filled = fill(layout, store_, results_);
      tables.push_back(parts_.table(std::move(filled.table), filled.runs));
    }
    add_with_heading({2, "Unclaimed cases", "unclaimed"}, std::move(tables));
  }

  void add_other_pictures() {
    const GroundLabels labels = labels_of_grounds(store_, results_.profile);
    std::vector<ShownPicture> shown;
    for (const Record& record : store_.records()) {
      if (record.profile != results_.profile) continue;
      for (const RecordedFigure& figure : record.figures) {
        if (claimed_.contains(figure.id)) continue;
        shown.push_back({&record, &figure,
                         labelled(record.experiment + " " + record.case_name, record, labels),
                         labelled(figure.caption, record, labels)});
      }
    }
    Document pictures = parts_.pictures(shown);
    if (pictures.empty()) return;
    pictures.insert(pictures.begin(),
                    Paragraph{"The measured terrains, as each representation stores them."});
    add_with_heading({2, "Terrains", "terrains"}, std::move(pictures));
  }

  void add_table(Table table, const std::vector<std::string>& runs) {
    document_.push_back(parts_.table(std::move(table), runs));
  }

  void add_absences() {
    Table table = absence_table(results_);
    if (table.rows.empty()) return;
    for (const auto& [ground, label] : labels_of_grounds(store_, results_.profile)) {
      for (std::vector<Cell>& row : table.rows) row.back().text = with_label(row.back().text, ground, label);
    }
    add_with_heading({2, "Without measurements", "absent"}, {parts_.table(std::move(table), {})});
  }

  const Store& store_;
  const ReportOptions& options_;
  std::span<const Paper> papers_;
  const std::filesystem::path& out_;
  JudgedResults results_;
  std::vector<FurtherGround> further_;
  ReportParts parts_;
  Document document_;
  std::string findings_, advice_;
  std::vector<PageLayout> grounds_, further_pages_;  // those with a page
  std::set<std::string>
      claimed_;  // ids of pictures that belong to a claim or stand on a further ground's page
};

}  // namespace

WrittenReport write_report(const std::filesystem::path& folder, const std::filesystem::path& reference,
                           const std::string& profile, const std::string& purpose) {
  const Store store = Store::open(folder, profile);
  if (reference.empty()) return write_report(store, papers(), {nullptr, purpose});
  const Store compared = Store::open(reference);
  return write_report(store, papers(), {&compared, purpose});
}

WrittenReport write_report(const Store& store, std::span<const Paper> papers, const ReportOptions& options) {
  const std::filesystem::path target = store.folder() / "report";
  NewFolder folder(target, kMark);
  Report report(store, papers, options, folder.path());
  report.write();
  folder.publish();
  return {target / kMark.file, report.faults(), report.findings_text(), report.advice_text()};
}

}  // namespace terrabench
