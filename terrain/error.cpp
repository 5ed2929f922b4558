#include "terrain/error.h"

#include <fmt/format.h>

#include "terrain/printable.h"
#include "terrain/spelling.h"

namespace terrabench {
namespace {

std::string join(std::string_view what, std::string_view where) {
  return where.empty() ? std::string(what) : fmt::format("{}: {}", where, what);
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
