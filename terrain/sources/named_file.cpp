#include "terrain/sources/named_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "terrain/error.h"

namespace terrabench {
namespace {

// Where the adjustments begin: at a comma with "word=" behind it.
std::size_t end_of_file_name(std::string_view text) {
  for (std::size_t at = text.find(','); at != text.npos; at = text.find(',', at + 1)) {
    const std::size_t end = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz_", at + 1);
    if (end != text.npos && end > at + 1 && text[end] == '=') return at;
  }
  return text.size();
}

}  // namespace

NamedFile parse_named_file(std::string_view text, std::span<const ParameterSpec> specs) {
  std::error_code ignored;
  const bool whole = std::filesystem::exists(std::filesystem::path(text), ignored);
  const std::size_t end = whole ? text.size() : end_of_file_name(text);
  NamedFile named{std::string(text.substr(0, end)), Parameters(specs)};
  std::vector<std::string_view> given;
  for (std::string_view rest = text.substr(end); !rest.empty();) {
    rest.remove_prefix(1);  // the comma
    const std::string_view assignment = rest.substr(0, rest.find(','));
    const std::string_view name = assignment.substr(0, assignment.find('='));
    if (std::ranges::find(given, name) != given.end()) {
      throw usage_error(fmt::format("'{}' is set twice", name), text, "leave out one");
    }
    given.push_back(name);
    named.options.set_from_text(assignment);
    rest.remove_prefix(assignment.size());
  }
  return named;
}

}  // namespace terrabench
