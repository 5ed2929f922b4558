// The names under which files and folders are written before they are renamed: NAME.PID.tmp beside NAME.
#pragma once

#include <filesystem>

namespace terrabench {

// A name of this process for what will be renamed to `target`. Removes what processes of this machine that
// were killed left of the same target; others are left alone. O(entries of the folder).
std::filesystem::path temporary_name(const std::filesystem::path& target);

}  // namespace terrabench
