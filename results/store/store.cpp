#include "results/store/store.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "results/store/record_json.h"
#include "terrain/files.h"
#include "terrain/machine_error.h"

namespace terrabench {
namespace {

constexpr std::string_view kMeasurements = "measurements.jsonl";

// A sync takes as long as a small case, and only a machine that stops loses what is not synced: a killed
// process does not.
constexpr std::chrono::seconds kSyncInterval{1};

constexpr std::uint64_t kLargestFile = std::uint64_t{1} << 30, kLargestPicture = std::uint64_t{1} << 28;

MachineError cannot_append(const std::filesystem::path& file, int error) {
  return MachineError(fmt::format("cannot write: {}", std::strerror(error)), file.string(),
                      error == ENOSPC || error == EDQUOT
                          ? "free some space on the disk, then go on with --resume"
                          : "check the folder's permissions, or choose another with --out");
}

// The file, locked against other processes that append to it or replace it.
class LockedFile {
 public:
  explicit LockedFile(const std::filesystem::path& path) : path_(path) {
    do {
      if (descriptor_ >= 0) close(descriptor_);
      descriptor_ = ::open(path.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, 0644);
      if (descriptor_ < 0) throw cannot_append(path, errno);
      // Without locks in the file system, lines still stay whole: each is one write.
      while (flock(descriptor_, LOCK_EX) != 0 && errno == EINTR) {
      }
    } while (was_replaced());
  }
  ~LockedFile() { close(descriptor_); }
  LockedFile(const LockedFile&) = delete;
  LockedFile& operator=(const LockedFile&) = delete;

  off_t size() const { return lseek(descriptor_, 0, SEEK_END); }

  // The text after the last newline.
  std::string unfinished_line() const {
    std::string tail;
    char block[4096];
    for (off_t end = size(); end > 0;) {
      const auto length = std::min<off_t>(end, sizeof block);
      const ssize_t got = pread(descriptor_, block, static_cast<std::size_t>(length), end - length);
      if (got != length) throw cannot_append(path_, got < 0 ? errno : EIO);
      const std::string_view text(block, static_cast<std::size_t>(length));
      const std::size_t newline = text.rfind('\n');
      tail.insert(0, text.substr(newline == text.npos ? 0 : newline + 1));
      if (newline != text.npos) break;
      end -= length;
    }
    return tail;
  }

  void sync() {
    if (const int error = sync_error(); error != 0) throw cannot_append(path_, error);
  }

  void cut_to(off_t size) {
    if (ftruncate(descriptor_, size) != 0) throw cannot_append(path_, errno);
  }

  // Writes all of the text or none of it.
  void append(std::string_view text, bool sync) {
    const off_t before = size();
    const ssize_t written = pwrite(descriptor_, text.data(), text.size(), before);
    const bool whole = written == static_cast<ssize_t>(text.size());
    // A full disk first shows as a short write.
    int error = whole ? 0 : written < 0 ? errno : ENOSPC;
    if (whole && sync) error = sync_error();
    if (error == 0) return;
    // If this fails too, the next append removes the half line.
    [[maybe_unused]] const int cut = ftruncate(descriptor_, before);
    throw cannot_append(path_, error);
  }

 private:
  // 0: synced, or the file system cannot.
  int sync_error() { return fsync(descriptor_) == 0 || errno == EINVAL || errno == EROFS ? 0 : errno; }

  // Whether another process replaced the file by a new one while this one waited for its lock.
  bool was_replaced() const {
    struct stat held {
    }, named{};
    return fstat(descriptor_, &held) == 0 &&
           (stat(path_.c_str(), &named) != 0 || held.st_ino != named.st_ino);
  }

