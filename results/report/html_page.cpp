#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "results/claims/embedded.h"
#include "results/report/document.h"
#include "results/store/format.h"

namespace terrabench {
namespace {

// Tables with more rows have a field that filters them.
constexpr std::size_t kRowsToScan = 12;

std::string html_link(const Link& link, std::string_view attributes = "") {
  if (link.target.empty()) return fmt::format("<code>{}</code>", escape_html(link.text));
  return fmt::format("<a href=\"{}\"{}>{}</a>", escape_html(link.target), attributes, escape_html(link.text));
}

std::string links_line(const std::vector<Link>& links) {
  std::string text;
  for (const Link& link : links) text += (text.empty() ? "" : " · ") + html_link(link);
  return text.empty() ? "" : fmt::format("<p class=\"links\">{}</p>\n", text);
}

std::string id_attribute(const std::string& id) {
  return id.empty() ? "" : fmt::format(" id=\"{}\"", escape_html(id));
}

// Hidden until the script shows it: without scripts there is nothing to fill in, and all rows are shown.
std::string filter_field(const TableBlock& block) {
  return fmt::format(
      "<p class=\"filter scripted\" data-table=\"{}\"{} hidden><label>Show rows with <input type=\"search\" "
      "placeholder=\"all of these words\"></label> <output></output></p>\n",
      escape_html(block.table.id), block.search ? " data-search" : "");
}

// For the script: "x y width height NAME", a line per panel.
std::string panels_attribute(const std::vector<NamedPanel>& panels) {
  std::string lines;
  for (const NamedPanel& p : panels) {
    lines += fmt::format("{}{} {} {} {} {}", lines.empty() ? "" : "&#10;", p.x, p.y, p.width, p.height,
                         escape_html(p.name));
  }
  return lines.empty() ? "" : fmt::format(" data-panels=\"{}\"", lines);
}

int total(const Bars::Bar& bar) { return std::reduce(bar.counts.begin(), bar.counts.end()); }

// `most`: the length of the longest bar.
std::string bar_row(const Bars& bars, const Bars::Bar& bar, int most) {
  std::string parts, words;
  for (std::size_t k = 0; k < Bars::kParts; ++k) {
    if (bar.counts[k] == 0) continue;
    const std::string named = fmt::format("{} {}", bar.counts[k], escape_html(bars.parts[k]));
    words += (words.empty() ? "" : ", ") + named;
    parts += fmt::format("<span class=\"part{0}\" style=\"flex-grow:{1}\" title=\"{2}\">{1}</span>", k,
                         bar.counts[k], named);
  }
  return fmt::format(
      "<li{}>{}<span class=\"bar\" role=\"img\" aria-label=\"{}\" style=\"--share:{:.3f}\">{}</span>"
      "<span class=\"note\">{}</span></li>\n",
      id_attribute(bar.anchor), html_link(bar.label), words,
      static_cast<double>(total(bar)) / std::max(most, 1), parts, escape_html(bar.note));
}

struct HtmlWriter {
  std::string text = "";

