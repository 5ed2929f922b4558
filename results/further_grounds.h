// Rows of the ledger that are judged again on further grounds: the same checks, read from other cases.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "results/claims.h"

namespace terrabench {

struct FurtherGround {
  // A row whose verdict is another here than where the paper's claim is judged.
  struct Known {
    std::string claim;
    Verdict verdict;
    std::string note;  // empty: the row's own
  };
  std::string name;   // goes behind the id of each row and of its figures
  std::string of;     // the ground that the rows' checks name: the case, or the first part of it
  std::string label;  // goes behind where it stands in the paper
  std::vector<std::string> profiles;
  std::vector<Known> known;
};

// Each row that is measured on `of`, and behind it the same on every further ground. O(rows · grounds).
std::vector<Claim> on_further_grounds(const std::vector<Claim>& claims,
                                      std::span<const FurtherGround> grounds);

}  // namespace terrabench
