#define TOML_IMPLEMENTATION
#include "terrain/toml.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "terrain/error.h"
#include "terrain/printable.h"
#include "terrain/spelling.h"

namespace terrabench {
namespace {

bool is_ascii(char c) { return static_cast<unsigned char>(c) < 0x80; }

// Rewrites a TOML text in ASCII: characters beyond it become escapes in strings (a literal string becomes a
// basic one) and go from comments; elsewhere they are refused. Lines stay where they are. toml++ thus never
// sees such a character, whatever it takes a malformed text for. Refuses keys of so many parts that toml++
// would exhaust the stack.
class AsciiToml {
 public:
  AsciiToml(std::string_view text, const std::string& file) : rest_(text), file_(file) {}

  std::string run() {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
    while (!rest_.empty()) {
      const char next = rest_[0];
      if (next == '#') {
        comment();
      } else if (next == '"' || next == '\'') {
        string(next);
      } else {
        count_parts(next);
        copy("outside a string or a comment", "put the key or the text in double quotes");
      }
    }
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(std::string_view what, std::string_view advice) const {
    throw bad_input(what, fmt::format("{}:{}:{}", file_, line_, column_), advice);
  }

  Character take() {
    const std::optional<Character> next = decode(rest_);
    if (!next) {
      fail(fmt::format("byte 0x{:02X} is not valid UTF-8", static_cast<unsigned char>(rest_[0])),
           "save the file as UTF-8");
    }
    rest_.remove_prefix(next->bytes);
    ++column_;
    if (next->code == '\n') {
      ++line_;
      column_ = 1;
    }
    return *next;
  }

  // toml++ makes a table inside a table for each part of a key, and destroys them by recursion.
  void count_parts(char next) {
    constexpr int kMostParts = 100;
    if (next == '.' && ++dots_ >= kMostParts) {
      fail(fmt::format("a key has more than {} parts", kMostParts), "write it with fewer dots");
    }
    if (std::string_view("=,[]{}\n").find(next) != std::string_view::npos) dots_ = 0;
  }

  // One character that must be ASCII.
  void copy(std::string_view where, std::string_view advice) {
    if (const std::optional<Character> next = decode(rest_); next && next->bytes > 1) {
      fail(fmt::format("'{}' (U+{:04X}) {}", rest_.substr(0, next->bytes),
                       static_cast<std::uint32_t>(next->code), where),
           advice);
    }
    out_ += static_cast<char>(take().code);
  }

  void comment() {
    while (!rest_.empty() && rest_[0] != '\n') {
      if (const Character next = take(); next.bytes == 1) out_ += static_cast<char>(next.code);
    }
  }

  // A line break ends a string of one line too: that is an error which toml++ reports.
  void string(char quote) {
    const std::size_t opening = rest_.starts_with(std::string(3, quote)) ? 3 : 1;
    for (std::size_t i = 0; i < opening; ++i) take();
    out_.append(opening, '"');
    while (!rest_.empty() && (opening == 3 || rest_[0] != '\n')) {
      if (rest_[0] == quote) {
        // Up to two quotes before the closing three belong to the string.
        std::size_t quotes = 0;
        for (; quotes < (opening == 3 ? 5 : 1) && rest_.starts_with(quote); ++quotes) take();
        const std::size_t closing = quotes >= opening ? opening : 0;
        out_.append(quotes - closing, quote);
        out_.append(closing, '"');
        if (closing > 0) {
          out_ += ' ';  // a quote that follows is refused instead of joining these
          return;
        }
      } else if (rest_[0] == '\\' && quote == '"') {
        out_ += static_cast<char>(take().code);
        if (!rest_.empty()) copy("after a backslash", "escape the backslash: \\\\");
      } else {
        const Character next = take();
        if (next.bytes > 1) {
          out_ += fmt::format("\\U{:08X}", static_cast<std::uint32_t>(next.code));
        } else {
          if (quote == '\'' && (next.code == '\\' || next.code == '"')) out_ += '\\';
          out_ += static_cast<char>(next.code);
        }
      }
    }
  }

  std::string_view rest_;
  const std::string& file_;
  std::string out_;
  std::size_t line_ = 1, column_ = 1;
  int dots_ = 0;  // in this key or value
};

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& file, std::string_view advice) {
  const std::string ascii = AsciiToml(text, file).run();
  // Otherwise as it is: errors of models name columns.
  if (!std::all_of(text.begin(), text.end(), is_ascii)) text = ascii;
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw bad_input(error.description(), fmt::format("{}:{}", file, error.source().begin.line), advice);
  }
}

std::string missing_key(std::string_view key, const toml::table& table) {
  for (const auto& [present, value] : table) {
    if (!is_slip(present.str(), key)) continue;
    return fmt::format("'{}' is missing; is it meant by '{}' in line {}?", key, present.str(),
                       value.source().begin.line);
  }
  return fmt::format("'{}' is missing", key);
}

}  // namespace terrabench
