// The parts of the report's pages: each function writes the files of tables or plots into the report's folder
// and returns the blocks that show them, with links to their files and to the runs that they came from.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "results/report/fill.h"
#include "results/report/front_page.h"
#include "results/report/ledger.h"
#include "results/report/shown_pictures.h"

namespace terrabench {

class ReportParts {
 public:
  // `out`: the report's folder. The store and the results must outlive the object.
  ReportParts(const Store& store, const JudgedResults& results, std::filesystem::path out)
      : store_(store), results_(results), uncertain_(uncertain_runs(store)), out_(std::move(out)) {}

  // With links to the runs that the table's figures come from, and the command and the records of these.
  TableBlock table(FilledTable);
  TableBlock table(Table table) { return this->table(FilledTable{std::move(table), {}}); }
  // The paper's tables and plots that stand on this page (TableLayout::page), without those of which nothing
  // was measured.
  Document tables(const Paper&, std::string_view page);
  Document plots(const Paper&, std::string_view page);
  // Shows pictures where they lie, outside the report's folder; one gallery, or nothing if all of them are
  // altered or gone.
  Document pictures(const std::vector<ShownPicture>&);
  // The page with all that belongs to a ground; nothing if nothing of it was measured.
  Document ground_page(const Paper&, const PageLayout&, Document remarks);

  // Tables, plots and pictures so far. For the ledger, which links to them.
  LedgerLinks& links() { return links_; }

 private:
  std::vector<Link> links_to_runs(const std::vector<std::string>& runs) const;
  std::vector<Link> sources(const std::vector<std::string>& runs,
                            const std::vector<const Record*>& records) const;

  const Store& store_;
  const JudgedResults& results_;
  std::set<std::string, std::less<>> uncertain_;
  std::filesystem::path out_;
  LedgerLinks links_;
};

}  // namespace terrabench
