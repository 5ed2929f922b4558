// What the report's first screen says: what was found, and what to do next.
#pragma once

#include <functional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "results/claims/judge.h"
#include "results/report/document.h"
#include "results/store/store.h"

namespace terrabench {

// What this is, how many statements of the papers hold, and where and when it was measured.
Document opening(const Store&, const JudgedResults&);
// Pictures that the claims files choose for it (Paper::cover), as far as they were drawn; nothing if none
// was.
Document cover_pictures(const Store&, const JudgedResults&, std::span<const Paper* const>);
// A bar per paper: how many of its statements hold.
Bars verdict_bars(const JudgedResults&, std::span<const Paper* const>);
Doors next_commands();

// The ids of the runs from which times were taken that cannot be trusted (Provenance::timing_warnings): the
// machine was busy, or this was no release build.
std::set<std::string, std::less<>> uncertain_runs(const Store&);
// Names such runs behind the profile's records, with links to them on the same page, or one to the page
// of runs; nothing if there are none.
Document busy_warning(const Store&, const JudgedResults&, bool links);
// Says why the results cannot be trusted; nothing if they can.
Document fault_warning(const Store&, const JudgedResults&);
// Claims that are not judged as expected. Of those of which nothing was measured, the first are named.
Document failed_checks(const JudgedResults&);

}  // namespace terrabench
