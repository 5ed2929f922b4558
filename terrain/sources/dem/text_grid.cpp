// Grids of numbers as text (Arc/Info and GRASS ASCII grids). GDAL reads a word among the numbers as 0, reads
// whole numbers as integers, which cannot hold "nan", and takes a word at the beginning for the header's.
#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal_priv.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <memory>
#include <string_view>
#include <system_error>
#include <vector>

#include "terrain/error.h"
#include "terrain/memory.h"
#include "terrain/sources/dem/gdal_session.h"

namespace terrabench {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 20, kLongestWord = 64;

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r') || c == '\0'; }

std::string lower(std::string_view word) {
  std::string text(word);
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

// Keys of the header of an Arc/Info and of a GRASS grid.
bool is_key(std::string_view word) {
  constexpr std::string_view kKeys[] = {
      "ncols",  "nrows", "xllcorner", "yllcorner", "xllcenter",    "yllcenter", "cellsize",
      "dx",     "dy",    "xdim",      "ydim",      "nodata_value", "nodata",    "north:",
      "south:", "east:", "west:",     "rows:",     "cols:",        "null:",     "type:"};
  return std::ranges::find(kKeys, std::string_view(lower(word))) != std::end(kKeys);
}

// Words for no height that GDAL reads as 0.
bool is_void(std::string_view word) {
  constexpr std::string_view kWords[] = {"null", "na", "n/a"};
  return std::ranges::find(kWords, std::string_view(lower(word))) != std::end(kWords);
}

// As GDAL reads it: a decimal comma, a leading plus, "nan" and GRASS's "*" for no data are numbers.
bool is_height(std::string_view word) {
  if (word == "*") return true;
  std::string text = lower(word.substr(word.starts_with('+') ? 1 : 0));
  std::ranges::replace(text, ',', '.');
  if (text == "nan" || text == "-nan" || text == "inf" || text == "-inf" || text.starts_with("1.#"))
    return true;
  // A number out of range, such as 1e-400, is one, too.
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error != std::errc::invalid_argument && end == text.data() + text.size();
}

// Follows the words of the file. The values begin after the last line that begins with a key.
class Scanner {
 public:
  // `rewritten`: takes a copy of the text in which each word that GDAL would misread is a number that is no
  // height; may be null.
  Scanner(std::string path, std::string* rewritten) : path_(std::move(path)), rewritten_(rewritten) {}

  void take(char c) {
    if (!is_space(c)) {
      if (word_.empty()) begin_ = column_;
      if (word_.size() < kLongestWord || rewritten_ != nullptr) word_ += c;
    } else if (!word_.empty()) {
      end_word();
    }
    if (is_space(c) && rewritten_ != nullptr) *rewritten_ += c;
    ++column_;
    if (c == '\n') {
      ++line_;
      column_ = 1;
      header_line_ = false;
      first_ = true;
    }
  }
  void end_word() {
    if (word_.empty()) return;
    bool begins = false;
    if (first_ && !values_) {
      header_line_ = is_key(word_);
      values_ = begins = !header_line_;
    }
    first_ = false;
    const bool missing = is_void(word_);
    if (!header_line_ && !missing && !is_height(word_)) {
      throw bad_input(fmt::format("'{}' stands where a height should be", printable()),
                      fmt::format("{}:{}:{}", path_, line_, begin_),
                      "replace it by a number, or by the grid's no-data value");
    }
    const bool misread = missing || (begins && std::isalpha(static_cast<unsigned char>(word_[0])) != 0);
    misread_ = misread_ || misread;
    if (rewritten_ != nullptr) *rewritten_ += misread ? kNoHeight : word_;
    word_.clear();
  }
  // Whether GDAL would misread a word.
  bool misread() const { return misread_; }

 private:
  // Not a whole number, and impossible as a height.
  static constexpr std::string_view kNoHeight = "-1.e38";

  std::string printable() const {
    std::string text = word_.substr(0, kLongestWord);
    std::ranges::replace_if(
        text, [](unsigned char c) { return c < 0x20 || c >= 0x7F; }, '?');
    return text;
  }

  std::string path_, word_;
  std::string* rewritten_;
  std::uint64_t line_ = 1, column_ = 1, begin_ = 1;
  bool first_ = true;         // no word of this line has been read
  bool header_line_ = false;  // this line is one of the header's
  bool values_ = false;       // the header has ended
  bool misread_ = false;
};

struct CloseFile {
  void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};

// Whether GDAL would misread a word of the grid. Throws bad_input with line and column for the first word
// among the values that is neither a number nor stands for no height. Reads the file once, in blocks.
bool scan_text_grid(const std::string& path, std::string* rewritten = nullptr) {
  const std::unique_ptr<VSILFILE, CloseFile> file(VSIFOpenL(path.c_str(), "rb"));
  if (file == nullptr) return false;  // not a file of its own: the driver says what it is
  Scanner scanner(path, rewritten);
  std::vector<char> block(kBlock);
  while (const std::size_t got = VSIFReadL(block.data(), 1, block.size(), file.get())) {
    for (std::size_t i = 0; i < got; ++i) scanner.take(block[i]);
  }
  scanner.end_word();
  return scanner.misread();
}

constexpr const char* kFormats[] = {"AAIGrid", "GRASSASCIIGrid"};

// GDAL does not tell the function which driver it is called for, so each format has its own.
using OpenFunction = GDALDataset* (*)(GDALOpenInfo*);
template <int format>
OpenFunction unchecked_open = nullptr;

// Opens a copy in memory, which lives as long as the dataset, with the file's reference system beside it.
template <int format>
GDALDataset* open_rewritten(const GDALOpenInfo& info) {
  const std::string path = info.pszFilename;
  VSIStatBufL status;
  if (VSIStatL(path.c_str(), &status) == 0) {
    require_memory(static_cast<std::uint64_t>(status.st_size) * 2, path, "write its words as numbers");
  }
  std::string text;
  scan_text_grid(path, &text);
  static std::atomic<int> number = 0;
  const std::string base = fmt::format("/vsimem/terrabench-text-grid-{}-{}", format, ++number);
  const std::string copy = base + ".asc", system = base + ".prj";
  const auto write = [](const std::string& name, const void* data, std::size_t size) {
    const std::unique_ptr<VSILFILE, CloseFile> out(VSIFOpenL(name.c_str(), "wb"));
    if (out != nullptr) VSIFWriteL(data, 1, size, out.get());
  };
  write(copy, text.data(), text.size());
  const std::string beside = CPLResetExtension(path.c_str(), "prj");
  if (VSIStatL(beside.c_str(), &status) == 0) {
    GByte* bytes = nullptr;
    vsi_l_offset size = 0;
    if (VSIIngestFile(nullptr, beside.c_str(), &bytes, &size, 1 << 20) != 0) write(system, bytes, size);
    VSIFree(bytes);
  }
  GDALOpenInfo rewritten(copy.c_str(), GA_ReadOnly);
  GDALDataset* const dataset = unchecked_open<format>(&rewritten);
  for (const std::string& name : {copy, system}) VSIUnlink(name.c_str());
  if (dataset != nullptr) dataset->SetDescription(path.c_str());
  return dataset;
}

template <int format>
GDALDataset* checked_open(GDALOpenInfo* info) {
  const GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName(kFormats[format]);
  if (driver->pfnIdentify != nullptr && driver->pfnIdentify(info) == 0) return nullptr;
  try {
    return scan_text_grid(info->pszFilename) ? open_rewritten<format>(*info) : unchecked_open<format>(info);
  } catch (const Error& error) {  // must not unwind through GDAL
    CPLError(CE_Failure, CPLE_AppDefined, "%s; %s", error.what(), error.advice().c_str());
  } catch (const std::exception& error) {  // no memory
    CPLError(CE_Failure, CPLE_OutOfMemory, "%s", error.what());
  }
  return nullptr;
}

template <int format>
void guard_format() {
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName(kFormats[format]);
  if (driver == nullptr) return;
  unchecked_open<format> = driver->pfnOpen;
  driver->pfnOpen = checked_open<format>;
}

}  // namespace

void guard_text_grids() {
  // Otherwise whole numbers would be integers, among which "nan" is 0.
  CPLSetConfigOption("AAIGRID_DATATYPE", "Float32");
  guard_format<0>();
  guard_format<1>();
}

}  // namespace terrabench
