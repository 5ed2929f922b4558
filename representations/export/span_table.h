// A representation as a table of its solid stretches, for spreadsheets and statistics programs: a CSV file
// with one row per span, line by line along x, rows of lines along z, spans of a line upward.
//
//   x (m),z (m),bottom (m),top (m),material
//   0,30,211.5,236,1
//
// x is east, z south of the first line, heights are metres; materials are numbers (1 is bedrock). Numbers are
// written with the fewest digits that read back as the same floats. A line without solid parts has no row.
#pragma once

#include <filesystem>
#include <vector>

#include "representations/line_grid.h"

namespace terrabench {

inline constexpr std::string_view kSpanHeader = "x (m),z (m),bottom (m),top (m),material";

// Written whole or not at all; holds some rows of lines at a time. O(spans), parallel; the same bytes for any
// number of threads. Throws environment_error.
void write_spans(const std::filesystem::path&, const Representation&, const LineGrid&, Progress&);

struct SpanTable {
  std::vector<float> x, z;  // of each row's line
  std::vector<Span> spans;
};

// For files that write_spans() wrote: throws bad_input for another header, and where a number is missing.
// O(bytes).
SpanTable read_spans(const std::filesystem::path&);

// The highest end of a span on each line, no-data where there is none; spans at other places than the lines'
// own are not used. O(rows).
Heightfield heights_of(const SpanTable&, const LineGrid&);

}  // namespace terrabench
