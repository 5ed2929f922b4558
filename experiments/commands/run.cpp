// run: measures experiments into a results folder.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "experiments/commands/commands.h"
#include "experiments/time_left.h"
#include "terrain/number.h"

namespace terrabench {
namespace {

// "2/8": every 8th case, from the second.
void parse_shard(const std::string& text, RunPlan& plan) {
  const std::size_t slash = std::min(text.find('/'), text.size() - 1);
  const auto shard = parse_number<int>(std::string_view(text).substr(0, slash)),
             shards = parse_number<int>(std::string_view(text).substr(slash + 1));
  if (!shard || !shards || *shard < 1 || *shard > *shards) {
    throw usage_error(fmt::format("invalid shard '{}': expected i/n, such as 2/8", text), "--shard",
                      "i counts from 1 to n");
  }
  plan.shard = *shard;
  plan.shards = *shards;
}

void print_cases(const RunPlan& plan) {
  const std::vector<PlannedCase> cases = plan_cases(plan);
  TimeLeft time;
  for (const PlannedCase& planned : cases) {
    fmt::print("{} '{}'{}\n", planned.experiment->id, planned.at.name,
               planned.experiment->timed(planned.at) ? ", timed" : "");
    time.expect(expected_seconds(plan, planned));
  }
  fmt::print("{} case{}; nothing was measured\n{}", cases.size(), cases.size() == 1 ? "" : "s",
             time.forecast());
}

}  // namespace

void add_run(CLI::App& app, RunArguments& a, int& threads) {
  auto* command = app.add_subcommand("run", "Measure experiments into a results folder");
  command->add_option(
      "ids", a.plan.patterns,
      "Names from `terrabench list experiments`, or globs such as 'hybrid.*' (default: all). A word "
      "that matches no experiment chooses among their cases, by name or glob");
  command
      ->add_option("--profile", a.profile,
                   "quick: takes minutes; paper: the papers' sizes; scale: growth with size (cross.scale), "
                   "kept with the measurements of the profile paper")
      ->check(CLI::IsMember({"quick", "paper", "scale"}))
      ->capture_default_str();
  command->add_option(
      "--terrain", a.plan.options.terrains,
      "Measure on these terrains: names from `terrabench list terrains`, paths of DEMs, or "
      "drawing:FILE.png (default: each experiment's own). dem:FILE,band=2,nodata=0,unit=ft and "
      "dem:FILE,encoding=terrarium say how a DEM is read (docs/grounds.md)");
  command->add_option("--out", a.plan.folder, "Results folder")->capture_default_str();
  command->add_flag("--resume", a.plan.resume,
                    "Skip cases that are already in the folder, but not those that failed");
  command->add_flag("--dry-run", a.dry_run, "List the cases instead of measuring them");
  command
      ->add_option("--shard", a.shard,
                   "i/n: measure only every n-th case, starting with the i-th (docs/sweeps.md)")
      ->capture_default_str();
  command
      ->add_option("--cases", a.part,
                   "all; timed: only cases that may record times, which want the machine to themselves; "
                   "untimed: only the others")
      ->check(CLI::IsMember({"all", "timed", "untimed"}))
      ->capture_default_str();
  command
      ->add_option(
          "--jobs", a.plan.jobs,
          "Measure so many untimed cases beside each other, in processes that share the threads; then "
          "the timed ones, one by one. Takes the memory of so many cases")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  add_renderer(*command, a.plan.options.renderer);
  command->add_option("--threads", threads, "Threads to use (default: all cores)")
      ->check(CLI::Range(1, 4096));
  command->add_option("--seed", a.plan.options.seed, "Seed of all randomness")->capture_default_str();
  command->add_option(
      "--set", a.plan.assignments,
      "Parameters of the experiments: name=value or name=value,name=value. Each applies to the cases that "
      "have it. A text value may contain commas, but not one followed by a parameter's name and '='");
}

ExitCode run_command(RunArguments a) {
  parse_shard(a.shard, a.plan);
  a.plan.part = a.part == "timed" ? Part::kTimed : a.part == "untimed" ? Part::kUntimed : Part::kAll;
  a.plan.options.profile = a.profile == "paper"   ? Profile::kPaper
                           : a.profile == "scale" ? Profile::kScale
                                                  : Profile::kQuick;
  if (a.dry_run) {
    print_cases(a.plan);
    return ExitCode::kGood;
  }
  const ExitCode code = run(a.plan);
  fmt::print("measurements: {}\nnext: terrabench check {}; terrabench report {}\n",
             (a.plan.folder / "measurements.jsonl").string(), a.plan.folder.string(), a.plan.folder.string());
  return code;
}

}  // namespace terrabench
