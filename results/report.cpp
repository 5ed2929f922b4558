#include "results/report.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <set>

#include "results/check.h"
#include "results/document.h"
#include "results/format.h"
#include "results/further_cases.h"
#include "results/layout.h"
#include "results/plot.h"
#include "results/rasterise.h"
#include "terrain/error.h"
#include "terrain/files.h"

namespace terrabench {
namespace {

constexpr int kBitmapWidth = 1760;  // twice the plots' own size: sharp in print

// A folder that becomes the report when all is in it, or vanishes.
class Draft {
 public:
  explicit Draft(std::filesystem::path target)
      : target_(std::move(target)),
        path_(target_.parent_path() / fmt::format(".{}.{}.tmp", target_.filename().string(), getpid())) {
    std::error_code error;
    if (std::filesystem::exists(target_, error) && !std::filesystem::exists(target_ / "index.html", error) &&
        !std::filesystem::is_empty(target_, error)) {
      throw environment_error("holds files that are no report, and would be replaced", target_.string(),
                              "move them away");
    }
    std::filesystem::remove_all(path_, error);
    std::filesystem::create_directories(path_, error);
    if (error) {
      throw environment_error(fmt::format("cannot write: {}", error.message()), path_.string(),
                              "check the folder's permissions and the free space");
    }
  }
  ~Draft() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;

  const std::filesystem::path& path() const { return path_; }

  // An earlier report changes places with the draft, and is then removed as the draft would have been.
  void publish() {
    if (std::rename(path_.c_str(), target_.c_str()) == 0) return;
    if (renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0) return;
    // A file system that cannot exchange: the old one goes first.
    std::error_code error;
    std::filesystem::remove_all(target_, error);
    std::filesystem::rename(path_, target_, error);
    if (error) {
      throw environment_error(fmt::format("cannot write: {}", error.message()), target_.string(),
                              "check the folder's permissions");
    }
  }

 private:
  std::filesystem::path target_, path_;
};

std::string short_id(const std::string& run) { return run.substr(0, 8); }
std::string run_anchor(const std::string& run) { return "run-" + short_id(run); }

std::vector<Link> run_links(const std::vector<std::string>& runs) {
  std::vector<Link> links;
  for (const std::string& run : runs) links.push_back({"run " + short_id(run), "#" + run_anchor(run)});
  return links;
}

std::string file_name(std::string_view id) {
  std::string name(id);
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.' && c != '-' && c != '_') c = '_';
  }
  return name.starts_with('.') ? "_" + name : name;
}

class Report {
 public:
  Report(const Store& store, std::span<const Paper> papers, const std::filesystem::path& out)
      : store_(store), papers_(papers), out_(out), check_(check(store, papers)) {}

  void write() {
    introduce();
    for (const Paper& paper : papers_) {
      if (has_results(paper)) add_paper(paper);
    }
    add_further_cases();
    add_other_pictures();
    add_pending();
    add_provenance();
    write_file(out_ / "index.html", html(document_));
    write_file(out_ / "report.md", markdown(document_));
  }

 private:
  void introduce() {
    document_.push_back(Heading{1, "Five terrain papers, measured again", "top"});
    std::string intro = fmt::format(
        "Every verdict below is computed from the measurements of profile “{}” and the papers' own figures; "
        "nothing is "
        "typed in. Each item names the run that it came from, and the run says on which machine, from which "
        "code and "
        "with which command.",
        check_.profile);
    document_.push_back(Paragraph{intro});
    if (!check_.faults.empty()) {
      document_.push_back(
          Paragraph{fmt::format("{} lines or pictures were altered or damaged, or lack their run: these "
                                "results cannot be trusted. The first: {}",
                                check_.faults.size(), without_folder(check_.faults.front())),
                    true});
    }
    for (const Row& row : check_.rows) {
      if (row.complaint.empty()) continue;
      document_.push_back(Paragraph{fmt::format("{}: {}.", row.claim->id, row.complaint), true});
    }
    add_summary();
  }

