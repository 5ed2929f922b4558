#include "terrain/sources/dem/text_grid.h"

#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal_priv.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "terrain/error.h"

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

// As GDAL reads it: a decimal comma, a leading plus, "nan" and GRASS's "*" for no data are numbers.
bool is_number(std::string_view word) {
  if (word == "*") return true;
  std::string text = lower(word.substr(word.starts_with('+') ? 1 : 0));
  std::ranges::replace(text, ',', '.');
  if (text == "nan" || text == "-nan" || text == "inf" || text == "-inf" || text.starts_with("1.#"))
    return true;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error != std::errc::invalid_argument && end == text.data() + text.size();
}

// Follows the words of the file. The values begin after the last line that begins with a key.
class Scanner {
 public:
  explicit Scanner(std::string path) : path_(std::move(path)) {}

  void take(char c) {
    if (!is_space(c)) {
      if (word_.empty()) begin_ = column_;
      if (word_.size() < kLongestWord) word_ += c;
    } else if (!word_.empty()) {
      end_word();
    }
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
    if (first_ && !values_) {
      header_line_ = is_key(word_);
      values_ = !header_line_;
    }
    first_ = false;
    if (!header_line_ && !is_number(word_)) {
      throw bad_input(fmt::format("'{}' stands where a height should be", printable()),
                      fmt::format("{}:{}:{}", path_, line_, begin_),
                      "replace it by a number, or by the grid's no-data value");
    }
    word_.clear();
  }

 private:
  std::string printable() const {
    std::string text = word_;
    std::ranges::replace_if(
        text, [](unsigned char c) { return c < 0x20 || c >= 0x7F; }, '?');
    return text;
  }

  std::string path_, word_;
  std::uint64_t line_ = 1, column_ = 1, begin_ = 1;
  bool first_ = true;         // no word of this line has been read
  bool header_line_ = false;  // this line is one of the header's
  bool values_ = false;       // the header has ended
};

struct CloseFile {
  void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};

// Throws bad_input with line and column for the first word among the values that is no number. Reads the file
// once, in blocks.
void check_text_grid(const std::string& path) {
  const std::unique_ptr<VSILFILE, CloseFile> file(VSIFOpenL(path.c_str(), "rb"));
  if (file == nullptr) return;  // not a file of its own; the driver has opened it
  Scanner scanner(path);
  std::vector<char> block(kBlock);
  while (const std::size_t got = VSIFReadL(block.data(), 1, block.size(), file.get())) {
    for (std::size_t i = 0; i < got; ++i) scanner.take(block[i]);
  }
  scanner.end_word();
}

constexpr const char* kFormats[] = {"AAIGrid", "GRASSASCIIGrid"};

// GDAL does not tell the function which driver it is called for, so each format has its own.
using OpenFunction = GDALDataset* (*)(GDALOpenInfo*);
template <int format>
OpenFunction unchecked_open = nullptr;

template <int format>
GDALDataset* checked_open(GDALOpenInfo* info) {
  GDALDataset* const dataset = unchecked_open<format>(info);
  if (dataset == nullptr) return nullptr;
  try {
    check_text_grid(info->pszFilename);
    return dataset;
  } catch (const Error& error) {  // must not unwind through GDAL
    CPLError(CE_Failure, CPLE_AppDefined, "%s; %s", error.what(), error.advice().c_str());
  } catch (const std::exception& error) {  // no memory
    CPLError(CE_Failure, CPLE_OutOfMemory, "%s", error.what());
  }
  GDALClose(dataset);
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
  guard_format<0>();
  guard_format<1>();
}

}  // namespace terrabench
