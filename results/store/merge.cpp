#include "results/store/merge.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <tuple>

#include "results/store/format.h"
#include "results/store/provenance.h"
#include "results/store/record_json.h"
#include "results/store/statistics.h"
#include "results/store/store.h"
#include "terrain/error.h"
#include "terrain/files.h"

namespace terrabench {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLargestPicture = std::uint64_t{1} << 28;
constexpr std::string_view kOneSweep = "merge folders of one sweep only";

// A record with the store that it comes from.
struct Source {
  const Store* store;
  const Record* record;

  const Provenance& run() const { return *store->run(record->run); }
  std::string where() const { return store->where(*record); }
};

// A shard may hold a run without a record: there can be more shards than cases.
Store open_shard(const fs::path& folder) {
  if (Store::is_at(folder)) return Store(folder);
  throw bad_input("holds no measurements", folder.string(),
                  "name folders that `terrabench run --out` has written");
}

std::string revision(const Provenance& run) {
  return run.git_revision + (run.git_dirty ? " with uncommitted changes" : "");
}

void check_trustworthy(const Store& store) {
  if (!store.faults().empty()) {
    throw bad_input(store.faults().front(), "", "measure these cases again, or leave the folder out");
  }
  for (const Record& record : store.records()) {
    for (const RecordedFigure& figure : record.figures) {
      if (store.intact(figure)) continue;
      throw bad_input(fmt::format("{} is missing or not the picture that was drawn", figure.file),
                      store.where(record), "measure the case again with `terrabench run --resume`");
    }
  }
}

void check_revision(const Source& first, const Source& other) {
  if (revision(first.run()) == revision(other.run())) return;
  throw bad_input(fmt::format("measured by revision {}, but {} by revision {}", revision(other.run()),
                              first.where(), revision(first.run())),
                  other.where(), "merge folders of one revision only");
}

// Of any two cases: folders of one sweep share the seed, and what stands under a path. (Experiments make
// several grounds of one name, such as in several sizes.)
class SweepCheck {
 public:
  void add(const Source& source) {
    const Record& record = *source.record;
    if (!first_) first_ = source;
    if (record.seed != first_->record->seed) {
      throw bad_input(fmt::format("measured with seed {}, but {} with seed {}", record.seed, first_->where(),
                                  first_->record->seed),
                      source.where(), kOneSweep);
    }
    const bool path = record.terrain.find_first_of("./\\<") != record.terrain.npos;
    if (!path || record.terrain_checksum.empty()) return;
    const auto [at, added] = grounds_.try_emplace({record.experiment, record.profile, record.terrain,
                                                   fmt::format("{}", fmt::join(record.overrides, ","))},
                                                  source);
    if (added || at->second.record->terrain_checksum == record.terrain_checksum) return;
    throw bad_input(fmt::format("{} is another terrain than in {}: the file was changed", record.terrain,
                                at->second.where()),
                    source.where(), kOneSweep);
  }