  // Where the folder lies is nobody's business but its owner's, and changes when it is copied.
  std::string without_folder(std::string text) const {
    const std::string prefix = store_.folder().string() + "/";
    const std::size_t at = text.find(prefix);
    return at == text.npos ? text : text.erase(at, prefix.size());
  }

  void add_summary() {
    constexpr Verdict kShown[] = {Verdict::kReproduced,    Verdict::kShape,   Verdict::kDiffers,
                                  Verdict::kNotComparable, Verdict::kMissing, Verdict::kNotRun,
                                  Verdict::kPending};
    Table table{"summary",
                "Verdicts",
                "How many rows of each paper's ledger have which verdict.",
                {{"Paper", "", false}},
                {}};
    for (const Verdict verdict : kShown) table.columns.push_back({std::string(name(verdict)), "", true});
    for (const Paper& paper : papers_) {
      std::vector<Cell> cells = {{paper.title, "", has_results(paper) ? "#" + paper.id : "#pending", ""}};
      for (const Verdict verdict : kShown) {
        const auto count = std::count_if(check_.rows.begin(), check_.rows.end(), [&](const Row& row) {
          return row.paper == &paper && row.verdict == verdict;
        });
        cells.push_back({std::to_string(count), "", "", ""});
      }
      table.rows.push_back(std::move(cells));
    }
    add_table(std::move(table), {});
  }

  // A table may show what no row judges yet.
  bool has_results(const Paper& paper) const {
    return std::any_of(check_.rows.begin(), check_.rows.end(),
                       [&](const Row& row) { return row.paper == &paper && !row.runs.empty(); }) ||
           std::any_of(paper.tables.begin(), paper.tables.end(),
                       [&](const TableLayout& layout) { return !fill(layout, store_, check_).runs.empty(); });
  }
  bool has_verdicts(const Paper& paper) const {
    return std::any_of(check_.rows.begin(), check_.rows.end(), [&](const Row& row) {
      return row.paper == &paper && row.verdict != Verdict::kPending;
    });
  }

  void add_paper(const Paper& paper) {
    document_.push_back(Heading{2, paper.title, paper.id});
    document_.push_back(Paragraph{paper.source + "."});
    for (const TableLayout& layout : paper.tables) {
      FilledTable filled = fill(layout, store_, check_);
      if (!filled.runs.empty()) add_table(std::move(filled.table), run_links(filled.runs));
    }
    for (const PlotLayout& layout : paper.plots) add_plot(layout);
    if (has_verdicts(paper)) add_verdicts(paper);
    add_gallery(paper);
  }

  void add_verdicts(const Paper& paper) {
    document_.push_back(Heading{3, "Verdicts", paper.id + "-verdicts"});
    Table table{
        paper.id + ".verdicts",
        "Every row of the ledger that is measured so far",
        "What the paper says in our words, the tolerance, what was found, and the verdict that follows.",
        {{"Row", "", false},
         {"The paper", "", false},
         {"Tolerance", "", false},
         {"Measured", "", false},
         {"Verdict", "", false},
         {"Run", "", false}},
        {}};
    Facts notes;
    for (const Row& row : check_.rows) {
      if (row.paper != &paper || row.verdict == Verdict::kPending) continue;
      const Claim& claim = *row.claim;
      const std::string run = row.runs.empty() ? "" : row.runs.back();
      table.rows.push_back(
          {{claim.id, "", "", ""},
           {claim.where + ": " + claim.statement, "", "", ""},
           {claim.tolerance, "", "", ""},
           {row.measured, "", "", ""},
           verdict_cell(row),
           {run.empty() ? "" : short_id(run), "", run.empty() ? "" : "#" + run_anchor(run), ""}});
      if (claim.note.empty()) continue;
      // Rows of one table often share a note.
      if (!notes.lines.empty() && notes.lines.back().second == claim.note) {
        notes.lines.back().first += ", " + claim.id;
      } else {
        notes.lines.emplace_back(claim.id, claim.note);
      }
    }
    add_table(std::move(table), {});
    if (notes.lines.empty()) return;
    document_.push_back(Heading{3, "Notes on these rows", paper.id + "-notes"});
    document_.push_back(std::move(notes));
  }

