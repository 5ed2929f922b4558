#include <fmt/format.h>

#include "results/report/document.h"
#include "results/store/format.h"

namespace terrabench {
namespace {

std::string markdown_link(const Link& link) {
  return link.target.empty()
             ? fmt::format("`{}`", link.text)
             : fmt::format("[{}]({})", escape_markdown(link.text), escape_markdown_target(link.target));
}

std::string links_line(const std::vector<Link>& links) {
  std::string line;
  for (const Link& link : links) line += (line.empty() ? "" : " · ") + markdown_link(link);
  return line.empty() ? "" : line + "\n\n";
}

// One row per bar.
Table table_of(const Bars& bars) {
  Table table{bars.id, bars.title, bars.caption, {{"Paper"}}, {}};
  for (std::size_t k = 0; k < Bars::kParts; ++k) {
    if (bars.shows(k)) table.columns.push_back({bars.parts[k], "", true});
  }
  table.columns.push_back({bars.notes, "", true});
  for (const Bars::Bar& bar : bars.bars) {
    std::vector<Cell>& row = table.rows.emplace_back();
    row.push_back({.text = bar.label.text, .link = bar.label.target, .anchor = bar.anchor});
    for (std::size_t k = 0; k < Bars::kParts; ++k) {
      if (bars.shows(k)) row.push_back({std::to_string(bar.counts[k])});
    }
    row.push_back({bar.note});
  }
  return table;
}

struct MarkdownWriter {
  std::string text = "";

  void operator()(const Heading& h) {
    text += fmt::format("{} <a id=\"{}\"></a>{}\n\n", std::string(static_cast<std::size_t>(h.level), '#'),
                        escape_html(h.id), escape_markdown(h.text));
  }
  void operator()(const Paragraph& p) {
    if (!p.text.empty())
      text += fmt::format("{}{}\n\n", p.warning ? "> **Warning:** " : "", escape_markdown(p.text));
    text += links_line(p.links);
  }
  void operator()(const Facts& facts) {
    for (const auto& [term, meaning] : facts.lines) {
      text += fmt::format("- **{}**: {}\n", escape_markdown(term), escape_markdown(meaning));
    }
    text += "\n";
  }
  void operator()(const Doors& doors) {
    for (const auto& [purpose, command] : doors.commands) {
      text += fmt::format("- {}: `{}`\n", escape_markdown(purpose), command);
    }
    text += "\n";
  }
  void operator()(const Search&) {}
  void operator()(const TableBlock& block) {
    text += fmt::format("<a id=\"{}\"></a>**{}.** {}\n\n{}\n", escape_html(block.table.id),
                        escape_markdown(block.table.title), escape_markdown(block.table.caption),
                        markdown(block.table)) +
            links_line(block.links);
  }
  void operator()(const Gallery& gallery) {
    for (const Picture& picture : gallery.pictures) {
      if (!picture.anchor.empty()) text += fmt::format("<a id=\"{}\"></a>", escape_html(picture.anchor));
      const std::string image =
          fmt::format("![{}]({})", escape_markdown(picture.title), escape_markdown_target(picture.file));
      text += picture.target.empty() ? image
                                     : fmt::format("[{}]({})", image, escape_markdown_target(picture.target));
      text += fmt::format("\n\n**{}.** {}\n\n", escape_markdown(picture.title),
                          escape_markdown(picture.caption)) +
              links_line(picture.links);
    }
  }
  void operator()(const Bars& bars) { (*this)(TableBlock{table_of(bars), {}}); }
};

}  // namespace

std::string markdown(const Document& document, const Navigation& navigation) {
  MarkdownWriter writer;
  for (const Block& block : document) std::visit(writer, block);
  if (!navigation.empty()) writer.text += "---\n\n";
  for (const auto& [group, links] : navigation) {
    writer.text += (group.empty() ? "" : escape_markdown(group) + ": ") + links_line(links);
  }
  return writer.text;
}

}  // namespace terrabench
