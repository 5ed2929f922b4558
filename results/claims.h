// What the papers reported, and how each claim is read from the measurements: experiments/*/claims.toml,
// compiled in. Tables and plots of the report are laid out in the same files. Verdicts are never written
// there, only what is known.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace terrabench {

enum class Verdict {
  kReproduced,  // inside the row's tolerance
  kShape,    // ratio, slope or order inside the tolerance; the absolute figure belongs to the paper's machine
  kDiffers,  // outside the tolerance
  kNotComparable,  // cannot be measured even in shape; the row says why
  kPending,        // the method is not built yet
  kNotRun,         // the profile that was run does not measure it
  kMissing,        // it should, but there is no measurement
};
std::string_view name(Verdict);

// A number, or "experiment/case/metric".
struct Operand {
  std::string experiment, case_name, metric;  // all empty for a number
  double number = 0;
  bool is_number() const { return metric.empty(); }
};

// One thing that must hold.
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
  std::vector<std::string> profiles;  // in which it is measured
  std::vector<Condition> conditions;  // all must hold
  Verdict known = Verdict::kReproduced;
  std::string pending, not_comparable;  // why; empty when measured
};

// A table of the report. Its rows are cases of one experiment; a row's own values are what the paper printed
// (numbers) and ids of claims (text).
struct TableLayout {
  struct Row {
    std::string label, case_name;
    std::map<std::string, std::variant<double, std::string>, std::less<>> values;
  };
  struct Column {
    enum class Kind { kReported, kMetric, kInterval, kGrowth, kSpeedUp, kVerdict };
    Kind kind = Kind::kMetric;
    std::string title, unit;
    std::string key;     // of Row::values; kReported, kSpeedUp (reported ÷ measured), kVerdict
    std::string metric;  // kMetric, kInterval, kGrowth (÷ the row before), kSpeedUp
  };
  std::string id, title, caption, experiment, rows_title;
  std::vector<Row> rows;
  std::vector<Column> columns;
};

// A plot of the report: lines through cases of an experiment, or through what the paper printed.
struct PlotLayout {
  struct Axis {
    std::string label, unit;
    bool log = false;
  };
  struct Series {
    std::string label, experiment, metric;
    std::string x_metric;  // of the same case, in place of the x of `cases`; empty: none
    std::vector<std::pair<double, std::string>> cases;  // x, case
    std::vector<std::pair<double, double>> values;      // x, y as printed; used when cases is empty
    bool slope = false;                                 // fit a power law and say its exponent
  };
  std::string id, title, caption;
  Axis x, y;
  std::vector<Series> series;
};

struct Paper {
  std::string id, title, source;  // source: authors, year, where
  std::vector<Claim> claims;
  std::vector<TableLayout> tables;
  std::vector<PlotLayout> plots;
};

// The five papers and the comparison across them, in the ledger's order. Parsed once.
std::span<const Paper> papers();
// All rows of all papers.
std::vector<const Claim*> claims();

// One claims file. Throws bad_input with file and line for anything that is not as described above: syntax,
// unknown or missing keys, wrong types, repeated ids. O(size).
Paper parse_claims(std::string_view toml, const std::string& origin);

}  // namespace terrabench