  // Is the picture what some row is about? Rows of other classes may rest on it too.
  bool has_own_row(const Paper& paper, std::string_view figure) const {
    return std::any_of(check_.rows.begin(), check_.rows.end(), [&](const Row& row) {
      return row.paper == &paper && row.claim->type == 'F' &&
             std::any_of(row.claim->conditions.begin(), row.claim->conditions.end(),
                         [&](const Condition& condition) { return condition.figure == figure; });
    });
  }

  void add_gallery(const Paper& paper) {
    Gallery gallery;
    for (const Row& row : check_.rows) {
      if (row.paper != &paper) continue;
      for (const Condition& condition : row.claim->conditions) {
        const auto [record, figure] = store_.find_figure(condition.figure, check_.profile);
        if (figure == nullptr || (row.claim->type != 'F' && has_own_row(paper, figure->id))) continue;
        claimed_.insert(figure->id);
        add_picture(gallery, *record, *figure, row.claim->where,
                    row.claim->statement + " " + figure->caption);
      }
    }
    if (gallery.pictures.empty()) return;
    document_.push_back(Heading{3, "Figures, in the paper's order", paper.id + "-figures"});
    document_.push_back(std::move(gallery));
  }

  void add_further_cases() {
    const std::vector<TableLayout> layouts = further_cases(store_, papers_, check_.profile);
    if (layouts.empty()) return;
    document_.push_back(Heading{2, "Further cases", "further"});
    for (const TableLayout& layout : layouts) {
      FilledTable filled = fill(layout, store_, check_);
      add_table(std::move(filled.table), run_links(filled.runs));
    }
  }

  void add_other_pictures() {
    Gallery gallery;
    for (const Record& record : store_.records()) {
      if (record.profile != check_.profile) continue;
      for (const Figure& figure : record.figures) {
        if (!claimed_.contains(figure.id)) {
          add_picture(gallery, record, figure, record.experiment + " " + record.case_name, figure.caption);
        }
      }
    }
    if (gallery.pictures.empty()) return;
    document_.push_back(Heading{2, "Terrains", "terrains"});
    document_.push_back(Paragraph{"The ground that was measured, as each representation holds it."});
    document_.push_back(std::move(gallery));
  }

  // The picture travels with the report, so that the folder can be moved alone.
  void add_picture(Gallery& gallery, const Record& record, const Figure& figure, std::string title,
                   std::string caption) {
    const std::filesystem::path from = store_.folder() / figure.file;
    std::error_code error;
    if (!std::filesystem::is_regular_file(from, error)) return;
    // Under its own name, as two pictures may have one id, and results/reference has its pictures here only.
    const std::string to = "figures/" + file_name(from.filename().string());
    write_file(out_ / to, read_file(from));
    gallery.pictures.push_back({std::move(title), std::move(caption), to, "", run_links({record.run})});
  }

  void add_plot(const PlotLayout& layout) {
    const FilledPlot filled = fill(layout, store_, check_.profile);
    if (filled.runs.empty()) return;  // the paper's curve alone shows nothing of ours
    const std::string stem = "figures/" + file_name(layout.id);
    write_file(out_ / (stem + ".svg"), plot_svg(filled.plot));
    svg_to_png(out_ / (stem + ".svg"), out_ / (stem + ".png"), kBitmapWidth);
    std::vector<Link> links = run_links(filled.runs);
    links.push_back({"PNG", stem + ".png"});
    document_.push_back(
        Gallery{{{layout.title, layout.caption, stem + ".svg", stem + ".png", std::move(links)}}});
  }

  void add_table(Table table, std::vector<Link> links) {
    const std::string stem = "tables/" + file_name(table.id);
    write_file(out_ / (stem + ".csv"), csv(table));
    write_file(out_ / (stem + ".md"), markdown(table));
    write_file(out_ / (stem + ".tex"), latex(table));
    links.push_back({"CSV", stem + ".csv"});
    links.push_back({"Markdown", stem + ".md"});
    links.push_back({"LaTeX", stem + ".tex"});
    document_.push_back(TableBlock{std::move(table), std::move(links)});
  }

