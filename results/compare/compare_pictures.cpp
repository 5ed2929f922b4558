#include "results/compare/compare_pictures.h"

#include <fmt/format.h>
#include <tbb/parallel_for_each.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>

#include "results/store/format.h"
#include "terrain/error.h"
#include "terrain/files.h"
#include "terrain/image.h"
#include "terrain/metrics/image_error.h"

namespace terrabench {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostAlone = 10;  // pictures of one folder alone that the text lists
constexpr std::string_view kNames[] = {"not compared", "differs",     "close",
                                       "identical",    "only before", "only after"};

// Pairs of more pixels, or of files of more bytes, are compared one after another.
constexpr std::int64_t kSmall = std::int64_t{1} << 22;
constexpr std::uint64_t kLargestFile = std::uint64_t{1} << 30;

// The pictures of a folder.
struct Pictures {
  fs::path folder;
  const Store* store;                            // null: the files are not recorded
  std::map<std::string, std::string> checksums;  // by file; empty when not recorded

  fs::path path_of(const std::string& file) const {
    return store == nullptr ? folder / file : store->path_of(file);
  }
};

// A file that several records name is as the last of them drew it.
Pictures recorded(const Store& store) {
  Pictures pictures{store.folder(), &store, {}};
  std::map<std::string, std::size_t> lines;
  for (const Record& record : store.records()) {
    for (const RecordedFigure& figure : record.figures) {
      const auto [line, added] = lines.try_emplace(figure.file, store.line(record));
      if (!added && line->second > store.line(record)) continue;
      line->second = store.line(record);
      pictures.checksums[figure.file] = figure.checksum;
    }
  }
  return pictures;
}

bool is_picture_name(const fs::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending == ".png" || ending == ".webp";
}

// The file's name in the other folder, where the picture may have been written in another form.
std::string twin(const std::string& file, const Pictures& other) {
  if (other.checksums.contains(file)) return file;
  for (const char* ending : {".webp", ".png"}) {
    const std::string name = fs::path(file).replace_extension(ending).string();
    if (other.checksums.contains(name)) return name;
  }
  return "";
}

Pictures found_in(const fs::path& folder) {
  Pictures pictures{folder, nullptr, {}};
  try {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.is_regular_file() && is_picture_name(entry.path()))
        pictures.checksums[entry.path().lexically_relative(folder).string()];
    }
  } catch (const fs::filesystem_error& error) {
    throw bad_input(fmt::format("cannot be read: {}", error.code().message()), folder.string(),
                    "name a results folder, or a folder of pictures");
  }
  return pictures;
}

// Two files that must be decoded.
struct Pair {
  fs::path before, after;
  ComparedPicture* result;
  bool small;  // whether both may be decoded beside others
};

std::string content(const Pictures& pictures, const std::string& file, std::string_view side) {
  const fs::path path = pictures.path_of(file);
  std::error_code error;
  if (!fs::is_regular_file(path, error)) throw bad_input(fmt::format("missing {}", side), "", "");
  std::string bytes = read_file(path, kLargestFile);
  const std::string& recorded = pictures.checksums.at(file);
  if (!recorded.empty() && checksum(bytes) != recorded)
    throw bad_input(fmt::format("{} it is not the picture that its record names", side), "", "");
  return bytes;
}

// Calls `work`, which may find that the two cannot be compared.
template <class Work>
void or_not_compared(ComparedPicture& picture, const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    if (error.code() != ExitCode::kBadInput) throw;
    picture.change = PictureChange::kNotCompared;
    picture.reason = error.what();
  }
}

// Nothing if the two need not be decoded: then all that there is to say of them is said.
std::optional<Pair> settle(const Pictures& before, const Pictures& after, ComparedPicture& result) {
  std::optional<Pair> pair;
  or_not_compared(result, [&] {
    const std::string bytes_before = content(before, result.file, "before"),
                      bytes_after = content(after, result.file_after, "after");
    if (bytes_before == bytes_after) {
      result.change = PictureChange::kIdentical;
      return;
    }
    const fs::path path_before = before.path_of(result.file), path_after = after.path_of(result.file_after);
    const auto [width, height] = result.size = picture_size(bytes_before, path_before.string());
    const auto [width_after, height_after] = picture_size(bytes_after, path_after.string());
    if (width != width_after || height != height_after) {
      result.reason =
          fmt::format("{} × {} pixels before, {} × {} after", width, height, width_after, height_after);
      return;
    }
    const bool small = std::int64_t{width} * height <= kSmall &&
                       std::ssize(bytes_before) + std::ssize(bytes_after) <= 8 * kSmall;
    pair = {path_before, path_after, &result, small};
  });
  return pair;
}

void decode(const Pair& pair, const PictureLimits& limits) {
  ComparedPicture& result = *pair.result;
  or_not_compared(result, [&] {
    const Image before = read_picture(pair.before), after = read_picture(pair.after);
    result.psnr = psnr(before, after);
    result.ssim = ssim(before, after);
    result.differing = differing_pixels(before, after);
    const bool close = result.psnr >= limits.psnr && result.ssim >= limits.ssim;
    result.change = close ? PictureChange::kClose : PictureChange::kDiffers;
  });
}

