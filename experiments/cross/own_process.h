// Runs this program in a second process, to measure what a process can only measure of itself.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "terrain/progress.h"

namespace terrabench::cross {

// Runs this executable with these arguments and waits; its output goes to `log`. An interruption is passed on
// to it. Throws environment_error with the log's last line when it fails, and Error(kInterrupted).
void run_own_program(const std::vector<std::string>& arguments, const std::filesystem::path& log, Progress&);

// Peak resident memory of this process (Linux: VmHWM). Throws environment_error where the system does not
// report it.
std::uint64_t peak_resident_bytes();

}  // namespace terrabench::cross
