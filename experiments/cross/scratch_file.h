// A file that exists while it is measured.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "terrain/error.h"

namespace terrabench::cross {

class ScratchFile {
 public:
  ScratchFile() {
    std::string name = (std::filesystem::temp_directory_path() / "terrabench-XXXXXX").string();
    const int file = mkstemp(name.data());
    if (file < 0) {
      throw environment_error("cannot make a temporary file", name, "free some space, or set TMPDIR");
    }
    close(file);
    path_ = name;
  }
  ~ScratchFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace terrabench::cross
