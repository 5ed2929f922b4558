#include "experiments/cross/own_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <thread>

#include "terrain/error.h"
#include "terrain/files.h"

namespace terrabench::cross {
namespace {

constexpr const char* kSelf = "/proc/self/exe";

pid_t start(const std::vector<std::string>& arguments, const std::filesystem::path& log) {
  std::string program = kSelf;
  std::vector<char*> argv{program.data()};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t child = 0;
  const int error = posix_spawn(&child, kSelf, &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    throw environment_error(fmt::format("cannot start a second process: {}", std::strerror(error)), kSelf,
                            "raise the limit on processes (ulimit -u)");
  }
  return child;
}

int wait(pid_t child) {
  bool told = false;
  for (;;) {
    int status = 0;
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) return status;
    // ECHILD when SIGCHLD is ignored: the exit status is lost, so the results cannot be trusted.
    if (ended < 0 && errno != EINTR) {
      throw environment_error(fmt::format("cannot wait for the second process: {}", std::strerror(errno)),
                              kSelf, "run the program with SIGCHLD at its default");
    }
    if (Progress::interrupted() && !told) {
      kill(child, SIGTERM);
      told = true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

std::string last_line(const std::filesystem::path& log) {
  std::ifstream in(log);
  std::string line, last;
  while (std::getline(in, line)) {
    if (!line.empty()) last = line;
  }
  return last;
}

}  // namespace

void run_own_program(const std::vector<std::string>& arguments, const std::filesystem::path& log,
                     Progress& progress) {
  const int status = wait(start(arguments, log));
  progress.advance();  // throws when interrupted
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  throw environment_error(WIFSIGNALED(status)
                              ? fmt::format("the second process was ended by signal {}", WTERMSIG(status))
                              : fmt::format("the second process failed: {}", last_line(log)),
                          "", "run the same experiment by itself");
}

std::uint64_t peak_resident_bytes() {
  std::ifstream status("/proc/self/status");
  std::string line;
  unsigned long long kibibytes = 0;
  while (std::getline(status, line)) {
    if (std::sscanf(line.c_str(), "VmHWM: %llu kB", &kibibytes) == 1) return kibibytes * 1024;
  }
  throw environment_error("the system does not report peak resident memory", "/proc/self/status",
                          "measure on Linux");
}

}  // namespace terrabench::cross
