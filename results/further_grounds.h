// "Which method for my ground": the rankings of the claims files on grounds that these do not name, such as a
// user's DEM, beside what was found on the grounds that they name, in the same results folder or in another.
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
// Every measured ground that no layout names, in the order of measurement. Of a task's layouts, it takes the
// one whose own ground was measured with the most of the same metrics, so that solids are compared as solids.
std::vector<FurtherGround> further_grounds(std::span<const RankingLayout>, const ProfileOfStore& measured,
                                           const ProfileOfStore& named);

// A table per further ground: for each task who is best there and by how much, and which of the named grounds
// have the same best.
std::vector<FilledTable> tables_of_further_grounds(std::span<const RankingLayout>,
                                                   const ProfileOfStore& measured,
                                                   const ProfileOfStore& named);

}  // namespace terrabench
