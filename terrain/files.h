// Files and byte streams: a file is written whole or not at all, and no read goes past the end.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace terrabench {

static_assert(std::endian::native == std::endian::little,
              "file forms are little-endian and written as they lie in memory");

// Collects the bytes that a structure saves.
class ByteSink {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    append(&value, sizeof value);
  }
  template <class T>
  void put_array(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    append(values.data(), values.size_bytes());
  }
  void put_text(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size()));
    append(text.data(), text.size());
  }
  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  void append(const void* data, std::size_t size) {
    const auto* first = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), first, first + size);
  }
  std::vector<std::byte> bytes_;
};

// Reads the bytes that a structure saved. Every read is checked: one past the end throws bad_input with
// `origin` and the offset.
class ByteSource {
 public:
  ByteSource(std::span<const std::byte> bytes, std::string origin)
      : bytes_(bytes), origin_(std::move(origin)) {}

  template <class T>
  T get() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value;
    std::memcpy(&value, take(sizeof value), sizeof value);
    return value;
  }
  // The count is checked against what is left before anything is allocated.
  template <class T>
  std::vector<T> get_array(std::uint64_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (count > left() / sizeof(T)) fail("an array is longer than the file");
    std::vector<T> values(static_cast<std::size_t>(count));
    if (count > 0) std::memcpy(values.data(), take(values.size() * sizeof(T)), values.size() * sizeof(T));
    return values;
  }
  std::string get_text();
  std::size_t left() const { return bytes_.size() - position_; }
  const std::string& origin() const { return origin_; }
  // Throws bad_input(what) with the current offset: for impossible values.
  [[noreturn]] void fail(std::string_view what) const;

 private:
  const std::byte* take(std::size_t size);

  std::span<const std::byte> bytes_;
  std::string origin_;
  std::size_t position_ = 0;
};

// Writes to a temporary name in the same folder, syncs, then renames: the file is the old one or the whole
// new one. Creates the folder. Throws environment_error (unwritable, disk full), with nothing left behind.
void write_file(const std::filesystem::path&, std::string_view content);
void write_file(const std::filesystem::path&, std::span<const std::byte> content);

// Whole files. Throws bad_input when the file cannot be read or is larger than `limit` bytes.
std::string read_file(const std::filesystem::path&, std::uint64_t limit = std::uint64_t{1} << 36);

// XXH3-128 of the bytes as 32 hex digits.
std::string checksum(std::span<const std::byte>);
std::string checksum(std::string_view);

// A file that appears whole or not at all: written under a temporary name in the same folder, synced, then
// renamed. An older file of that name stays until then.

class NewFile {
 public:
  // Creates the folder and the empty temporary file, and removes those that killed processes left. A link
  // stays a link: its target is replaced. Throws environment_error when the name is that of a folder or a
  // device, or cannot be written. So do all others.
  explicit NewFile(const std::filesystem::path& name);
  // Removes the temporary file unless keep() was called.
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  void append(std::span<const std::byte> content);
  void append(std::string_view content);
  // For libraries that open files by name, instead of append(). They must have closed it before keep().
  const std::filesystem::path& temporary() const { return temporary_; }
  void keep();

 private:
  std::filesystem::path path_, temporary_;
  int descriptor_ = -1;
};

}  // namespace terrabench
