#include "results/new_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "terrain/error.h"

namespace terrabench {
namespace fs = std::filesystem;

namespace {

// Without the "." or empty last part of "folder/." and "folder/", which has no parent to write beside.
fs::path named(const fs::path& folder) {
  fs::path path = fs::absolute(folder).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

}  // namespace

NewFolder::NewFolder(const fs::path& target, bool (*is_earlier)(const fs::path&), const char* kind)
    : target_(named(target)),
      path_(target_.parent_path() / fmt::format(".{}.{}.tmp", target_.filename().string(), getpid())) {
  std::error_code error;
  const bool exists = fs::exists(fs::symlink_status(target_, error));
  if (exists && !fs::is_directory(target_, error)) {
    throw environment_error("is not a folder", target_.string(), "name another, or move it away");
  }
  if (exists && !fs::is_empty(target_, error) && !is_earlier(target_)) {
    throw environment_error(fmt::format("holds files that are not a {} and would be replaced", kind),
                            target_.string(), "move them away");
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
