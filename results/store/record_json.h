// The lines of measurements.jsonl: one JSON object each, with a digest of its own content, so that a figure
// altered by hand is found. Nothing here reads or writes files. docs/results.md states every field; a test
// compares it with what is written.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "results/store/record.h"
#include "terrain/error.h"

namespace terrabench {

// Version of the fields of records and of the runs that they name: 1 has no field `schema`, 2 has. A change
// that a reader must know of gets the next number.
inline constexpr std::uint64_t kSchema = 2;

// What forbids such a text as the name of a case, a metric or the like: "is empty", "has 231 bytes, at most
// 200 are allowed", "holds control characters"; empty if nothing does.
std::string name_fault(std::string_view);

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
// Whether the text is one JSON value from beginning to end: what a cut line never is.
bool is_complete_json(std::string_view text);
// A line of a later version than kSchema. Unlike a damaged line it must not be passed over.
struct NewerSchema : Error {
  using Error::Error;
};
// Takes any bytes. Throws NewerSchema, and bad_input("what is wrong", where) for what is not such a line: not
// JSON, wrong types, numbers that no double holds, texts with control characters, a picture outside the
// folder.
Line parse_line(std::string_view text, const std::string& where);

}  // namespace terrabench
