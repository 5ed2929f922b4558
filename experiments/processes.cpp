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
#include <map>
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
  std::atomic<std::size_t> next{0};  // task; the number of tasks or more: none is left
  std::atomic<std::size_t>
      current[kMostProcesses];      // task that each process is at; the number of tasks: none
  std::atomic<bool> failed{false};  // the first to set it writes what follows
  bool closed_pipe = false;         // nobody reads what it prints
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
      shared.current[process] = tasks;
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

// How it ended, if not by _exit(0): "was ended by signal 9 (Killed)".
std::string abnormal_end(int status) {
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    return fmt::format("the process was ended by signal {} ({}){}", signal, strsignal(signal),
                       signal == SIGKILL ? ", as when memory runs out" : "");
  }
  const int code = WEXITSTATUS(status);
  return code == 0 ? "" : fmt::format("the process ended with exit status {}", code);
}

// The processes that do the tasks, each in its slot of Shared::current.
class Pool {
 public:
  Pool(std::size_t tasks, const std::function<void(std::size_t)>& task,
       const std::function<void(std::size_t, const std::string&)>& died)
      : tasks_(tasks), task_(task), died_(died) {}

  // Waits until all have ended; passes an interruption on to them.
  void run(std::size_t jobs) {
    for (std::size_t slot = 0; slot < jobs; ++slot) start(slot);
    bool told = false;
    while (!processes_.empty()) {
      reap();
      if (Progress::interrupted() && !told) {
        for (const auto& [process, slot] : processes_) kill(process, SIGTERM);
        told = true;
      }
      // A signal does not wake waitpid(): std::signal() restarts it.
      if (!processes_.empty()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    if (shared_->closed_pipe) throw std::system_error(std::make_error_code(std::errc::broken_pipe));
    if (shared_->failed) throw Error(shared_->code, shared_->what, "", shared_->advice);
    if (Progress::interrupted()) throw Error(ExitCode::kInterrupted, "interrupted", "", "");
  }

 private:
  void start(std::size_t slot) {
    std::fflush(nullptr);  // or each process would write what is buffered
    const pid_t parent = getpid();
    shared_->current[slot] = tasks_;
    const pid_t process = fork();
    if (process == 0) work(*shared_, static_cast<int>(slot), parent, tasks_, task_);
    if (process > 0) {
      processes_[process] = slot;
    } else {
      keep_error(*shared_, tasks_, ExitCode::kEnvironment,
                 fmt::format("cannot start a process: {}", std::strerror(errno)),
                 "close other programs, or use fewer --jobs");
    }
  }

  void reap() {
    for (const auto& [process, slot] : std::map(processes_)) {
      int status = 0;
      if (waitpid(process, &status, WNOHANG) == 0) continue;
      processes_.erase(process);
      const std::string how = abnormal_end(status);
      // Interrupted, a process ends early, and run() says so.
      if (how.empty() || Progress::interrupted()) continue;
      replace(slot, how);
    }
  }

  // Another process takes the tasks that are left.
  void replace(std::size_t slot, const std::string& how) {
    const std::size_t task = shared_->current[slot];
    try {
      if (task < tasks_) died_(task, how);
    } catch (const Error& error) {
      keep_error(*shared_, tasks_, error.code(), error.what(), error.advice());
    }
    if (shared_->next < tasks_) start(slot);
  }

  const std::unique_ptr<Shared, Unmap> shared_ = share();
  std::size_t tasks_;
  const std::function<void(std::size_t)>& task_;
  const std::function<void(std::size_t, const std::string&)>& died_;
  std::map<pid_t, std::size_t> processes_;  // running, with their slots
};

}  // namespace

void run_in_processes(int jobs, std::size_t tasks, const std::function<void(std::size_t)>& task,
                      const std::function<void(std::size_t, const std::string&)>& died) {
  Pool(tasks, task, died).run(std::min<std::size_t>({static_cast<std::size_t>(jobs), tasks, kMostProcesses}));
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
      [](std::size_t, const std::string& how) { throw environment_error(how, "", "close other programs"); });
  std::string text;
  char buffer[4096];
  std::rewind(file.get());
  while (const std::size_t got = std::fread(buffer, 1, sizeof buffer, file.get())) text.append(buffer, got);
  if (std::ferror(file.get()) != 0) throw failed("read");
  return text;
}

}  // namespace terrabench
