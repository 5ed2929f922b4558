#include "results/report/document.h"

#include <fmt/format.h>

#include "results/claims/embedded.h"
#include "results/store/format.h"
#include "terrain/files.h"

namespace terrabench {
namespace {

struct HtmlWriter {
  std::string text = "";

  static std::string links(const std::vector<Link>& links) {
    std::string text;
    for (const Link& link : links) {
      text += fmt::format("{}<a href=\"{}\">{}</a>", text.empty() ? "" : " · ", escape_html(link.target),
                          escape_html(link.text));
    }
    return text.empty() ? "" : fmt::format("<p class=\"links\">{}</p>\n", text);
  }
  // Hidden until the script shows it: without scripts there is nothing to fill in, and all rows are shown.
  static std::string filter_field(const Table& table) {
    return fmt::format(
        "<p class=\"filter\" data-table=\"{}\" hidden><label>Show rows with <input type=\"search\" "
        "placeholder=\"all of these words\"></label> <output></output></p>\n",
        escape_html(table.id));
  }
  void operator()(const Heading& h) {
    text += fmt::format("<h{0} id=\"{1}\">{2}</h{0}>\n", h.level, escape_html(h.id), escape_html(h.text));
  }
  void operator()(const Paragraph& p) {
    text += fmt::format("<p{}>{}</p>\n", p.warning ? " class=\"warning\" role=\"alert\"" : "",
                        escape_html(p.text)) +
            links(p.links);
  }
  void operator()(const Facts& facts) {
    text += "<dl>\n";
    for (const auto& [term, meaning] : facts.lines) {
      text += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escape_html(term), escape_html(meaning));
    }
    text += "</dl>\n";
  }
  void operator()(const TableBlock& block) {
    if (block.filter) text += filter_field(block.table);
    text += "<div class=\"table\">\n" + html(block.table) + links(block.links) + "</div>\n";
    if (block.filter) text += fmt::format("<script>\n{}</script>\n", embedded_script()[0].text);
  }
  void operator()(const Gallery& gallery) {
    text += gallery.pictures.size() == 1 ? "<div class=\"wide\">\n" : "<div class=\"gallery\">\n";
    for (const Picture& picture : gallery.pictures) {
      const std::string file = escape_html(picture.file), title = escape_html(picture.title);
      const std::string id =
          picture.anchor.empty() ? "" : fmt::format(" id=\"{}\"", escape_html(picture.anchor));
      text += fmt::format(
          "<figure{4}>\n<a href=\"{0}\"><img src=\"{0}\" alt=\"{1}: {2}\" loading=\"lazy\"></a>\n"
          "<figcaption><strong>{1}.</strong> {2}</figcaption>\n{3}</figure>\n",
          file, title, escape_html(picture.caption), links(picture.links), id);
    }
    text += "</div>\n";
  }
};

struct MarkdownWriter {
  std::string text = "";

  void links(const std::vector<Link>& links) {
    std::string line;
    for (const Link& link : links) {
      line += fmt::format("{}[{}]({})", line.empty() ? "" : " · ", escape_markdown(link.text),
                          escape_markdown_target(link.target));
    }
    if (!line.empty()) text += line + "\n\n";
  }
  void operator()(const Heading& h) {
    text += fmt::format("{} <a id=\"{}\"></a>{}\n\n", std::string(static_cast<std::size_t>(h.level), '#'),
                        escape_html(h.id), escape_markdown(h.text));
  }
  void operator()(const Paragraph& p) {
    text += fmt::format("{}{}\n\n", p.warning ? "> **Warning:** " : "", escape_markdown(p.text));
    links(p.links);
  }
  void operator()(const Facts& facts) {
    for (const auto& [term, meaning] : facts.lines) {
      text += fmt::format("- **{}**: {}\n", escape_markdown(term), escape_markdown(meaning));
    }
    text += "\n";
  }
  void operator()(const TableBlock& block) {
    text += fmt::format("<a id=\"{}\"></a>**{}.** {}\n\n{}\n", escape_html(block.table.id),
                        escape_markdown(block.table.title), escape_markdown(block.table.caption),
                        markdown(block.table));
    links(block.links);
  }
  void operator()(const Gallery& gallery) {
    for (const Picture& picture : gallery.pictures) {
      if (!picture.anchor.empty()) text += fmt::format("<a id=\"{}\"></a>", escape_html(picture.anchor));
      text += fmt::format("![{0}]({1})\n\n**{0}.** {2}\n\n", escape_markdown(picture.title),
                          escape_markdown_target(picture.file), escape_markdown(picture.caption));
      links(picture.links);
    }
  }
};

// With the targets of all links as they are in that form.
Document in_form(Document document, const PageForm& form, bool is_main) {
  const auto resolve = [&](std::string& target) {
    if (target == "main" || target.starts_with("main#"))
      target.replace(0, 4, is_main ? std::string_view() : form.main_page);
    if (const std::size_t at = target.find(".*"); at != target.npos)
      target.replace(at + 1, 1, form.extension);
  };
  const auto resolve_all = [&](std::vector<Link>& links) {
    for (Link& link : links) resolve(link.target);
  };
  for (Block& block : document) {
    if (auto* const paragraph = std::get_if<Paragraph>(&block)) resolve_all(paragraph->links);
    if (auto* const gallery = std::get_if<Gallery>(&block)) {
      for (Picture& picture : gallery->pictures) resolve_all(picture.links);
    }
    if (auto* const table = std::get_if<TableBlock>(&block)) {
      resolve_all(table->links);
      for (std::vector<Cell>& row : table->table.rows) {
        for (Cell& cell : row) resolve(cell.link);
      }
    }
  }
  return document;
}

}  // namespace

void write_page(const std::filesystem::path& folder, std::string_view stem, const Document& document,
                std::string_view first_line) {
  for (const PageForm& form : {kHtmlForm, kMarkdownForm}) {
    const bool is_html = form.extension == kHtmlForm.extension, is_main = stem.empty();
    const Document page = in_form(document, form, is_main);
    const std::string file =
        is_main ? std::string(form.main_page) : fmt::format("{}.{}", stem, form.extension);
    write_file(folder / file, is_html ? std::string(first_line) + html(page) : markdown(page));
  }
}

std::string html(const Document& document) {
  std::string title, contents;
  for (const Block& block : document) {
    const auto* const heading = std::get_if<Heading>(&block);
    if (heading == nullptr) continue;
    if (heading->level == 1) title = escape_html(heading->text);
    if (heading->level != 2) continue;
    contents += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", escape_html(heading->id),
                            escape_html(heading->text));
  }
  HtmlWriter writer;
  for (const Block& block : document) std::visit(writer, block);
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n"
      "<style>\n{}</style>\n</head>\n<body>\n<nav "
      "aria-label=\"Contents\"><ul>\n{}</ul></nav>\n<main>\n{}</main>\n"
      "</body>\n</html>\n",
      title, embedded_style()[0].text, contents, writer.text);
}

std::string markdown(const Document& document) {
  MarkdownWriter writer;
  for (const Block& block : document) std::visit(writer, block);
  return writer.text;
}

}  // namespace terrabench
