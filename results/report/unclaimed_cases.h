// Tables of cases that nothing else is about: no table or plot shows them, no claim reads them or judges a
// picture that they drew. Such are other parameters, and further grounds of experiments whose tables stand on
// no ground's page.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "results/claims/claims.h"
#include "results/report/further_grounds.h"
#include "results/store/store.h"

namespace terrabench {

// One table per experiment with such cases, in the order of measurement. The columns are those of the
// experiment's first table in the claims files that these cases have metrics for; if there are none, all
// metrics of these cases.
std::vector<TableLayout> unclaimed_cases(const Store&, std::span<const Paper>, std::span<const FurtherGround>,
                                         std::string_view profile);

}  // namespace terrabench
