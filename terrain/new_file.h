// A file that appears whole or not at all: written under a temporary name in the same folder, synced, then
// renamed. An older file of that name stays until then.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace terrabench {

class NewFile {
 public:
  // Creates the folder and the empty temporary file, and removes those that killed processes left. A link
  // stays a link: its target is replaced. Throws environment_error when the name is that of a folder or a
  // device, or cannot be written. So do all others.
  explicit NewFile(const std::filesystem::path& name);
  // Removes the temporary file unless keep() was called.
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  void append(std::span<const std::byte> content);
  void append(std::string_view content);
  // For libraries that open files by name, instead of append(). They must have closed it before keep().
  const std::filesystem::path& temporary() const { return temporary_; }
  void keep();

 private:
  std::filesystem::path path_, temporary_;
  int descriptor_ = -1;
};

}  // namespace terrabench
