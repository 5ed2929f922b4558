// The pages of a report. Each is written as HTML and as Markdown, and leads to all others.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "results/report/document.h"

namespace terrabench {

class Site {
 public:
  // `stem`: the page's name without the extension, "" for the main page. `group`: under which the navigation
  // lists it, by its label, in the order of addition; empty: beside the groups. The main page comes first.
  void add(std::string stem, std::string group, std::string label, Document);

  // `first_line`: what the main page begins with in HTML.
  void write(const std::filesystem::path& folder, std::string_view first_line) const;

 private:
  struct Page {
    std::string stem, group, label;
    Document document;
  };
  Navigation navigation_of(const Page&, const PageForm&) const;

  std::vector<Page> pages_;
};

}  // namespace terrabench
