#include "results/report/ground_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "terrain/files.h"
#include "terrain/sources/dem/dem.h"

namespace terrabench {
namespace {

constexpr std::size_t kLongestStem = 40;  // a file's name may have 255 bytes, and more is added to an id
constexpr std::size_t kDigest = 8;

// The end of the ground's name that begins after the '/' before `from`; the whole name if there is none.
std::string_view tail_before(std::string_view ground, std::size_t from) {
  const std::size_t slash = from == 0 ? ground.npos : ground.rfind('/', from - 1);
  return slash == ground.npos ? ground : ground.substr(slash + 1);
}

bool ends_in(std::string_view ground, std::string_view tail) {
  if (!ground.ends_with(tail)) return false;
  return ground.size() == tail.size() || ground[ground.size() - tail.size() - 1] == '/';
}

}  // namespace

std::string ground_id(std::string_view ground) {
  std::string stem;
  const std::size_t prefix = ground.starts_with(kDemPrefix) ? kDemPrefix.size() : 0;
  for (const char c : std::filesystem::path(ground.substr(prefix)).stem().string()) {
    const bool kept = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-';
    if (stem.size() < kLongestStem && (kept || !stem.ends_with('_'))) stem += kept ? c : '_';
  }
  return fmt::format("{}-{}", stem.empty() ? "ground" : stem, checksum(ground).substr(0, kDigest));
}

std::vector<std::string> ground_labels(std::span<const std::string> grounds) {
  std::vector<std::string> labels;
  for (const std::string& ground : grounds) {
    const std::size_t end = ground.ends_with('/') ? ground.size() - 1 : ground.size();
    std::string_view tail = tail_before(ground, end);
    const auto shared = [&](const std::string& other) { return other != ground && ends_in(other, tail); };
    while (tail.size() < ground.size() && std::ranges::any_of(grounds, shared)) {
      tail = tail_before(ground, ground.size() - tail.size() - 1);
    }
    labels.push_back(readable_dem(tail));
  }
  return labels;
}

std::string with_label(std::string text, std::string_view ground, std::string_view label) {
  if (ground.find('/') == ground.npos && !ground.starts_with(kDemPrefix)) return text;
  for (std::size_t at = text.find(ground); at != text.npos; at = text.find(ground, at + label.size())) {
    text.replace(at, ground.size(), label);
  }
  return text;
}

}  // namespace terrabench
