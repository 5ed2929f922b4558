#include "terrain/temporary_name.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <string>
#include <string_view>

namespace terrabench {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".tmp";

// Whether the name is `start`PID.tmp of a process that does not run.
bool is_abandoned(std::string_view name, std::string_view start) {
  if (!name.starts_with(start) || !name.ends_with(kEnding)) return false;
  name.remove_prefix(start.size());
  const char* const end = name.data() + name.size() - std::min(name.size(), kEnding.size());
  pid_t process = 0;
  const auto [stop, error] = std::from_chars(name.data(), end, process);
  return error == std::errc() && stop == end && process > 0 && kill(process, 0) != 0 && errno == ESRCH;
}

}  // namespace

fs::path temporary_name(const fs::path& target) {
  const std::string start = target.filename().string() + ".";
  std::error_code error, ignored;
  for (fs::directory_iterator at(target.has_parent_path() ? target.parent_path() : ".", error), end;
       !error && at != end; at.increment(error)) {
    if (is_abandoned(at->path().filename().string(), start)) fs::remove_all(at->path(), ignored);
  }
  return target.string() + fmt::format(".{}{}", getpid(), kEnding);
}

}  // namespace terrabench
