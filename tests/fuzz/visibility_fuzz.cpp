// Decodes text and binary change tables: any input is refused with an Error or gives a table that both forms
// encode and decode without loss.
#include <cstdlib>
#include <string>
#include <string_view>

#include "lod/mrbsp/visibility/change_table.h"
#include "lod/mrbsp/visibility/codec.h"
#include "terrain/error.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace terrabench;
using namespace terrabench::mrbsp::visibility;

void require(bool good) {
  if (!good) std::abort();
}

void take(const ChangeTable& table) {
  ByteSink file;
  encode_binary(table, file);
  require(decode_binary(file.bytes(), "fuzz") == table);
  require(decode_text(encode_text(table), "fuzz") == table);
  Flags flags(table);
  flags.move_to(table, {table.cells.columns - 1, table.cells.rows - 1});
}

// Appends the valid checksum, so that decoding gets past it.
std::vector<std::byte> sealed(std::span<const std::byte> content) {
  std::vector<std::byte> file(content.begin(), content.end());
  for (const char c : checksum(content)) file.push_back(static_cast<std::byte>(c));
  return file;
}

ChangeTable some_table(int columns, int rows) {
  Sets sets({columns, rows, 4}, 5, 1.8F);
  sets.ground.fill('7');
  for (int cell = 0; cell < sets.cells.count(); ++cell) {
    for (std::uint32_t e = 0; e < 32; ++e) {
      if ((cell * 7 + static_cast<int>(e) * 5) % 11 < 4) sets.add(cell, e);
    }
  }
  return changes_of(sets);
}

}  // namespace

// The first byte selects the form of the rest.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  try {
    if (data[0] % 2 == 0) {
      take(decode_text({reinterpret_cast<const char*>(data + 1), size - 1}, "fuzz"));
    } else {
      take(decode_binary(sealed({reinterpret_cast<const std::byte*>(data + 1), size - 1}), "fuzz"));
    }
  } catch (const Error&) {
  }
  return 0;
}

FuzzSeeds fuzz_seeds() {
  FuzzSeeds seeds;
  for (const ChangeTable& table : {some_table(8, 1), some_table(3, 4)}) {
    std::vector<std::uint8_t>& text = seeds.emplace_back(1, std::uint8_t{0});
    const std::string words = encode_text(table);
    text.insert(text.end(), words.begin(), words.end());
    ByteSink file;
    encode_binary(table, file);
    constexpr std::size_t kChecksum = 32;  // sealed() appends its own
    std::vector<std::uint8_t>& bytes = seeds.emplace_back(1, std::uint8_t{1});
    for (const std::byte b : file.bytes().first(file.bytes().size() - kChecksum)) {
      bytes.push_back(static_cast<std::uint8_t>(b));
    }
  }
  return seeds;
}
