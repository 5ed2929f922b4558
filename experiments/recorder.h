// Takes what an experiment measures.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "results/store/record.h"
#include "terrain/source.h"

namespace terrabench {

class Recorder {
 public:
  Recorder(Record& record, std::filesystem::path folder) : record_(record), folder_(std::move(folder)) {}

  // Adds a sample to the metric of that name. Throws bad_input for one that is not finite, which cannot be
  // recorded.
  void add(std::string_view metric, std::string_view unit, double sample);
  // The same for a metric that varies from run to run although is_timing() of its unit is false.
  void add_varying(std::string_view metric, std::string_view unit, double sample);
  // The same for a metric with a sample per frame of a path, in the frames' order: Metric::series.
  void add_frame(std::string_view metric, std::string_view unit, double sample);
  // Records that the metrics have no value here, and why: "the ground is flat".
  void undefined(std::initializer_list<std::string_view> metrics, std::string_view reason);
  // Adds numerator ÷ denominator; if the denominator is 0, records that it is undefined and why.
  void add_ratio(std::string_view metric, double numerator, double denominator,
                 std::string_view why_undefined);
  // Declares a picture of a claim; returns where to write it, as WebP, and say what it contains, as long as
  // the recorder lives.
  FigureFile figure(std::string_view id, std::string_view caption);
  // Records the ground that was measured. The overload for a temporary returns it.
  void terrain(const TerrainSource& source) { terrain(source.name, source.checksum, source.notes); }
  TerrainSource terrain(TerrainSource&& source) {
    terrain(source.name, source.checksum, source.notes);
    return std::move(source);
  }
  void terrain(std::string_view name, std::string_view checksum, std::vector<std::string> notes = {});

 private:
  Record& record_;
  std::filesystem::path folder_;
};

}  // namespace terrabench
