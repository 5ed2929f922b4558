// Files of visibility changes (MRBSP paper, §4): text (visibility_text.h) where the name ends in .txt, else
// bytes (visibility_binary.h).
#pragma once

#include <filesystem>

#include "lod/mrbsp/visibility_table.h"

namespace terrabench {

// Written whole or not at all.
void write_visibility(const std::filesystem::path&, const VisibilityTable&);
// Throws bad_input for what write_visibility() cannot have written.
VisibilityTable read_visibility(const std::filesystem::path&);

}  // namespace terrabench
