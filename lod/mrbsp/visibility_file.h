// Files of visibility changes (MRBSP paper, §4): text (visibility_text.h) where the name ends in .txt, else
// bytes (visibility_binary.h).
#pragma once

#include <filesystem>

#include "lod/mrbsp/visibility_table.h"

namespace terrabench {

// Written whole or not at all. Throws usage_error for text beyond 1 GiB, which would not be read again.
void write_visibility(const std::filesystem::path&, const VisibilityTable&);
// Throws bad_input for what write_visibility() cannot have written.
VisibilityTable read_visibility(const std::filesystem::path&);

// What the file holds; where there is none, what find_visible() finds, which is then written to it. Throws
// usage_error for a file of other ground, another depth or other options (the number of sampled eyes aside,
// which files do not say), environment_error, before any work, where there is no such folder.
VisibilityTable kept_visibility(const std::filesystem::path&, const GroundGrid&, const BisectionTree&,
                                const VisibilityOptions&, Progress&);

}  // namespace terrabench
