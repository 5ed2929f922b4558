// A results folder: DIR/measurements.jsonl, with one line per run of the program and one per measured case.
// Lines are only appended, so a killed run loses at most its current case. An append is one write; at most
// once per second, and at a run's end, it is also synced to the disk, so a power failure loses what was
// measured in the seconds before it.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "results/store/record.h"

namespace terrabench {

class Store {
 public:
  // Reads the folder, n lines in O(n log n); a folder without measurements is an empty store. Drops damaged
  // lines with a warning, also a last line that was cut short, which the next append removes. Throws
  // bad_input when the file cannot be read, all its lines are damaged, or one was written by a later version
  // of the program.
  explicit Store(std::filesystem::path folder);

  // Whether the folder holds a file of measurements.
  static bool is_at(const std::filesystem::path& folder);
  // As the constructor, but throws bad_input when there are no measurements, or none of this profile; empty:
  // any.
  static Store open(const std::filesystem::path& folder, const std::string& profile = "");

  // Throw environment_error (disk full, unwritable) and leave the file as it was. Several processes may
  // append to one folder. The record's run must have begun before append().
  void begin_run(const Provenance&);
  void append(const Record&);
  void sync();  // to the disk, as far as the file system can
  // Appends all of them in one step: whenever the process is killed, the file is the old one or the whole new
  // one. Then reads the folder again: O(bytes of the file).
  void append_all(std::span<const Provenance> runs, std::span<const Record> records);

  // The newest record of each case and profile, in the order in which the cases were first measured. Altered
  // records are among them: see altered().
  const std::vector<Record>& records() const { return records_; }
  // A case with overridden parameters has a name of its own (Record::case_name).
  const Record* find(std::string_view experiment, std::string_view case_name, std::string_view profile) const;
  // For --resume: the record of this case with the same seed and parameters, and of the same terrain if
  // `planned` knows its checksum; if it is unaltered, its pictures are still those that it drew, and its run
  // is comparable with `now`. Otherwise null.
  const Record* find(const Record& planned, const Provenance& now) const;
  // The newest record of the profile that drew this figure, ignoring records with overridden parameters. Both
  // null when there is none.
  std::pair<const Record*, const RecordedFigure*> find_figure(std::string_view id,
                                                              std::string_view profile) const;
  const Provenance* run(std::string_view id) const;  // null when unknown

  // For a record of records(): whether it was altered by hand, and "file:line".
  bool altered(const Record&) const;
  std::string where(const Record&) const;
  std::size_t line(const Record& record) const { return lines_[index(record)]; }  // from 1
  // Whether the picture exists, byte for byte as recorded. Reads the file.
  bool intact(const RecordedFigure&) const;
  // Where a picture lies, or would be written. Throws bad_input when links lead out of the folder.
  std::filesystem::path path_of(const std::string& figure_file) const;
  // The profile that is judged and reported: the one that open() was given, otherwise that of the newest
  // record; empty for an empty store.
  const std::string& profile() const { return profile_; }

  const std::filesystem::path& folder() const { return folder_; }
  // What was dropped or ignored while reading, with line numbers.
  const std::vector<std::string>& warnings() const { return warnings_; }
  // Those warnings that make the results untrustworthy: altered or damaged lines, records without their run.
  const std::vector<std::string>& faults() const { return faults_; }

 private:
  void read(std::string_view content);
  void read_line(std::string_view text);
  void note_fault(const std::string& fault);
  void keep(Record record, bool altered);
  void add_run(Provenance);
  std::size_t index(const Record& record) const {
    return static_cast<std::size_t>(&record - records_.data());
  }
  void create_folder() const;
  void append_line(const std::string& line);

  std::filesystem::path folder_, file_;
  std::vector<Record> records_;
  std::vector<bool> altered_;       // parallel to records_
  std::vector<std::size_t> lines_;  // parallel to records_: line numbers, so a larger one is newer
  std::size_t last_line_ = 0;       // number of the line that was read or appended last
  std::map<std::tuple<std::string, std::string, std::string>, std::size_t, std::less<>>
      places_;                                           // experiment, case, profile → index in records_
  std::map<std::string, Provenance, std::less<>> runs_;  // by id
  std::string profile_;
  std::chrono::steady_clock::time_point synced_{};  // when this process last synced the file
  std::vector<std::string> warnings_, faults_;
};

}  // namespace terrabench
