#include "results/report_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "terrain/error.h"

namespace terrabench {

ReportFolder::ReportFolder(std::filesystem::path target)
    : target_(std::move(target)),
      path_(target_.parent_path() / fmt::format(".{}.{}.tmp", target_.filename().string(), getpid())) {
  std::error_code error;
  if (std::filesystem::exists(target_, error) && !std::filesystem::exists(target_ / "index.html", error) &&
      !std::filesystem::is_empty(target_, error)) {
    throw environment_error("holds files that are not a report and would be replaced", target_.string(),
                            "move them away");
  }
  std::filesystem::remove_all(path_, error);
  std::filesystem::create_directories(path_, error);
  if (error) {
    throw environment_error(fmt::format("cannot write: {}", error.message()), path_.string(),
                            "check the folder's permissions and the free space");
  }
}

ReportFolder::~ReportFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

void ReportFolder::publish() {
  if (std::rename(path_.c_str(), target_.c_str()) == 0) return;
  if (renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0) return;
  // A file system without exchange: remove the old report first.
  std::error_code error;
  std::filesystem::remove_all(target_, error);
  std::filesystem::rename(path_, target_, error);
  if (error) {
    throw environment_error(fmt::format("cannot write: {}", error.message()), target_.string(),
                            "check the folder's permissions");
  }
}

}  // namespace terrabench
