// Reads TOML, for event files, camera paths and claims. Include this header only in .cpp files that read such
// a file: toml++ takes seconds to compile. Its parser is compiled once, in toml.cpp.
#pragma once

#ifndef TOML_HEADER_ONLY
#define TOML_HEADER_ONLY 0
#endif
// toml++ 3.3.0 asserts, or with clang assumes, that the time after a date begins with a digit. Without the
// assertion, it reports a time that does not as a syntax error.
#include <toml++/impl/preprocessor.h>
#undef TOML_ASSERT_ASSUME
#define TOML_ASSERT_ASSUME(...) static_assert(true)
#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace terrabench {

// Parses `text`, the content of `file`. Throws bad_input with file and line if it is not TOML, and `advice`
// if toml++ found the error. Invalid UTF-8, and characters beyond ASCII outside strings and comments, are
// found before toml++ runs, with the column: toml++ 3.3.0 has undefined behaviour for some (U+00A1 to
// U+0499), and exhausts the stack for a key of 260,000 parts, which are refused above 100. O(n).
toml::table parse_toml(std::string_view text, const std::string& file, std::string_view advice);

// "'height' is missing; is it meant by 'hieght' in line 9?", the question only if the table has such a key.
std::string missing_key(std::string_view key, const toml::table&);

}  // namespace terrabench
