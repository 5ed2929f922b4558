// Tables of what was measured but stands in no table, plot or row of the ledger: ground of the user's own,
// other parameters.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "results/claims.h"
#include "results/store.h"

namespace terrabench {

// One an experiment that has such cases, in the order of measurement. The columns are those of the
// experiment's first table in the ledger; or, where these cases have none of its figures, all figures that
// they have.
std::vector<TableLayout> further_cases(const Store&, std::span<const Paper>, std::string_view profile);

}  // namespace terrabench
