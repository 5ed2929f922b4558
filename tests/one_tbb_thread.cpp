// Part of every test program that ThreadSanitizer checks. Debian's libtbb is built without it, so each
// hand-over of a task to another thread looks like a race; suppressing one costs more than the task (a test
// of 2 s took over 20 min). With one thread, TBB runs its tasks where they are started. Our own threads,
// locks and atomics are checked as ever.
#include <oneapi/tbb/global_control.h>

namespace {
const oneapi::tbb::global_control kOneThread(oneapi::tbb::global_control::max_allowed_parallelism, 1);
}
