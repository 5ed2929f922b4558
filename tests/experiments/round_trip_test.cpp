// DEM to file and back: every type with every form that it can write, and what is measured on small ground.
#include <gmock/gmock.h>

#include <set>

#include "experiments/cross/files/read_back.h"
#include "experiments/experiment.h"
#include "representations/export/export.h"
#include "terrain/error.h"
#include "tests/experiments/value.h"

namespace terrabench::cross {
namespace {

constexpr std::string_view kId = "cross.round-trip";

// On the first 40² samples; levels of 6 m.
Record measure(const Case& listed) {
  Case at = listed;
  at.parameters.set("size", std::int64_t{40});
  at.parameters.set("step", 6.0);
  Record record;
  Recorder recorder(record, "unused");
  Progress progress;
  experiment(kId).measure(at, {}, recorder, progress);
  return record;
}

// A type or a form that is added to its table is measured, and can be read back.
TEST(RoundTrip, EveryTypeAndFormComesBack) {
  const std::vector<Case> cases = experiment(kId).cases({});
  std::set<std::string> expected, names;
  for (const RepresentationType& type : representations()) {
    for (const ExportFormat& format : export_formats()) {
      if (format.can_write(type)) {
        expected.insert("jacksboro/" + std::string(type.name) + "/" +
                        std::string(format.extension.substr(1)));
      }
    }
  }
  for (const Case& at : cases) {
    SCOPED_TRACE(at.name);
    names.insert(at.name);
    const Record record = measure(at);
    EXPECT_EQ(value(record, "samples"), 1600);
    EXPECT_EQ(value(record, "lost"), 0);
    EXPECT_GT(value(record, "file_bytes"), 100);
    const bool levels = at.name.find("voxel") != at.name.npos || at.name.find("stack") != at.name.npos;
    const bool polygons = at.name.ends_with("ply") || at.name.ends_with("obj");
    if (levels && !polygons) {
      EXPECT_EQ(value(record, "largest_error"), 3);  // half a level
    }
    if (at.name.find("heightmap") != at.name.npos) {
      EXPECT_EQ(value(record, "largest_error"), 0);
    }
    const bool placed = at.name.ends_with("tif") || at.name.ends_with("vdb");
    EXPECT_EQ(value(record, "place_fields"), placed ? 7 : 0);
    EXPECT_EQ(value(record, "place_equal"), placed ? 7 : 0);
  }
  EXPECT_EQ(names, expected);
}

TEST(RoundTrip, AFormThatNothingReadsIsAnError) { EXPECT_THROW(read_back("a.stl", LineGrid{}), Error); }

}  // namespace
}  // namespace terrabench::cross
