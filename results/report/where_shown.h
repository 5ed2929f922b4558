// Which table or plot of the report shows the numbers of a claim. The ledger's rows link to it.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "results/claims/claims.h"
#include "results/store/store.h"

namespace terrabench {

// Ids of the tables and plots that the report contains.
using ShownIds = std::set<std::string, std::less<>>;

// An index over the layouts of all tables and plots. It points into the papers, which must outlive it.
class WhereShown {
 public:
  struct Layout {
    std::string_view id, title;  // of the table or plot; the id is its anchor on the page
    std::string_view ground;     // PageLayout::id of that page; empty for the main page
  };
  struct Place {
    Layout layout;
    bool same_quantity;  // false: it shows a case that the claim reads, but other metrics of that case
  };

  // Tables and plots that are not among those shown are left out. O(n log n) for n cells and points.
  WhereShown(std::span<const Paper>, const ShownIds&);

  // The first table with a row that names the claim; otherwise the first table, or else plot, that shows one
  // of the metrics that the claim reads; otherwise the one that shows the most similarly named metric of a
  // case that the claim reads. None if no such case was measured in this profile and is shown.
  std::optional<Place> find(const Claim&, const Store&, std::string_view profile) const;

 private:
  struct Shown {
    std::string metric;
    Layout layout;
  };
  void add(const TableLayout&);
  void add(const PlotLayout&);
  void add(std::string_view experiment, std::string_view case_name, const std::string& metric,
           const Layout& layout);

  std::map<std::string_view, Layout> by_claim_;  // claims' ids; other texts of a table's rows do no harm
  // By experiment and case; tables before plots, both in the papers' order.
  std::map<std::pair<std::string_view, std::string_view>, std::vector<Shown>> by_case_;
};

}  // namespace terrabench
