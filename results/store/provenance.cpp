#include "results/store/provenance.h"

#include <fmt/format.h>
#include <gdal_version.h>
#include <sched.h>
#include <sys/utsname.h>
#include <tbb/version.h>
#include <vtkVersionMacros.h>
#include <webp/encode.h>
#include <xxhash.h>
#include <zstd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <glm/detail/setup.hpp>
#include <thread>
#include <tuple>
#if __has_include(<openvdb/version.h>)
#include <openvdb/version.h>
#endif

#include "results/build_info.h"
#include "results/store/format.h"
#include "results/store/record_json.h"
#include "terrain/memory.h"

namespace terrabench {
namespace {

// The value of the first line "key<separator>value" in a file of such lines.
std::string value_in(const char* file, std::string_view key, char separator) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(key)) continue;
    const std::size_t at = line.find(separator);
    if (at == line.npos) continue;
    std::string value = line.substr(at + 1);
    value.erase(0, value.find_first_not_of(" \t\""));
    value.erase(value.find_last_not_of(" \t\"") + 1);
    return value;
  }
  return "unknown";
}

std::string operating_system() {
  utsname name{};
  const std::string system = value_in("/etc/os-release", "PRETTY_NAME", '=');
  return uname(&name) == 0 ? fmt::format("{}, {} {} {}", system, name.sysname, name.release, name.machine)
                           : system;
}

// Fewer than the machine's in a container or under taskset.
int allowed_processors() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  return sched_getaffinity(0, sizeof allowed, &allowed) == 0
             ? std::max(1, CPU_COUNT(&allowed))
             : static_cast<int>(std::thread::hardware_concurrency());
}

std::string utc_time() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

std::string packed(int number, int step) {
  return fmt::format("{}.{}.{}", number / (step * step), number / step % step, number % step);
}

std::vector<std::pair<std::string, std::string>> library_versions() {
  const int webp = WebPGetEncoderVersion();
  return {
      {"fmt", packed(FMT_VERSION, 100)},
      {"GDAL", GDAL_RELEASE_NAME},
      {"glm", fmt::format("{}.{}.{}", GLM_VERSION_MAJOR, GLM_VERSION_MINOR, GLM_VERSION_PATCH)},
      {"libwebp", fmt::format("{}.{}.{}", webp >> 16, webp >> 8 & 255, webp & 255)},
      {"oneTBB", TBB_VERSION_STRING},
#ifdef OPENVDB_LIBRARY_VERSION_STRING
      {"OpenVDB", OPENVDB_LIBRARY_VERSION_STRING},
#endif
      {"VTK", VTK_VERSION},
      {"xxHash", packed(XXH_VERSION_NUMBER, 100)},
      {"zstd", ZSTD_VERSION_STRING},
  };
}

std::string in_quotes(std::string_view argument) {
  std::string text = "'";
  for (const char c : argument) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

// For control characters, which a record cannot hold, with the escapes of Bash, Zsh and POSIX 2024.
std::string in_quotes_with_escapes(std::string_view argument) {
  std::string text = "$'";
  for (const char c : argument) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte >= 0x7F) {
      text += fmt::format("\\x{:02x}", byte);
    } else {
      text += c == '\'' || c == '\\' ? fmt::format("\\{}", c) : std::string(1, c);
    }
  }
  return text + "'";
}

}  // namespace

std::string quote_command(const std::vector<std::string>& arguments) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
  std::string command;
  for (const std::string& argument : arguments) {
    if (!command.empty()) command += ' ';
    if (!argument.empty() && argument.find_first_not_of(kPlain) == argument.npos) {
      command += argument;
      continue;
    }
    command += printable(argument) == argument ? in_quotes(argument) : in_quotes_with_escapes(argument);
  }
  return command;
}

bool same_machine(const Provenance& a, const Provenance& b) {
  return a.cpu == b.cpu && a.threads == b.threads && a.simd == b.simd;
}

bool same_code(const Provenance& a, const Provenance& b) {
  return a.git_revision == b.git_revision && a.git_dirty == b.git_dirty;
}

std::string machine_name(const Provenance& p) {
  return fmt::format("{}, {} threads, {}, {}", p.cpu, p.threads, p.simd,
                     p.gl_renderer.empty() ? "no pictures" : p.gl_renderer);
}

bool comparable(const Provenance& a, const Provenance& b) {
  const auto build = [](const Provenance& p) { return std::tie(p.compiler, p.flags, p.build_type); };
  return same_code(a, b) && same_machine(a, b) && build(a) == build(b);
}

Provenance collect_provenance(const RunFacts& facts) {
  Provenance p;
  p.time = utc_time();
  p.command = quote_command(facts.command);
  p.git_revision = kGitRevision;
  p.git_dirty = kGitDirty;
  p.compiler = kCompiler;
  p.flags = kFlags;
  p.build_type = kBuildType;
  p.cpu = printable(value_in("/proc/cpuinfo", "model name", ':'));
  p.threads = facts.threads > 0 ? facts.threads : allowed_processors();
  p.memory = physical_memory();
  p.os = printable(operating_system());
  p.gl_renderer = printable(facts.gl_renderer);
  p.simd = facts.simd;
  p.libraries = library_versions();
  for (const auto& library : facts.libraries) {
    std::erase_if(p.libraries, [&](const auto& known) { return known.first == library.first; });
    p.libraries.push_back(library);
  }
  std::sort(p.libraries.begin(), p.libraries.end());
  if (p.build_type != "Release")
    p.timing_warnings = {fmt::format("this is no release build ({}): times are longer", p.build_type)};
  p.id = digest(p);
  return p;
}

}  // namespace terrabench
