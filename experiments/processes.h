// Runs tasks in forked processes, one or several beside each other: tasks in different processes share no
// heap, no OpenGL context and no thread pool, so what they count per process is what they would count alone.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace terrabench {

// Calls task(0) … task(tasks - 1), each once, in `jobs` processes; a process takes the next task when it is
// done with one. Call it before this process has threads: they do not live on in a forked one.
//
// When a process is killed or crashes, calls died(task, "the process was ended by signal 9 (Killed)") here
// for the task that it was at, and goes on with the others in a new process.
//
// An Error that a task or died() throws is thrown here, once the tasks in progress are done; no further task
// is begun. Of std::system_error, a broken pipe is thrown as such. After Progress::interrupt() the processes
// are interrupted too: in them, SIGINT and SIGTERM only call Progress::interrupt(), however often they come,
// so that they can clean up while this process waits. When it ends before them, by a kill or a second Ctrl-C,
// they are killed with it, and may leave temporary files.
void run_in_processes(int jobs, std::size_t tasks, const std::function<void(std::size_t)>& task,
                      const std::function<void(std::size_t, const std::string&)>& died);

// What `produce` returns, in a process of its own: for work that starts threads.
std::string call_in_process(const std::function<std::string()>& produce);

}  // namespace terrabench
