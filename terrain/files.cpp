#include "terrain/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <xxhash.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <utility>

#include "terrain/error.h"
#include "terrain/machine_error.h"
#include "terrain/temporary_name.h"

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

namespace {

MachineError cannot_write(const std::filesystem::path& path, int error) {
  return MachineError(fmt::format("cannot write: {}", std::strerror(error)), path.string(),
                      error == ENOSPC ? "free some space on the disk, or choose another folder with --out"
                                      : "check the folder's permissions, or choose another with --out");
}

}  // namespace

NewFile::NewFile(const std::filesystem::path& name) {
  std::error_code error;
  // Renaming over a link would replace the link, and over a device remove the device.
  const bool link = std::filesystem::is_symlink(name, error);
  path_ = link ? std::filesystem::weakly_canonical(name, error) : name;
  error.clear();  // a new file has no status yet
  const auto status = std::filesystem::status(path_, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw MachineError("cannot write: it is a folder or a device", path_.string(), "name a file");
  }
  error.clear();
  if (path_.has_parent_path()) std::filesystem::create_directories(path_.parent_path(), error);
  if (error) throw cannot_write(path_, error.value());
  temporary_ = temporary_name(path_);
  descriptor_ = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor_ < 0) throw cannot_write(path_, errno);
}

NewFile::~NewFile() {
  if (descriptor_ >= 0) close(descriptor_);
  std::error_code ignored;
  if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
}

void NewFile::append(std::span<const std::byte> content) {
  for (std::size_t done = 0; done < content.size();) {
    const ssize_t written = write(descriptor_, content.data() + done, content.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw cannot_write(path_, errno);
    done += static_cast<std::size_t>(written);
  }
}

void NewFile::append(std::string_view content) {
  append(std::as_bytes(std::span(content.data(), content.size())));
}

void NewFile::keep() {
  // Opened anew, since a library may have put another file in its place.
  if (close(std::exchange(descriptor_, -1)) != 0) throw cannot_write(path_, errno);
  descriptor_ = open(temporary_.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) throw cannot_write(path_, errno);
  // A full disk may be reported only here.
  if (fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) throw cannot_write(path_, errno);
  if (close(std::exchange(descriptor_, -1)) != 0) throw cannot_write(path_, errno);
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) throw cannot_write(path_, errno);
  temporary_.clear();
}

}  // namespace terrabench
