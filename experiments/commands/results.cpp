// check, report and compare: the subcommands that read measurements and measure nothing.
#include <fmt/format.h>
#include <unistd.h>

#include "experiments/commands/commands.h"
#include "results/check.h"
#include "results/compare.h"
#include "results/report.h"
#include "terrain/files.h"

namespace terrabench {

ExitCode check_command(const CheckArguments& arguments) {
  const CheckReport report = check(arguments.folder);
  fmt::print("{}", arguments.json ? check_json(report) : check_text(report, isatty(STDOUT_FILENO) != 0));
  if (!arguments.junit.empty()) write_file(arguments.junit, check_junit(report));
  return report.passed() ? ExitCode::kGood : ExitCode::kClaimFallsShort;
}

ExitCode report_command(const std::filesystem::path& folder) {
  fmt::print("{}\n", write_report(folder).string());
  return ExitCode::kGood;
}

ExitCode compare_command(const CompareArguments& arguments) {
  const Comparison comparison = compare(arguments.before, arguments.after);
  fmt::print(
      "{}", arguments.json ? compare_json(comparison) : compare_text(comparison, isatty(STDOUT_FILENO) != 0));
  return comparison.exact_equal() ? ExitCode::kGood : ExitCode::kClaimFallsShort;
}

}  // namespace terrabench
