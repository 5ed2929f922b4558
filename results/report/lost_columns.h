// Columns where only one of ground and method has a height: beside samples without data, or in holes. Errors
// of height leave them out, so that a method that loses many of them seems better than it is.
#pragma once

#include <string>
#include <string_view>

#include "results/claims/claims.h"
#include "results/store/store.h"

namespace terrabench {

// A warning if a case that the page's tables, plots or sheets show and that records `columns` and
// `lost_columns` lost 1 % of its columns or more, with the largest
// share and its case; otherwise empty. O(rows of the tables + points of the plots + sheets), each a
// Store::find().
std::string lost_columns(const Paper&, const PageLayout&, const Store&, std::string_view profile);

}  // namespace terrabench
