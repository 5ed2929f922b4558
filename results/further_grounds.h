// "Which method for my ground": ranks the methods on grounds that no claims file names, such as a user's DEM,
// and compares the result with the rankings on the named grounds, of the same or of another results folder.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "results/fill.h"
#include "results/ranking.h"

namespace terrabench {

struct ProfileOfStore {
  const Store& store;
  std::string profile;
};

struct FurtherGround {
  std::string name;                    // a case of it is called "name/…"
  std::vector<RankingLayout> layouts;  // one per task
};
// Every measured ground that no layout names, in the order of measurement. For each task it gets the layout
// whose named ground was measured by the most similar metrics, so that solids are ranked as solids.
std::vector<FurtherGround> further_grounds(std::span<const RankingLayout>, const ProfileOfStore& measured,
                                           const ProfileOfStore& named);

// A table per further ground: for each task who is best there and by how much, and which of the named grounds
// have the same best.
std::vector<FilledTable> tables_of_further_grounds(std::span<const RankingLayout>,
                                                   const ProfileOfStore& measured,
                                                   const ProfileOfStore& named);

}  // namespace terrabench
