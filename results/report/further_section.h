// What the report's main page says of further grounds (further_grounds.h): which method is best on each,
// their first pictures, and a list of their pages, which it writes.
#pragma once

#include <functional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "results/report/further_grounds.h"
#include "results/report/report.h"
#include "results/report/report_parts.h"

namespace terrabench {

struct FurtherSection {
  Document blocks;                // empty if nothing was measured
  Document pictures;              // the widest of each ground
  std::vector<PageLayout> pages;  // that were written
  std::set<std::string> figures;  // ids of pictures that stand on them
  std::string advice;             // advice_text() of each ground
};
// `remarks`: what stands at the top of a ground's page.
FurtherSection further_section(const Store&, const std::string& profile, const ReportOptions&,
                               std::span<const FurtherGround>, ReportParts&,
                               const std::function<Document(const FurtherGround&)>& remarks);

}  // namespace terrabench
