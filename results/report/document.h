// The report as a list of blocks, written as one self-contained HTML page and as Markdown.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "results/report/table.h"

namespace terrabench {

struct Link {
  std::string text, target;  // a relative file, or #id
};

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
  std::string title, caption, file;  // file: for HTML
  std::string bitmap;                // for Markdown, when it differs
  std::vector<Link> links;
  std::string original = {};  // at full size, where a click leads; empty: the file
  std::string anchor = {};    // id of the picture, for links to it; empty: none
};
// Pictures side by side where they fit; a single picture is wide.
struct Gallery {
  std::vector<Picture> pictures;
};

using Block = std::variant<Heading, Paragraph, Facts, TableBlock, Gallery>;
using Document = std::vector<Block>;

std::string html(const Document&);
std::string markdown(const Document&);

}  // namespace terrabench
