// A folder that appears whole or not at all: it is filled under a temporary name beside its target, then
// renamed.
#pragma once

#include <filesystem>

namespace terrabench {

class NewFolder {
 public:
  // `is_earlier(folder)` tells whether a folder that stands at the target is an earlier one of the same kind,
  // which publish() replaces; an empty one always may be. `kind` is the word for it in messages, such as
  // "report". Throws environment_error when the target is anything else, or nothing can be written beside it.
  NewFolder(const std::filesystem::path& target, bool (*is_earlier)(const std::filesystem::path&),
            const char* kind);
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
