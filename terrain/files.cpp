#include "terrain/files.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <fstream>

#include "terrain/error.h"
#include "terrain/new_file.h"

namespace terrabench {

std::string ByteSource::get_text() {
  const auto size = get<std::uint32_t>();
  if (size > left()) fail("a text is longer than the file");
  const std::byte* const text = take(size);
  return {reinterpret_cast<const char*>(text), size};
}

const std::byte* ByteSource::take(std::size_t size) {
  if (size > left()) fail("the file ends too early");
  const std::byte* const at = bytes_.data() + position_;
  position_ += size;
  return at;
}

void ByteSource::fail(std::string_view what) const {
  throw bad_input(fmt::format("{} (at byte {})", what, position_), origin_,
                  "the file is damaged or was cut short: make it again from its source");
}

void write_file(const std::filesystem::path& path, std::span<const std::byte> content) {
  NewFile file(path);
  file.append(content);
  file.keep();
}

void write_file(const std::filesystem::path& path, std::string_view content) {
  write_file(path, std::as_bytes(std::span(content.data(), content.size())));
}

std::string read_file(const std::filesystem::path& path, std::uint64_t limit) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (error || !std::filesystem::exists(status))
    throw bad_input("no such file", path.string(), "check the path");
  if (!std::filesystem::is_regular_file(status)) {
    throw bad_input("is not a regular file", path.string(), "name a file");
  }
  const std::uint64_t size = std::filesystem::file_size(path, error);
  if (error || size > limit) {
    throw bad_input(fmt::format("is larger than {} bytes", limit), path.string(),
                    "check the path: files of this kind are smaller");
  }
  std::ifstream in(path, std::ios::binary);
  std::string content(size, '\0');
  if (!in || !in.read(content.data(), static_cast<std::streamsize>(size))) {
    throw bad_input("cannot be read", path.string(), "check the file's permissions");
  }
  return content;
}

std::string checksum(std::span<const std::byte> bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::string checksum(std::string_view text) {
  return checksum(std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace terrabench
