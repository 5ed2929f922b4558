#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "lod/mrbsp/visibility/codec.h"
#include "terrain/error.h"

namespace terrabench::mrbsp::visibility {
namespace {

constexpr std::array<char, 8> kMagic = {'T', 'e', 'r', 'r', 'a', 'V', 'i', 's'};
constexpr std::uint32_t kVersion = 3;
constexpr std::size_t kChecksumBytes = 32;
constexpr std::uint64_t kLargestFile = std::uint64_t{1} << 30;

// Seven bits per byte, low bits first; the eighth bit is set if more bytes follow.
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
    if (e >= std::uint64_t{1} << depth) in.fail("a triangle's number is too large");
    out.push_back(static_cast<std::uint32_t>(e));
    next = e + 1;
  }
}

void put_lists(const ChangeTable& table, ByteSink& out) {
  put_list(out, table.start);
  for (int step = 0; step < table.steps(); ++step) put_list(out, table.step(step));
}

}  // namespace

void encode_binary(const ChangeTable& table, ByteSink& out) {
  ByteSink file;
  file.put(kMagic);
  file.put(kVersion);
  file.put(static_cast<std::int32_t>(table.cells.columns));
  file.put(static_cast<std::int32_t>(table.cells.rows));
  file.put(static_cast<std::int32_t>(table.cells.side));
  file.put(static_cast<std::int32_t>(table.depth));
  file.put(table.eye_height);
  file.put(table.ground);
  file.put(static_cast<std::uint8_t>(table.mode));
  put_lists(table, file);
  const std::string sum = checksum(file.bytes());
  file.put_array(std::span<const char>(sum));
  out.put_array(file.bytes());
}

ChangeTable decode_binary(std::span<const std::byte> file, const std::string& origin) {
  ByteSource whole(file, origin);
  if (whole.left() < kMagic.size() || whole.get<std::array<char, 8>>() != kMagic) {
    throw bad_input("not a file of visibility changes", origin, "give a file that terrabench wrote");
  }
  if (whole.left() < kChecksumBytes) whole.fail("the file ends too early");
  const auto content = file.first(file.size() - kChecksumBytes);
  const std::string sum = checksum(content);
  if (!std::equal(sum.begin(), sum.end(), reinterpret_cast<const char*>(file.data()) + content.size())) {
    whole.fail("the checksum does not match the content");
  }
  ByteSource in(content, origin);
  (void)in.get<std::array<char, 8>>();
  if (const auto version = in.get<std::uint32_t>(); version != kVersion) {
    in.fail(fmt::format("the format's version must be {}, got {}", kVersion, version));
  }
  ChangeTable table;
  table.cells.columns = in.get<std::int32_t>();
  table.cells.rows = in.get<std::int32_t>();
  table.cells.side = in.get<std::int32_t>();
  table.depth = in.get<std::int32_t>();
  table.eye_height = in.get<float>();
  table.ground = in.get<GroundChecksum>();
  if (const std::string_view error = header_error(table); !error.empty()) in.fail(error);
  const auto mode = in.get<std::uint8_t>();
  if (mode >= kModeNames.size()) in.fail("the kind of sets is unknown");
  table.mode = static_cast<Mode>(mode);
  get_list(in, table.depth, table.start);
  // A step takes at least one byte; checked here so that a short file cannot request much memory.
  if (static_cast<std::size_t>(table.steps()) > in.left()) in.fail("the file ends too early");
  table.first.reserve(static_cast<std::size_t>(table.steps()) + 1);
  table.first.push_back(0);
  for (int step = 0; step < table.steps(); ++step) {
    get_list(in, table.depth, table.changes);
    table.first.push_back(static_cast<std::uint32_t>(table.changes.size()));
  }
  if (in.left() > 0) in.fail("bytes are left over after the changes");
  if (!is_consistent(table)) in.fail("the changes around a corner of four cells do not cancel out");
  return table;
}

EncodedSizes encoded_sizes(const ChangeTable& table) {
  EncodedSizes bytes;
  ByteSink changes, lists;
  put_lists(table, changes);
  bytes.changes = changes.bytes().size();
  const Sets sets = sets_of(table);
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

namespace {

// In what a loaded table differs from the one that the options give; empty if in nothing.
std::string difference(const ChangeTable& table, const GroundGrid& ground, const BisectionTree& tree,
                       const Options& options) {
  if (table.ground != ground_checksum(ground, tree)) return "other ground or another depth of the tree";
  if (table.mode != options.mode) {
    return fmt::format("{} sets, not {}", name_of(table.mode), name_of(options.mode));
  }
  const Layout layout = layout_of(ground, tree, options);
  if (table.cells != layout.cells) return "other cells";
  if (table.depth != layout.depth) return "another coarseness";
  if (table.eye_height != options.eye_height) return "another eye height";
  return {};
}

}  // namespace

void save_file(const std::filesystem::path& path, const ChangeTable& table) {
  if (path.extension() == ".txt") {
    const std::string text = encode_text(table);
    if (text.size() > kLargestFile) {
      throw usage_error("the visibility as text exceeds 1 GiB", path.string(),
                        "give a name that does not end in .txt, or choose fewer cells");
    }
    write_file(path, text);
    return;
  }
  ByteSink file;
  encode_binary(table, file);
  write_file(path, file.bytes());
}

ChangeTable load_file(const std::filesystem::path& path) {
  const std::string file = read_file(path, kLargestFile);
  if (path.extension() == ".txt") return decode_text(file, path.string());
  return decode_binary(std::as_bytes(std::span(file)), path.string());
}

ChangeTable load_or_find(const std::filesystem::path& path, const GroundGrid& ground,
                         const BisectionTree& tree, const Options& options, Progress& progress) {
  std::error_code error;
  const bool there = std::filesystem::exists(path, error);
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  // Checked before the sets are computed, which takes long.
  if (error || (!there && !std::filesystem::is_directory(folder, error))) {
    throw environment_error("the folder does not exist or cannot be read", folder.string(),
                            "create it, or name a file in another folder");
  }
  if (!there) {
    ChangeTable table = changes_of(find_sets(ground, tree, options, progress));
    save_file(path, table);
    return table;
  }
  ChangeTable table = load_file(path);
  if (const std::string what = difference(table, ground, tree, options); !what.empty()) {
    throw usage_error(fmt::format("the file does not fit: it has {}", what), path.string(),
                      "name another file, or remove this one so that it is computed again");
  }
  return table;
}

}  // namespace terrabench::mrbsp::visibility
