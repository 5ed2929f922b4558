#include "experiments/runner.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <new>
#include <sstream>
#include <system_error>

#include "experiments/processes.h"
#include "experiments/stopwatch.h"
#include "experiments/time_left.h"
#include "renderers/context.h"
#include "renderers/raytrace/ray_index.h"
#include "results/store/absences.h"
#include "results/store/format.h"
#include "results/store/provenance.h"
#include "results/store/record_json.h"
#include "results/store/statistics.h"
#include "results/store/store.h"
#include "terrain/duration.h"
#include "terrain/files.h"
#include "terrain/image.h"
#include "terrain/machine_error.h"
#include "terrain/sources/noise/program.h"

namespace terrabench {
namespace {

// GL_RENDERER, or why there is none; a run without pictures is still useful.
std::string renderer_name(const std::string& context) {
  try {
    return open_context(context, 16, 16)->renderer();
  } catch (const Error& error) {
    if (error.code() != ExitCode::kEnvironment) throw;
    return fmt::format("none ({})", error.what());
  }
}

// What the picture is and contains. One that was drawn without a sheet is a single panel.
void describe(const std::filesystem::path& folder, RecordedFigure& figure) {
  const std::string bytes = read_file(folder / figure.file);
  figure.checksum = checksum(bytes);
  if (figure.layout != FigureLayout()) return;
  const auto [width, height] = picture_size(bytes, figure.file);
  figure.layout.panels = {{0, 0, width, height}};
}

std::vector<std::pair<std::string, Value>> values(const Parameters& parameters) {
  std::vector<std::pair<std::string, Value>> out;
  for (std::size_t i = 0; i < parameters.specs().size(); ++i) {
    out.emplace_back(parameters.specs()[i].name, parameters.value(i));
  }
  return out;
}

// Reads the user's grounds once before anything is measured on them: says what their reader converted,
// guessed or left out, and throws for one that cannot be read.
void print_notes(const RunOptions& options) {
  for (const std::string& terrain : options.terrains) {
    const std::string file = terrain_file(terrain);
    std::error_code error;
    if (file.empty() || std::filesystem::is_directory(file, error)) continue;
    const std::string notes = call_in_process(
        [&] { return fmt::format("{}", fmt::join(open_terrain(terrain, options.seed).notes, "\n")); });
    std::istringstream lines(notes);
    for (std::string note; std::getline(lines, note);) fmt::print(stderr, "note: {}: {}\n", terrain, note);
  }
}

Provenance provenance_of(const RunPlan& plan) {
  return collect_provenance({.command = plan.command,
                             .gl_renderer = renderer_name(plan.options.renderer),
                             .simd = std::string(noise::simd_name()),
                             .threads = plan.threads,
                             .libraries = {{"Embree", RayIndex::embree_version()}}});
}

// The same without a thread or an OpenGL context in this process, so that it can be forked.
Provenance provenance_from_process(const RunPlan& plan) {
  const std::string line = call_in_process([&] { return to_line(provenance_of(plan)); });
  return std::get<Provenance>(parse_line(line, "this run").content);
}

Progress::Output progress_output() {
  return isatty(STDERR_FILENO) != 0 ? Progress::Output::kTerminal : Progress::Output::kLines;
}

// What is known of a case before it is measured.
Record begin_record(const RunPlan& plan, const PlannedCase& planned, const std::string& run) {
  Record record;
  record.experiment = planned.experiment->id;
  record.case_name = planned.at.name;
  record.overrides = planned.at.overrides;
  record.profile = plan.options.profile == Profile::kQuick ? "quick" : "paper";
  record.run = run;
  record.seed = plan.options.seed;
  record.parameters = values(planned.at.parameters);
  record.terrain_checksum = plan.terrain_checksum;
  return record;
}

bool is_settled(const Record& record, const Store& store, const Provenance& now) {
  const Record* const found = store.find(record, now);
  return found != nullptr && found->outcome != CaseOutcome::kFailed;
}

// Otherwise the times of a case that ran beside others would be taken for those of one that ran alone.
void check_untimed(const Record& record) {
  for (const Metric& metric : record.metrics) {
    if (!is_timing(metric.unit)) continue;
    throw Error(ExitCode::kEnvironment,
                fmt::format("records the time '{}', but counts as untimed", metric.name), record.experiment,
                "let the experiment's kind be kTimed (experiments/experiment.h), or its times() be true for "
                "this case");
  }
}

void become(CaseOutcome outcome, std::string_view reason, const PlannedCase& planned, Record& record) {
  record.outcome = outcome;
  record.reason = reason.empty() ? "for an unknown reason" : printable(reason);
  record.metrics.clear();
  record.figures.clear();
  record.undefined.clear();
  if (record.terrain.empty()) record.terrain = planned.at.terrain;
}

void check_interrupted() {
  if (!Progress::interrupted()) return;
  throw Error(ExitCode::kInterrupted, "interrupted", "run",
              "measurements are kept; to continue, repeat the command (`run`: add --resume)");
}

void measure(const RunPlan& plan, const PlannedCase& planned, Progress::Output output, Record& record) {
  check_interrupted();
  Progress progress(output);
  Recorder recorder(record, plan.folder);
  planned.experiment->measure(planned.at, plan.options, recorder, progress);
  progress.end();
  if (!planned.experiment->timed(planned.at)) check_untimed(record);
  for (RecordedFigure& figure : record.figures) describe(plan.folder, figure);
}

// The record of the case, whatever became of it. Throws only what ends the run.
Record outcome_of(const RunPlan& plan, const PlannedCase& planned, Record record, Progress::Output output) {
  const auto fail = [&](std::string_view reason) {
    check_interrupted();  // what an interruption broke is not the case's fault
    become(CaseOutcome::kFailed, reason, planned, record);
  };
  try {
    measure(plan, planned, output, record);
  } catch (const SkippedCase& skipped) {
    become(CaseOutcome::kSkipped, skipped.what(), planned, record);
  } catch (const MachineError&) {
    throw;
  } catch (const Error& error) {
    fail(error.what());
  } catch (const std::bad_alloc&) {
    fail("out of memory");
  } catch (const std::filesystem::filesystem_error& error) {
    fail(error.what());
  } catch (const std::system_error&) {
    throw;  // of standard output or standard error
  } catch (const std::exception& error) {
    fail(error.what());
  }
  return record;
}

// The planned cases, measured into one folder.
class Session {
 public:
  explicit Session(const RunPlan& plan) : plan_(plan), cases_(plan_cases(plan)), store_(plan.folder) {
    for (const std::string& warning : store_.warnings()) fmt::print(stderr, "warning: {}\n", warning);
    print_notes(plan.options);
    provenance_ = provenance_from_process(plan);
    for (const std::string& warning : provenance_.timing_warnings) {
      fmt::print(stderr, "warning: {}\n", warning);
    }
    store_.begin_run(provenance_);
  }

