#include "terrain/temporary_files.h"

#include <fmt/format.h>

#include <cstdlib>

#include "terrain/machine_error.h"

namespace terrabench {

std::filesystem::path temporary_files() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (!error) return folder;
  const char* const named = std::getenv("TMPDIR");
  throw MachineError(fmt::format("no folder for temporary files: {}", error.message()),
                     named == nullptr ? "/tmp" : named, "set TMPDIR to a folder that exists");
}

}  // namespace terrabench
