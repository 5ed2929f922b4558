// The parts of the report's pages: each function writes the files of tables or plots into the report's folder
// and returns the blocks that show them, with links to their files and to the runs that they came from.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "results/report/ledger.h"
#include "results/report/shown_pictures.h"

namespace terrabench {

class ReportParts {
 public:
  // `out`: the report's folder. The store and the results must outlive the object.
  ReportParts(const Store& store, const JudgedResults& results, std::filesystem::path out)
      : store_(store), results_(results), out_(std::move(out)) {}

  // `runs`: ids of those that the table's figures come from; a link leads to the run on the main page.
  TableBlock table(Table, const std::vector<std::string>& runs);
  // The paper's tables and plots that stand on this page (TableLayout::page), without those of which nothing
  // was measured.
  Document tables(const Paper&, std::string_view page);
  Document plots(const Paper&, std::string_view page);
  // Shows pictures where they lie, outside the report's folder; one gallery, or nothing if all of them are
  // altered or gone.
  Document pictures(const std::vector<ShownPicture>&);
  // All that belongs to a ground, as a page in both forms. `elsewhere`: what other pages hold, as words
  // before the links to them. Returns whether there was anything to show.
  bool write_ground_page(const Paper&, const PageLayout&, Document remarks, std::string elsewhere,
                         std::vector<Link> links);

  // Tables, plots and pictures so far. For the ledger, which links to them.
  LedgerLinks& links() { return links_; }

 private:
  const Store& store_;
  const JudgedResults& results_;
  std::filesystem::path out_;
  LedgerLinks links_;
};

}  // namespace terrabench