PictureComparison compare_all(const Pictures& before, const Pictures& after, const PictureLimits& limits) {
  PictureComparison comparison{limits, {}};
  std::vector<ComparedPicture>& pictures = comparison.pictures;
  for (const auto& [file, checksum] : before.checksums) {
    std::string other = twin(file, after);
    const auto change = other.empty() ? PictureChange::kOnlyBefore : PictureChange::kNotCompared;
    pictures.push_back({.file = file, .file_after = std::move(other), .change = change});
  }
  for (const auto& [file, checksum] : after.checksums) {
    if (twin(file, before).empty()) pictures.push_back({.file = file, .change = PictureChange::kOnlyAfter});
  }
  std::vector<Pair> beside, alone;
  for (ComparedPicture& picture : pictures) {
    if (picture.change != PictureChange::kNotCompared) continue;
    if (std::optional<Pair> pair = settle(before, after, picture)) {
      (pair->small ? beside : alone).push_back(std::move(*pair));
    }
  }
  tbb::parallel_for_each(beside, [&](const Pair& pair) { decode(pair, limits); });
  for (const Pair& pair : alone) decode(pair, limits);
  std::ranges::sort(pictures, {},
                    [](const ComparedPicture& p) { return std::tie(p.change, p.psnr, p.ssim, p.file); });
  return comparison;
}

bool one_sided(const ComparedPicture& p) {
  return p.change == PictureChange::kOnlyBefore || p.change == PictureChange::kOnlyAfter;
}

bool decoded(const ComparedPicture& p) {
  return p.change == PictureChange::kClose || p.change == PictureChange::kDiffers;
}

std::string finding_text(const ComparedPicture& p) {
  if (one_sided(p)) return "";
  if (!decoded(p)) return "  " + printable(p.reason);
  if (p.differing == 0) return "  all pixels equal, in other bytes";
  const double all = static_cast<double>(p.size[0]) * p.size[1];
  return fmt::format("  {:.2f} dB, SSIM {:.4f}, {} of {} × {} pixels differ ({} %)", p.psnr, p.ssim,
                     format_count(p.differing), p.size[0], p.size[1],
                     format_number(100 * static_cast<double>(p.differing) / all));
}

}  // namespace

std::string_view name(PictureChange change) { return kNames[static_cast<std::size_t>(change)]; }

std::size_t PictureComparison::count(PictureChange change) const {
  return static_cast<std::size_t>(std::ranges::count(pictures, change, &ComparedPicture::change));
}

PictureComparison compare_pictures(const Store& before, const Store& after, const PictureLimits& limits) {
  return compare_all(recorded(before), recorded(after), limits);
}

PictureComparison compare_pictures(const fs::path& before, const fs::path& after,
                                   const PictureLimits& limits) {
  PictureComparison comparison = compare_all(found_in(before), found_in(after), limits);
  if (std::ranges::all_of(comparison.pictures, one_sided)) {
    throw bad_input("no results, and no pictures of the same names",
                    fmt::format("{} and {}", before.string(), after.string()),
                    "name two results folders, or two folders of PNG or WebP files with the same names");
  }
  return comparison;
}

std::string pictures_text(const PictureComparison& comparison, bool colour) {
  if (comparison.pictures.empty()) return "";
  std::string tally, text;
  for (std::size_t i = 0; i < std::size(kNames); ++i) {
    const std::size_t count = comparison.count(static_cast<PictureChange>(i));
    if (count > 0) tally += fmt::format("{}{} {}", tally.empty() ? "" : ", ", count, kNames[i]);
  }
  std::size_t alone = 0;
  for (const ComparedPicture& p : comparison.pictures) {
    if (p.change == PictureChange::kIdentical || (one_sided(p) && ++alone > kMostAlone)) continue;
    const bool marked = p.change != PictureChange::kClose;
    const std::string_view paint = colour && marked ? "\x1b[33m" : "", plain = paint.empty() ? "" : "\x1b[0m";
    text += fmt::format("  {} {}{:<12}{} {}{}\n", marked ? '*' : ' ', paint, name(p.change), plain,
                        printable(p.file), finding_text(p));
  }
  if (alone > kMostAlone) {
    text += fmt::format("  … and {} more that only one folder has; --json lists all\n", alone - kMostAlone);
  }
  return fmt::format("pictures: {} (close: at least {} dB and SSIM {})\n{}", tally, comparison.limits.psnr,
                     comparison.limits.ssim, text);
}

std::string pictures_json(const PictureComparison& comparison) {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  for (const ComparedPicture& p : comparison.pictures) {
    Json entry = {{"file", p.file}, {"change", name(p.change)}};
    if (!p.reason.empty()) entry["reason"] = p.reason;
    if (decoded(p)) {
      entry["width"] = p.size[0];
      entry["height"] = p.size[1];
      entry["psnr"] = p.psnr;  // JSON has no infinity: null
      entry["ssim"] = p.ssim;
      entry["differing"] = p.differing;
    }
    list.push_back(std::move(entry));
  }
  const Json json = {{"passed", comparison.passed()},
                     {"psnr", comparison.limits.psnr},
                     {"ssim", comparison.limits.ssim},
                     {"list", list}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace terrabench
