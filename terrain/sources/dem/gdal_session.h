// What every use of GDAL needs: drivers registered once, its messages caught instead of printed, datasets
// that close. Internal to terrain/sources/dem: pulls in GDAL's headers.
#pragma once

#include <gdal_priv.h>

#include <memory>
#include <string>
#include <vector>

namespace terrabench {

// Registers the drivers on the first call; cheap and thread-safe afterwards.
void register_gdal();

// While one lives, what GDAL reports on this thread is collected here and does not reach stderr.
class GdalMessages {
 public:
  GdalMessages();
  ~GdalMessages();
  GdalMessages(const GdalMessages&) = delete;
  GdalMessages& operator=(const GdalMessages&) = delete;

  bool failed() const { return !first_failure_.empty(); }
  const std::string& first_failure() const { return first_failure_; }
  const std::vector<std::string>& warnings() const { return warnings_; }  // different ones, the first few

 private:
  static void collect(CPLErr severity, CPLErrorNum number, const char* text);

  std::string first_failure_;
  std::vector<std::string> warnings_;
};

struct CloseDataset {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using DatasetPointer = std::unique_ptr<GDALDataset, CloseDataset>;

}  // namespace terrabench
