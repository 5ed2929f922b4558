// The container: magic, format version, type name, whether the structure is encoded, sizes, the zstd frame,
// and XXH3-128 of everything before it. The checksum is verified before unpacking, so that a damaged file
// cannot make the program allocate.
#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "representations/representation.h"
#include "terrain/error.h"

namespace terrabench {
namespace {

constexpr std::array<char, 8> kMagic = {'T', 'e', 'r', 'r', 'a', 'R', 'e', 'p'};
constexpr std::uint32_t kVersion = 2;
constexpr int kLevel = 9;  // zstd level, the same for all methods
constexpr std::size_t kChecksum = 32;
constexpr std::size_t kNameBytes = 16;  // at least, so that equal content takes equal bytes
// A zstd block of 128 KiB takes at least 4 bytes: no valid file unpacks to more than this many times its
// size.
constexpr std::uint64_t kLargestRatio = 1 << 15;

std::vector<std::byte> compress(std::span<const std::byte> raw) {
  std::vector<std::byte> packed(ZSTD_compressBound(raw.size()));
  const std::size_t size = ZSTD_compress(packed.data(), packed.size(), raw.data(), raw.size(), kLevel);
  if (ZSTD_isError(size) != 0) throw std::bad_alloc();  // the only way left to fail
  packed.resize(size);
  return packed;
}

std::vector<std::byte> decompress(std::span<const std::byte> packed, std::uint64_t raw_size,
                                  const ByteSource& in) {
  if (raw_size / kLargestRatio > packed.size() || raw_size > available_memory() ||
      ZSTD_getFrameContentSize(packed.data(), packed.size()) != raw_size) {
    in.fail("the unpacked size is impossible");
  }
  std::vector<std::byte> raw(static_cast<std::size_t>(raw_size));
  const std::size_t size = ZSTD_decompress(raw.data(), raw.size(), packed.data(), packed.size());
  if (ZSTD_isError(size) != 0 || size != raw.size()) in.fail("the content cannot be unpacked");
  return raw;
}

}  // namespace

std::size_t save_representation(const std::filesystem::path& path, const RepresentationType& type,
                                const Representation& structure, std::optional<double> largest_error) {
  ByteSink raw, file;
  const bool encoded = largest_error && type.decode != nullptr && structure.encode(*largest_error, raw);
  if (!encoded) structure.save(raw);
  const std::vector<std::byte> packed = compress(raw.bytes());
  file.put(kMagic);
  file.put(kVersion);
  std::string name(type.name);
  name.resize(std::max(name.size(), kNameBytes), '\0');
  file.put_text(name);
  file.put(static_cast<std::uint8_t>(encoded));
  file.put(static_cast<std::uint64_t>(raw.bytes().size()));
  file.put(static_cast<std::uint64_t>(packed.size()));
  file.put_array(std::span<const std::byte>(packed));
  const std::string sum = checksum(file.bytes());
  file.put_array(std::span<const char>(sum));
  write_file(path, file.bytes());
  return file.bytes().size();
}

Loaded load_representation(std::span<const std::byte> file, const std::string& origin) {
  ByteSource in(file, origin);
  if (in.left() < kMagic.size() || in.get<std::array<char, 8>>() != kMagic) {
    throw bad_input("is not a saved representation", origin, "name a file that `terrabench represent` wrote");
  }
  if (const auto version = in.get<std::uint32_t>(); version != kVersion) {
    throw bad_input(fmt::format("has format version {}, this program reads {}", version, kVersion), origin,
                    "save it again with this version of terrabench");
  }
  if (in.left() < kChecksum) in.fail("the file ends too early");
  const auto content = file.first(file.size() - kChecksum);
  const std::string sum = checksum(content);
  if (!std::equal(sum.begin(), sum.end(), reinterpret_cast<const char*>(file.data()) + content.size())) {
    in.fail("the checksum does not match the content");
  }
  Loaded loaded;
  std::string name = in.get_text();
  name.resize(std::min(name.find('\0'), name.size()));
  const auto types = representations();
  const auto type = std::find_if(types.begin(), types.end(), [&](const auto& t) { return t.name == name; });
  if (type == types.end()) in.fail(fmt::format("unknown representation '{}'", name));
  loaded.type = &*type;
  const auto encoded = in.get<std::uint8_t>();
  if (encoded > (type->decode != nullptr ? 1 : 0)) in.fail("the structure's form is unknown");
  const auto raw_size = in.get<std::uint64_t>(), packed_size = in.get<std::uint64_t>();
  if (packed_size + kChecksum != in.left()) in.fail("the content's size does not match the file");
  const std::vector<std::byte> raw =
      decompress(content.last(static_cast<std::size_t>(packed_size)), raw_size, in);
  ByteSource structure(raw, origin);
  loaded.representation = encoded != 0 ? type->decode(structure) : type->load(structure);
  if (structure.left() > 0) structure.fail("bytes are left over after the structure");
  return loaded;
}

Loaded load_representation(const std::filesystem::path& path) {
  const std::string file = read_file(path);
  return load_representation(std::as_bytes(std::span(file)), path.string());
}

bool is_saved_representation(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::array<char, kMagic.size()> first{};
  return in.read(first.data(), first.size()) && first == kMagic;
}

}  // namespace terrabench
