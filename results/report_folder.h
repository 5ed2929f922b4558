// The folder that a report is written into: it appears whole or not at all.
#pragma once

#include <filesystem>

namespace terrabench {

// A temporary folder beside the target; publish() renames it to the target, otherwise it is removed.
class ReportFolder {
 public:
  // Throws environment_error when the target holds files that are no report, or nothing can be written there.
  explicit ReportFolder(std::filesystem::path target);
  ~ReportFolder();
  ReportFolder(const ReportFolder&) = delete;
  ReportFolder& operator=(const ReportFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  // Exchanges an earlier report with this one; the earlier one is removed with the temporary folder.
  void publish();

 private:
  std::filesystem::path target_, path_;
};

}  // namespace terrabench
