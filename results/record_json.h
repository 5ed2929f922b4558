// The lines of measurements.jsonl: one JSON object each, with a digest of its own content, so that a figure
// altered by hand is found. Nothing here reads or writes files.
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "results/record.h"

namespace terrabench {

// Without the newline. Throws bad_input when a number is not finite.
std::string to_line(const Record&);
std::string to_line(const Provenance&);  // ignores `id`

// What Provenance::id must be: the digest of everything else in it.
std::string digest(const Provenance&);

// A line read back.
struct Line {
  std::variant<Record, Provenance> content;
  bool altered = false;  // the digest does not belong to the content
  std::string warning;   // something in it that was ignored; empty for none
};
// Takes any bytes. Throws bad_input("what is wrong", where) for what is not such a line: not JSON, wrong
// types, numbers that no double holds, names with control characters, a picture outside the folder.
Line parse_line(std::string_view text, const std::string& where);

}  // namespace terrabench
