// The output of `terrabench check`: text for people, JSON for programs, JUnit XML for CI servers.
#pragma once

#include <string>

#include "results/claims/judge.h"

namespace terrabench {

struct TextLook {
  int width = 100;       // columns; lines are cut or wrapped there
  bool colour = false;   // ANSI escapes
  bool verbose = false;  // all evidence under each line
};
// The claims that fail the check come first; then one line per claim, by paper; then one line per paper; last
// PASS or FAIL. A line holds the claim's id, its verdict, the figure that decides, what it must be, its name.
std::string check_text(const JudgedResults&, const TextLook&);

std::string check_json(const JudgedResults&);
std::string check_junit(const JudgedResults&);

}  // namespace terrabench
