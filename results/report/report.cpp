#include "results/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <set>

#include "results/claims/judge.h"
#include "results/claims/ranking.h"
#include "results/claims/statements.h"
#include "results/report/advice.h"
#include "results/report/citation.h"
#include "results/report/discrepancies.h"
#include "results/report/fill.h"
#include "results/report/findings_table.h"
#include "results/report/front_page.h"
#include "results/report/further_grounds.h"
#include "results/report/further_section.h"
#include "results/report/ground_name.h"
#include "results/report/ledger.h"
#include "results/report/report_parts.h"
#include "results/report/report_tables.h"
#include "results/report/shown_pictures.h"
#include "results/report/site.h"
#include "results/report/unclaimed_cases.h"
#include "results/store/format.h"
#include "results/store/new_folder.h"
#include "terrain/files.h"

namespace terrabench {
namespace {

constexpr std::string_view kOfPaper = "";  // TableLayout::page of what stands on the paper's page
constexpr const char *kPapers = "Papers", *kGrounds = "Grounds";  // groups of pages

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
        rankings_(rank(ranking_layouts(), store, results_.profile)),
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
    for (const Paper& paper : papers_) {
      if (has_results(paper)) shown_.push_back(&paper);
    }
    for (const Paper* const paper : shown_) add_paper(*paper);
    write_further_pages();
    if (has_claims()) {
      introduce();
    } else {
      introduce_grounds();
    }
    add_other_measurements();
    if (has_claims()) add_ledger();
    add_runs();
    site_.add("", "", "Report", std::move(document_));
    site_.write(out_, fmt::format("{}\n", kMark.line));
  }

 private:
  void introduce() {
    add(opening(store_, results_));
    add(fault_warning(store_, results_));
    for (const std::string& ignored : results_.ignored) document_.push_back(Paragraph{ignored + ".", true});
    add(busy_warning(store_, results_, false));
    add(cover_pictures(store_, results_, shown_));
    document_.push_back(next_commands());
    add_summary();
    add(failed_checks(results_));
    warn_of_failures();
    add_findings();
    add_discrepancies();
    add_further_grounds();
  }

  void warn_of_failures() {
    if (std::ranges::count(results_.absences, "failed", &Absence::what) == 0) return;
    document_.push_back(Paragraph{"Some cases failed: what they should have measured is missing.",
                                  true,
                                  {{"Which, and why", "runs.*#absent"}}});
  }

  // The main page shows the part before the heading.
  void add_findings() {
    if (rankings_.empty()) return;
    write_file(out_ / "findings.json", findings_json(rankings_));
    Facts lines = headlines(rankings_);
    const auto counts = count_standings(statements(results_.judgements));
    if (const auto stated = counts.find(Group::kStated); stated != counts.end()) {
      lines.lines.emplace_back("What the papers state in numbers or comparisons",
                               counts_text(stated->second, Group::kStated) + ".");
    }
    Document brief{std::move(lines)};
    // The reference run itself is of the paper profile.
    const std::span<const Answer> reference =
        results_.profile == "paper" ? std::span<const Answer>() : reference_answers();
    for (Table& table : findings_tables(rankings_, reference)) {
      findings_ += plain_text(table) + "\n";
      brief.push_back(parts_.table(std::move(table)));
    }
    Document page{Heading{1, "Findings", "top"}};
    std::ranges::copy(brief, std::back_inserter(page));
    page.push_back(Heading{2, "Every value, with the 95 % interval of each factor", "values"});
    page.push_back(Paragraph{tie_rule()});
    page.push_back(findings(rankings_));
    site_.add("findings", "", "Findings", std::move(page));
    document_.push_back(Heading{2, "Findings", "findings"});
    add(std::move(brief));
    document_.push_back(Paragraph{"Every value, and when methods are called tied:",
                                  false,
                                  {{"Findings", "findings.*"}, {"as JSON", "findings.json"}}});
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
    add(fault_warning(store_, results_));
    for (const std::string& ignored : results_.ignored) document_.push_back(Paragraph{ignored + ".", true});
    add(busy_warning(store_, results_, false));
    warn_of_failures();
    add_further_grounds();
  }

