// What the report's main page says of further grounds (further_grounds.h): which method is best on each,
// their first pictures, and a list of their pages.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "results/report/further_grounds.h"
#include "results/report/report.h"
#include "results/report/report_parts.h"

namespace terrabench {

struct FurtherSection {
  Document blocks;     // empty if nothing was measured
  Document pictures;   // the widest of each ground
  std::string advice;  // advice_text() of each ground
};
// `pages`: those that the site has.
FurtherSection further_section(const Store&, const std::string& profile, const ReportOptions&,
                               std::span<const FurtherGround>, std::span<const PageLayout> pages,
                               ReportParts&);

}  // namespace terrabench
