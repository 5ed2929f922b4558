// A results folder: DIR/measurements.jsonl, one line a process run and one a measured case, only ever
// appended to, so that a killed run loses at most the case it was in. Each append is one write and one fsync.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "results/record.h"

namespace terrabench {

// What makes a measurement the one that --resume need not repeat.
struct CaseKey {
  std::string_view experiment, case_name, profile;
  std::vector<std::pair<std::string, Value>> parameters;  // in any order
  std::uint64_t seed = 0;
  std::optional<std::string_view> terrain_checksum;  // nothing: not known yet, and not compared
};

class Store {
 public:
  // Reads what the folder holds; a folder without measurements is an empty store. A last line that was cut
  // short is dropped with a warning (and removed by the next append); so is any line that is damaged. Throws
  // bad_input when the file cannot be read, or holds nothing but damage.
  explicit Store(std::filesystem::path folder);

  // As above, for reading results: throws bad_input when there are no measurements.
  static Store open(const std::filesystem::path& folder);

  // Throw environment_error (disk full, unwritable) with the file as it was. Several processes may append to
  // one folder. append() needs the record's run to have begun.
  void begin_run(const Provenance&);
  void append(const Record&);

  // The newest record of each case and profile, in the order in which the cases were first measured. Altered
  // records are among them: see altered().
  const std::vector<Record>& records() const { return records_; }
  const Record* find(std::string_view experiment, std::string_view case_name, std::string_view profile) const;
  // The record with this key, if it is unaltered and its pictures are still there.
  const Record* find(const CaseKey&) const;
  const Provenance* run(std::string_view id) const;  // null when unknown

  bool altered(const Record&) const;  // of records()
  // The profile of what was measured last; empty for an empty store.
  const std::string& last_profile() const { return last_profile_; }

  const std::filesystem::path& folder() const { return folder_; }
  // For the user: what was dropped or ignored in reading, with line numbers.
  const std::vector<std::string>& warnings() const { return warnings_; }
  // Of these, what makes the results untrustworthy: altered and damaged lines, records without their run.
  const std::vector<std::string>& faults() const { return faults_; }

 private:
  void read(std::string_view content);
  void read_line(std::string_view text, std::size_t number);
  void keep(Record record, bool altered);
  void append_line(const std::string& line) const;

  std::filesystem::path folder_, file_;
  std::vector<Record> records_;
  std::vector<bool> altered_;  // beside records_
  std::vector<Provenance> runs_;
  std::string last_profile_;
  std::vector<std::string> warnings_, faults_;
};

}  // namespace terrabench
