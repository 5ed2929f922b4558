// Reads the conditions of a claim from its file, and which of them are not expected to hold (claims.h).
#pragma once

#include <span>
#include <string>

#include "results/claims/claims.h"
#include "results/claims/toml_reader.h"

namespace terrabench {

// An element of a claim's `check`. Throws bad_input with file and line.
Condition condition_from(const TomlValue&);

// Marks in all claims of a file the conditions that their `fails` and `may_fail` name. Throws bad_input for a
// pattern that names no condition of any claim that was read from the same lines, for a condition that both
// keys name, and for a claim that does not say why its conditions fail.
void expect_failures(std::span<Claim>, const std::string& origin);

}  // namespace terrabench
