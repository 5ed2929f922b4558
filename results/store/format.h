// Formats numbers for people, and escapes text for each language that the report is written in.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "terrain/printable.h"

namespace terrabench {

// Whole numbers in full with thousands separators, others with four significant digits: 393,216
// 0.1423  1.5e-07.
std::string format_number(double);
inline std::string format_count(std::uint64_t n) { return format_number(static_cast<double>(n)); }
// "393,216 B", "0.1423 s", "12" for no unit.
std::string format_quantity(double, std::string_view unit);
// The shortest digits that read back the same: for CSV.
std::string format_exact(double);

std::string escape_html(std::string_view);  // also XML; what is not printable becomes spaces
std::string escape_markdown(std::string_view);
// The target of a Markdown link, a URL: what could end it, or a table's cell, is percent-encoded.
std::string escape_markdown_target(std::string_view);
// For T1-encoded fonts. Characters that LaTeX lacks become [U+2713]; bytes that are not UTF-8 become "?".
std::string escape_latex(std::string_view);
// RFC 4180. Text that a spreadsheet would take for a formula, since it begins with = + - @ or a tab and is
// neither a number nor an interval of two, begins with an apostrophe.
std::string escape_csv(std::string_view);

}  // namespace terrabench
