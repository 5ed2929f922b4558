// Data files that travel inside the binary, so that the program needs no path to its sources.
#pragma once

#include <span>
#include <string_view>

namespace terrabench {

struct EmbeddedFile {
  std::string_view name, text;  // name: the path from the project's root
};

// Every experiments/*/claims.toml, in alphabetical order.
std::span<const EmbeddedFile> embedded_claims();
// results/report.css
std::span<const EmbeddedFile> embedded_style();

}  // namespace terrabench
