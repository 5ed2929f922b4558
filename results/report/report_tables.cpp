#include "results/report/report_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "results/claims/statements.h"
#include "results/report/fill.h"
#include "results/store/format.h"
#include "terrain/files.h"

namespace terrabench {

std::string where_and_statement(const Claim& claim) { return claim.where + ": " + claim.statement; }

std::string reported_text(const Claim& claim) {
  std::string text;
  for (const double value : claim.reported) {
    text += (text.empty() ? "" : ", ") + format_quantity(value, claim.unit);
  }
  return text.empty() ? "–" : text;
}

std::string file_name(std::string_view id) {
  std::string name(id);
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.' && c != '-' && c != '_') c = '_';
  }
  if (name.starts_with('.')) name[0] = '_';
  return name == id ? name : name + "-" + checksum(id).substr(0, 8);
}

std::string url_path(std::string_view path) {
  std::string url;
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = byte < 0x80 && (std::isalnum(byte) != 0 ||
                                       std::string_view("-._~/").find(c) != std::string_view::npos);
    url += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return url;
}

std::string ground_page(std::string_view ground) { return "ground-" + file_name(ground); }

Table ground_table(std::string id, std::string title, std::span<const PageLayout> layouts) {
  Table table{std::move(id),
              std::move(title),
              "Each has the tables, plots and pictures that show that ground alone.",
              {{"Ground"}, {"What it is"}},
              {}};
  for (const PageLayout& layout : layouts) {
    table.rows.push_back({{layout.label, "", ground_page(layout.id) + ".*"}, {layout.about}});
  }
  return table;
}

std::string short_id(const std::string& run) { return run.substr(0, 8); }
std::string run_anchor(const std::string& run) { return "run-" + short_id(run); }

std::string standings_sentence(const JudgedResults& results) {
  const std::vector<Statement> of_papers = statements(results.judgements);
  std::string text;
  for (const auto& [group, counts] : count_standings(of_papers)) {
    constexpr std::string_view kWhat[] = {"Statements of the papers in numbers or comparisons",
                                          "Figures drawn", "Asked beyond the papers"};
    text += fmt::format("{}{}: {}, of which {}", text.empty() ? "" : " ",
                        kWhat[static_cast<std::size_t>(group)], sum(counts), counts_text(counts, group));
    const int everywhere = count_everywhere(of_papers, group);
    if (counts[0] > everywhere)
      text +=
          fmt::format(" (of those that hold, {} on every further ground and in every setting)", everywhere);
    text += '.';
  }
  return text;
}

Table summary_table(const JudgedResults& results, std::span<const Paper> papers) {
  Table table{
      "summary",
      "Verdicts",
      "Of the numbers and comparisons that each paper states, how many hold as printed, hold only in another "
      "reading of the same words, do not hold, and are not judged: not measured in this profile, or not "
      "comparable. On every ground and setting: of those that were measured. Apart from "
      "them: "
      "figures whose picture shows what the paper's does, and what we ask "
      "beyond the paper, which says nothing about it.",
      {{"Paper"}, {"statements", "", true}},
      {}};
  for (const Standing standing : kStandings) {
    table.columns.push_back({std::string(name(standing, Group::kStated)), "", true});
    if (standing == Standing::kAsPrinted)
      table.columns.push_back({"of these, on every ground and setting", "", true});
  }
  for (const char* const column : {"figures drawn that hold", "our own questions, hold"})
    table.columns.push_back({column, "", true});
  const auto add = [&](const std::string& title, std::span<const Judgement> judgements) {
    const std::vector<Statement> of_paper = statements(judgements);
    std::map<Group, StandingCounts> counts = count_standings(of_paper);
    const auto share = [&](Group group) -> Cell {
      const int all = sum(counts[group]);
      return {all == 0 ? "–" : fmt::format("{} of {}", counts[group][0], all)};
    };
    const StandingCounts& stated = counts[Group::kStated];
    const int all = sum(stated);
    std::vector<Cell> cells = {{title}, {all == 0 ? "–" : std::to_string(all)}};
    for (const Standing standing : kStandings) {
      const auto show = [&](int count) { cells.push_back({all == 0 ? "–" : std::to_string(count)}); };
      show(stated[static_cast<std::size_t>(standing)]);
      if (standing == Standing::kAsPrinted) show(count_everywhere(of_paper, Group::kStated));
    }
    cells.insert(cells.end(), {share(Group::kFigure), share(Group::kBeyond)});
    table.rows.push_back(std::move(cells));
  };
  for (const Paper& paper : papers) add(paper.title, results.of(paper));
  if (papers.size() > 1) add("All", results.judgements);
  return table;
}

