#include "terrain/temporary_name.h"

#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstdlib>

#include "terrain/files.h"
#include "terrain/machine_error.h"
#include "terrain/number.h"

namespace terrabench {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".tmp";

// Whether the name is `start`PID.tmp of a process that does not run.
bool is_abandoned(std::string_view name, std::string_view start) {
  if (!name.starts_with(start) || !name.ends_with(kEnding)) return false;
  name.remove_prefix(start.size());
  const auto process =
      parse_number<pid_t>(name.substr(0, name.size() - std::min(name.size(), kEnding.size())));
  return process && *process > 0 && kill(*process, 0) != 0 && errno == ESRCH;
}

std::string this_machine() {
  utsname system{};
  return machine_in_names(uname(&system) == 0 ? system.nodename : "");
}

}  // namespace

std::string machine_in_names(std::string_view host) {
  constexpr std::size_t kLongest = 16, kDigits = 8;
  std::string name(host);
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_') c = '_';
  }
  if (name == host && name.size() <= kLongest && !name.empty()) return name;
  return name.substr(0, kLongest - kDigits - 1) + "-" + checksum(host).substr(0, kDigits);
}

fs::path temporary_name(const fs::path& target) {
  static const std::string kMachine = this_machine();
  const std::string start = fmt::format("{}.{}.", target.filename().string(), kMachine);
  std::error_code error, ignored;
  for (fs::directory_iterator at(target.has_parent_path() ? target.parent_path() : ".", error), end;
       !error && at != end; at.increment(error)) {
    if (is_abandoned(at->path().filename().string(), start)) fs::remove_all(at->path(), ignored);
  }
  return target.string() + fmt::format(".{}.{}{}", kMachine, getpid(), kEnding);
}

std::filesystem::path temporary_files() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (!error) return folder;
  const char* const named = std::getenv("TMPDIR");
  throw MachineError(fmt::format("no folder for temporary files: {}", error.message()),
                     named == nullptr ? "/tmp" : named, "set TMPDIR to a folder that exists");
}

}  // namespace terrabench
