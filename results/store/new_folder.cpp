#include "results/store/new_folder.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "terrain/error.h"
#include "terrain/temporary_name.h"

namespace terrabench {
namespace fs = std::filesystem;

namespace {

// Without the "." or empty last part of "folder/." and "folder/", which has no parent to write beside.
fs::path named(const fs::path& folder) {
  fs::path path = fs::absolute(folder).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

bool has_mark(const fs::path& folder, const FolderMark& mark) {
  std::ifstream file(folder / mark.file, std::ios::binary);
  std::string start(mark.line.size(), ' ');
  return file.read(start.data(), std::ssize(start)) && start == mark.line;
}

}  // namespace

NewFolder::NewFolder(const fs::path& target, const FolderMark& mark)
    : target_(named(target)),
      path_(temporary_name(target_.parent_path() / ("." + target_.filename().string()))) {
  std::error_code error;
  const bool exists = fs::exists(fs::symlink_status(target_, error));
  if (exists && !fs::is_directory(target_, error)) {
    throw environment_error("is not a folder", target_.string(), "name another, or move it away");
  }
  if (exists && !fs::is_empty(target_, error) && !has_mark(target_, mark)) {
    throw environment_error(
        fmt::format("holds files that are not a {} and would be replaced", mark.kind), target_.string(),
        fmt::format("move them away; a {} is known by the first line of {}", mark.kind, mark.file));
  }
  fs::remove_all(path_, error);
  fs::create_directories(path_, error);
  if (error) {
    throw environment_error(fmt::format("cannot write: {}", error.message()), path_.string(),
                            "check the folder's permissions and the free space");
  }
}

NewFolder::~NewFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void NewFolder::publish() {
  if (std::rename(path_.c_str(), target_.c_str()) == 0) return;
  if (renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0) return;
  // A file system without exchange: remove the earlier folder first.
  std::error_code error;
  fs::remove_all(target_, error);
  fs::rename(path_, target_, error);
  if (error) {
    throw environment_error(fmt::format("cannot write: {}", error.message()), target_.string(),
                            "check the folder's permissions");
  }
}

}  // namespace terrabench