  std::filesystem::path path_;
  int descriptor_ = -1;
};

}  // namespace

Store::Store(std::filesystem::path folder) : folder_(std::move(folder)), file_(folder_ / kMeasurements) {
  if (is_at(folder_)) read(read_file(file_, kLargestFile));
}

bool Store::is_at(const std::filesystem::path& folder) {
  std::error_code error;
  return std::filesystem::exists(folder / kMeasurements, error);
}

Store Store::open(const std::filesystem::path& folder, const std::string& profile) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) {
    throw bad_input("no such folder", folder.string(),
                    "name a folder that 'terrabench run --out' has written");
  }
  Store store(folder);
  if (store.records_.empty()) {
    throw bad_input("holds no measurements", folder.string(),
                    "measure first: terrabench run --out " + folder.string());
  }
  if (profile.empty() || profile == store.profile_) return store;
  if (std::ranges::count(store.records_, profile, &Record::profile) == 0) {
    throw bad_input(fmt::format("holds no measurements of profile {}", profile), folder.string(),
                    fmt::format("leave out --profile to read those of profile {}", store.profile_));
  }
  store.profile_ = profile;
  return store;
}

void Store::read(std::string_view content) {
  for (std::size_t at = 0; at < content.size();) {
    const std::size_t newline = content.find('\n', at);
    const bool last = newline == content.npos;
    const std::string_view text = content.substr(at, last ? content.npos : newline - at);
    at = last ? content.size() : newline + 1;
    ++last_line_;
    if (text.find_first_not_of(" \t\r") == text.npos) continue;
    if (last && !is_complete_json(text)) {
      warnings_.push_back(
          fmt::format("{}:{}: the last line was cut short and is dropped", file_.string(), last_line_));
    } else {
      read_line(text);
    }
  }
  for (std::size_t i = 0; i < records_.size(); ++i) {
    if (run(records_[i].run) != nullptr) continue;
    note_fault(fmt::format("{}: {} {} names a run that is not in the file", file_.string(),
                           records_[i].experiment, records_[i].case_name));
  }
  if (records_.empty() && runs_.empty() && !faults_.empty()) {
    throw bad_input("holds no measurements", file_.string(), "the first fault: " + faults_.front());
  }
}

void Store::read_line(std::string_view text) {
  const std::string where = fmt::format("{}:{}", file_.string(), last_line_);
  try {
    Line line = parse_line(text, where);
    if (!line.warning.empty()) warnings_.push_back(where + ": " + line.warning);
    if (line.altered) note_fault(where + ": altered: the digest does not match the content");
    if (auto* record = std::get_if<Record>(&line.content)) {
      keep(std::move(*record), line.altered);
    } else {
      add_run(std::get<Provenance>(std::move(line.content)));
    }
  } catch (const NewerSchema&) {
    throw;
  } catch (const Error& error) {
    note_fault(fmt::format("{}; the line is not used", error.what()));
  }
}

void Store::note_fault(const std::string& fault) {
  faults_.push_back(fault);
  warnings_.push_back(fault);
}

void Store::keep(Record record, bool altered) {
  profile_ = record.profile;
  const auto [at, added] =
      places_.try_emplace({record.experiment, record.case_name, record.profile}, records_.size());
  if (added) {
    records_.emplace_back();
    altered_.emplace_back();
    lines_.emplace_back();
  }
  records_[at->second] = std::move(record);
  altered_[at->second] = altered;
  lines_[at->second] = last_line_;
}

void Store::add_run(Provenance run) {
  std::string id = run.id;
  runs_.try_emplace(std::move(id), std::move(run));
}

void Store::create_folder() const {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw cannot_append(file_, error.value());
}

void Store::append_line(const std::string& line) {
  create_folder();
  LockedFile file(file_);
  const std::string tail = file.unfinished_line();
  const bool finish = is_complete_json(tail);  // an editor may have removed the last newline
  if (!tail.empty() && !finish) file.cut_to(file.size() - static_cast<off_t>(tail.size()));
  const auto now = std::chrono::steady_clock::now();
  const bool sync = now - synced_ >= kSyncInterval;
  file.append((finish ? "\n" : "") + line + "\n", sync);
  if (sync) synced_ = now;
}

void Store::sync() {
  create_folder();
  LockedFile(file_).sync();
}

