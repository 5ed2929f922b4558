// The parts of the report's pages: each function writes the files of a table, plot or picture into the
// report's folder and returns the block that shows it, with links to its files and to the runs that it came
// from.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "results/claims/layouts.h"
#include "results/report/document.h"
#include "results/store/store.h"

namespace terrabench {

class ReportParts {
 public:
  // `out`: the report's folder. The store must outlive the object. Reads every picture of the profile:
  // O(pixels), in parallel.
  ReportParts(const Store&, std::string profile, std::filesystem::path out);

  // `runs`: ids of those that the table's figures come from; a link leads to the run on the main page.
  TableBlock table(Table, const std::vector<std::string>& runs) const;
  // Nothing if no series was measured: the paper's own curve is not shown alone.
  std::optional<Gallery> plot(const PlotLayout&) const;
  // Shows a small copy, which lies in the report's folder and moves with it, and links to the original
  // outside it. Nothing if the picture is altered, damaged or gone.
  std::optional<Picture> picture(const Record&, const RecordedFigure&, std::string title,
                                 std::string caption) const;

 private:
  const Store& store_;
  std::string profile_;
  std::filesystem::path out_;
  // The small copies, by checksum and file of the picture. Altered pictures have none: the pages say at their
  // top that they were altered. Those that cannot be read have an empty one.
  std::map<std::pair<std::string, std::string>, std::string> previews_;
};

}  // namespace terrabench