 private:
  std::optional<Source> first_;
  std::map<std::array<std::string, 4>, Source> grounds_;
};

void check_same_case(const Source& kept, const Source& other) {
  const Record &a = *kept.record, &b = *other.record;
  // A case that failed may not know its terrain's.
  const bool checksums = !a.terrain_checksum.empty() && !b.terrain_checksum.empty();
  const char* const what = checksums && a.terrain_checksum != b.terrain_checksum ? "terrain"
                           : !same_values(a.parameters, b.parameters)            ? "parameters"
                                                                                 : nullptr;
  if (what == nullptr) return;
  throw bad_input(
      fmt::format("{} {} has another {} than in {}", b.experiment, b.case_name, what, kept.where()),
      other.where(), kOneSweep);
}

// Exact figures hold on any machine, so two measurements of a case must agree in them.
void compare_exact(const Source& kept, const Source& other, std::vector<std::string>& contradictions) {
  for (const Metric& metric : kept.record->metrics) {
    const Metric* const match = other.record->find(metric.name);
    if (match == nullptr || timed(metric) || timed(*match) || metric.samples == match->samples) continue;
    contradictions.push_back(fmt::format("{} {} {}: {} in {} on {}; {} in {} on {}", kept.record->experiment,
                                         kept.record->case_name, metric.name,
                                         format_quantity(summarise(metric.samples).median, metric.unit),
                                         kept.store->folder().string(), machine_name(kept.run()),
                                         format_quantity(summarise(match->samples).median, match->unit),
                                         other.store->folder().string(), machine_name(other.run())));
  }
}

// The records of the merged folder, in order, each once.
struct Plan {
  std::vector<Source> records;
  std::map<std::tuple<std::string, std::string, std::string>, std::size_t>
      places;                                   // experiment, case, profile → index in records
  std::map<std::string, std::string> pictures;  // file → checksum
};

void add_record(const Source& source, Plan& plan, Merged& out) {
  const Record& record = *source.record;
  const auto [it, added] =
      plan.places.try_emplace({record.experiment, record.case_name, record.profile}, plan.records.size());
  if (!added) {
    Source& kept = plan.records[it->second];
    if (to_line(*kept.record) == to_line(record))
      return;  // a copy of it, such as from a merge that was killed
    check_same_case(kept, source);
    compare_exact(kept, source, out.contradictions);
    ++out.repeated;
    const auto failed = [](const Record& r) { return r.outcome == CaseOutcome::kFailed; };
    if (!failed(*kept.record) || failed(record)) return;
    kept = source;
  } else {
    plan.records.push_back(source);
  }
  for (const RecordedFigure& figure : record.figures) {
    const auto [picture, first] = plan.pictures.try_emplace(figure.file, figure.checksum);
    if (first || picture->second == figure.checksum) continue;
    throw bad_input(fmt::format("{} is another picture than in a folder before", figure.file), source.where(),
                    kOneSweep);
  }
}

// Pictures first: a record is only written once its pictures are there.
void copy_records(const std::vector<Source>& sources, Store& out) {
  std::vector<Provenance> runs;
  std::vector<Record> records;
  for (const Source& source : sources) {
    if (source.store == &out) continue;
    for (const RecordedFigure& figure : source.record->figures) {
      if (out.intact(figure)) continue;
      write_file(out.path_of(figure.file), read_file(source.store->path_of(figure.file), kLargestPicture));
    }
    const Provenance& run = source.run();
    if (out.run(run.id) == nullptr && std::ranges::count(runs, run.id, &Provenance::id) == 0) {
      runs.push_back(run);
    }
    records.push_back(*source.record);
  }
  if (!records.empty()) out.append_all(runs, records);
}

std::size_t count_machines(const std::vector<Source>& records) {
  std::vector<const Provenance*> kinds;
  for (const Source& source : records) {
    const Provenance& run = source.run();
    if (std::ranges::none_of(kinds, [&](const Provenance* kind) { return comparable(*kind, run); })) {
      kinds.push_back(&run);
    }
  }
  return kinds.size();
}

}  // namespace

Merged merge(const fs::path& out, std::span<const fs::path> folders) {
  std::error_code error;
  for (const fs::path& folder : folders) {
    if (!fs::equivalent(out, folder, error)) continue;
    throw usage_error("the output folder is also an input", out.string(),
                      "name it once, first: it may already hold results");
  }
  Store target(out);
  std::vector<Store> inputs;
  inputs.reserve(folders.size());
  for (const fs::path& folder : folders) inputs.push_back(open_shard(folder));
  std::vector<const Store*> stores{&target};
  for (const Store& store : inputs) stores.push_back(&store);
  Merged result;
  Plan plan;
  SweepCheck sweep;
  for (const Store* const store : stores) {
    check_trustworthy(*store);
    result.warnings.insert(result.warnings.end(), store->warnings().begin(), store->warnings().end());
    for (const Record& record : store->records()) {
      sweep.add({store, &record});
      add_record({store, &record}, plan, result);
      check_revision(plan.records.front(), {store, &record});
    }
  }
  result.machines = count_machines(plan.records);
  for (const Source& source : plan.records) ++(source.store == &target ? result.present : result.copied);
  copy_records(plan.records, target);
  return result;
}

std::string merge_text(const Merged& merged) {
  std::string text;
  for (const std::string& warning : merged.warnings) text += fmt::format("warning: {}\n", warning);
  text += fmt::format("{} records copied, {} were there\n", merged.copied, merged.present);
  if (merged.machines > 1) {
    text += fmt::format(
        "measured on {} machines or builds: `check` judges orders and ratios of times only within one\n",
        merged.machines);
  }
  if (merged.repeated > 0) {
    text += fmt::format(
        "{} cases were measured more than once; the first folder's record is kept, unless it failed\n",
        merged.repeated);
  }
  for (const std::string& line : merged.contradictions) text += fmt::format("differs: {}\n", line);
  if (!merged.passed()) {
    text += fmt::format("{} exact figures differ between folders: they should be the same on any machine\n",
                        merged.contradictions.size());
  }
  return text;
}

}  // namespace terrabench
