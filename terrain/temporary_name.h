// The names under which files and folders are written before they are renamed: NAME.MACHINE.PID.tmp beside
// NAME. MACHINE is the host name: on a folder that machines share, a process id says nothing on another one.
// And where files go that nobody asked for.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace terrabench {

// The host name. Shortened with a digest if it is long, so that a temporary name is at most 33 bytes longer
// than its target; other characters than letters, digits, '-' and '_' become '_', and a digest follows.
std::string machine_in_names(std::string_view host);

// A name of this process for what will be renamed to `target`. Removes what processes of this machine that
// were killed left of the same target; others are left alone. O(entries of the folder).
std::filesystem::path temporary_name(const std::filesystem::path& target);

// The system's folder for temporary files. Throws environment_error if TMPDIR names none.
std::filesystem::path temporary_files();

}  // namespace terrabench
