#include "tests/experiments/command_line.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace terrabench {

CommandLine::CommandLine() {
  std::string name = (std::filesystem::temp_directory_path() / "terrabench_cli_XXXXXX").string();
  folder_ = mkdtemp(name.data());
}

CommandLine::~CommandLine() { std::filesystem::remove_all(folder_); }

pid_t CommandLine::start(const std::string& command) const {
  const pid_t child = fork();
  if (child == 0) {
    setpgid(0, 0);
    const int out = open((folder_ / "log").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    const int in = open("/dev/null", O_RDONLY);
    dup2(in, 0);
    dup2(out, 1);
    dup2(out, 2);
    setenv("T", TERRABENCH_PROGRAM, 1);
    if (chdir(folder_.c_str()) != 0) _exit(126);
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    _exit(127);
  }
  return child;
}

CommandLine::Outcome CommandLine::wait(pid_t child) const {
  int status = 0;
  waitpid(child, &status, 0);
  std::ostringstream text;
  text << std::ifstream(folder_ / "log").rdbuf();
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status), text.str()};
}

std::size_t CommandLine::temporary_files() const {
  const std::filesystem::recursive_directory_iterator all(folder_);
  return std::count_if(begin(all), end(all),
                       [](const auto& entry) { return entry.path().extension() == ".tmp"; });
}

}  // namespace terrabench
