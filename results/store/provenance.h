// Where the numbers come from: code, compiler, machine and command, collected once per process.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "results/store/record.h"

namespace terrabench {

// What only the caller knows.
struct RunFacts {
  std::vector<std::string> command;  // argv
  std::string gl_renderer;           // of GlContext::renderer(); empty when nothing was drawn
  std::string simd;                  // instruction set chosen at run time
  int threads = 0;                   // in use; 0: as many as this process may use
  std::vector<std::pair<std::string, std::string>> libraries;  // added to those known here: name, version
};

// Reads /proc and the build's own facts; a fact that cannot be read is "unknown". Sets the id.
Provenance collect_provenance(const RunFacts&);

// Whether times of two runs can be compared, of whatever code: same processor, threads and instruction set.
bool same_machine(const Provenance&, const Provenance&);
// Whether both ran the same revision. Then exact figures must be the same, on any machine.
bool same_code(const Provenance&, const Provenance&);
// "Intel(R) Xeon(R) Processor, 2 threads, AVX3, llvmpipe": what tells machines apart, for a reader.
std::string machine_name(const Provenance&);

// A command line that can be pasted into a shell: arguments are quoted where needed, 'it'\''s'.
std::string quote_command(const std::vector<std::string>& arguments);

}  // namespace terrabench