Facts claim_notes(const JudgedResults& results, const Paper& paper) {
  Facts notes;
  for (const Judgement& judgement : results.of(paper)) {
    const Claim& claim = *judgement.claim;
    if (claim.note.empty()) continue;
    // Claims of one table often share a note.
    if (!notes.lines.empty() && notes.lines.back().second == claim.note) {
      notes.lines.back().first += ", " + claim.id;
    } else {
      notes.lines.emplace_back(claim.id, claim.note);
    }
  }
  return notes;
}

namespace {

Facts run_facts(const Provenance& run) {
  std::string libraries;
  for (const auto& [name, version] : run.libraries) {
    libraries += fmt::format("{}{} {}", libraries.empty() ? "" : ", ", name, version);
  }
  Facts facts{
      {{"Time", run.time},
       {"Command", run.command},
       {"Code", fmt::format("git {}{}", run.git_revision, run.git_dirty ? ", with uncommitted changes" : "")},
       {"Compiler", fmt::format("{}, {}, {}", run.compiler, run.build_type, run.flags)},
       {"Processor", fmt::format("{}, {} threads used, {}", run.cpu, run.threads, run.simd)},
       {"Memory", fmt::format("{:.1f} GiB", static_cast<double>(run.memory) / (1 << 30))},
       {"System", run.os},
       {"Renderer", run.gl_renderer},
       {"Libraries", libraries},
       {"Digest", run.id}}};
  if (!run.timing_warnings.empty()) {
    facts.lines.emplace_back("Times", fmt::format("untrustworthy: {}", fmt::join(run.timing_warnings, "; ")));
  }
  return facts;
}

}  // namespace

Document provenance(const Store& store) {
  Document document{Heading{2, "Provenance", "provenance"}};
  std::vector<const Provenance*> runs;
  for (const Record& record : store.records()) {
    const Provenance* const run = store.run(record.run);
    if (run == nullptr || std::ranges::count(runs, run) > 0) continue;
    runs.push_back(run);
    document.push_back(Heading{3, "Run " + short_id(run->id), run_anchor(run->id)});
    document.push_back(run_facts(*run));
  }
  return document;
}

Table absence_table(const JudgedResults& results) {
  Table table{
      "absences",
      "Without measurements",
      "Cases that failed or were skipped, and quantities that are not defined, such as an error relative to "
      "a relief of 0. Tables show these words in their place.",
      {{"What"}, {"Reason"}, {"Cases"}},
      {}};
  for (const Absence& absence : results.absences) {
    table.rows.push_back(
        {{absence.what}, {absence.reason}, {fmt::format("{}", fmt::join(absence.where, "; "))}});
  }
  return table;
}

Table input_table(const Store& store, std::string_view profile) {
  Table table{
      "inputs",
      "",
      "",
      {{"Experiment"}, {"Case"}, {"Seed", "", true}, {"Terrain"}, {"Checksum"}, {"Parameters"}, {"Run"}},
      {}};
  for (const Record& record : store.records()) {
    if (record.profile != profile) continue;
    std::string parameters;
    for (const auto& [name, value] : record.parameters) {
      parameters += fmt::format("{}{}={}", parameters.empty() ? "" : " ", name, to_string(value));
    }
    table.rows.push_back({{record.experiment},
                          {record.case_name},
                          {std::to_string(record.seed)},
                          {record.terrain},
                          {record.terrain_checksum},
                          {parameters},
                          {short_id(record.run)}});
  }
  return table;
}

}  // namespace terrabench
