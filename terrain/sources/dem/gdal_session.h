// Shared by all uses of GDAL: drivers registered once, messages collected instead of printed, datasets that
// are closed. Internal to terrain/sources/dem: pulls in GDAL's headers.
#pragma once

#include <gdal_priv.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "terrain/machine_error.h"

namespace terrabench {

// Registers the drivers on the first call; cheap and thread-safe afterwards.
void register_gdal();

// Makes GDAL read nan, null and na in text grids as no height, and refuse them with any other word among
// their values, saying its line and column. This holds wherever GDAL opens one, also as a source of a .vrt.
// Opening a grid then reads it once more, O(bytes); one with null, na or a word as its first value is held in
// memory while it is open. Called once by register_gdal(). (text_grid.cpp)
void guard_text_grids();

// During its lifetime GDAL's messages on this thread are collected here and do not reach stderr.
class GdalMessages {
 public:
  GdalMessages();
  ~GdalMessages();
  GdalMessages(const GdalMessages&) = delete;
  GdalMessages& operator=(const GdalMessages&) = delete;

  bool failed() const { return !first_failure_.empty(); }
  const std::string& first_failure() const { return first_failure_; }
  const std::vector<std::string>& warnings() const { return warnings_; }  // the first few different ones

 private:
  static void collect(CPLErr severity, CPLErrorNum number, const char* text);

  std::string first_failure_;
  std::vector<std::string> warnings_;
};

struct CloseDataset {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using DatasetPointer = std::unique_ptr<GDALDataset, CloseDataset>;

// environment_error for a file that GDAL cannot write.
MachineError cannot_write(const std::filesystem::path& path, const std::string& why);

}  // namespace terrabench