  // What was measured on grounds that no claims file names.
  void add_further_grounds() {
    FurtherSection section =
        further_section(store_, results_.profile, options_, further_, further_pages_, parts_);
    if (!section.blocks.empty())
      document_.push_back(Heading{2, has_claims() ? "Further grounds" : "What to take", "grounds"});
    add(std::move(section.blocks));
    if (!has_claims()) add(std::move(section.pictures));
    advice_ = std::move(section.advice);
  }

  void write_further_pages() {
    for (const FurtherGround& ground : further_) {
      if (!add_ground_page(ground.paper, ground.page(), ground.warnings)) continue;
      further_pages_.push_back(ground.page());
      // Their figures do not stand on the main page, too.
      for (const auto* const cases : {&ground.page().sheets, &ground.page().pictures}) {
        for (const ShownPicture& shown : drawn_pictures(store_, results_.profile, *cases, ground.label))
          claimed_.insert(shown.figure->id);
      }
    }
  }

  void add_ledger() {
    const LedgerLinks& links = parts_.links();
    site_.add("ledger", "", "Ledger", ledger(store_, results_, papers_, links));
    write_file(out_ / "tables/ledger.csv", csv(ledger_table(store_, results_, papers_, links)));
  }

  void add_discrepancies() {
    Document page = discrepancies(results_, papers_);
    if (page.empty()) return;
    site_.add("wrong-or-vague", "", "Not confirmed", std::move(page));
    document_.push_back(Heading{2, "Differences", "differences"});
    if (Table causes = causes_of_differences(results_, papers_); !causes.rows.empty())
      document_.push_back(parts_.table(std::move(causes)));
    document_.push_back(Paragraph{"Every difference with its reason and the reading that matches:",
                                  false,
                                  {{std::string(kDiscrepanciesTitle), "wrong-or-vague.*"}}});
  }

  void add_summary() {
    if (!shown_.empty()) document_.push_back(verdict_bars(results_, shown_));
    document_.push_back(
        Paragraph{"", false, {{"Ledger: every statement, measurement and verdict", "ledger.*"}}});
    document_.push_back(Search{"Find claims with all of these words:", "ledger.*"});
    Table table = summary_table(results_, papers_);
    write_file(out_ / "tables/summary.csv", csv(table));
    for (std::vector<Cell>& row : table.rows) {
      const auto paper = std::ranges::find(shown_, row[0].text, &Paper::title);
      if (paper != shown_.end()) row[0].link = "#" + (*paper)->id;
    }
    write_file(out_ / "tables/summary.md", markdown(table));  // README.md shows it
  }

  // True also for a paper with filled tables but no measured claim.
  bool has_results(const Paper& paper) const {
    return std::ranges::any_of(results_.of(paper), [](const Judgement& j) { return !j.runs.empty(); }) ||
           std::ranges::any_of(paper.tables, [&](const TableLayout& layout) {
             return !fill(layout, store_, results_).runs.empty();
           });
  }

  void add_paper(const Paper& paper) {
    const std::string reference = paper.reference ? reference_text(*paper.reference) : "";
    Document page{
        Heading{1, paper.title, "top"},
        Paragraph{reference + (reference.empty() || paper.source.empty() ? "" : " ") + paper.source}};
    append(page, verdicts(paper));
    append(page, grounds_of(paper));
    append_part(page, {2, "Tables", "tables"}, parts_.tables(paper, kOfPaper));
    append_part(page, {2, "Plots", "plots"}, parts_.plots(paper, kOfPaper));
    const std::vector<ShownPicture> shown = claimed_pictures(store_, results_, paper);
    for (const ShownPicture& picture : shown) claimed_.insert(picture.figure->id);
    append_part(page, {2, "Figures, in the paper's order", "figures"}, parts_.pictures(shown));
    site_.add(paper_page(paper), kPapers, paper.id, std::move(page));
  }

  // A list of the pages of all grounds of which something was measured.
  Document grounds_of(const Paper& paper) {
    std::vector<PageLayout> written;
    for (const PageLayout& layout : paper.pages) {
      std::vector<std::string> warnings;
      std::string lost = lost_columns(store_, results_.profile, layout.id, layout.label);
      if (!lost.empty()) warnings.push_back(std::move(lost));
      if (add_ground_page(paper, layout, warnings)) written.push_back(layout);
    }
    if (written.empty()) return {};
    return {TableBlock{ground_table(paper.id + ".grounds", "One page per ground", written), {}}};
  }

