// Files of visibility changes, text and bytes: any input is refused with an Error, or is a table that both
// forms bring back.
#include <cstdlib>
#include <string>
#include <string_view>

#include "lod/mrbsp/visibility_binary.h"
#include "lod/mrbsp/visibility_text.h"
#include "lod/mrbsp/visible_flags.h"
#include "terrain/error.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace terrabench;

void require(bool good) {
  if (!good) std::abort();
}

void take(const VisibilityTable& table) {
  ByteSink file;
  save_visibility(table, file);
  require(load_visibility(file.bytes(), "fuzz") == table);
  require(parse_visibility(visibility_text(table), "fuzz") == table);
  VisibleFlags flags(table);
  flags.move_to(table, {table.cells.columns - 1, table.cells.rows - 1});
}

// With the checksum that belongs to the bytes, or nothing behind it would ever be read.
std::vector<std::byte> sealed(std::span<const std::byte> content) {
  std::vector<std::byte> file(content.begin(), content.end());
  for (const char c : checksum(content)) file.push_back(static_cast<std::byte>(c));
  return file;
}

VisibilityTable some_table(int columns, int rows) {
  VisibleSets sets({columns, rows, 4}, 5, 1.8F);
  sets.surface.fill('7');
  for (int cell = 0; cell < sets.cells.count(); ++cell) {
    for (std::uint32_t e = 0; e < 32; ++e) {
      if ((cell * 7 + static_cast<int>(e) * 5) % 11 < 4) sets.add(cell, e);
    }
  }
  return changes_of(sets);
}

}  // namespace

// The first byte says which form follows.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  try {
    if (data[0] % 2 == 0) {
      take(parse_visibility({reinterpret_cast<const char*>(data + 1), size - 1}, "fuzz"));
    } else {
      take(load_visibility(sealed({reinterpret_cast<const std::byte*>(data + 1), size - 1}), "fuzz"));
    }
  } catch (const Error&) {
  }
  return 0;
}

std::vector<std::vector<std::uint8_t>> fuzz_seeds() {
  std::vector<std::vector<std::uint8_t>> seeds;
  for (const VisibilityTable& table : {some_table(8, 1), some_table(3, 4)}) {
    std::vector<std::uint8_t>& text = seeds.emplace_back(1, std::uint8_t{0});
    const std::string words = visibility_text(table);
    text.insert(text.end(), words.begin(), words.end());
    ByteSink file;
    save_visibility(table, file);
    constexpr std::size_t kChecksum = 32;  // sealed() writes its own
    std::vector<std::uint8_t>& bytes = seeds.emplace_back(1, std::uint8_t{1});
    for (const std::byte b : file.bytes().first(file.bytes().size() - kChecksum)) {
      bytes.push_back(static_cast<std::uint8_t>(b));
    }
  }
  return seeds;
}