void Store::begin_run(const Provenance& provenance) {
  const std::string line = to_line(provenance);
  Line parsed = parse_line(line, "this run");
  append_line(line);
  add_run(std::get<Provenance>(std::move(parsed.content)));
}

void Store::append(const Record& record) {
  const std::string line = to_line(record);
  // Do not write a line that cannot be read back.
  Line parsed = parse_line(line, record.experiment + "/" + record.case_name);
  append_line(line);
  ++last_line_;
  keep(std::get<Record>(std::move(parsed.content)), false);
}

void Store::append_all(std::span<const Provenance> runs, std::span<const Record> records) {
  std::string lines;
  for (const Provenance& run : runs) lines += to_line(run) + "\n";
  for (const Record& record : records) lines += to_line(record) + "\n";
  create_folder();
  {
    const LockedFile lock(file_);
    std::string content = read_file(file_, kLargestFile);
    const std::size_t end = content.rfind('\n') + 1;  // npos + 1 is 0
    if (is_complete_json(std::string_view(content).substr(end))) {
      content += '\n';
    } else {
      content.resize(end);
    }
    write_file(file_, content + lines);
  }
  *this = Store(folder_);
}

const Record* Store::find(std::string_view experiment, std::string_view case_name,
                          std::string_view profile) const {
  const auto it = places_.find(std::tuple(experiment, case_name, profile));
  return it == places_.end() ? nullptr : &records_[it->second];
}

const Record* Store::find(const Record& planned, const Provenance& now) const {
  const Record* const record = find(planned.experiment, planned.case_name, planned.profile);
  if (record == nullptr || altered(*record)) return nullptr;
  const Provenance* const measured_under = run(record->run);
  if (measured_under == nullptr || !comparable(*measured_under, now)) return nullptr;
  if (record->seed != planned.seed || !same_values(record->parameters, planned.parameters)) return nullptr;
  if (!planned.terrain_checksum.empty() && record->terrain_checksum != planned.terrain_checksum)
    return nullptr;
  const bool pictures =
      std::ranges::all_of(record->figures, [&](const RecordedFigure& figure) { return intact(figure); });
  return pictures ? record : nullptr;
}

std::pair<const Record*, const RecordedFigure*> Store::find_figure(std::string_view id,
                                                                   std::string_view profile) const {
  std::pair<const Record*, const RecordedFigure*> found{nullptr, nullptr};
  for (const Record& record : records_) {
    if (record.profile != profile || !record.overrides.empty()) continue;
    if (found.first != nullptr && lines_[index(record)] < lines_[index(*found.first)]) continue;
    for (const RecordedFigure& figure : record.figures) {
      if (figure.id == id) found = {&record, &figure};
    }
  }
  return found;
}

const Provenance* Store::run(std::string_view id) const {
  const auto it = runs_.find(id);
  return it == runs_.end() ? nullptr : &it->second;
}

bool Store::altered(const Record& record) const { return altered_[index(record)]; }

std::string Store::where(const Record& record) const {
  return fmt::format("{}:{}", file_.string(), lines_[index(record)]);
}

bool Store::intact(const RecordedFigure& figure) const {
  std::error_code error;
  try {
    const std::filesystem::path file = path_of(figure.file);
    return std::filesystem::is_regular_file(file, error) &&
           checksum(read_file(file, kLargestPicture)) == figure.checksum;
  } catch (const Error&) {
    return false;
  }
}

std::filesystem::path Store::path_of(const std::string& figure_file) const {
  const std::filesystem::path file = folder_ / figure_file;
  std::error_code error;
  const std::filesystem::path within =
      std::filesystem::weakly_canonical(file, error)
          .lexically_relative(std::filesystem::weakly_canonical(folder_, error));
  if (error || within.empty() || *within.begin() == "..") {
    throw bad_input("leads out of the results folder", file.string(),
                    "put the picture itself there, or measure the case again");
  }
  return file;
}

}  // namespace terrabench
