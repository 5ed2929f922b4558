// The one way to read TOML: event files, camera paths and claims. Only the readers of such files include this
// header: toml++ takes seconds to compile, and its parser is compiled once, in toml.cpp.
#pragma once

#ifndef TOML_HEADER_ONLY
#define TOML_HEADER_ONLY 0
#endif
// toml++ 3.3.0 asserts (and assumes, with clang) that the time of a date begins with a digit; without that it
// refuses such a time.
#include <toml++/impl/preprocessor.h>
#undef TOML_ASSERT_ASSUME
#define TOML_ASSERT_ASSUME(...) static_assert(true)
#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace terrabench {

// Parses `text`, which came from `file`. Throws bad_input with file and line for what is not TOML, with
// `advice` where toml++ refuses it, and with the column for invalid UTF-8 and for characters beyond ASCII
// outside strings and comments, where toml++ 3.3.0 has undefined behaviour (U+00A1 to U+0499). O(n).
toml::table parse_toml(std::string_view text, const std::string& file, std::string_view advice);

}  // namespace terrabench
