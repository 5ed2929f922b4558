// `terrabench view`: the window, from its opening to its closing.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "terrain/error.h"
#include "viewer/ground.h"

namespace terrabench::viewer {

struct ViewOptions {
  std::string ground;
  std::vector<std::string> methods;  // one or two names, see method_named()
  glm::ivec2 window{1280, 800};      // pixels
  std::filesystem::path script;      // empty: interactive
  bool panels = true;
};

// Returns once the window is closed or the script has ended; of a script, prints how long frames took. Throws
// environment_error without a display, what opening the first ground throws, and what Script throws.
ExitCode view(const ViewOptions&, const OpenGround&);

}  // namespace terrabench::viewer
