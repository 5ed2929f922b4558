// The report's page of one ground: all its tables, then its plots, then its pictures, which would otherwise
// stand among those of other grounds. A claims file says what belongs to it (layouts.h, PageLayout).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "results/claims/claims.h"
#include "results/report/document.h"

namespace terrabench {

// The report is written in two forms. Pages of a form lead to each other.
struct ReportForm {
  std::string_view extension, main_page;
};
inline constexpr ReportForm kHtmlForm{"html", "index.html"}, kMarkdownForm{"md", "report.md"};

struct GroundPage {
  const PageLayout* layout = nullptr;
  std::string elsewhere;             // what `section` holds, as words before the link; ends in ':'
  Link section;                      // to a section of the main page, "#id"
  Document remarks;                  // the profile, and warnings
  Document tables, plots, pictures;  // a link to "#id" means that place on the report's main page

  bool empty() const { return tables.empty() && plots.empty() && pictures.empty(); }
};

// "ground-caves.html", relative to the report's folder; of an empty id, the main page.
std::string page_file(std::string_view ground, const ReportForm&);
Document ground_page(const GroundPage&, const ReportForm&);

// Links to the pages in one form.
std::vector<Link> ground_links(std::span<const PageLayout>, const ReportForm&);
// The pages with links to both forms, for the main page.
Table ground_table(std::string id, std::string title, std::span<const PageLayout>);

}  // namespace terrabench
