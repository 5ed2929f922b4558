// What a process of this machine writes before it renames it, for tests of what killed processes leave.
#pragma once

#include <unistd.h>

#include <string>

#include "terrain/temporary_name.h"

namespace terrabench {

inline std::string temporary_of(const std::string& name, const std::string& process) {
  char host[256] = {};
  gethostname(host, sizeof host - 1);
  return name + "." + machine_in_names(host) + "." + process + ".tmp";
}

}  // namespace terrabench