  void add_pending() {
    Table table{"pending-rows",
                "Rows that wait for their method",
                "They do not count against a run.",
                {{"Row", "", false}, {"The paper", "", false}, {"Why", "", false}},
                {}};
    for (const Row& row : check_.rows) {
      if (row.verdict != Verdict::kPending) continue;
      table.rows.push_back({{row.claim->id, "", "", ""},
                            {row.claim->where + ": " + row.claim->statement, "", "", ""},
                            {row.measured, "", "", ""}});
    }
    if (table.rows.empty()) return;
    document_.push_back(Heading{2, "Pending", "pending"});
    add_table(std::move(table), {});
  }

  void add_provenance() {
    document_.push_back(Heading{2, "Provenance", "provenance"});
    std::vector<const Provenance*> runs;
    for (const Record& record : store_.records()) {
      const Provenance* const run = store_.run(record.run);
      if (run != nullptr && std::find(runs.begin(), runs.end(), run) == runs.end()) runs.push_back(run);
    }
    for (const Provenance* const run : runs) add_run(*run);
    add_inputs();
  }

  void add_run(const Provenance& run) {
    document_.push_back(Heading{3, "Run " + short_id(run.id), run_anchor(run.id)});
    std::string libraries;
    for (const auto& [name, version] : run.libraries) {
      libraries += fmt::format("{}{} {}", libraries.empty() ? "" : ", ", name, version);
    }
    document_.push_back(
        Facts{{{"Time", run.time},
               {"Command", run.command},
               {"Code",
                fmt::format("git {}{}", run.git_revision, run.git_dirty ? ", with uncommitted changes" : "")},
               {"Compiler", fmt::format("{}, {}, {}", run.compiler, run.build_type, run.flags)},
               {"Processor", fmt::format("{}, {} threads used, {}", run.cpu, run.threads, run.simd)},
               {"Memory", fmt::format("{:.1f} GiB", static_cast<double>(run.memory) / (1 << 30))},
               {"System", run.os},
               {"Renderer", run.gl_renderer},
               {"Libraries", libraries},
               {"Digest", run.id}}});
  }

  // What was measured, on what: one line a case.
  void add_inputs() {
    Table table{"inputs",
                "What was measured",
                "Every case with its seed, its ground and the checksum of that ground.",
                {{"Experiment", "", false},
                 {"Case", "", false},
                 {"Seed", "", true},
                 {"Terrain", "", false},
                 {"Checksum", "", false},
                 {"Parameters", "", false},
                 {"Run", "", false}},
                {}};
    for (const Record& record : store_.records()) {
      if (record.profile != check_.profile) continue;
      std::string parameters;
      for (const auto& [name, value] : record.parameters) {
        parameters += fmt::format("{}{}={}", parameters.empty() ? "" : " ", name, to_string(value));
      }
      table.rows.push_back({{record.experiment, "", "", ""},
                            {record.case_name, "", "", ""},
                            {std::to_string(record.seed), "", "", ""},
                            {record.terrain, "", "", ""},
                            {record.terrain_checksum, "", "", ""},
                            {parameters, "", "", ""},
                            {short_id(record.run), "", "#" + run_anchor(record.run), ""}});
    }
    add_table(std::move(table), {});
  }

  const Store& store_;
  std::span<const Paper> papers_;
  const std::filesystem::path& out_;
  CheckReport check_;
  Document document_;
  std::set<std::string> claimed_;  // ids of pictures that belong to a row
};

}  // namespace

std::filesystem::path write_report(const std::filesystem::path& folder) {
  return write_report(Store::open(folder), papers());
}

std::filesystem::path write_report(const Store& store, std::span<const Paper> papers) {
  const std::filesystem::path target = store.folder() / "report";
  Draft draft(target);
  Report(store, papers, draft.path()).write();
  draft.publish();
  return target / "index.html";
}

}  // namespace terrabench
