// Data files of results/ and experiments/ that are compiled into the program.
#pragma once

#include <span>

#include "terrain/embedded.h"

namespace terrabench {

// Every experiments/*/claims.toml, in alphabetical order.
std::span<const EmbeddedFile> embedded_claims();
// results/report/report.css
std::span<const EmbeddedFile> embedded_style();
// results/report/report.js
std::span<const EmbeddedFile> embedded_script();

// results/reference/report/findings.json
std::span<const EmbeddedFile> embedded_findings();
// results/reference/durations.csv
std::span<const EmbeddedFile> embedded_durations();

}  // namespace terrabench
