#include "results/report/table.h"

#include <fmt/format.h>

#include "results/store/format.h"

namespace terrabench {
namespace {

// The results of `write` for all entries, with separators between them.
template <class Entries, class Write>
std::string line(const Entries& entries, std::string_view separator, Write write) {
  std::string text;
  bool first = true;
  for (const auto& entry : entries) {
    if (!first) text += separator;
    text += write(entry);
    first = false;
  }
  return text;
}

// "1.5 ×" stays on one line.
std::string unbroken(std::string text) {
  for (std::size_t at = text.find(" ×"); at != text.npos; at = text.find(" ×", at))
    text.replace(at, 1, "\u00a0");
  return text;
}

std::string html_cell(const Cell& cell, const Column& column, bool heads_row) {
  const std::string words = unbroken(escape_html(cell.text));
  const std::string text =
      cell.link.empty() ? words : fmt::format("<a href=\"{}\">{}</a>", escape_html(cell.link), words);
  std::string style = cell.style;
  if (column.numeric) style += style.empty() ? "number" : " number";
  std::string attribute = cell.anchor.empty() ? "" : fmt::format(" id=\"{}\"", escape_html(cell.anchor));
  if (!style.empty()) attribute += fmt::format(" class=\"{}\"", escape_html(style));
  return heads_row ? fmt::format("<th scope=\"row\"{}>{}</th>", attribute, text)
                   : fmt::format("<td{}>{}</td>", attribute, text);
}

std::string markdown_cell(const Cell& cell) {
  std::string text = escape_markdown(cell.text);
  if (!cell.anchor.empty()) text = fmt::format("<a id=\"{}\"></a>", escape_html(cell.anchor)) + text;
  return cell.link.empty() ? text : fmt::format("[{}]({})", text, escape_markdown_target(cell.link));
}

}  // namespace

std::string heading(const Column& column) {
  return column.unit.empty() ? column.title : fmt::format("{} [{}]", column.title, column.unit);
}

std::string html(const Table& table) {
  std::string text =
      fmt::format("<table id=\"{}\">\n<caption><div><strong>{}.</strong> {}</div></caption>\n<thead><tr>",
                  escape_html(table.id), escape_html(table.title), escape_html(table.caption));
  for (const Column& column : table.columns) {
    text += fmt::format("<th scope=\"col\"{}>{}</th>", column.numeric ? " class=\"number\"" : "",
                        escape_html(heading(column)));
  }
  text += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    text += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) text += html_cell(row[i], table.columns[i], i == 0);
    text += "</tr>\n";
  }
  return text + "</tbody>\n</table>\n";
}

std::string markdown(const Table& table) {
  std::string text =
      "| " + line(table.columns, " | ", [](const Column& c) { return escape_markdown(heading(c)); });
  text +=
      " |\n|" + line(table.columns, "|", [](const Column& c) { return c.numeric ? "---:" : "---"; }) + "|\n";
  for (const auto& row : table.rows) text += "| " + line(row, " | ", markdown_cell) + " |\n";
  return text;
}

std::string csv(const Table& table) {
  std::string text =
      line(table.columns, ",", [](const Column& c) { return escape_csv(heading(c)); }) + "\r\n";
  for (const auto& row : table.rows) {
    text += line(row, ",", [](const Cell& c) { return escape_csv(c.raw.empty() ? c.text : c.raw); }) + "\r\n";
  }
  return text;
}

}  // namespace terrabench
