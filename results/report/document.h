// A page of the report as a list of blocks, written as HTML and as Markdown. site.h puts pages together.
#pragma once

#include <algorithm>
#include <array>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "results/report/table.h"

namespace terrabench {

// The target is a relative file, or #id; none: the text is a command, shown as such. In a target, ".*" is
// replaced by the extension of the page's form, so that links lead to pages of the same form.
struct Link {
  std::string text, target = {};
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
// What a reader may want next, with the command that does it, side by side where they fit.
struct Doors {
  std::vector<std::pair<std::string, std::string>> commands;
};
// HTML: a field whose words open `page` with its rows filtered by them. It needs the script; without it and
// in Markdown there is none.
struct Search {
  std::string label, page;
};
struct TableBlock {
  Table table;
  std::vector<Link> links;  // to its runs and its other file forms
  bool search = false;      // HTML: Search fills the field that filters its rows
};
// A part of a picture, in pixels.
struct NamedPanel {
  std::string name;
  int x, y, width, height;
};
struct Picture {
  std::string title, caption, file;
  std::vector<Link> links;
  std::string anchor = {};  // id of the picture, for links to it; empty: none
  std::string target = {};  // where a click leads; empty: to the file
  // HTML: any two of these can be laid over each other, with a slider between them. Needs the script.
  std::vector<NamedPanel> panels = {};
  int width = 0, height = 0;  // pixels, so that the page knows its place before it is loaded; 0: not known
};
// Pictures side by side where they fit; a single picture is wide. In a strip all have one shape, which may
// cut their borders off.
struct Gallery {
  std::vector<Picture> pictures;
  bool strip = false;
};
// Stacked bars of counts, all to one scale; parts that are 0 in all bars are not shown. Markdown: a table.
struct Bars {
  static constexpr std::size_t kParts = 7;
  struct Bar {
    Link label;
    std::string anchor;
    std::array<int, kParts> counts;
    std::string note;
  };
  std::string id, title, caption;
  std::array<std::string, kParts> parts;  // names; each has a colour of its own, the last three are hollow
  std::string notes;                      // what the bars' notes are about
  std::vector<Bar> bars;

  bool shows(std::size_t part) const {
    return std::ranges::any_of(bars, [&](const Bar& bar) { return bar.counts[part] > 0; });
  }
};

using Block = std::variant<Heading, Paragraph, Facts, Doors, Search, TableBlock, Gallery, Bars>;
using Document = std::vector<Block>;
inline void append(Document& to, Document blocks) { std::ranges::move(blocks, std::back_inserter(to)); }

// `navigation`: to the other pages. The targets of links are taken as they are.
using Navigation = std::vector<std::pair<std::string, std::vector<Link>>>;  // by the name of a group, or ""
std::string html(const Document&, const Navigation& = {});
std::string markdown(const Document&, const Navigation& = {});

}  // namespace terrabench
