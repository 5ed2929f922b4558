#include "terrain/spelling.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace terrabench {
namespace {

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

}  // namespace

bool is_slip(std::string_view name, std::string_view known) {
  const std::size_t distance = edit_distance(name, known);
  return distance <= std::max<std::size_t>(2, known.size() / 3) && distance < known.size();
}

std::string suggestion(std::string_view name, std::span<const std::string_view> known) {
  if (known.empty()) return {};
  const auto nearest = *std::min_element(known.begin(), known.end(), [&](auto a, auto b) {
    return edit_distance(name, a) < edit_distance(name, b);
  });
  return is_slip(name, nearest) ? fmt::format("; did you mean '{}'?", nearest) : "";
}

std::string unknown_key(std::string_view key, std::span<const std::string_view> known) {
  return fmt::format("unknown key '{}'{}", key, suggestion(key, known));
}

}  // namespace terrabench
