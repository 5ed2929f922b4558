// What the papers report, and how each claim is read from the measurements: experiments/*/claims.toml,
// compiled in. The files also lay out the report's tables, plots and pages. Keys `fails` and `may_fail` of a
// claim name those of its conditions that are not expected to hold; the verdicts of a run are computed by
// judge.h and not stored.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "results/claims/layouts.h"

namespace terrabench {

// Those up to kDiffers are computed from measurements.
enum class Verdict {
  kReproduced,  // inside the claim's tolerance
  kShape,       // ratio, slope or order inside the tolerance; absolute values depend on the paper's machine
  kDiffers,     // outside the tolerance
  kNotComparable,  // not even the shape can be measured; the claim says why
  kNotRun,         // the profile that was run does not measure it
  kMissing,        // it should be measured, but there is no measurement
};
std::string_view name(Verdict);
inline bool holds(Verdict v) { return v <= Verdict::kShape; }
inline bool was_measured(Verdict v) { return v != Verdict::kNotRun; }

// A number, or a metric of a case: "experiment/case/metric". Case names may contain '/'.
struct Operand {
  std::string experiment, case_name, metric;  // all empty for a number
  double number = 0;
  bool is_number() const { return metric.empty(); }
};

// One condition on the measurements: an element of a claim's `check`, such as
// {growth = ["drill.growth/n=256/drills", "drill.growth/n=8192/drills"], range = [362, 2896]}. Medians are
// compared. An element with `each` stands for several: toml_reader.h.
struct Condition {
  enum class Kind {
    kEqual,   // equal = [a, b, …]: all operands are equal, to the bit
    kOrder,   // order = [a, b, …]: each is below the next
    kWithin,  // within = [a]: a lies in the range
    kRatio,   // ratio = [a, b]: a ÷ b lies in the range
    kGrowth,  // growth = [a, b]: b ÷ a, the growth from a to b, lies in the range
    kFigure,  // figure = ID: the picture is the one that was drawn, can be decoded and is not blank; if
              // `panels` are declared, each shows something and no two show the same, except those `alike`
  };
  Kind kind = Kind::kEqual;
  std::vector<Operand> operands;
  double low = 0, high = 0;  // range, both ends included
  std::string figure;        // id
  // Further for figures, all optional: panels = N, or their names in the order drawn; alike = [a, b, …]:
  // names of panels (here counted from 1) that may look the same because their methods may draw the same;
  // prints = [a, …]: metrics that the figure's words give; brightness = a: the mean of all pixels, 0 black to
  // 1 white, within kBrightness. `prints` are operands.
  int panels = 0;
  std::vector<int> alike;
  std::vector<Operand> brightness;  // one or none
  static constexpr double kBrightness = 0.005;
  enum class Expected { kHolds, kFails, kEither } expected = Expected::kHolds;  // Claim::fails, may_fail
};
// The condition as one line: "e/c/m = 3", "1 < e/c/m", "e/c/m in [0, 2]", "e/c/m / e/c/n in [5, 20]" for a
// ratio and the other way round for growth, "figure p.F1".
std::string formula(const Condition&);

// What a claim is about. The groups are counted apart and never added up.
enum class Group {
  kStated,  // a number or an order that the paper states
  kFigure,  // a figure that the paper draws: class F
  kBeyond,  // what we ask beyond the paper: key about = "beyond"
};
std::string_view name(Group);
inline constexpr Group kGroups[] = {Group::kStated, Group::kFigure, Group::kBeyond};

// What a sub-row changes of the claim that it belongs to. Sub-rows are judged, but not counted.
enum class Variation {
  kNone,     // it is a claim of its own
  kReading,  // another defensible reading of the same words: keys `reading_of`, each_is = "reading"
  kSetting,  // other parameters or terrain, or a part of it: `setting_of`, a member of `each` after the first
  kGround,   // the ground of a [[ground]]
};
std::string_view name(Variation);

// A reason for which several claims do not hold, stated once: a [[cause]].
struct Cause {
  std::string id, title, text;
};

// One statement, or a sub-row of one.
struct Claim {
  std::string id, where, statement;
  Group group = Group::kStated;  // a sub-row's is that of its claim
  Variation varies = Variation::kNone;
  std::string of;                     // id of the claim that a sub-row belongs to; else empty
  char claim_class = 'E';             // key `class`: E exact, T tolerance, S shape, F figure, Q qualitative.
                                      // Only S changes a verdict's name; F the report's layout
  std::vector<double> reported;       // as printed in the paper
  std::string unit, note, tolerance;  // tolerance: in words, for readers; the ranges in check decide
  std::vector<std::string> profiles;  // those that measure it
  std::vector<Condition> conditions;  // all must hold
  // Patterns (glob.h) for the formula() of conditions, such as "*/rmse_best_w = *". Where a claim stands for
  // several, by `each` or on further grounds, a pattern may name conditions of only some of them.
  // Those in `fails` are expected to fail, so that the claim is known to differ; those in `may_fail` were
  // seen to hold in one run and to fail in another, of another machine or profile, and `machine` says why.
  std::vector<std::string> fails, may_fail;
  std::string machine;
  std::string not_comparable;  // the reason; empty if the claim is measured
  // For claims known to differ: the id of the claim of the reading that matches, or a sentence that says that
  // none does.
  std::string matches;
  std::string cause, cause_title;  // id and title of the Cause for which it does not hold; or both empty
  int line = 0;                    // in the claims file
  std::string vague;  // what the paper leaves open, where this claim measures several readings; else empty

