// A table, written as HTML, Markdown, CSV and LaTeX (booktabs), each escaped.
#pragma once

#include <string>
#include <vector>

namespace terrabench {

struct Cell {
  std::string text;         // as people read it
  std::string raw = "";     // what CSV holds instead, such as all digits; empty: the text
  std::string link = "";    // HTML and Markdown: where the text points; empty: nowhere
  std::string style = "";   // HTML class of the cell
  std::string anchor = "";  // HTML and Markdown: id of the cell, for links to it; empty: none
};

struct Column {
  std::string title, unit = "";
  bool numeric = false;  // aligned right
};

struct Table {
  std::string id, title, caption;
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;  // each as long as columns
};

std::string heading(const Column&);  // "Size [B]"

std::string html(const Table&);      // <table> with caption and scopes
std::string markdown(const Table&);  // pipes; without the caption
std::string csv(const Table&);       // RFC 4180, units in the header
// A float, or a longtable where it is longer than a page. Needs the packages array, booktabs, longtable,
// pdflscape and [T1]{fontenc}, UTF-8, and lines at least 174 mm long.
std::string latex(const Table&);

}  // namespace terrabench
