#include "results/report/ground_page.h"

#include <fmt/format.h>

#include <utility>

#include "results/report/report_tables.h"

namespace terrabench {
namespace {

std::string title(const PageLayout& layout) { return "Ground " + layout.label; }

// Makes the block's links to places on the main page lead there from another page.
Block from_another_page(Block block, std::string_view main_page) {
  const auto lead = [&](std::vector<Link>& links) {
    for (Link& link : links) {
      if (link.target.starts_with('#')) link.target = fmt::format("{}{}", main_page, link.target);
    }
  };
  if (auto* const table = std::get_if<TableBlock>(&block)) lead(table->links);
  if (auto* const gallery = std::get_if<Gallery>(&block)) {
    for (Picture& picture : gallery->pictures) lead(picture.links);
  }
  return block;
}

}  // namespace

std::string page_file(std::string_view ground, const ReportForm& form) {
  if (ground.empty()) return std::string(form.main_page);
  return fmt::format("ground-{}.{}", file_name(ground), form.extension);
}

Document ground_page(const GroundPage& page, const ReportForm& form) {
  Document document = {Heading{1, title(*page.layout), "top"}, Paragraph{page.layout->about}};
  document.insert(document.end(), page.remarks.begin(), page.remarks.end());
  const auto add_part = [&](const char* heading, const char* id, const Document& blocks) {
    if (blocks.empty()) return;
    document.push_back(Heading{2, heading, id});
    for (const Block& block : blocks) document.push_back(from_another_page(block, form.main_page));
  };
  add_part("Tables", "tables", page.tables);
  add_part("Plots", "plots", page.plots);
  add_part("Pictures", "pictures", page.pictures);
  document.push_back(Heading{2, "Other pages", "pages"});
  document.push_back(Paragraph{page.elsewhere,
                               false,
                               {{page.section.text, fmt::format("{}{}", form.main_page, page.section.target)},
                                {"Report", std::string(form.main_page)},
                                {"Ledger", fmt::format("ledger.{}", form.extension)}}});
  return document;
}

std::vector<Link> ground_links(std::span<const PageLayout> layouts, const ReportForm& form) {
  std::vector<Link> links;
  for (const PageLayout& layout : layouts) links.push_back({title(layout), page_file(layout.id, form)});
  return links;
}

Table ground_table(std::string id, std::string title, std::span<const PageLayout> layouts) {
  Table table{std::move(id),
              std::move(title),
              "Each has the tables, plots and pictures that show that ground alone.",
              {{"Ground"}, {"What it is"}, {"As Markdown"}},
              {}};
  for (const PageLayout& layout : layouts) {
    const std::string markdown_file = page_file(layout.id, kMarkdownForm);
    table.rows.push_back({{layout.label, "", page_file(layout.id, kHtmlForm)},
                          {layout.about},
                          {markdown_file, "", markdown_file}});
  }
  return table;
}

}  // namespace terrabench