  // The expected verdict: differs if a condition is expected to fail. Those in `may_fail` do not count.
  Verdict expected() const;
  // Why it differs: if it is known to, the first sentence of `note`, or without a note the cause; otherwise
  // `machine`.
  std::string reason() const;
  // Growth with size is measured with `run --profile scale`, whose records are of the profile paper, and is
  // judged only where it was measured.
  bool of_profile_scale() const { return profiles.front() == "scale"; }
  // Whether records of that profile can hold what it reads.
  bool measured_in(std::string_view profile) const {
    return std::ranges::count(profiles, profile) > 0 || (of_profile_scale() && profile == "paper");
  }
  // Those whose measurements the conditions read, in that order. Empty for a picture of which only its file
  // is judged: no claim says which experiment draws it.
  std::vector<std::string_view> experiments() const;
};

// Bibliographic data, only as far as the paper's text states them.
struct Reference {
  std::vector<std::string> authors;  // may be empty
  std::string title;
  std::string subject;      // in place of a title that the text does not state: what its abstract says it is
  std::string institution;  // of the authors; may be empty
  int year = 0;             // 0: not stated
};

// A figure for the report's first screen. Both empty: none.
struct Cover {
  std::string figure, shows;  // id; what is seen, in one sentence
};

struct ClaimsFile {
  std::string text, origin;  // origin: its name, for error messages
};

struct Paper {
  std::string id, title;               // title: the name that pages and tables use
  std::optional<Reference> reference;  // the comparison across the papers has none
  std::string source;                  // what else there is to say; may be empty where there is a reference
  std::vector<Claim> claims;
  std::vector<TableLayout> tables;
  std::vector<PlotLayout> plots;
  std::vector<PageLayout> pages = {};
  std::vector<RankingLayout> rankings = {};
  // The claims file, if it has [further]: its layouts are read again for grounds that it does not name.
  std::optional<ClaimsFile> further = {};
  std::vector<Cause> causes = {};
  Cover cover = {};
};

// The five papers and the comparison across them, in this order. Parsed once.
std::span<const Paper> papers();

// Reads one claims file. Throws bad_input with file and line for wrong syntax, unknown or missing keys, wrong
// types and repeated ids. O(size).
Paper parse_claims(std::string_view toml, const std::string& origin);

// A ground that no claims file names.
struct UnnamedGround {
  std::string name, label, id;  // Record::terrain; what readers call it; part of file names and ids
};
// The paper's page for this ground, with the tables, plots and rankings that belong to it; no claims. `has`
// says which metrics were measured there. Throws bad_input if [further] does not suit the ground.
Paper layouts_of(const Paper&, const UnnamedGround&, const std::function<bool(std::string_view metric)>& has);

}  // namespace terrabench
