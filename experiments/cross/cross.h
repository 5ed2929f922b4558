// What enters the comparison of level-of-detail methods.
#pragma once

#include <string>
#include <vector>

namespace terrabench::cross {

// Every method as it comes, and those with an option worth a comparison of its own.
struct Entrant {
  std::string name;  // of its cases
  std::string method, options;
};
std::vector<Entrant> entrants();

}  // namespace terrabench::cross
