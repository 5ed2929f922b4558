// A folder that appears whole or not at all: it is filled under a temporary name beside its target, then
// renamed. What killed processes left under such names is removed.
#pragma once

#include <filesystem>
#include <string_view>

namespace terrabench {

// How a folder is known that the program wrote itself, so that it may be replaced: this file begins with
// `line`, which says so.
struct FolderMark {
  const char* kind;  // the word for such folders in messages, such as "report"
  const char* file;
  std::string_view line;
};

class NewFolder {
 public:
  // publish() replaces an earlier folder of the same kind, or an empty one. Throws environment_error when the
  // target is anything else, or nothing can be written beside it.
  NewFolder(const std::filesystem::path& target, const FolderMark&);
  ~NewFolder();  // removes the temporary folder
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }      // to write into
  const std::filesystem::path& target() const { return target_; }  // absolute
  // Exchanges an earlier folder with this one. Throws environment_error.
  void publish();

 private:
  std::filesystem::path target_, path_;
};

}  // namespace terrabench