  // Returns whether anything was measured there.
  bool add_ground_page(const Paper& paper, const PageLayout& layout,
                       const std::vector<std::string>& warnings) {
    Document remarks{Paragraph{fmt::format("Measured in profile “{}”.", results_.profile)}};
    append(remarks, fault_warning(store_, results_));
    for (const std::string& warning : warnings) remarks.push_back(Paragraph{warning, true});
    append(remarks, answers_for(layout));
    Document page = parts_.ground_page(paper, layout, std::move(remarks));
    if (page.empty()) return false;
    site_.add(ground_page(layout.id), kGrounds, layout.label, std::move(page));
    return true;
  }

  // Which methods are best on a ground of the claims files.
  Document answers_for(const PageLayout& ground) {
    std::vector<Ranking> here, elsewhere;
    for (const Ranking& ranking : rankings_)
      (ranking.layout->ground == ground.id ? here : elsewhere).push_back(ranking);
    if (here.empty()) return {};
    FilledTable filled{advice(here, answers(elsewhere)), {}};
    filled.table.id = "answers." + ground.id;
    filled.table.title = "Which method for " + ground.label;
    std::set<std::string> runs;
    for (const Ranking& ranking : here) runs.insert(ranking.runs.begin(), ranking.runs.end());
    filled.runs.assign(runs.begin(), runs.end());
    return {parts_.table(std::move(filled))};
  }

  // How many statements hold, in a sentence per group.
  Document verdicts(const Paper& paper) const {
    std::string counts;
    for (const auto& [group, standings] : count_standings(statements(results_.of(paper)))) {
      std::string sentence = fmt::format("{}: {}.", name(group), counts_text(standings, group));
      sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
      counts += (counts.empty() ? "" : " ") + sentence;
    }
    if (counts.empty()) return {};
    return {Paragraph{counts, false, {{"Each statement with its verdict", "ledger.*#" + paper.id}}}};
  }

  // Nothing if there are no blocks.
  static void append_part(Document& to, Heading heading, Document blocks) {
    if (blocks.empty()) return;
    to.push_back(std::move(heading));
    append(to, std::move(blocks));
  }
  void add(Document blocks) { append(document_, std::move(blocks)); }

  // What no claim and no ground's page is about.
  void add_other_measurements() {
    Document page{Heading{1, "Other measurements", "top"}};
    Document tables;
    for (const TableLayout& layout : unclaimed_cases(store_, papers_, further_, results_.profile))
      tables.push_back(parts_.table(fill(layout, store_, results_)));
    append_part(page, {2, "Unclaimed cases", "unclaimed"}, std::move(tables));
    append_part(page, {2, "Terrains, as each representation stores them", "terrains"}, other_pictures());
    if (page.size() > 1) site_.add("other", "", "Other measurements", std::move(page));
  }

  Document other_pictures() {
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
    return parts_.pictures(shown);
  }

  // Where the numbers come from, and what has none.
  void add_runs() {
    Document page{Heading{1, "Runs", "top"}};
    append(page, busy_warning(store_, results_, true));
    write_file(out_ / "tables/inputs.csv", csv(input_table(store_, results_.profile)));
    page.push_back(
        Paragraph{"Every case with its seed, its terrain, that terrain's checksum and its parameters:",
                  false,
                  {{"CSV", "tables/inputs.csv"}}});
    append_part(page, {2, "Without measurements", "absent"}, absent_cases());
    append(page, provenance(store_));
    site_.add("runs", "", "Runs", std::move(page));
  }

  Document absent_cases() {
    Table table = absence_table(results_);
    if (table.rows.empty()) return {};
    for (const auto& [ground, label] : labels_of_grounds(store_, results_.profile)) {
      for (std::vector<Cell>& row : table.rows) row.back().text = with_label(row.back().text, ground, label);
    }
    return {parts_.table(std::move(table))};
  }

  const Store& store_;
  const ReportOptions& options_;
  std::span<const Paper> papers_;
  const std::filesystem::path& out_;
  JudgedResults results_;
  std::vector<Ranking> rankings_;
  std::vector<FurtherGround> further_;
  ReportParts parts_;
  Site site_;
  Document document_;                // the main page
  std::vector<const Paper*> shown_;  // those of which something was measured
  std::string findings_, advice_;
  std::vector<PageLayout> further_pages_;  // grounds that have a page
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
