#include "experiments/processes.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <system_error>
#include <thread>
#include <vector>

#include "terrain/error.h"
#include "terrain/progress.h"

namespace terrabench {
namespace {

constexpr std::size_t kLongestText = 4096;
constexpr int kMostProcesses = 1024;

// What the processes share, in memory that a fork does not copy.
struct Shared {
  std::atomic<std::size_t> next{0};                  // task; the number of tasks or more: none is left
  std::atomic<std::size_t> current[kMostProcesses];  // task that each process is at
  std::atomic<bool> failed{false};                   // the first to set it writes what follows
  bool closed_pipe = false;                          // nobody reads what it prints
  ExitCode code = ExitCode::kGood;
  char what[kLongestText] = "", advice[kLongestText] = "";
};

struct Unmap {
  void operator()(Shared* shared) const { munmap(shared, sizeof(Shared)); }
};

std::unique_ptr<Shared, Unmap> share() {
  void* const memory =
      mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  return std::unique_ptr<Shared, Unmap>(new (memory) Shared);
}

void copy_text(std::string_view text, std::span<char> out) {
  const std::size_t size = std::min(text.size(), out.size() - 1);
  std::copy_n(text.data(), size, out.data());
  out[size] = 0;
}

void keep_error(Shared& shared, std::size_t tasks, ExitCode code, std::string_view what,
                std::string_view advice, bool closed_pipe = false) {
  shared.next = tasks;
  if (shared.failed.exchange(true)) return;
  shared.closed_pipe = closed_pipe;
  shared.code = code;
  copy_text(what, shared.what);
  copy_text(advice, shared.advice);
}

// A forked process: never returns, and leaves alone what its parent has to flush and to destroy.
[[noreturn]] void work(Shared& shared, int process, pid_t parent, std::size_t tasks,
                       const std::function<void(std::size_t)>& task) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);  // it was killed before this process asked to die with it
  // A terminal's Ctrl-C goes to the whole group, and the parent passes it on: the second signal must not end
  // this process before it has removed its temporary files.
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { Progress::interrupt(); });
  try {
    for (std::size_t i = shared.next++; i < tasks; i = shared.next++) {
      shared.current[process] = i;
      task(i);
    }
  } catch (const Error& error) {
    keep_error(shared, tasks, error.code(), error.what(), error.advice());
  } catch (const std::bad_alloc&) {
    keep_error(
        shared, tasks, ExitCode::kEnvironment, "out of memory",
        "close other programs, or run fewer cases beside each other (--jobs); then go on with --resume");
  } catch (const std::system_error& error) {
    keep_error(shared, tasks, ExitCode::kEnvironment, error.what(), "",
               error.code() == std::errc::broken_pipe);
  } catch (const std::exception& error) {
    keep_error(shared, tasks, ExitCode::kEnvironment, error.what(), "");
  }
  _exit(0);
}

// Waits until all have ended; passes an interruption on to them.
void wait_for(std::vector<pid_t> processes, Shared& shared, std::size_t tasks,
              const std::function<std::string(std::size_t)>& name) {
  const std::vector<pid_t> numbered = processes;
  bool told = false;
  while (!processes.empty()) {
    for (const pid_t process : numbered) {
      int status = 0;
      if (std::ranges::count(processes, process) == 0 || waitpid(process, &status, WNOHANG) == 0) continue;
      std::erase(processes, process);
      // Interrupted, a process ends early, and run_in_processes() says so.
      if ((WIFEXITED(status) && WEXITSTATUS(status) == 0) || Progress::interrupted()) continue;
      const auto index = std::ranges::find(numbered, process) - numbered.begin();
      keep_error(shared, tasks, ExitCode::kEnvironment,
                 fmt::format("the process that measured {} {} {}", name(shared.current[index]),
                             WIFSIGNALED(status) ? "was ended by signal" : "ended with exit status",
                             WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status)),
                 "if memory ran out, close other programs, or run fewer cases beside each other (--jobs); "
                 "then go on with --resume");
    }
    if (Progress::interrupted() && !told) {
      for (const pid_t process : processes) kill(process, SIGTERM);
      told = true;
    }
    // A signal does not wake waitpid(): std::signal() restarts it.
    if (!processes.empty()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

}  // namespace

void run_in_processes(int jobs, std::size_t tasks, const std::function<void(std::size_t)>& task,
                      const std::function<std::string(std::size_t)>& name) {
  const auto shared = share();
  const auto count = std::min<std::size_t>({static_cast<std::size_t>(jobs), tasks, kMostProcesses});
  std::fflush(nullptr);  // or each process would write what is buffered
  const pid_t parent = getpid();
  std::vector<pid_t> processes;
  for (std::size_t i = 0; i < count; ++i) {
    const pid_t process = fork();
    if (process == 0) work(*shared, static_cast<int>(i), parent, tasks, task);
    if (process > 0) {
      processes.push_back(process);
    } else {
      keep_error(*shared, tasks, ExitCode::kEnvironment,
                 fmt::format("cannot start a process: {}", std::strerror(errno)),
                 "close other programs, or use fewer --jobs");
    }
  }
  wait_for(std::move(processes), *shared, tasks, name);
  if (shared->closed_pipe) throw std::system_error(std::make_error_code(std::errc::broken_pipe));
  if (shared->failed) throw Error(shared->code, shared->what, "", shared->advice);
  if (Progress::interrupted()) throw Error(ExitCode::kInterrupted, "interrupted", "", "");
}

std::string call_in_process(const std::function<std::string()>& produce) {
  const auto failed = [](const char* what) {
    return environment_error(fmt::format("cannot {} a file in memory: {}", what, std::strerror(errno)), "",
                             "close other programs");
  };
  const int memory = memfd_create("text", MFD_CLOEXEC);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(memory < 0 ? nullptr : fdopen(memory, "w+"),
                                                             std::fclose);
  if (!file) {
    const Error error = failed("create");
    if (memory >= 0) close(memory);
    throw error;
  }
  run_in_processes(
      1, 1,
      [&](std::size_t) {
        const std::string text = produce();
        if (std::fwrite(text.data(), 1, text.size(), file.get()) != text.size() ||
            std::fflush(file.get()) != 0) {
          throw failed("write to");
        }
      },
      [](std::size_t) { return "the environment"; });
  std::string text;
  char buffer[4096];
  std::rewind(file.get());
  while (const std::size_t got = std::fread(buffer, 1, sizeof buffer, file.get())) text.append(buffer, got);
  if (std::ferror(file.get()) != 0) throw failed("read");
  return text;
}

}  // namespace terrabench
