// Parses options, handles errors in one place, returns the exit codes of docs/commands.md.
#include "experiments/commands/command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <new>
#include <span>
#include <system_error>
#include <thread>
#include <utility>

#include "experiments/commands/commands.h"
#include "experiments/commands/manual.h"
#include "experiments/method_sets.h"
#include "renderers/contexts.h"
#include "results/report/citation.h"
#include "terrain/error.h"
#include "terrain/number.h"
#include "terrain/progress.h"
#include "terrain/sources/dem/network.h"
#include "terrain/sources/noise/program.h"

namespace terrabench {
namespace {

// Exit code when the reader of standard output closes the pipe, as in `terrabench list | head -1`. A shell
// reports the same for a program that SIGPIPE ended.
constexpr int kClosedPipe = 141;

constexpr const char* kFooter =
    "Exit codes: 0 good, 1 a claim is not as expected, 2 wrong use, 3 bad input, 4 environment (no GL, "
    "disk full), 5 some cases of a run failed, 130 interrupted, 141 the reader of the output closed the "
    "pipe.";

// Below the help of the command.
constexpr std::pair<const char*, const char*> kExamples[] = {
    {"list", "  terrabench list terrains\n  terrabench list mrbsp"},
    {"advise", "  terrabench advise mountain.tif --for flying --out mine"},
    {"run",
     "  terrabench run mrbsp.walk real-257/fitted\n"
     "  terrabench run 'hybrid.*' --profile paper --out out"},
    {"check", "  terrabench check out\n  terrabench check results/reference --claims 'mrbsp.T2.*' --verbose"},
    {"report", "  terrabench report out\n  terrabench report results/reference --latex bundle"},
    {"compare", "  terrabench compare before after\n  terrabench compare figures-by-osmesa figures-by-gpu"},
    {"merge", "  terrabench merge out shard1 shard2"},
    {"represent",
     "  terrabench represent mountain.tif --as layered_stack --save mountain.tb --render mountain.png\n"
     "  terrabench represent caves --as implicit --render caves.png --renderer raytrace --samples 128"},
    {"export",
     "  terrabench export mountain.tb mountain.ply\n"
     "  terrabench export mountain.tb mountain.obj --surface-only --up z"},
    {"render", "  terrabench render mountain.tif --scene --out mountain.png"},
    {"view", "  terrabench view mountain.tif\n  terrabench view jacksboro --lod roam --lod geomipmap"},
    {"info", "  terrabench info mountain.tif"},
};

void on_signal(int) {
  // A second signal ends the process at once: the work may not check for the first.
  if (Progress::interrupted()) _exit(static_cast<int>(ExitCode::kInterrupted));
  Progress::interrupt();
}

// What the options set. Must outlive the parser.
struct Arguments {
  ListArguments list;
  RunArguments run;
  AdviseArguments advise;
  RepresentArguments represent;
  ExportArguments exported;
  RenderArguments render;
  ViewArguments view;
  CheckArguments check;
  CompareArguments compare;
  MergeArguments merge;
  ReportArguments report;
  std::filesystem::path info;
  std::string help;         // the command to describe; empty: the program
  std::string help_format;  // empty: text
  int threads = 0;
};

void add_list(CLI::App& app, Arguments& a) {
  auto* command = app.add_subcommand("list",
                                     "List representations, lods, experiments, claims, terrains, models and "
                                     "the scene, with their parameters");
  command
      ->add_option("what", a.list.what,
                   "What to list; a paper, or cross, lists its experiments and claims (default: all)")
      ->type_name(
          "{representations,lods,experiments,claims,terrains,models,scene,hybrid,ght,drill,mrbsp,meshgrow,"
          "cross}");
  command->add_flag("--json", a.list.json, "Print JSON");
}

void add_profile_to_read(CLI::App& command, std::string& profile) {
  command
      .add_option("--profile", profile,
                  "Read only measurements of this profile, quick or paper (default: that of the newest)")
      ->check(CLI::IsMember({"quick", "paper"}));
}

void add_results(CLI::App& app, Arguments& a) {
  auto* check = app.add_subcommand(
      "check",
      "Print the verdict on each claim: first the claims that fail the check, then one line per claim "
      "(verdict, the value that decides, its expected range), then one line per paper. Exits with 0 if every "
      "claim is as expected: exactly those of its conditions fail that are known to; else with 1");
  check->add_option("dir", a.check.folder, "Results folder")->capture_default_str();
  check->add_option(
      "--claims,--rows", a.check.claims,
      "Check only these claims: ids from `terrabench list claims`, or globs such as 'hybrid.T1.*' "
      "(default: those of the experiments that were run)");
  check->add_flag("--all", a.check.all, "Also claims of experiments that were not run: they fail as missing");
  add_profile_to_read(*check, a.check.profile);
  check->add_flag("--verbose", a.check.verbose, "Print all evidence under each line");
  check->add_flag("--json", a.check.json, "Print JSON");
  check->add_option("--junit", a.check.junit, "Also write JUnit XML for a CI server");
  auto* report = app.add_subcommand(
      "report", "Write tables, plots and a web page from the measurements: DIR/report/index.html");
  report->add_option("dir", a.report.folder, "Results folder")->capture_default_str();
  add_profile_to_read(*report, a.report.profile);
  auto* const latex = report->add_option(
      "--latex", a.report.latex,
      "Write this folder instead: tables, plots and pictures for a paper, which `latexmk -pdf` compiles "
      "(Debian: latexmk, texlive-latex-recommended, lmodern). Plots are PDF, a column (84 mm) "
      "and a page (174 mm) wide; pictures are PNG");
  report
      ->add_option(
          "--reference", a.report.reference,
          "Compare your ground with the grounds of this results folder (default: the reference run, which is "
          "inside the program)")
      ->excludes(latex);
  app.add_subcommand("cite", "Print BibTeX of the papers and of this program");
  auto* compare = app.add_subcommand(
      "compare",
      "Compare two results folders, metric by metric: exact figures on any machines, "
      "times within one kind of machine, with confidence intervals, and pictures. Also "
      "two folders of PNG and WebP files. Exits with 1 if exact figures or pictures differ, with 3 if "
      "the folders have nothing in common");
  compare->add_option("a", a.compare.before, "Results folder, or folder of pictures")->required();
  compare->add_option("b", a.compare.after, "The same")->required();
  compare->add_option("--psnr", a.compare.limits.psnr, "Pictures differ below this PSNR, dB")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
  compare->add_option("--ssim", a.compare.limits.ssim, "Pictures differ below this mean SSIM")
      ->check(CLI::Range(-1.0, 1.0))
      ->capture_default_str();
  compare->add_flag("--json", a.compare.json, "Print JSON");
  compare->add_flag("--all", a.compare.all, "List every metric, not only those that changed");
  auto* merge = app.add_subcommand(
      "merge",
      "Join results folders, such as those of `run --shard`, into one (docs/sweeps.md). Refuses altered "
      "lines, "
      "changed pictures and mixed revisions before it writes anything; after an interruption, give the same "
      "command again.");
  merge->add_option("out", a.merge.out, "Folder to write; what it holds counts as the first folder")
      ->required();
  merge->add_option("in", a.merge.folders, "Results folders")->required();
}

std::vector<std::string_view> names_of_commands(const CLI::App& app) {
  std::vector<std::string_view> names;
  for (const CLI::App* const command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

// After the other commands, which it names.
void add_help(CLI::App& app, Arguments& a) {
  app.add_subcommand("version", "Print the version, the instruction set in use and the GPU");
  auto* command = app.add_subcommand("help", "Describe the program, or a command: terrabench help run");
  auto* const one = command->add_option("command", a.help, "The command to describe (default: the program)")
                        ->type_name(fmt::format("{{{}}}", fmt::join(names_of_commands(app), ",")));
  command
      ->add_option("--format", a.help_format,
                   "Print the whole manual page (man), or a script that completes command lines: source "
                   "<(terrabench help --format bash)")
      ->check(CLI::IsMember(std::vector<std::string>(manual_formats().begin(), manual_formats().end())))
      ->excludes(one);
}

// What is wrong with the value of an option of that type, or nothing.
std::string fault_of(const std::string& type, const std::string& value) {
  if (value.empty()) return "must not be empty: leave the option out, or give a value";
  if (type.starts_with("FLOAT") && !std::isfinite(parse_number<double>(value).value_or(NAN))) {
    return fmt::format("must be a finite number, got '{}'", value);
  }
  const bool is_unsigned = type.starts_with("UINT");
  const auto whole = parse_number<std::int64_t>(value);
  // CLI11 reads 010 as 8.
  if ((type.starts_with("INT") || is_unsigned) &&
      !(whole && fmt::format("{}", *whole) == value && (*whole >= 0 || !is_unsigned))) {
    return fmt::format("must be a whole number{}, got '{}'",
                       is_unsigned ? fmt::format(" from 0 to {}", INT64_MAX) : "", value);
  }
  return {};
}

// All values of all options, before ranges: CLI11 alone takes an empty value for none, NaN for a number in
// any range, and -1 for the largest unsigned number.
void check_values(CLI::App& app) {
  for (CLI::App* const command : app.get_subcommands([](CLI::App*) { return true; })) {
    for (CLI::Option* const option : command->get_options()) {
      if (option->get_items_expected_max() == 0) continue;  // a flag
      const std::string type = option->get_type_name();
      option->transform(CLI::Validator([type](std::string& value) { return fault_of(type, value); }, ""));
    }
  }
}

// CLI11 would take the next argument for the value of "--junit=".
void check_empty_values(std::span<char*> arguments) {
  for (const std::string_view word : arguments) {
    if (!word.starts_with("--") || word.find('=') != word.size() - 1) continue;
    throw usage_error("must not be empty", word.substr(0, word.size() - 1),
                      "leave the option out, or give a value");
  }
}

// The first word that is no option must be a command. CLI11 would say that a command is missing.
void check_command(const CLI::App& app, std::span<char*> arguments) {
  for (const char* const word : arguments) {
    if (*word == '-') continue;
    const std::vector<std::string_view> known = names_of_commands(app);
    if (std::find(known.begin(), known.end(), word) == known.end())
      throw unknown_name("command", word, known);
    return;
  }
}

ExitCode help_command(const CLI::App& app, const std::string& command, const std::string& format) {
  if (!format.empty()) {
    fmt::print("{}", manual(app, format));
    return ExitCode::kGood;
  }
  if (command.empty()) {
    // app.help() would describe the command that was given: this one.
    fmt::print("{}", app.get_formatter()->make_help(&app, app.get_name(), CLI::AppFormatMode::Normal));
    return ExitCode::kGood;
  }
  const std::vector<std::string_view> known = names_of_commands(app);
  if (std::find(known.begin(), known.end(), command) == known.end()) {
    throw unknown_name("command", command, known);
  }
  fmt::print("{}", app.get_subcommand(command)->help());
  return ExitCode::kGood;
}

// What a report of an error should name.
std::string about_program() {
  const std::string gpu = gpu_name();
  return fmt::format("terrabench {}\nInstruction set: {}\nGPU with OpenGL 4.5: {}", version(),
                     noise::simd_name(), gpu.empty() ? "none; pictures are drawn in software" : gpu);
}

// Only for commands that ask Progress whether to stop; in others a signal ends the process at once, as usual.
void install_signals() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

ExitCode dispatch(const CLI::App& app, Arguments& a) {
  if (app.got_subcommand("help")) return help_command(app, a.help, a.help_format);
  if (app.got_subcommand("version")) {
    fmt::print("{}\n", about_program());
    return ExitCode::kGood;
  }
  if (app.got_subcommand("list")) return list_command(a.list);
  if (app.got_subcommand("check")) return check_command(a.check);
  if (app.got_subcommand("report")) return report_command(a.report);
  if (app.got_subcommand("cite")) return cite_command();
  if (app.got_subcommand("compare")) return compare_command(a.compare);
  if (app.got_subcommand("merge")) return merge_command(a.merge);
  if (app.got_subcommand("info")) return info_command(a.info);
  install_signals();
  a.run.plan.threads = a.threads;
  if (app.got_subcommand("advise")) return advise_command(a.advise, a.run.plan);
  if (app.got_subcommand("represent")) return represent_command(a.represent);
  if (app.got_subcommand("export")) return export_command(a.exported);
  if (app.got_subcommand("render")) return render_command(a.render);
  if (app.got_subcommand("view")) return view_command(a.view);
  return run_command(a.run);
}

int main_program(int argc, char** argv) {
  CLI::App app{"terrabench reproduces five terrain papers and measures their methods against each other."};
  app.require_subcommand(1);
  app.set_version_flag("--version", about_program);
  app.add_flag_callback("--allow-network", allow_network,
                        "Let DEMs that name files on the network, such as /vsicurl/ in a .vrt, fetch them");
  Arguments arguments;
  arguments.run.plan.command.assign(argv, argv + argc);
  add_list(app, arguments);
  add_advise(app, arguments.advise, arguments.threads);
  add_run(app, arguments.run, arguments.threads);
  add_results(app, arguments);
  add_represent(app, arguments.represent, arguments.threads);
  add_export(app, arguments.exported);
  add_info(app, arguments.info);
  add_render(app, arguments.render, arguments.threads);
  add_view(app, arguments.view, arguments.threads);
  add_help(app, arguments);
  app.footer(kFooter);
  for (const auto& [command, examples] : kExamples) {
    app.get_subcommand(command)->footer(std::string(kFooter) + "\nExamples:\n" + examples);
  }
  check_values(app);
  const std::span<char*> given = std::span(argv, static_cast<std::size_t>(argc)).subspan(1);
  check_command(app, given);
  check_empty_values(given);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::kUsage);
  }
  // A closed pipe and a file over the size limit then make write() fail, so that the error names the file.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  const std::size_t threads = arguments.threads > 0 ? arguments.threads : std::thread::hardware_concurrency();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  std::max<std::size_t>(1, threads));
  const ExitCode code = dispatch(app, arguments);
  if (std::fflush(stdout) != 0) throw std::system_error(errno, std::generic_category(), "standard output");
  return static_cast<int>(code);
}

}  // namespace

int command_line(int argc, char** argv) {
  // Not fmt::print, which throws when standard error is closed.
  const auto fail = [](ExitCode code, const char* what, const char* advice) {
    std::fprintf(stderr, "terrabench: %s\n", what);
    if (*advice != 0) std::fprintf(stderr, "  %s\n", advice);
    return static_cast<int>(code);
  };
  try {
    declare_methods();
    return main_program(argc, argv);
  } catch (const Error& error) {
    return fail(error.code(), error.what(), error.advice().c_str());
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::kEnvironment, "out of memory",
                "use a smaller terrain (--crop, --resample) or resolution");
  } catch (const std::filesystem::filesystem_error& error) {
    const std::string what = error.path1().string() + ": " + error.code().message();
    return fail(ExitCode::kEnvironment, what.c_str(), "check that it exists and may be read and written");
  } catch (const std::system_error& error) {
    // Thrown only for standard output and standard error; errors of files are Error.
    if (error.code() == std::errc::broken_pipe) return kClosedPipe;
    return fail(ExitCode::kEnvironment, error.what(), "");
  } catch (const std::exception& error) {
    return fail(ExitCode::kEnvironment, error.what(), "");
  }
}

}  // namespace terrabench