  void operator()(const Heading& h) {
    text += fmt::format("<h{0} id=\"{1}\">{2}</h{0}>\n", h.level, escape_html(h.id), escape_html(h.text));
  }
  void operator()(const Paragraph& p) {
    if (p.warning) {
      text += fmt::format("<div class=\"warning\" role=\"alert\">\n<p>{}</p>\n{}</div>\n",
                          escape_html(p.text), links_line(p.links));
      return;
    }
    if (!p.text.empty()) text += fmt::format("<p>{}</p>\n", escape_html(p.text));
    text += links_line(p.links);
  }
  void operator()(const Facts& facts) {
    text += "<dl>\n";
    for (const auto& [term, meaning] : facts.lines) {
      text += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escape_html(term), escape_html(meaning));
    }
    text += "</dl>\n";
  }
  void operator()(const Doors& doors) {
    text += "<ul class=\"doors\">\n";
    for (const auto& [purpose, command] : doors.commands) {
      text += fmt::format("<li>{}<code>{}</code></li>\n", escape_html(purpose), escape_html(command));
    }
    text += "</ul>\n";
  }
  void operator()(const Search& search) {
    text += fmt::format(
        "<form class=\"scripted\" action=\"{}\" hidden><label>{} <input type=\"search\" name=\"filter\" "
        "required></label> <button>Search</button></form>\n",
        escape_html(search.page), escape_html(search.label));
  }
  void operator()(const TableBlock& block) {
    if (block.search || block.table.rows.size() > kRowsToScan) text += filter_field(block);
    text += "<div class=\"table\">\n" + html(block.table) + "</div>\n" + links_line(block.links);
  }
  void operator()(const Gallery& gallery) {
    const bool wide = gallery.pictures.size() == 1 && !gallery.strip;
    text += fmt::format("<div class=\"{}\">\n", gallery.strip ? "strip" : wide ? "wide" : "gallery");
    for (const Picture& picture : gallery.pictures) add(picture);
    text += "</div>\n";
  }
  void operator()(const Bars& bars) {
    int most = 0;
    for (const Bars::Bar& bar : bars.bars) most = std::max(most, total(bar));
    text += fmt::format(
        "<figure class=\"bars\" id=\"{}\">\n<figcaption><strong>{}.</strong> {}</figcaption>\n<p "
        "class=\"legend\">",
        escape_html(bars.id), escape_html(bars.title), escape_html(bars.caption));
    for (std::size_t k = 0; k < Bars::kParts; ++k) {
      if (!bars.shows(k)) continue;
      text += fmt::format("<span><span class=\"part{}\"></span>{}</span> ", k, escape_html(bars.parts[k]));
    }
    text += "</p>\n<ul>\n";
    for (const Bars::Bar& bar : bars.bars) text += bar_row(bars, bar, most);
    text += "</ul>\n</figure>\n";
  }

 private:
  void add(const Picture& picture) {
    const std::string file = escape_html(picture.file), title = escape_html(picture.title),
                      caption = escape_html(picture.caption);
    const std::string size =
        picture.width == 0 ? "" : fmt::format(" width=\"{}\" height=\"{}\"", picture.width, picture.height);
    text += fmt::format(
        "<figure{}{}>\n<div class=\"{}\"><a href=\"{}\"><img src=\"{}\" alt=\"{}: {}\"{} "
        "loading=\"lazy\"></a></div>\n",
        id_attribute(picture.anchor), panels_attribute(picture.panels),
        picture.file.ends_with(".svg") ? "plot" : "picture",
        picture.target.empty() ? file : escape_html(picture.target), file, title, caption, size);
    text += fmt::format("<figcaption><strong>{}.</strong> {}</figcaption>\n{}</figure>\n", title, caption,
                        links_line(picture.links));
  }
};

std::string contents_of(const Document& document) {
  std::string items;
  int headings = 0;
  for (const Block& block : document) {
    const auto* const heading = std::get_if<Heading>(&block);
    if (heading == nullptr || heading->level != 2) continue;
    ++headings;
    items += fmt::format("<li>{}</li>\n", html_link({heading->text, "#" + heading->id}));
  }
  return headings < 3 ? "" : fmt::format("<nav aria-label=\"Contents\"><ul>\n{}</ul></nav>\n", items);
}

// Groups open by a click, without a script.
std::string links_to_pages(const Navigation& navigation) {
  std::string items;
  for (const auto& [group, links] : navigation) {
    std::string of_group;
    for (const Link& link : links) {
      of_group += fmt::format("<li>{}</li>\n",
                              html_link(link, link.target == "#top" ? " aria-current=\"page\"" : ""));
    }
    items += group.empty() ? of_group
                           : fmt::format("<li><details><summary>{}</summary><ul>\n{}</ul></details></li>\n",
                                         escape_html(group), of_group);
  }
  return items.empty()
             ? ""
             : fmt::format("<nav aria-label=\"Pages\" class=\"pages\"><ul>\n{}</ul></nav>\n", items);
}

}  // namespace

std::string html(const Document& document, const Navigation& navigation) {
  HtmlWriter writer;
  std::string title;
  for (const Block& block : document) {
    std::visit(writer, block);
    const auto* const heading = std::get_if<Heading>(&block);
    if (heading != nullptr && heading->level == 1) title = escape_html(heading->text);
  }
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n"
      "<style>\n{}</style>\n</head>\n<body>\n{}{}<main>\n{}</main>\n<script>\n{}</script>\n</body>\n</"
      "html>\n",
      title, embedded_style()[0].text, links_to_pages(navigation), contents_of(document), writer.text,
      embedded_script()[0].text);
}

}  // namespace terrabench
