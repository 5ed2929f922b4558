// Formats numbers for people, and escapes text for each language that the report is written in.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

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

// Code points of UTF-8, each one column wide.
std::size_t characters(std::string_view);
// Lines of at most `width` characters, unless a word is longer: with 0, a line per word.
std::vector<std::string> wrap(std::string_view text, std::size_t width);

// "a, b and c": with `between` after each part but the last two, and `last` after the last but one.
std::string list_of(const std::vector<std::string>& parts, std::string_view between, std::string_view last);

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
