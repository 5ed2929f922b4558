// Cases that cannot be measured because a method cannot hold the ground: nothing is at fault.
#pragma once

#include "experiments/experiment.h"
#include "terrain/error.h"

namespace terrabench {

// Whether a type refuses the input or a setting; false where the machine failed or the user interrupted.
inline bool refuses(const Error& error) {
  return error.code() == ExitCode::kBadInput || error.code() == ExitCode::kUsage;
}

// What `work` returns. Where it throws because a type cannot hold the ground: SkippedCase.
template <class Work>
auto unless_refused(const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    if (!refuses(error)) throw;
    throw SkippedCase(error.what());
  }
}

}  // namespace terrabench