  ExitCode run() {
    std::vector<std::size_t> untimed, own_process, alone;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      if (plan_.resume && is_settled(begin(i), store_, provenance_)) continue;
      const Experiment& experiment = *cases_[i].experiment;
      left_.expect(weight(i));
      if (experiment.kind == Experiment::kOwnProcess) {
        own_process.push_back(i);
      } else {
        (plan_.jobs > 1 && !experiment.timed(cases_[i].at) ? untimed : alone).push_back(i);
      }
    }
    fmt::print(stderr, "{}", left_.forecast());
    const auto output = progress_output();
    measure_in_processes(untimed, plan_.jobs, Progress::Output::kSilent);
    for (const std::size_t i : untimed) left_.done(weight(i));
    for (const std::size_t i : own_process) {
      measure_in_processes({i}, 1, output);
      left_.done(weight(i));
    }
    for (const std::size_t i : alone) {
      measure_one(i, output);
      left_.done(weight(i));
    }
    store_.sync();
    const std::size_t skipped = cases_.size() - untimed.size() - own_process.size() - alone.size();
    if (skipped > 0)
      fmt::print(stderr, "{} of {} cases were already in the results folder\n", skipped, cases_.size());
    return list_absent() ? kCasesFailed : ExitCode::kGood;
  }

 private:
  void measure_in_processes(const std::vector<std::size_t>& cases, int jobs, Progress::Output output) {
    const auto share = static_cast<std::size_t>(std::max(1, provenance_.threads / jobs));
    run_in_processes(
        jobs, cases.size(),
        [&](std::size_t k) {
          const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, share);
          measure_one(cases[k], output, jobs > 1);
        },
        [&](std::size_t k, const std::string& how) { note_death(cases[k], how); });
  }

  // `beside_others`: how long these take says nothing of the time left.
  void measure_one(std::size_t i, Progress::Output output, bool beside_others = false) {
    const Stopwatch watch;
    Record record = outcome_of(plan_, cases_[i], begin(i), output);
    const double seconds = record.seconds = watch.seconds();
    keep(record, i);
    fmt::print(stderr, "[{}/{}] {}: {:.2f} s{}{}\n", i + 1, cases_.size(), title(i), seconds,
               record.outcome == CaseOutcome::kMeasured
                   ? ""
                   : fmt::format(", {}: {}", name(record.outcome), record.reason),
               beside_others ? "" : left_.text(weight(i)));
  }

  // As a failure if the record cannot be written as it is.
  void keep(Record& record, std::size_t i) {
    try {
      store_.append(record);
    } catch (const MachineError&) {
      throw;
    } catch (const Error& error) {
      become(CaseOutcome::kFailed, error.what(), cases_[i], record);
      store_.append(record);
    }
  }

  // The process that measured the case was killed or crashed.
  void note_death(std::size_t i, const std::string& how) {
    Record record = begin(i);
    become(CaseOutcome::kFailed, how, cases_[i], record);
    store_.append(record);
    fmt::print(stderr, "[{}/{}] {}, failed: {}\n", i + 1, cases_.size(), title(i), how);
  }

  // Prints which of the planned cases failed or were skipped, and why, from the folder, since other processes
  // measured some; returns whether any failed, or was lost by a process that ended between two cases.
  bool list_absent() const {
    const Store store(plan_.folder);
    std::vector<const Record*> records;
    bool lost = false;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      const Record planned = begin(i);
      const Record* const record = store.find(planned.experiment, planned.case_name, planned.profile);
      if (record == nullptr) {
        fmt::print(stderr, "not measured: {}\n", title(i));
        lost = true;
      } else if (record->outcome != CaseOutcome::kMeasured) {
        records.push_back(record);
      }
    }
    fmt::print(stderr, "{}", absences_text(absences(records), false));
    return lost ||
           std::ranges::any_of(records, [](const Record* r) { return r->outcome == CaseOutcome::kFailed; });
  }

  Record begin(std::size_t i) const { return begin_record(plan_, cases_[i], provenance_.id); }
  double weight(std::size_t i) const { return expected_seconds(plan_, cases_[i]); }
  std::string title(std::size_t i) const {
    return fmt::format("{} {}", cases_[i].experiment->id, cases_[i].at.name);
  }

  const RunPlan& plan_;
  std::vector<PlannedCase> cases_;
  Store store_;
  Provenance provenance_;
  TimeLeft left_;
};

}  // namespace

ExitCode run(const RunPlan& plan) { return Session(plan).run(); }

}  // namespace terrabench
