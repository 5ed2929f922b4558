// Data files that travel inside the binary, so that the program needs no path to its sources. What
// terrabench_embed (cmake/embed.cmake) makes of files is a list of these.
#pragma once

#include <span>
#include <string_view>

namespace terrabench {

struct EmbeddedFile {
  std::string_view name, text;  // name: the path from the project's root
};

}  // namespace terrabench
