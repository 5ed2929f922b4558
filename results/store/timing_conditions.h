// What makes the times of a run untrustworthy, read before it starts (as Google Benchmark does). The run
// warns about it and keeps the warnings in its provenance.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace terrabench {

struct TimingConditions {
  std::string build_type, flags;  // of this program
  double busy = 0;                // processors that other work uses
  int processors = 1;             // of the machine
  int allowed_processors = 1;     // of these, those that this process may use
  double quota = 0;               // processor time per second that the control group allows; 0: no limit
  std::string governor;           // frequency scaling other than "performance" of some processor; empty: none
};

// Time since the start of the machine, of all its processors together: busy, and busy or not.
struct ProcessorTicks {
  double busy = 0, all = 0;
};
// From the first line of /proc/stat; both 0 if it has not that form.
ProcessorTicks read_ticks(std::istream&);

// Reads /proc, /sys and the build's own facts. What cannot be read stays at its default. Waits for a fifth of
// a second if the load of the last minute does not show that the machine is idle.
TimingConditions read_timing_conditions();

// One sentence per condition that makes times longer or makes them vary; empty when there is none.
std::vector<std::string> timing_warnings(const TimingConditions&);

// At least 1; fewer than the machine's in a container or under taskset.
int allowed_processors();

}  // namespace terrabench
