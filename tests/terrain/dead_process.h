// The id of a process that has ended, for tests of what killed processes leave.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

namespace terrabench {

inline pid_t dead_process() {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  waitpid(child, nullptr, 0);
  return child;
}

}  // namespace terrabench
