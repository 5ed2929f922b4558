// The report as a list of blocks, written as one self-contained HTML page and as Markdown.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "results/report/table.h"

namespace terrabench {

// The target is a relative file, or #id. Each page is written as HTML and as Markdown, and links
// lead to pages of the same format. In a target, a leading "main" is replaced by the main page's file name
// (by nothing on the main page itself), and ".*" by the format's extension.
struct Link {
  std::string text, target;
};
struct PageForm {
  std::string_view extension, main_page;
};
inline constexpr PageForm kHtmlForm{"html", "index.html"}, kMarkdownForm{"md", "report.md"};

struct Heading {
  int level;  // 1 is the page's title, 2 appears in the table of contents
  std::string text, id;
};
struct Paragraph {
  std::string text;
  bool warning = false;
  std::vector<Link> links = {};  // on a line of their own
};
// Terms with their meanings, one per line.
struct Facts {
  std::vector<std::pair<std::string, std::string>> lines;
};
struct TableBlock {
  Table table;
  std::vector<Link> links;  // to its runs and its other file forms
  bool filter = false;      // HTML: with a field that filters the rows by text
};
struct Picture {
  std::string title, caption, file;  // a click leads to the file
  std::vector<Link> links;
  std::string anchor = {};  // id of the picture, for links to it; empty: none
};
// Pictures side by side where they fit; a single picture is wide.
struct Gallery {
  std::vector<Picture> pictures;
};

using Block = std::variant<Heading, Paragraph, Facts, TableBlock, Gallery>;
using Document = std::vector<Block>;

std::string html(const Document&);
std::string markdown(const Document&);

// Writes both forms of a page. `stem`: its name without the extension; empty for the main page, which begins
// with `first_line` in HTML.
void write_page(const std::filesystem::path& folder, std::string_view stem, const Document&,
                std::string_view first_line = "");

}  // namespace terrabench
