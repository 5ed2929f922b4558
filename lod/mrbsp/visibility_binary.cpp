#include "lod/mrbsp/visibility_binary.h"

#include <algorithm>
#include <array>

#include "terrain/error.h"

namespace terrabench {
namespace {

constexpr std::array<char, 8> kMagic = {'T', 'e', 'r', 'r', 'a', 'V', 'i', 's'};
constexpr std::uint32_t kVersion = 2;
constexpr std::size_t kChecksum = 32;

// Seven bits a byte, low ones first, the eighth set when more follow.
void put_number(ByteSink& out, std::uint32_t number) {
  for (; number >= 0x80; number >>= 7) out.put(static_cast<std::uint8_t>(number | 0x80));
  out.put(static_cast<std::uint8_t>(number));
}

std::uint32_t get_number(ByteSource& in) {
  std::uint64_t number = 0;
  for (int shift = 0; shift < 35; shift += 7) {
    const auto byte = in.get<std::uint8_t>();
    number |= static_cast<std::uint64_t>(byte & 0x7F) << shift;
    if (byte < 0x80) {
      if (number > 0xFFFFFFFFU || (byte == 0 && shift > 0)) break;
      return static_cast<std::uint32_t>(number);
    }
  }
  in.fail("a number is too long");
}

void put_list(ByteSink& out, std::span<const std::uint32_t> elements) {
  put_number(out, static_cast<std::uint32_t>(elements.size()));
  std::uint32_t next = 0;
  for (const std::uint32_t e : elements) {
    put_number(out, e - next);
    next = e + 1;
  }
}

void get_list(ByteSource& in, int depth, std::vector<std::uint32_t>& out) {
  const std::uint32_t count = get_number(in);
  if (count > in.left()) in.fail("a list is longer than the file");
  std::uint64_t next = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint64_t e = next + get_number(in);
    if (e >= std::uint64_t{1} << depth) in.fail("a triangle's number cannot be");
    out.push_back(static_cast<std::uint32_t>(e));
    next = e + 1;
  }
}

void put_lists(const VisibilityTable& table, ByteSink& out) {
  put_list(out, table.start);
  for (int step = 0; step < table.steps(); ++step) put_list(out, table.step(step));
}

}  // namespace

void save_visibility(const VisibilityTable& table, ByteSink& out) {
  ByteSink file;
  file.put(kMagic);
  file.put(kVersion);
  file.put(static_cast<std::int32_t>(table.cells.columns));
  file.put(static_cast<std::int32_t>(table.cells.rows));
  file.put(static_cast<std::int32_t>(table.cells.side));
  file.put(static_cast<std::int32_t>(table.depth));
  file.put(table.eye_height);
  file.put(table.surface);
  file.put(static_cast<std::uint8_t>(table.conservative));
  put_lists(table, file);
  const std::string sum = checksum(file.bytes());
  file.put_array(std::span<const char>(sum));
  out.put_array(file.bytes());
}

VisibilityTable load_visibility(std::span<const std::byte> file, const std::string& origin) {
  ByteSource whole(file, origin);
  if (whole.left() < kMagic.size() || whole.get<std::array<char, 8>>() != kMagic) {
    throw bad_input("is no file of visibility changes", origin, "give a file that terrabench wrote");
  }
  if (whole.left() < kChecksum) whole.fail("the file ends too early");
  const auto content = file.first(file.size() - kChecksum);
  const std::string sum = checksum(content);
  if (!std::equal(sum.begin(), sum.end(), reinterpret_cast<const char*>(file.data()) + content.size())) {
    whole.fail("the checksum does not fit the content");
  }
  ByteSource in(content, origin);
  (void)in.get<std::array<char, 8>>();
  if (in.get<std::uint32_t>() != kVersion) in.fail("the format's version is another");
  VisibilityTable table;
  table.cells.columns = in.get<std::int32_t>();
  table.cells.rows = in.get<std::int32_t>();
  table.cells.side = in.get<std::int32_t>();
  table.depth = in.get<std::int32_t>();
  table.eye_height = in.get<float>();
  table.surface = in.get<SurfaceChecksum>();
  if (const std::string_view fault = head_fault(table); !fault.empty()) in.fail(fault);
  const auto conservative = in.get<std::uint8_t>();
  if (conservative > 1) in.fail("the kind of sets cannot be");
  table.conservative = conservative == 1;
  get_list(in, table.depth, table.start);
  // A step takes a byte at least, so that a short file cannot ask for many.
  if (static_cast<std::size_t>(table.steps()) > in.left()) in.fail("the file ends too early");
  table.first.reserve(static_cast<std::size_t>(table.steps()) + 1);
  table.first.push_back(0);
  for (int step = 0; step < table.steps(); ++step) {
    get_list(in, table.depth, table.changes);
    table.first.push_back(static_cast<std::uint32_t>(table.changes.size()));
  }
  if (in.left() > 0) in.fail("bytes are left over after the changes");
  if (!is_consistent(table)) in.fail("the changes around a corner of cells do not cancel out");
  return table;
}

VisibilityBytes visibility_bytes(const VisibilityTable& table) {
  VisibilityBytes bytes;
  ByteSink changes, lists;
  put_lists(table, changes);
  bytes.changes = changes.bytes().size();
  const VisibleSets sets = sets_of(table);
  std::vector<std::uint32_t> list;
  for (int cell = 0; cell < sets.cells.count(); ++cell) {
    list.clear();
    for (std::uint32_t e = 0; e < 1U << sets.depth; ++e) {
      if (sets.sees(cell, e)) list.push_back(e);
    }
    put_list(lists, list);
  }
  bytes.lists = lists.bytes().size();
  bytes.bits = static_cast<std::size_t>(sets.cells.count()) * (((std::size_t{1} << sets.depth) + 7) / 8);
  return bytes;
}

}  // namespace terrabench
