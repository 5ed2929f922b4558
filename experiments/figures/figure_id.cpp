#include "experiments/figures/figure_id.h"

#include <cctype>

namespace terrabench::figures {

std::string ground_suffix(std::string_view ground, std::string_view main_ground) {
  if (ground == main_ground) return "";
  std::string name(ground.substr(ground.find_last_of('/') + 1));
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-') c = '_';
  }
  return "." + name;
}

}  // namespace terrabench::figures
