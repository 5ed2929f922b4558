#include "results/report/report_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <set>

#include "results/plot/plot.h"
#include "results/report/report_tables.h"
#include "results/store/provenance.h"
#include "terrain/files.h"

namespace terrabench {
namespace {

// "12–14, 20 and 7 more" of line numbers in rising order.
std::string ranges(const std::vector<std::size_t>& lines) {
  constexpr int kShown = 4;
  std::string text;
  int shown = 0;
  for (std::size_t i = 0; i < lines.size(); ++shown) {
    if (shown == kShown) return fmt::format("{} and {} more", text, lines.size() - i);
    std::size_t last = i;
    while (last + 1 < lines.size() && lines[last + 1] == lines[last] + 1) ++last;
    text += fmt::format("{}{}", text.empty() ? "" : ", ", lines[i]);
    if (last > i) text += fmt::format("–{}", lines[last]);
    i = last + 1;
  }
  return text;
}

// Whether it has letters, digits and these characters alone, so that a shell takes it as one word.
bool is_plain(std::string_view name, std::string_view others) {
  return std::ranges::all_of(name, [&](unsigned char c) {
    return std::isalnum(c) != 0 || others.find(static_cast<char>(c)) != others.npos;
  });
}

// The case arguments of `run` that select these records, as " 'real-257/fitted'" or, if they only begin
// alike, " 'real-257/*'"; empty if they do not.
std::string cases_of(const std::vector<const Record*>& records) {
  const std::string& first = records.front()->case_name;
  const auto all = [&](auto holds) {
    return std::ranges::all_of(records,
                               [&](const Record* r) { return holds(std::string_view(r->case_name)); });
  };
  if (!is_plain(first, "._-/=%")) return "";
  if (all([&](std::string_view name) { return name == first; })) return fmt::format(" '{}'", first);
  const std::string ground = first.substr(0, first.find('/')) + "/";
  if (ground.size() > first.size()) return "";
  return all([&](std::string_view name) { return name.starts_with(ground); }) ? fmt::format(" '{}*'", ground)
                                                                              : "";
}

// What measures these records again. Empty if a name is not plain, or if other options are needed: a file of
// the user's, parameters, a seed.
std::string command_for(const std::vector<const Record*>& records, const Store& store) {
  std::string command = "terrabench run", profile = records.front()->profile;
  std::set<std::string_view> seen;
  for (const Record* const record : records) {
    if (!is_plain(record->experiment, "._-") || !is_plain(record->profile, "")) return "";
    const bool is_file = record->terrain.find_first_of("./:") != std::string::npos;  // not one of ours
    if (!record->overrides.empty() || record->seed != 1 || is_file) return "";
    if (seen.insert(record->experiment).second) command += " " + record->experiment;
    // Kept with the measurements of another profile.
    const Provenance* const run = store.run(record->run);
    if (run != nullptr && run->command.find("--profile scale") != run->command.npos) profile = "scale";
  }
  return command + cases_of(records) + " --profile " + profile;
}

}  // namespace

std::vector<Link> ReportParts::links_to_runs(const std::vector<std::string>& runs) const {
  std::vector<Link> links;
  for (const std::string& id : runs) {
    links.push_back(
        {fmt::format("run {}{}", short_id(id), uncertain_.contains(id) ? ", times uncertain" : ""),
         "runs.*#" + run_anchor(id)});
  }
  return links;
}

std::vector<Link> ReportParts::sources(const std::vector<std::string>& runs,
                                       const std::vector<const Record*>& records) const {
  std::vector<Link> links = links_to_runs(runs);
  if (records.empty()) return links;
  std::set<std::size_t> lines;
  for (const Record* const record : records) lines.insert(store_.line(*record));
  links.push_back({fmt::format("measurements.jsonl, line{} {}", lines.size() == 1 ? "" : "s",
                               ranges({lines.begin(), lines.end()})),
                   "../measurements.jsonl"});
  if (std::string command = command_for(records, store_); !command.empty())
    links.push_back({std::move(command)});
  return links;
}

TableBlock ReportParts::table(FilledTable filled) {
  Table& table = filled.table;
  const std::string file = "tables/" + file_name(table.id) + ".csv";
  write_file(out_ / file, csv(table));
  links_.shown.insert(table.id);
  std::vector<Link> links = sources(filled.runs, filled.records);
  links.insert(links.begin(), {"CSV", file});
  return {std::move(table), std::move(links)};
}

Document ReportParts::tables(const Paper& paper, std::string_view page) {
  Document blocks;
  for (const TableLayout& layout : paper.tables) {
    if (layout.page != page) continue;
    FilledTable filled = fill(layout, store_, results_);
    if (!filled.runs.empty()) blocks.push_back(table(std::move(filled)));
  }
  return blocks;
}

Document ReportParts::plots(const Paper& paper, std::string_view page) {
  Document blocks;
  for (const PlotLayout& layout : paper.plots) {
    if (layout.page != page) continue;
    const FilledPlot filled = fill(layout, store_, results_.profile);
    if (filled.runs.empty()) continue;  // the paper's own curve is not shown alone
    const std::string file = "figures/" + file_name(layout.id) + ".svg";
    write_file(out_ / file, plot_svg(filled.plot));
    links_.shown.insert(layout.id);
    std::vector<Link> links = sources(filled.runs, filled.records);
    links.insert(links.begin(), {"SVG", file});
    const PlotSize size = screen_size(filled.plot);
    blocks.push_back(Gallery{{{.title = layout.title,
                               .caption = layout.caption,
                               .file = file,
                               .links = std::move(links),
                               .anchor = layout.id,
                               .width = size.width,
                               .height = size.height}}});
  }
  return blocks;
}

Document ReportParts::pictures(const std::vector<ShownPicture>& shown) {
  Gallery gallery;
  for (const auto& [record, figure, title, caption] : shown) {
    if (!store_.intact(*figure)) continue;
    const std::string file = picture_file(*figure);
    links_.pictures.insert(file);
    gallery.pictures.push_back(
        {title, caption, file, sources({record->run}, {record}), "", "", comparable_panels(figure->layout)});
  }
  if (gallery.pictures.empty()) return {};
  return {std::move(gallery)};
}

Document ReportParts::ground_page(const Paper& paper, const PageLayout& layout, Document remarks) {
  Document page{Heading{1, "Ground " + layout.label, "top"}, Paragraph{layout.about}};
  append(page, std::move(remarks));
  const std::size_t empty = page.size();
  const auto add_part = [&](const char* heading, const char* id, Document blocks) {
    if (blocks.empty()) return;
    page.push_back(Heading{2, heading, id});
    append(page, std::move(blocks));
  };
  add_part("Tables", "tables", tables(paper, layout.id));
  add_part("Plots", "plots", plots(paper, layout.id));
  Document shown;
  const auto show = [&](std::span<const PageLayout::Drawn> cases) {
    append(shown, pictures(drawn_pictures(store_, results_.profile, cases, layout.label)));
  };
  for (const PageLayout::Drawn& sheet : layout.sheets) show(std::span(&sheet, 1));
  show(layout.pictures);
  add_part("Pictures", "pictures", std::move(shown));
  return page.size() == empty ? Document() : page;
}

}  // namespace terrabench
