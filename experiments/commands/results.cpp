// check, report, cite, compare and merge: the subcommands that measure nothing.
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

#include "experiments/commands/commands.h"
#include "results/check_output.h"
#include "results/citation.h"
#include "results/compare.h"
#include "results/latex_bundle.h"
#include "results/merge.h"
#include "results/report.h"
#include "terrain/files.h"

namespace terrabench {

ExitCode check_command(const CheckArguments& arguments) {
  const JudgedResults results = judge(arguments.folder, arguments.claims);
  // Before the text, whose reader may close the pipe.
  if (!arguments.junit.empty()) write_file(arguments.junit, check_junit(results));
  TextLook look{.verbose = arguments.verbose};
  if (isatty(STDOUT_FILENO) != 0) {
    winsize size{};
    look.colour = true;
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0) look.width = std::clamp<int>(size.ws_col, 80, 100);
  }
  fmt::print("{}", arguments.json ? check_json(results) : check_text(results, look));
  return results.passed() ? ExitCode::kGood : ExitCode::kClaimFallsShort;
}

ExitCode report_command(const ReportArguments& arguments) {
  const std::filesystem::path written = arguments.latex.empty()
                                            ? write_report(arguments.folder, arguments.reference)
                                            : write_latex_bundle(arguments.folder, arguments.latex);
  fmt::print("{}\n", written.string());
  return ExitCode::kGood;
}

ExitCode cite_command() {
  fmt::print("{}", bibtex(papers()));
  return ExitCode::kGood;
}

ExitCode compare_command(const CompareArguments& arguments) {
  const Comparison comparison = compare(arguments.before, arguments.after);
  fmt::print(
      "{}", arguments.json ? compare_json(comparison) : compare_text(comparison, isatty(STDOUT_FILENO) != 0));
  return comparison.passed() ? ExitCode::kGood : ExitCode::kClaimFallsShort;
}

ExitCode merge_command(const MergeArguments& arguments) {
  const Merged merged = merge(arguments.out, arguments.folders);
  fmt::print("{}", merge_text(merged));
  return merged.passed() ? ExitCode::kGood : ExitCode::kClaimFallsShort;
}

}  // namespace terrabench
