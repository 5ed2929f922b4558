// A folder for files that an experiment measures and does not keep.
#pragma once

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>

#include "terrain/machine_error.h"
#include "terrain/temporary_name.h"

namespace terrabench::cross {

// An empty folder in the system's temporary folder, deleted with this object, also after an error or Ctrl-C.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (temporary_files() / "terrabench-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
      throw MachineError(fmt::format("cannot make a folder: {}", std::strerror(errno)), name,
                         "free some space, or set TMPDIR to a folder that has it");
    }
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace terrabench::cross
