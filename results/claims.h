// What the papers report, and how each claim is read from the measurements: experiments/*/claims.toml,
// compiled in. The files also lay out the report's tables and plots. They hold the verdict that a claim is
// known to have, never one that was found.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "results/layouts.h"

namespace terrabench {

enum class Verdict {
  kReproduced,  // inside the claim's tolerance
  kShape,    // ratio, slope or order inside the tolerance; the absolute figure belongs to the paper's machine
  kDiffers,  // outside the tolerance
  kNotComparable,  // cannot be measured even in shape; the claim says why
  kPending,        // the method is not built yet
  kNotRun,         // the profile that was run does not measure it
  kMissing,        // it should be measured, but there is no measurement
};
std::string_view name(Verdict);
inline bool was_measured(Verdict v) { return v != Verdict::kPending && v != Verdict::kNotRun; }

// A number, or "experiment/case/metric".
struct Operand {
  std::string experiment, case_name, metric;  // all empty for a number
  double number = 0;
  bool is_number() const { return metric.empty(); }
};

// One thing that must hold: an element of a claim's `check`.
struct Condition {
  enum class Kind {
    kEqual,   // all operands equal, to the bit
    kOrder,   // each below the next
    kWithin,  // the one operand lies in [low, high]
    kRatio,   // first ÷ second lies in [low, high]
    kGrowth,  // second ÷ first lies in [low, high]
    kFigure,  // the picture is there, can be decoded and is not blank
  };
  Kind kind = Kind::kEqual;
  std::vector<Operand> operands;
  double low = 0, high = 0;
  std::string figure;
};

struct Claim {
  std::string id, where, statement;
  char type = 'E';               // E exact, T tolerance, S shape, F figure, Q qualitative
  std::vector<double> reported;  // as printed in the paper
  std::string unit, tolerance, note;
  std::vector<std::string> profiles;  // that measure it
  std::vector<Condition> conditions;  // all must hold
  Verdict known = Verdict::kReproduced;
  std::string pending, not_comparable;  // the reason; empty when measured
};

struct Paper {
  std::string id, title, source;  // source: authors, year, where
  std::vector<Claim> claims;
  std::vector<TableLayout> tables;
  std::vector<PlotLayout> plots;
};

// The five papers and the comparison across them, in this order. Parsed once.
std::span<const Paper> papers();

// Reads one claims file. Throws bad_input with file and line for wrong syntax, unknown or missing keys, wrong
// types and repeated ids. O(size).
Paper parse_claims(std::string_view toml, const std::string& origin);

}  // namespace terrabench
