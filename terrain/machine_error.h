// What the machine cannot do for any input: a full disk, no OpenGL. All further work would fail alike, so
// that a run ends on it; after another Error it goes on with its next case.
#pragma once

#include "terrain/error.h"

namespace terrabench {

class MachineError : public Error {
 public:
  // Exit code kEnvironment; arguments as of Error.
  MachineError(std::string_view what, std::string_view where, std::string_view advice)
      : Error(ExitCode::kEnvironment, what, where, advice) {}
};

}  // namespace terrabench
