// The program once more, beside this one: for what a process can only measure of itself.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "terrain/progress.h"

namespace terrabench::cross {

// Runs this very executable with these arguments and waits; what it prints goes to `log`. An interruption is
// passed on to it. Throws environment_error with the log's last line when it fails, and Error(kInterrupted).
void run_own_program(const std::vector<std::string>& arguments, const std::filesystem::path& log, Progress&);

// The most memory that this process ever had resident (Linux: VmHWM). Throws environment_error where the
// system does not tell.
std::uint64_t peak_resident_bytes();

}  // namespace terrabench::cross
