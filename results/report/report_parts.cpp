#include "results/report/report_parts.h"

#include <algorithm>
#include <iterator>

#include "results/plot/plot.h"
#include "results/report/fill.h"
#include "results/report/report_tables.h"
#include "terrain/files.h"

namespace terrabench {
namespace {

std::vector<Link> run_links(const std::vector<std::string>& runs) {
  std::vector<Link> links;
  for (const std::string& run : runs) links.push_back({"run " + short_id(run), "main#" + run_anchor(run)});
  return links;
}

void append(Document& document, Document blocks) { std::ranges::move(blocks, std::back_inserter(document)); }

}  // namespace

TableBlock ReportParts::table(Table table, const std::vector<std::string>& runs) {
  const std::string file = "tables/" + file_name(table.id) + ".csv";
  write_file(out_ / file, csv(table));
  links_.shown.insert(table.id);
  std::vector<Link> links = run_links(runs);
  links.push_back({"CSV", file});
  return {std::move(table), std::move(links)};
}

Document ReportParts::tables(const Paper& paper, std::string_view page) {
  Document blocks;
  for (const TableLayout& layout : paper.tables) {
    if (layout.page != page) continue;
    FilledTable filled = fill(layout, store_, results_);
    if (!filled.runs.empty()) blocks.push_back(table(std::move(filled.table), filled.runs));
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
    blocks.push_back(Gallery{{{layout.title, layout.caption, file, run_links(filled.runs), layout.id}}});
  }
  return blocks;
}

Document ReportParts::pictures(const std::vector<ShownPicture>& shown) {
  Gallery gallery;
  for (const auto& [record, figure, title, caption] : shown) {
    if (!store_.intact(*figure)) continue;
    const std::string file = picture_file(*figure);
    links_.pictures.insert(file);
    gallery.pictures.push_back({title, caption, file, run_links({record->run})});
  }
  if (gallery.pictures.empty()) return {};
  return {std::move(gallery)};
}

bool ReportParts::write_ground_page(const Paper& paper, const PageLayout& layout, Document remarks,
                                    std::string elsewhere, std::vector<Link> links) {
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
  if (page.size() == empty) return false;
  page.push_back(Heading{2, "Other pages", "pages"});
  page.push_back(Paragraph{std::move(elsewhere), false, std::move(links)});
  write_page(out_, ground_page(layout.id), page);
  return true;
}

}  // namespace terrabench
