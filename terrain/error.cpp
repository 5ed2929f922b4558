#include "terrain/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "terrain/printable.h"

namespace terrabench {
namespace {

std::string join(std::string_view what, std::string_view where) {
  return where.empty() ? std::string(what) : fmt::format("{}: {}", where, what);
}

// Levenshtein distance, one row at a time.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substituted, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

// "; did you mean 'jacksboro'?", or nothing.
std::string suggestion(std::string_view name, std::span<const std::string_view> known) {
  if (known.empty()) return {};
  const auto nearest = *std::min_element(known.begin(), known.end(), [&](auto a, auto b) {
    return edit_distance(name, a) < edit_distance(name, b);
  });
  const bool close = edit_distance(name, nearest) <= std::max<std::size_t>(2, nearest.size() / 3);
  return close ? fmt::format("; did you mean '{}'?", nearest) : "";
}

}  // namespace

Error::Error(ExitCode code, std::string_view what, std::string_view where, std::string_view advice)
    : std::runtime_error(printable(join(what, where))), code_(code), advice_(printable(advice)) {}

Error usage_error(std::string_view what, std::string_view where, std::string_view advice) {
  return {ExitCode::kUsage, what, where, advice};
}

Error bad_input(std::string_view what, std::string_view where, std::string_view advice) {
  return {ExitCode::kBadInput, what, where, advice};
}

Error environment_error(std::string_view what, std::string_view where, std::string_view advice) {
  return {ExitCode::kEnvironment, what, where, advice};
}

Error unknown_name(std::string_view kind, std::string_view name, std::span<const std::string_view> known) {
  return usage_error(fmt::format("unknown {} '{}'{}", kind, name, suggestion(name, known)), "",
                     fmt::format("known: {}", fmt::join(known, ", ")));
}

std::string invalid_value(std::string_view name, std::string_view value,
                          std::span<const std::string_view> allowed) {
  return fmt::format("invalid value '{}' for '{}': expected {}{}", value, name, alternatives(allowed),
                     suggestion(value, allowed));
}

std::string alternatives(std::span<const std::string_view> words) {
  if (words.size() < 2) return fmt::format("{}", fmt::join(words, ""));
  return fmt::format("{} or {}", fmt::join(words.first(words.size() - 1), ", "), words.back());
}

}  // namespace terrabench
