// A limit on the size of files, which stands in for a full disk: a write stops in its middle.
#pragma once

#include <sys/resource.h>

#include <csignal>

#include "tests/terrain/errors.h"

namespace terrabench {

// As failure_of(), while no file may be longer than `bytes`.
template <class Call>
Failure failure_with_small_files(rlim_t bytes, const Call& call) {
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  auto* const handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{bytes, old.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  Failure failure = failure_of(call);
  setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, handler);
  return failure;
}

}  // namespace terrabench
