// Where numbers come from: the code, the compiler, the machine and the command, collected once a process.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "results/record.h"

namespace terrabench {

// What only the caller knows.
struct RunFacts {
  std::vector<std::string> command;  // argv
  std::string gl_renderer;           // as GlContext::renderer() says; empty when nothing was drawn
  std::string simd;                  // instruction set chosen at run time
  int threads = 0;                   // 0: as many as the machine runs at once
  std::vector<std::pair<std::string, std::string>> libraries;  // added to those known here: name, version
};

// Reads /proc and the build's own facts; what cannot be found out says "unknown". The id is set.
Provenance collect_provenance(const RunFacts&);

// For shells: 'a b' 'it'\''s'. Arguments that need no quotes get none.
std::string quote_command(const std::vector<std::string>& arguments);

}  // namespace terrabench
