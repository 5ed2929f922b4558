// Grounds that were measured and that no claims file names, such as a user's DEM: what the report shows of
// them. A claims file says with its [further] how its tables, plots, pictures and rankings are had for such a
// ground (toml_reader.h). "Which method for my ground" (advice.h) ranks the methods there.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "results/claims/claims.h"
#include "results/report/advice.h"
#include "results/report/fill.h"

namespace terrabench {

struct ProfileOfStore {
  const Store& store;
  std::string profile;
};

// What readers call each ground that was measured (ground_name.h), by Record::terrain.
using GroundLabels = std::map<std::string, std::string, std::less<>>;
GroundLabels labels_of_grounds(const Store&, std::string_view profile);
// The text, such as a case's name, with the label instead of the path of the DEM that was measured.
std::string labelled(std::string text, const Record&, const GroundLabels&);

// Whether the case is named "GROUND" or "GROUND/…".
bool is_case_of(const Record&, std::string_view ground);

// A warning if a case of this ground has no height in 1 % of its columns or more, where only one of ground
// and method has one: beside samples without data, or in holes. Errors of height leave such columns out, so
// that a method that loses many seems better than it is. Empty if none does. O(records).
std::string lost_columns(const Store&, std::string_view profile, std::string_view ground,
                         std::string_view label);

struct FurtherGround : UnnamedGround {  // the label is that of labels_of_grounds()
  Paper paper;                          // layouts_of(): all that the ground's page may show, measured or not
  // Shown to readers: the ground's content changed between its measurements; lost_columns().
  std::vector<std::string> warnings;

  const PageLayout& page() const { return paper.pages.front(); }
  std::string table_id() const { return "which-method-" + id; }  // of tables_of_further_grounds()
};

// In the order of measurement. A record tells its ground (Record::terrain), and belongs to it if
// is_case_of() and if its experiment is one that the page shows. Throws bad_input as layouts_of() does.
std::vector<FurtherGround> further_grounds(std::span<const Paper>, const ProfileOfStore& measured);

// A table per further ground of which methods can be ranked: advice() for it. `purpose`: the questions that
// matter for it; empty: all.
std::vector<FilledTable> tables_of_further_grounds(std::span<const FurtherGround>,
                                                   const ProfileOfStore& measured,
                                                   std::span<const Answer> elsewhere,
                                                   std::string_view purpose = "");

}  // namespace terrabench
