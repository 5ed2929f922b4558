// check, report, cite, compare and merge: the subcommands that measure nothing.
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

#include "experiments/commands/commands.h"
#include "results/claims/check_output.h"
#include "results/compare/compare.h"
#include "results/report/citation.h"
#include "results/report/latex_bundle.h"
#include "results/report/report.h"
#include "results/store/merge.h"
#include "terrain/files.h"

namespace terrabench {

ExitCode check_command(const CheckArguments& arguments) {
  const Demand demand = arguments.all || !arguments.claims.empty() ? Demand::kAll : Demand::kRun;
  const JudgedResults results = judge(arguments.folder, arguments.claims, arguments.profile, demand);
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

void warn_of(const std::vector<std::string>& faults) {
  if (faults.empty()) return;
  fmt::print(
      stderr,
      "warning: these results cannot be trusted: {} lines or pictures were altered or damaged, or name "
      "an unknown run; the first: {}\n  'terrabench check' lists all; measure these cases again\n",
      faults.size(), faults.front());
}

namespace {

std::filesystem::path report(const ReportArguments& arguments) {
  const WrittenReport report = write_report(arguments.folder, arguments.reference, arguments.profile);
  warn_of(report.faults);
  fmt::print("{}{}", report.findings, report.advice);
  return report.page;
}

std::filesystem::path latex_bundle(const ReportArguments& arguments) {
  const WrittenBundle bundle = write_latex_bundle(arguments.folder, arguments.latex, arguments.profile);
  warn_of(bundle.faults);
  if (!bundle.left_out.empty()) {
    fmt::print(
        stderr,
        "warning: {} of the pictures are missing, altered or not readable, and left out; the first: {}\n"
        "  copy them beside measurements.jsonl, and write the bundle again\n",
        bundle.left_out.size(), (arguments.folder / bundle.left_out.front()).string());
  }
  return bundle.main;
}

}  // namespace

ExitCode report_command(const ReportArguments& arguments) {
  fmt::print("{}\n", (arguments.latex.empty() ? report(arguments) : latex_bundle(arguments)).string());
  return ExitCode::kGood;
}

ExitCode cite_command() {
  fmt::print("{}", bibtex(papers()));
  return ExitCode::kGood;
}

ExitCode compare_command(const CompareArguments& arguments) {
  const auto& [before, after, limits, json, all] = arguments;
  const bool colour = isatty(STDOUT_FILENO) != 0;
  if (!Store::is_at(before) && !Store::is_at(after)) {
    const PictureComparison pictures = compare_pictures(before, after, limits);
    fmt::print("{}", json ? pictures_json(pictures) : pictures_text(pictures, colour));
    return pictures.passed() ? ExitCode::kGood : ExitCode::kClaimFallsShort;
  }
  const Comparison comparison = compare(before, after, limits);
  fmt::print("{}", json ? compare_json(comparison) : compare_text(comparison, colour, all));
  return comparison.passed() ? ExitCode::kGood : ExitCode::kClaimFallsShort;
}

ExitCode merge_command(const MergeArguments& arguments) {
  const Merged merged = merge(arguments.out, arguments.folders);
  fmt::print("{}", merge_text(merged));
  return merged.passed() ? ExitCode::kGood : ExitCode::kClaimFallsShort;
}

}  // namespace terrabench
