// Where temporary files go.
#pragma once

#include <filesystem>

namespace terrabench {

// The system's folder for temporary files. Throws environment_error if TMPDIR names none.
std::filesystem::path temporary_files();

}  // namespace terrabench
